#include "systems/models/metal_shell/dent/feel.hpp"

#include <numbers>

#include "systems/bodies/blows.hpp"
#include "systems/models/metal_shell/dent/dent.hpp"

namespace cullet::metal_shell {
namespace {

constexpr double kLeastFold = 0.1;    // of the thickness
constexpr float kFlatContact = 0.2f;  // of half of the box diagonal
constexpr double kSameWay = 0.9;      // cosine of pushes of one impact

double energy_of(const Bodies& bodies, const Knock& knock) {
    const double inverse_mass =
        inverse_mass_at(bodies, knock.body, knock.point, knock.push) + knock.striker_inverse_mass;
    return inverse_mass > 0 ? 0.5 * knock.speed * knock.speed / inverse_mass : 0;
}

void remember(MetalRows rows, const Knock& knock, double energy, const Earlier& earlier) {
    MetalImpacts& impacts = rows.metal_impacts;
    impacts.reach(knock.body + 1);
    const Row<Bodies> b = knock.body;
    impacts.frame[b] = knock.frame;
    impacts.energy[b] = energy;
    if (earlier.goes_on) return;
    impacts.seconds[b] = kLeastSeconds;
    impacts.has_shape[b] = 0;
    impacts.striker[b] = knock.striker;
    impacts.shape[b] = static_cast<uint8_t>(knock.radius > 0 ? StrikerShape::Sphere : StrikerShape::Plane);
    impacts.point.set(b, knock.point.to_float());
    impacts.push.set(b, knock.push.to_float());
    impacts.radius[b] = static_cast<float>(knock.radius);
    impacts.contact[b] = least_contact(rows, rows.bodies.structure[b], knock.radius > 0);
}

}  // namespace

Earlier earlier_of(const MetalImpacts& impacts, const Knock& knock) {
    Earlier found;
    const Row<Bodies> b = knock.body;
    if (b >= impacts.size() || !(impacts.seconds[b] > 0) || impacts.striker[b] != knock.striker) return found;
    if (knock.frame < impacts.frame[b]) return found;
    const float since = static_cast<float>(knock.frame - impacts.frame[b]) * knock.step_seconds;
    if (since > impacts.seconds[b] + 0.5f * knock.step_seconds) return found;
    const Vec3d push(impacts.push[b]);
    const bool is_round = impacts.radius[b] > 0;
    if (dot(push, knock.push) < kSameWay || is_round != (knock.radius > 0)) return found;
    const Vec3d away = knock.point - Vec3d(impacts.point[b]);
    const double aside = length(away - dot(away, push) * push);
    if (aside > std::max(double{impacts.contact[b]}, 0.25 * double{impacts.radius[b]})) return found;
    found.goes_on = true;
    found.has_shape = impacts.has_shape[b];
    found.energy = impacts.energy[b];
    return found;
}

float least_contact(MetalSizes rows, Row<Structures> structure, bool is_round) {
    return is_round ? 0 : kFlatContact * rows.metal_shells.half_diagonal[metal_of(rows, structure)];
}

double least_energy(const MetalView& view) {
    const SheetMetal metal = sheet_metal(view);
    return std::numbers::pi * metal.yield_stress * metal.thickness * metal.thickness * kLeastFold * metal.thickness;
}

bool leaves_nothing(MetalRows rows, const Knock& knock, float& bounce) {
    const Row<Structures> structure = rows.bodies.structure[knock.body];
    if (!metal_of(rows, structure).exists()) return false;
    const MetalView metal(rows, structure);
    const Earlier earlier = earlier_of(rows.metal_impacts, knock);
    const double energy = energy_of(rows.bodies, knock) + earlier.energy;
    const bool is_weak = !(energy > least_energy(metal));
    bounce = 0;
    if (!is_weak) {
        Striker striker;
        striker.shape = knock.radius > 0 ? StrikerShape::Sphere : StrikerShape::Plane;
        striker.point = knock.point, striker.push = knock.push, striker.radius = knock.radius;
        if (!is_elastic(metal, striker, energy)) return false;
        bounce = static_cast<float>(kMostBounce);
    }
    if (knock.is_sure) remember(rows, knock, energy, earlier);
    return true;
}

}  // namespace cullet::metal_shell
