// Whether what a game draws is closed, from the drawn mesh alone.
#pragma once
#include <string>

#include "cullet/view.hpp"

namespace cullet::test {

/// "" or a sentence on the first edge that is not run as often one way as the other, with equal positions taken as one.
/// It knows nothing of the shell, so that it also finds what our own check by numbers would share a mistake with.
std::string find_open_edge(const BodyView& view);

}  // namespace cullet::test
