// A car body of the test data, for those that have it.
#pragma once
#include <optional>
#include <string>

#include "cullet/model.hpp"

namespace cullet {

inline constexpr double kCarMass = 1000, kCarPressure = 0.2e6;  // kg; Pa, that crushes one

/// The folder of test data: given, or CULLET_TEST_DATA, or ../shared/data.
std::string metal_data_folder();
/// A generated body of 14,658 vertices, 4.4 m long along x, nose toward +x: an even mesh.
const Model& even_car();
Model even_car_of(const char* metal);
/// toycar_body_26k.ply, 3.8 m long along z, cooked with edges of at most 5 % of its diagonal; nothing where it is not
/// there. It is full of slivers. Both are of steel of 0.8 mm.
const std::optional<Model>& toy_car();

}  // namespace cullet
