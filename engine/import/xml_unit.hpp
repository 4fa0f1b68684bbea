// The units of formats for printing, of X3D and of Collada.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cullet/result.hpp"

namespace cullet {

/// In metres: micron, millimeter, centimeter, inch, foot, feet, meter, as 3MF and AMF write them.
std::optional<double> metres_of(std::string_view unit);

/// Whether a number can be the length of a unit in metres: above 0 and below 1e12.
bool is_length(std::optional<double> metres);

/// What an AMF or X3D says of places, and assimp 5.2 does not see.
struct XmlPlaces {
    double metres = 1;    // how long its unit is; an AMF that names none is in millimetres, an X3D in metres
    uint64_t turned = 0;  // instances in constellations of an AMF that are turned
};

/// `text` as plain_xml() gives it. Blanks take the place of what turns an instance: assimp 5.2 moves it by that many
/// units instead.
Result<XmlPlaces> places_of_xml(std::string& text, const std::string& path);

}  // namespace cullet
