#include "systems/structures/tetrahedra/part_by_load.hpp"

#include "engine/random.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

constexpr float kAskew = 0.15f;  // of the plane, each way

}  // namespace

bool part_solid_by_load(Read<All<SolidRows, Bodies>> rows, Blows& blows, Row<Bodies> body,
                        const LoadedSection& section) {
    if (!has_row_for_cut(blows)) return false;
    const Vec3 place = section.place;
    const Random random{section.seed};
    const auto aside = [&](uint32_t i) { return kAskew * static_cast<float>(2 * random.uniform(i) - 1); };
    const Vec3 across = normalised(section.normal + Vec3{aside(0), aside(1), aside(2)});
    SectionExtent along;
    const Range points = skin_of(rows, rows.bodies.structure[body]).points;
    for (uint32_t p = points.first; p < points.first + points.count; ++p)
        along.add(dot(across, rows.skin_points.place[p].to_float()));
    const uint32_t row = along.size() > 0 ? append_cut(blows, body) : kNone;
    if (row == kNone) return false;
    const float at = dot(across, place);
    blows.point.set(row, place + (kept_between(along, at) - at) * across);
    blows.direction.set(row, across);
    return true;
}

}  // namespace cullet
