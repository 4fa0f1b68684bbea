#include "systems/motion/energy_balance.hpp"

#include <cmath>

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

void open_energy_balance(Serial, Step step, ShellTables shells, const DamageCounts& counts, const RigidWorld& rigid,
                         EnergyBalance& balance) {
    balance.start = world_energy(shells.state, step.gravity);
    balance.from_outside = counts.work_from_outside;
    balance.rigid = rigid.work();
}

void close_energy_balance(Serial, Step step, ShellTables shells, const DamageCounts& counts, const RigidWorld& rigid,
                          EnergyBalance& balance, Events<FaultEvent>& faults) {
    const MechanicalEnergy end = world_energy(shells.state, step.gravity);
    const double outside = counts.work_from_outside - balance.from_outside,
                 work = rigid.work().sum() - balance.rigid.sum();
    balance.gain = end.total() - balance.start.total() - outside - work;
    const double share = balance.gain / energy_tolerance(step, balance.start, end);
    if (share > balance.most_share) {
        balance.most_share = share;
        balance.most_gain = balance.gain;
        balance.most_frame = step.frame;
    }
    // Springs of soft bodies have steps of their own, with damping and flow between them: theirs is measured alone.
    const bool is_soft = balance.start.awake > 0 || end.awake > 0;
    if (share > 1 && !is_soft)
        faults.push(
            {{}, 0, {}, "This frame made energy: more came out of it than went in (motion/energy_balance.hpp)."});
}

}  // namespace cullet
