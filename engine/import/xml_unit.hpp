// The units of formats for printing, and of X3D.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "cullet/result.hpp"

namespace cullet {

/// In metres: micron, millimeter, centimeter, inch, foot, feet, meter, as 3MF and AMF write them.
std::optional<double> metres_of(std::string_view unit);

/// How long the unit of an AMF or X3D is, in metres. An AMF that names none is in millimetres, an X3D in metres.
Result<double> unit_of_xml(std::string_view bytes, const std::string& path);

}  // namespace cullet
