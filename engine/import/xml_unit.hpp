// The units of formats for printing, of X3D and of Collada.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "cullet/result.hpp"

namespace cullet {

/// In metres: micron, millimeter, centimeter, inch, foot, feet, meter, as 3MF and AMF write them.
std::optional<double> metres_of(std::string_view unit);

/// Whether a number can be the length of a unit in metres: above 0 and below 1e12.
bool is_length(std::optional<double> metres);

/// How long the unit of an AMF or X3D is, in metres. An AMF that names none is in millimetres, an X3D in metres.
Result<double> unit_of_xml(std::string_view bytes, const std::string& path);

}  // namespace cullet
