// Vertices, elements and hinges: what thick shells are made of, and sheet metal.
#pragma once
#include "systems/slots.hpp"

namespace cullet {

SlotList shell_structure();

}  // namespace cullet
