#include "systems/models/lattice/crack/blow.hpp"

#include <algorithm>
#include <numbers>

namespace cullet {
namespace {

constexpr double kShortest = 1e-6;   // s, of a contact
constexpr double kPatchEdges = 1.2;  // of the lattice's edge
constexpr double kPatchSize = 0.24;  // of the cube root of the volume
constexpr double kCrackSpeed = 0.4;  // of the speed of sound along a rod
constexpr double kCrackWay = 1.5;    // of the cube root of the volume

}  // namespace

double power(double x, double y) {
    return x > 0 ? exponential(y * logarithm(x)) : 0;
}

HertzContact hertz_contact(const SolidBlow& blow, const ElasticSolid& body) {
    const auto compliance = [](const ElasticSolid& e) { return (1 - e.poisson * e.poisson) / e.young; };
    const double modulus = 1 / (compliance(blow.striker) + compliance(body));
    HertzContact contact;
    if (!(blow.speed > 0) || !(blow.effective_mass > 0)) return contact;
    const double m = blow.effective_mass;
    contact.duration = 2.868 * power(m * m / (modulus * modulus * blow.radius * blow.speed), 0.2);
    contact.duration = std::clamp(contact.duration, kShortest, blow.longest);
    contact.force = 1.84 * 2 * m * blow.speed / contact.duration;
    contact.radius = std::sqrt(blow.radius * (blow.speed * contact.duration / 2.943));
    return contact;
}

double patch_radius(const HertzContact& contact, const BrittleSolid& brittle, double edge, double volume) {
    const double crushed = std::sqrt(contact.force / (2 * std::numbers::pi * brittle.compressive_strength));
    return std::max({contact.radius, crushed, kPatchEdges * edge, kPatchSize * power(volume, 1.0 / 3)});
}

double force_share(double brought, double strain_energy) {
    return std::sqrt(brought / (brought + strain_energy));
}

Vec3d SolidBlast::impulse(Vec3d place, Vec3d normal, double area) const {
    const Vec3d away = place - centre;
    const double distance = length(away);
    if (!(distance < radius) || !(distance > 0)) return {};
    const double facing = dot(normal, away) / distance, left = 1 - distance / radius;
    return facing < 0 ? (strength * left * left * facing * area) * normal : Vec3d{};
}

double load_share(double ratio, double duration, double volume, const BrittleSolid& brittle) {
    if (!(ratio > 0)) return 0;
    const double sound = std::sqrt(brittle.elastic.young / brittle.density);
    const double running = kCrackWay * power(volume, 1.0 / 3) / (kCrackSpeed * sound);
    return std::min(1.0, 1 / ratio + 2 * running / duration);
}

}  // namespace cullet
