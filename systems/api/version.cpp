#include "cullet/version.hpp"

namespace cullet {

#define CULLET_TEXT_OF(number) #number
#define CULLET_TEXT(number) CULLET_TEXT_OF(number)
const char* version() {
    return CULLET_TEXT(CULLET_VERSION_MAJOR) "." CULLET_TEXT(CULLET_VERSION_MINOR) "." CULLET_TEXT(
        CULLET_VERSION_PATCH);
}
#undef CULLET_TEXT
#undef CULLET_TEXT_OF

}  // namespace cullet
