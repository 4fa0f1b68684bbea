#include "systems/structures/tetrahedra/cook/exact.hpp"

namespace cullet {

double exact_determinant(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
    __extension__ using Wide = __int128;
    const auto apart = [](double p, double q) { return static_cast<int64_t>(p) - static_cast<int64_t>(q); };
    const int64_t bx = apart(b.x, a.x), by = apart(b.y, a.y), bz = apart(b.z, a.z);
    const int64_t cx = apart(c.x, a.x), cy = apart(c.y, a.y), cz = apart(c.z, a.z);
    const int64_t dx = apart(d.x, a.x), dy = apart(d.y, a.y), dz = apart(d.z, a.z);
    const Wide sum = static_cast<Wide>(dx) * (by * cz - bz * cy) + static_cast<Wide>(dy) * (bz * cx - bx * cz) +
                     static_cast<Wide>(dz) * (bx * cy - by * cx);
    return static_cast<double>(sum);
}

}  // namespace cullet
