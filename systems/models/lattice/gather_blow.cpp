#include "systems/models/lattice/gather_blow.hpp"

#include <algorithm>

#include "systems/bodies/blows.hpp"
#include "systems/models/lattice/shared/brittle.hpp"

namespace cullet::lattice {
namespace {

constexpr double kFlatRadius = 0.5;  // of the body's reach: the corner that meets what is flat

}  // namespace

bool gather_blow(LatticeRows rows, const Blows& blows, Row<Tasks> task) {
    rows.lattice_runs.reach(task + 1);
    rows.lattice_results.reach(task + 1);
    rows.lattice_runs.clear_rows(task, 1);
    rows.lattice_results.clear_rows(task, 1);
    const TaskContacts& contacts = rows.task_contacts;
    const Row<Bodies> body = rows.tasks.body[task];
    LatticeRuns& runs = rows.lattice_runs;
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.task[b] != task.index || !is_kind(blows, b, BlowKind::Cut)) continue;
        runs.point.set(task, Vec3d(blows.point[b])), runs.push.set(task, Vec3d(blows.direction[b]));
        return true;
    }
    const uint32_t first = rows.tasks.first_contact[task], end = first + rows.tasks.contact_count[task];
    double most = 0;
    for (uint32_t c = first; c < end; ++c) {
        const Vec3d point(contacts.point[c]), push(contacts.normal[c]);
        const Vec3d arm = point - rows.bodies.centre[body];
        const Vec3d moving = Vec3d(rows.tasks.start_velocity[task]) + cross(Vec3d(rows.tasks.start_spin[task]), arm);
        const double speed = double{contacts.start_speed[c]} - dot(moving, push);
        const double inverse_mass =
            inverse_mass_at(rows.bodies, body, point, push) + double{contacts.striker_inverse_mass[c]};
        if (!(speed > 0) || !(inverse_mass > 0)) continue;
        const double energy = 0.5 * speed * speed / inverse_mass;
        if (!(energy > most)) continue;
        most = energy;
        runs.point.set(task, point), runs.push.set(task, push);
        runs.speed[task] = speed;
        runs.effective_mass[task] = 1 / inverse_mass;
        const double own = kFlatRadius * double{rows.bodies.radius[body]}, his = double{contacts.striker_radius[c]};
        runs.radius[task] = his > 0 ? own * his / (own + his) : own;
        // What strikes is as stiff as what is struck, where it has no structure that says otherwise.
        const Row<Bodies> striker = contacts.striker[c];
        Row<Structures> stuff = rows.tasks.source[task];
        if (striker.exists() && rows.bodies.structure[striker].exists()) stuff = rows.bodies.structure[striker];
        const Row<Materials> material = rows.structures.material[stuff];
        runs.striker_young[task] = double{rows.materials.young_modulus[material]};
        runs.striker_poisson[task] = double{rows.materials.poisson_ratio[material]};
    }
    runs.spin.set(task, Vec3d(rows.tasks.start_spin[task]));
    // Of several the hardest: all of them push the pieces.
    double hardest = 0;
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.task[b] != task.index || !is_kind(blows, b, BlowKind::Explosion)) continue;
        runs.blast_impulse.set(task, Vec3d(runs.blast_impulse[task]) + Vec3d(blows.impulse[b]));
        if (!(double{blows.speed[b]} > hardest)) continue;
        hardest = double{blows.speed[b]};
        runs.blast_centre.set(task, Vec3d(blows.point[b]));
        runs.blast_radius[task] = double{blows.radius[b]};
        runs.blast_strength[task] = double{blows.strength[b]};
        runs.point.set(task, Vec3d(blows.point[b])), runs.push.set(task, Vec3d(blows.direction[b]));
        runs.speed[task] = hardest;
    }
    return most > 0 || hardest > 0;
}

SolidBlow blow_of(const LatticeRuns& runs, Row<Tasks> task) {
    SolidBlow blow;
    blow.point = runs.point[task], blow.push = runs.push[task];
    blow.speed = runs.speed[task];
    blow.effective_mass = runs.effective_mass[task];
    blow.radius = runs.radius[task];
    blow.striker.young = runs.striker_young[task], blow.striker.poisson = runs.striker_poisson[task];
    blow.spin = runs.spin[task];
    blow.blast.centre = runs.blast_centre[task];
    blow.blast.radius = runs.blast_radius[task], blow.blast.strength = runs.blast_strength[task];
    return blow;
}

}  // namespace cullet::lattice
