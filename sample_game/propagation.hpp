// The ways of Propagation by their names in scripts and options.
#pragma once
#include <string>

#include "cullet/model.hpp"

namespace cullet {

std::string name_of(Propagation way);

}  // namespace cullet
