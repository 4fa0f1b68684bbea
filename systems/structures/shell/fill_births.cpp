#include "systems/births/settle_momenta.hpp"
#include "systems/structures/shell/fragment_parts.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/systems.hpp"

namespace cullet {
namespace {

void fill_rest(const ShellView& broken, const Break& of, const FragmentPart& part) {
    if (of.is_rest_smaller(broken.structures())) measure_part(broken, part);
    if (of.chooses_shape && !part.has_pins) choose_shape(broken, of.points.first, &part);
    if (of.chooses_shape && part.has_pins) clear_shape(broken);
}

void fill_body(MetalShellRows rows, const Break& of, const FragmentPart& part, Row<Structures> structure) {
    const ShellView piece(rows, structure);
    fill_piece(rows, of.broken, part, structure);
    if (!of.is_torn && !part.has_pins) choose_shape(piece, piece.points().first);
    if (part.has_pins) clear_shape(piece);
}

double volume_of(const ShellView& shell, const FragmentPart& part) {
    const Elements& elements = shell.state.elements;
    double volume = 0;
    for (uint32_t e = part.first_element; e != kNone; e = elements.next[shell.element(e)])
        volume += elements.volume[shell.element(e)];
    return volume;
}

}  // namespace

// Parts share no element, vertex or hinge; cells, which they may share, were dealt with when the rows were taken.
void fill_births(Each<Birth> birth, const Events<Break>& breaks, MetalShellRows rows, Fragments& fragments,
                 Touches& touches, const Bodies& bodies) {
    const Break& of = breaks.all()[birth->of];
    const Row<Fragments> f = birth->fragment;
    if (!f.exists()) {
        settle_momenta(fragments, of.fragments, touches, of.start, rows.shell_rows.scratch);
        return;
    }
    if (!is_shell(rows.structures, of.broken)) return;
    const ShellView broken(rows, of.broken);
    const FragmentPart part = part_of(fragments, f);
    if (f == of.largest) return fill_rest(broken, of, part);
    if (fragments.child[f].exists())
        fill_body(rows, of, part, bodies.structure[fragments.child[f]]);
    else
        fragments.volume[f] = volume_of(broken, part);
    shed_part(broken, part);
}

}  // namespace cullet
