#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/systems.hpp"

namespace cullet {

// Parts share no element, vertex or hinge; cells, which they may share, were dealt with when the rows were taken.
void fill_births(Each<Birth> birth, const Events<Break>& breaks, ShellRows& rows, const Bodies& bodies) {
    const Break& plan = breaks.all()[birth->of];
    if (birth->part == kNone) return settle_momenta(plan.handoff[0].start, plan.motions, plan.handoff[0].report);
    const FragmentPart& part = plan.parts[birth->part];
    const ShellView broken(rows, plan.broken);
    if (birth->part == plan.largest) {
        if (plan.is_rest_smaller(rows)) measure_part(broken, part);
        if (plan.chooses_shape && !part.has_pins) choose_shape(broken, plan.points.first, &part);
        if (plan.chooses_shape && part.has_pins) clear_shape(broken);
        return;
    }
    if (plan.child[birth->part].exists()) {
        const ShellView piece(rows, bodies.structure[plan.child[birth->part]]);
        fill_piece(rows, plan.broken, part, piece.structure);
        if (!plan.is_torn && !part.has_pins) choose_shape(piece, piece.points().first);
        if (part.has_pins) clear_shape(piece);
    }
    shed_part(broken, part);
}

}  // namespace cullet
