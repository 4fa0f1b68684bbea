#include "systems/births/settle_momenta.hpp"

#include <algorithm>
#include <cmath>

#include "systems/births/part_motion.hpp"
#include "systems/births/stop_approach.hpp"

namespace cullet {
namespace {

// I^-1 L; zero for a part so thin that its inertia has no inverse in double, which only lowers the energy.
Vec3d spin_of(const Fragments& f, uint32_t row) {
    if (!can_turn(f.inertia[row])) return {};
    return inverse(f.inertia[row]) * f.turning[row];
}

bool is_moving(const Fragments& f, uint32_t row) {
    return !f.has_pins[row] && f.moving_mass[row] > 0;
}

double energy_of(const Fragments& f, uint32_t row) {
    if (!is_moving(f, row)) return 0;
    const Vec3d momentum = f.momentum[row], spin = f.spin[row];
    return dot(momentum, momentum) / (2 * f.moving_mass[row]) + dot(spin, f.inertia[row] * spin) / 2;
}

// As free bodies, each by itself.
HandoffReport free_motions(Fragments& f, Rows<Fragments> of) {
    HandoffReport report;
    report.largest = heaviest_of(f, of);
    for (const Row<Fragments> row : of) {
        report.energy_hidden += f.hidden_energy[row];
        report.momentum_before += f.momentum[row];
        if (f.has_pins[row]) {
            report.support_momentum += f.momentum[row];
            f.momentum.set(row, {});
        } else {
            f.spin.set(row, spin_of(f, row));
        }
        f.free_momentum.set(row, f.momentum[row]);
        f.free_spin.set(row, f.spin[row]);
        report.energy_unclamped += energy_of(f, row);
    }
    return report;
}

// How far the motions may go towards those of `parts`: 1 as a rule, less where they have more energy than before (see
// stop_approach). Energy is a quadratic of the share, a s^2 + 2 b s more than before.
double share_within_energy(std::span<const Touching> parts, const Fragments& f, Rows<Fragments> of) {
    double a = 0, b = 0;
    for (const Row<Fragments> row : of) {
        const Touching& part = parts[row - of.first];
        if (!(part.inverse_mass > 0)) continue;
        const double mass = f.moving_mass[row];
        const Vec3d momentum = f.momentum[row], spin = f.spin[row];
        const Vec3d impulse = mass * part.velocity - momentum, turned = part.spin - spin;
        a += dot(impulse, impulse) / (2 * mass) + dot(turned, f.inertia[row] * turned) / 2;
        b += (dot(momentum, impulse) / mass + dot(spin, f.inertia[row] * turned)) / 2;
    }
    return a + 2 * b > 0 ? std::clamp(-2 * b / a, 0.0, 1.0) : 1;
}

// What a static part takes goes to the support.
void part_cracks(Fragments& f, Rows<Fragments> of, Touches& touches, const HandoffStart& start, ScratchMemory& scratch,
                 HandoffReport& report) {
    const ScratchArray<Touching> parts(scratch, of.count);
    for (const Row<Fragments> row : of) {
        Touching& part = parts[row - of.first];
        part = {f.centre[row], {}, f.spin[row], 0, {}};
        f.crushed_energy[row] = energy_of(f, row);
        if (!is_moving(f, row)) continue;
        part.velocity = (1 / f.moving_mass[row]) * f.momentum[row];
        part.inverse_mass = 1 / f.moving_mass[row];
        if (can_turn(f.inertia[row])) part.inverse_inertia = inverse(f.inertia[row]);
    }
    stop_approach(parts.all(), of.first, touches, start.touches, start.impact_speed);
    const double share = share_within_energy(parts.all(), f, of);
    double energy = 0;
    for (const Row<Fragments> row : of) {
        const Touching& part = parts[row - of.first];
        if (part.inverse_mass > 0) {
            const Vec3d momentum = f.momentum[row], spin = f.spin[row];
            f.momentum.set(row, momentum + share * (f.moving_mass[row] * part.velocity - momentum));
            f.spin.set(row, spin + share * (part.spin - spin));
        }
        f.free_momentum.set(row, f.momentum[row]);
        f.free_spin.set(row, f.spin[row]);
        const double left = energy_of(f, row);
        f.crushed_energy[row] -= left;
        energy += left;
    }
    for (const Row<Touches> t : start.touches) {
        if (f.has_pins[touches.a[t]]) report.support_momentum += share * touches.impulse[t];
        if (f.has_pins[touches.b[t]]) report.support_momentum -= share * touches.impulse[t];
    }
    report.energy_crushed = report.energy_unclamped - energy;
    report.energy_unclamped = energy;
}

// Pulls the part's speed to the limit; returns the momentum that was cut off, so that the sum stays exact.
Vec3d clamp_speed(Fragments& f, uint32_t row, const HandoffStart& start) {
    const double mass = f.moving_mass[row];
    const Vec3d before = start.velocity + cross(start.spin, f.centre[row] - start.centre);
    const Vec3d relative = (1 / mass) * f.momentum[row] - before;
    const double speed = length(relative), most = kMostRelativeSpeed * start.impact_speed;
    if (!(speed > most)) return {};
    const Vec3d kept = mass * (before + (most / speed) * relative);
    const Vec3d cut = f.momentum[row] - kept;
    f.momentum.set(row, kept);
    f.is_speed_clamped[row] = 1;
    return cut;
}

Vec3d clamp_spin(Fragments& f, uint32_t row, const HandoffStart& start) {
    const Vec3d spin = f.spin[row], relative = spin - start.spin;
    const Sym3d& inertia = f.inertia[row];
    const double rim = length(relative) * f.radius[row], most = kMostRelativeSpeed * start.impact_speed;
    if (!(rim > most)) return {};
    Vec3d kept = start.spin + (most / rim) * relative;
    // The body's own spin may have been the livelier one; then slow down about the part's own axis.
    if (dot(kept, inertia * kept) > dot(spin, inertia * spin))
        kept = std::min(1.0, most / (length(spin) * f.radius[row])) * spin;
    const Vec3d cut = inertia * (spin - kept);
    f.spin.set(row, kept);
    f.is_spin_clamped[row] = 1;
    return cut;
}

void clamp(Fragments& f, Rows<Fragments> of, const HandoffStart& start, HandoffReport& report) {
    for (const Row<Fragments> row : of) {
        if (!is_moving(f, row)) continue;
        const Vec3d lost = clamp_spin(f, row, start);
        report.spin_clamp_loss += lost;
        report.spin_clamps += f.is_spin_clamped[row];
        if (row == report.largest) continue;
        const Vec3d cut = clamp_speed(f, row, start);
        report.speed_clamps += f.is_speed_clamped[row];
        if (f.has_pins[report.largest])
            report.support_momentum += cut;
        else
            f.momentum.set(report.largest, f.momentum[report.largest] + cut);
    }
}

double energy_of_all(const Fragments& f, Rows<Fragments> of) {
    double sum = 0;
    for (const Row<Fragments> row : of) sum += energy_of(f, row);
    return sum;
}

// All parts at `share` of the way from their free motion to the clamped one.
void go_back(Fragments& f, Rows<Fragments> of, double share) {
    for (const Row<Fragments> row : of) {
        const Vec3d momentum = f.free_momentum[row], spin = f.free_spin[row];
        f.momentum.set(row, momentum + share * (f.momentum[row] - momentum));
        f.spin.set(row, spin + share * (f.spin[row] - spin));
    }
}

// Energy is a quadratic of the way, E(0) <= E_hidden < E(1): the largest share of it with E <= E_hidden. Momentum is
// the same all along.
void keep_energy(Fragments& f, Rows<Fragments> of, HandoffReport& report) {
    if (!(energy_of_all(f, of) > report.energy_hidden)) return;
    double a = 0, b = 0;
    for (const Row<Fragments> row : of) {
        if (!is_moving(f, row)) continue;
        const double mass = f.moving_mass[row];
        const Vec3d free_momentum = f.free_momentum[row], free_spin = f.free_spin[row];
        const Vec3d p = f.momentum[row] - free_momentum, w = f.spin[row] - free_spin;
        a += dot(p, p) / (2 * mass) + dot(w, f.inertia[row] * w) / 2;
        b += dot(free_momentum, p) / mass + dot(free_spin, f.inertia[row] * w);
    }
    constexpr double kRounded = 1 - 1e-9;
    const double room = std::max(report.energy_hidden - report.energy_unclamped, 0.0);
    const double share = a > 0 ? kRounded * std::clamp((std::sqrt(b * b + 4 * a * room) - b) / (2 * a), 0.0, 1.0) : 0;
    go_back(f, of, share);
    report.support_momentum = report.free_support + share * (report.support_momentum - report.free_support);
    report.spin_clamp_loss = share * report.spin_clamp_loss;
    if (energy_of_all(f, of) > report.energy_hidden) {
        go_back(f, of, 0);
        report.support_momentum = report.free_support;
        report.spin_clamp_loss = {};
    }
}

}  // namespace

HandoffReport settle_momenta(Fragments& f, Rows<Fragments> of, Touches& touches, const HandoffStart& start,
                             ScratchMemory& scratch) {
    HandoffReport report = free_motions(f, of);
    if (start.touches.count > 0) part_cracks(f, of, touches, start, scratch, report);
    report.free_support = report.support_momentum;
    clamp(f, of, start, report);
    keep_energy(f, of, report);
    for (const Row<Fragments> row : of) {
        if (f.moving_mass[row] > 0) f.velocity.set(row, (1 / f.moving_mass[row]) * f.momentum[row]);
        report.momentum_after += f.momentum[row];
        report.energy_after += energy_of(f, row);
    }
    return report;
}

}  // namespace cullet
