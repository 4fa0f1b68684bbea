// What comes apart in a step, whatever it is made of. Rows stand from plan_births until make_births: between two steps
// there are none.
#pragma once
#include "components/structures.hpp"
#include "engine/system.hpp"

namespace cullet {

struct Bodies;

/// Parts of one hit that can be told apart; more of them end the hit as a fault.
inline constexpr uint32_t kMostParts = 1024;

/// A column of a table whose rows no step leaves to the next one.
template <class T>
class PassingColumn : public Column<T> {
 public:
    template <class Owner>
    PassingColumn(Owner& table, const char* name, const char* unit = "1")
        : Column<T>(table, name, unit, Keep::Scratch) {}
};

/// One row is one part of a body that comes apart, whether it leaves or stays. Those of one body stand side by side, in
/// the order of their numbers in its structure. Places and motions are along the body's axes.
struct Fragments : Table<Fragments> {
    using Table::Table;
    CULLET_TABLE(fragments);
    template <class T>
    using Own = PassingColumn<T>;
    // What it is: elements of the structure, in a list that the structure knows to follow.
    Own<uint32_t> first_element{*this, "first_element"};  // the smallest; kNone: it is one with another fragment
    Own<uint32_t> last_element{*this, "last_element"};    // kNone: those of what is left need not be listed
    Own<uint32_t> element_count{*this, "element_count"};
    Own<double> mass{*this, "mass", "kg"};  // of its elements
    Own<uint8_t> has_pins{*this, "has_pins"};
    // What becomes of it.
    Own<Row<Fragments>> order{*this, "order"};  // of all of the body, heaviest first: row i names the i-th of them
    Own<Row<Bodies>> child{*this, "child"};     // a new body, or none
    Own<uint8_t> is_debris{*this, "is_debris"};
    Own<double> volume{*this, "volume", "m3"};  // of debris, once births are filled
    Own<uint32_t> debris{*this, "debris"};      // row of Debris once it is made, or kNone
    // How it moves. Mass, centre and inertia are those that its momenta were summed with: with them these are the
    // hidden state's, and the energy can only fall. What holds a pin stands still.
    Own<double> moving_mass{*this, "moving_mass", "kg"};
    Own<Vec3d> centre{*this, "centre", "m"};
    Own<Sym3d> inertia{*this, "inertia", "kg m2"};  // about the centre
    Own<double> radius{*this, "radius", "m"};       // no point of it is farther from the centre
    Own<Vec3d> momentum{*this, "momentum", "N s"};  // as the clamps leave it, once it is settled
    Own<Vec3d> turning{*this, "turning", "N m s"};  // about the centre, of the hidden state
    Own<double> hidden_energy{*this, "hidden_energy", "J"};
    Own<Vec3d> velocity{*this, "velocity", "m/s"};  // of the centre
    Own<Vec3d> spin{*this, "spin", "rad/s"};
    Own<Vec3d> free_momentum{*this, "free_momentum", "N s"};  // before the clamps
    Own<Vec3d> free_spin{*this, "free_spin", "rad/s"};
    Own<double> crushed_energy{*this, "crushed_energy", "J"};  // lost to others whose crack faces were in its way
    Own<uint8_t> is_speed_clamped{*this, "is_speed_clamped"};
    Own<uint8_t> is_spin_clamped{*this, "is_spin_clamped"};
};

/// One row is a place on a crack that two fragments of a body have in common, along the body's axes.
struct Touches : Table<Touches> {
    using Table::Table;
    CULLET_TABLE(touches);
    template <class T>
    using Own = PassingColumn<T>;
    Own<Row<Fragments>> a{*this, "a"};
    Own<Row<Fragments>> b{*this, "b"};
    Own<Vec3d> point{*this, "point", "m"};
    Own<Vec3d> normal{*this, "normal"};           // unit, from b towards a
    Own<double> reach{*this, "reach", "m"};       // of this part of the crack to both sides of the point
    Own<Vec3d> impulse{*this, "impulse", "N s"};  // on a, and the opposite on b, of those that stopped them
    // Of stop_approach: from the centres; the touch has needed an impulse.
    Own<Vec3d> arm_a{*this, "arm_a", "m"};
    Own<Vec3d> arm_b{*this, "arm_b", "m"};
    Own<uint8_t> is_used{*this, "is_used"};
};

/// So many new rows that name no body and no elements; none of them where there is no room for all.
inline Rows<Fragments> append_fragments(Fragments& fragments, uint32_t count) {
    const uint32_t first = fragments.append(count);
    if (first == kNone) return {};
    for (uint32_t f = first; f < first + count; ++f) {
        fragments.first_element[f] = fragments.last_element[f] = kNone;
        fragments.child[f] = {};
        fragments.debris[f] = kNone;
        fragments.order[f] = Row<Fragments>(f);
    }
    return {first, count};
}

inline bool leaves(const Fragments& fragments, uint32_t row) {
    return fragments.child[row].exists() || fragments.is_debris[row];
}

/// Ties to the lower row.
inline Row<Fragments> heaviest_of(const Fragments& fragments, Rows<Fragments> of) {
    Row<Fragments> best(of.first);
    for (const Row<Fragments> f : of)
        if (fragments.mass[f] > fragments.mass[best]) best = f;
    return best;
}

}  // namespace cullet
