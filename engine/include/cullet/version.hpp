// Which cullet this is.
#pragma once

#define CULLET_VERSION_MAJOR 0
#define CULLET_VERSION_MINOR 1
#define CULLET_VERSION_PATCH 0

namespace cullet {
/// "0.1.0", of the library that is linked; compare with the macros above to find a header that does not fit.
const char* version();
}  // namespace cullet
