#include "components/body_id.hpp"
#include "systems/births/make_debris.hpp"
#include "systems/impacts/opening.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/take_out.hpp"

namespace cullet {
namespace {

ImpactEvent event_of(const Bodies& bodies, const Crushed& c) {
    ImpactEvent event = cullet::event_of(bodies, {c.body, c.toucher, c.point, c.normal, 0}, 0);
    event.load = c.load;
    return event;
}

}  // namespace

void grind_crushed(Serial, Step step, const Events<Crushed>& crushed, WorldRows& rows, WaitingHits waiting,
                   DebrisTables debris_tables, const DamageModels& models, RigidWorld& rigid, ToldOfGrinding told) {
    const Bodies& bodies = rows.bodies;
    // All are told of before any goes: two that lie on each other are named by each other's events.
    uint32_t ground = 0;
    for (const Crushed& c : crushed) {
        const double mass = bodies.mass[c.body],
                     density = rows.materials.density[rows.structures.material[bodies.structure[c.body]]];
        const NewDebris piece{c.body, centre_of(bodies, c.body), bodies.velocity[c.body], mass, mass / density};
        if (make_debris(debris_tables, bodies, rigid, piece, step.frame, told.debris) == kNone) {
            told.refused.push(refused_event(bodies, c.body, "limits.debris"));
            continue;
        }
        told.impacts.push(event_of(bodies, c));
        ++ground;
    }
    // Where one finds no room those behind it find none.
    for (const Crushed& c : crushed.all().first(ground)) take_out(rows, waiting, rigid, models, c.body);
}

}  // namespace cullet
