#include "tests/support/places.hpp"

namespace cullet {

std::string source_folder() { return CULLET_SOURCE_DIR; }
std::string build_folder() { return CULLET_BINARY_DIR; }
std::string compiler() { return CULLET_COMPILER; }

}  // namespace cullet
