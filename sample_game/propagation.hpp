// The ways of Propagation by their names in scripts and options.
#pragma once
#include <string>

#include "cullet/model.hpp"

namespace cullet {

inline constexpr const char* kPropagations = "guarded_front, front, single_vertex or single_vertex_tets";

const char* name_of(Propagation way);
/// False: there is no such way, and `way` stays.
bool find_propagation(const std::string& name, Propagation& way);

}  // namespace cullet
