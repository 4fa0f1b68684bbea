// The verification cases of metal shells (metal shell note, section 15), and of the dents beside FEM.
#pragma once
#include "sample_game/truth_cases.hpp"

namespace cullet {

// truth_published.cpp
std::vector<Verdict> metal_bounce();
std::vector<Verdict> metal_single_cell();
std::vector<Verdict> metal_strain_limit();
// truth_cells.cpp
std::vector<Verdict> metal_face_distance();
std::vector<Verdict> metal_square();
// truth_dents.cpp
std::vector<Verdict> metal_depth();
std::vector<Verdict> metal_obstacle();
std::vector<Verdict> metal_fifty_hits();
// truth_crash.cpp: no figures without the car of the test data
std::vector<Verdict> metal_one_crash();
std::vector<Verdict> metal_fifty_crashes();
std::vector<Verdict> metal_momentum();
std::vector<Verdict> metal_car_at_a_wall();
// truth_metal.cpp: no figures without the curves
std::vector<Verdict> metal_beside_fem();

}  // namespace cullet
