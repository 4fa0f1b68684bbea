// What this machine does with the bare work that a frame's budget is counted in, measured now and here.
#pragma once
#include <map>
#include <string>

#include "cullet/model.hpp"

namespace cullet {

/// unit_ns: nanoseconds of a unit on one thread, as a fifth of a vertex through one bare hidden step of this model:
/// the kernel alone, least of many. Takes some 20 ms.
std::map<std::string, double> measure_yardsticks(const Model& model);

}  // namespace cullet
