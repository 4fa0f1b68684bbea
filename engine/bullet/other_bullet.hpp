// Whether some other Bullet in the process takes the names of ours, or ours those of another.
#pragma once
#include <string>

namespace cullet::bullet {

/// Empty, or a sentence that names the libraries. Shared libraries find each other by the names of functions, and both
/// precisions of Bullet have the same: whichever was linked first answers for both. What was linked hidden, or loaded
/// with RTLD_LOCAL and RTLD_DEEPBIND, keeps to itself and is no trouble. Looks at all loaded libraries.
std::string other_bullet();

}  // namespace cullet::bullet
