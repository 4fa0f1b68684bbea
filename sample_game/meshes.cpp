#include "sample_game/meshes.hpp"
