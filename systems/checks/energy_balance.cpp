#include "systems/checks/energy_balance.hpp"

#include <algorithm>
#include <cmath>

#include "systems/models.hpp"
#include "systems/systems.hpp"

namespace cullet {

// Heights: floats of metres are good to 6e-8, kinetic energies to some 1e-7. What lies still is kept up by impulses
// that the solver finds to a few mm/s: as fast it may rise, for a step. Springs that swing in semi-implicit steps have
// an energy that is off by up to step * frequency / 2 within a swing, and softened shells (B7) take their largest
// steps.
double energy_tolerance(const Step& step, const MechanicalEnergy& before, const MechanicalEnergy& after) {
    constexpr double kRounding = 1e-6, kOfMotion = 1e-4, kOfStrain = 0.02;
    constexpr double kUnsolved = 0.003;  // m/s
    return 1e-6 + kRounding * (std::fabs(before.height) + std::fabs(after.height)) +
           kUnsolved * double{step.dt} * after.mass * length(Vec3d(step.gravity)) +
           kOfMotion * (before.kinetic + after.kinetic) + kOfStrain * (before.strain + after.strain);
}

// What is not found term by term: points that lie too deep in a striker are put outside without speed, which strains
// their springs; of two soft bodies each holds a copy of the other for the frame. Two sheets that meet make up to 3.6 %
// of their motion in a frame. What a dent holds back is no strain while its body lies still.
double soft_tolerance(const MechanicalEnergy& before, const MechanicalEnergy& after) {
    constexpr double kOfMeeting = 0.05;
    const double most = std::max(before.kinetic + before.strain, after.kinetic + after.strain);
    return kOfMeeting * most + (after.awake > before.awake ? after.strain : 0);
}

namespace {

// Who is driven into an awake body puts points that he lies too deep in outside, against their springs, and lifts them:
// his work, which no impulse tells of.
double work_of_presses(const MechanicalEnergy& before, const MechanicalEnergy& after) {
    return std::max(0.0, after.strain - before.strain) + std::max(0.0, after.height - before.height);
}

}  // namespace

void open_energy_balance(Serial, Step step, WorldRows& rows, const Debris& debris, const DamageModels& models,
                         const DamageCounts& counts, const RigidWorld& rigid, EnergyBalance& balance) {
    balance.start = world_energy(models, rows, debris, step.gravity);
    balance.from_outside = counts.work_from_outside;
    balance.rigid = rigid.work();
}

void close_energy_balance(Serial, Step step, WorldRows& rows, const Debris& debris, const DamageModels& models,
                          const DamageCounts& counts, const RigidWorld& rigid, EnergyBalance& balance,
                          Events<FaultEvent>& faults) {
    const MechanicalEnergy end = world_energy(models, rows, debris, step.gravity);
    const double outside = counts.work_from_outside - balance.from_outside,
                 work = rigid.work().sum() - balance.rigid.sum();
    balance.gain = end.total() - balance.start.total() - outside - work;
    const double share = balance.gain / energy_tolerance(step, balance.start, end);
    if (share > balance.most_share) {
        balance.most_share = share;
        balance.most_gain = balance.gain;
        balance.most_frame = step.frame;
    }
    const bool is_soft = balance.start.awake > 0 || end.awake > 0;
    const bool is_pressed = is_soft && models.is_any_driven_into(rows);
    const double allowed =
        energy_tolerance(step, balance.start, end) +
        (is_soft ? soft_tolerance(balance.start, end) + (is_pressed ? work_of_presses(balance.start, end) : 0) : 0);
    if (balance.gain > allowed)
        faults.push(
            {{}, 0, {}, "This frame made energy: more came out of it than went in (checks/energy_balance.hpp)."});
}

}  // namespace cullet
