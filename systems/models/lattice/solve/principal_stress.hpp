// Principal values of a symmetric tensor by arithmetic that is the same everywhere: no angles, no cube roots.
#pragma once
#include "engine/math.hpp"

namespace cullet {

struct PrincipalStress {
    double first = 0, second = 0, third = 0;  // descending, Pa
};
PrincipalStress principal_stress(const Sym3d& stress);
/// Unit direction of the first; of its two signs the one whose first component above 1e-6 is positive. Where first and
/// second are as good as equal it is one of their plane.
Vec3d first_direction(const Sym3d& stress, const PrincipalStress& principal);

}  // namespace cullet
