#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Of the hinges of a sheet whose material has a bending stiffness of its own (bend_sheets.cpp), J; 0 for others.
double sheet_energy(const BentView& view);

}  // namespace cullet
