#include "systems/structures/tetrahedra/systems.hpp"

#include "systems/structures/tetrahedra/draw_solid.hpp"
#include "systems/structures/tetrahedra/solid_pieces.hpp"

namespace cullet {

void fill_solids(Each<Birth> birth, const Events<Break>& breaks, All<SolidRows, const Tasks> rows, Fragments& fragments,
                 const Bodies& bodies) {
    const Break& of = breaks.all()[birth->of];
    const Row<Fragments> f = birth->fragment;
    if (!f.exists() || is_shell(rows.structures, of.broken)) return;
    const BreakingRoom* const room = room_of_task(rows, of.task);
    const uint32_t piece = f - of.fragments.first;
    if (f == of.largest)
        fill_solid(rows, room->broken, piece, of.broken);
    else if (fragments.child[f].exists())
        fill_solid(rows, room->broken, piece, bodies.structure[fragments.child[f]]);
    else
        fragments.volume[f] = room->broken.pieces[piece].volume;
}

void draw_solids(Each<DrawnChanged> changed, Step step, DrawnSolids rows) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(rows.bodies.kind[body]) == BodyKind::Free) return;
    if (is_shell(rows.structures, rows.bodies.structure[body])) return;
    draw_solid_body(rows, body);
    rows.bodies.drawn_frame[body] = step.frame;
}

}  // namespace cullet
