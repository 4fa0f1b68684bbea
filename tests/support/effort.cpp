#include "tests/support/effort.hpp"

#include <cstdlib>

namespace cullet::test {

bool plays_all() {
    const char* wanted = std::getenv("CULLET_ALL_TESTS");
    return wanted && std::atoi(wanted) != 0;
}

}  // namespace cullet::test
