// Vertices, elements and hinges: what thick shells are made of, and sheet metal.
#pragma once
#include "systems/models.hpp"

namespace cullet {

SlotList shell_structure();

}  // namespace cullet
