#include "systems/checks/world_energy.hpp"

#include "components/body_id.hpp"
#include "systems/births/limit_energy.hpp"
#include "systems/models.hpp"
#include "systems/structure_calls.hpp"

namespace cullet {
MechanicalEnergy& MechanicalEnergy::operator+=(const MechanicalEnergy& o) {
    kinetic += o.kinetic, height += o.height, strain += o.strain, waiting += o.waiting, awake += o.awake,
        mass += o.mass;
    return *this;
}

MechanicalEnergy body_energy(const DamageModels& models, WorldRows& state, Row<Bodies> body, Vec3 gravity) {
    const Bodies& bodies = state.bodies;
    const auto kind = static_cast<BodyKind>(bodies.kind[body]);
    const bool has_structure = bodies.structure[body].exists();
    if (kind != BodyKind::Dynamic && !(kind == BodyKind::Static && has_structure)) return {};
    if (has_structure)
        if (const auto own = models.energy(state, body, gravity)) return *own;
    return {rigid_energy(bodies, body),
            -bodies.mass[body] * dot(Vec3d(gravity), Vec3d(centre_of(bodies, body))),
            0,
            has_structure ? calls_of(state.structures, bodies.structure[body]).waiting_energy(state, body) : 0,
            0,
            bodies.mass[body]};
}

MechanicalEnergy debris_energy(const Debris& debris, uint32_t row, Vec3 gravity) {
    if (!debris.is_used[row]) return {};
    const Vec3d v(debris.velocity[row]);
    return {0.5 * debris.mass[row] * dot(v, v),
            -debris.mass[row] * dot(Vec3d(gravity), Vec3d(debris.position[row])),
            0,
            0,
            0,
            debris.mass[row]};
}

MechanicalEnergy world_energy(const DamageModels& models, WorldRows& state, const Debris& debris, Vec3 gravity) {
    MechanicalEnergy sum;
    for (uint32_t t = 0; t < state.tasks.size(); ++t) {
        if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free) continue;
        const uint32_t first = state.tasks.first_contact[t], end = first + state.tasks.contact_count[t];
        for (uint32_t c = first; c < end; ++c) sum.waiting += state.task_contacts.answer_energy[c];
    }
    for (uint32_t b = 0; b < state.bodies.size(); ++b) sum += body_energy(models, state, Row<Bodies>(b), gravity);
    for (uint32_t d = 0; d < debris.size(); ++d) sum += debris_energy(debris, d, gravity);
    return sum;
}

}  // namespace cullet
