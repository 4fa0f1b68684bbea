#include "systems/models/thick_shell/springs/check_springs.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {
namespace {

struct SpringChecker {
    const ShellRows& state;
    const SpringView& view;
    std::string trouble;

    void expect(bool fits, const std::string& what) {
        if (!fits && trouble.empty()) trouble = what;
    }
    std::string place(const AnyTable& table, const char* column, uint32_t row) const {
        return std::string(table.name()) + "." + column + "[" + std::to_string(row) + "]";
    }

    void check_row() {
        const ShellSprings& own = state.shell_springs;
        const uint32_t row = view.row, vertices = view.shell.vertices().capacity;
        expect(own.layout[row] <= static_cast<uint8_t>(SpringLayout::Crossed),
               place(own, "layout", row) + " is " + std::to_string(own.layout[row]));
        const bool layered = own.layout[row] != static_cast<uint8_t>(SpringLayout::OneLayer);
        expect(
            own.packs[row].count == (vertices + kLanes - 1) / kLanes && own.packs[row].count <= own.packs[row].capacity,
            place(own, "packs", row) + " are not those of " + std::to_string(vertices) + " vertices");
        expect(own.layers[row].count == (layered ? own.springs[row].count : 0) &&
                   own.layer_slots[row].count == (layered ? own.slots[row].count : 0) &&
                   own.twins[row].count == (layered ? own.packs[row].count * kLanes : 0),
               place(own, "layers", row) + " and its layout differ");
        const uint32_t elements = own.edges[row].capacity > 0 ? view.shell.element_count() : 0;
        expect(own.edges[row].count == elements, place(own, "edges", row) + " are of " +
                                                     std::to_string(own.edges[row].count) + " elements, not " +
                                                     std::to_string(elements));
        expect(own.time_step[row] > 0 && own.time_step[row] <= 1,
               place(own, "time_step", row) + " is " + std::to_string(own.time_step[row]) + " s, not above 0 to 1");
        expect(own.young_modulus[row] >= 0 && own.damping_ratio[row] >= 0 && own.damping_ratio[row] <= 1,
               place(own, "young_modulus", row) + " or its damping_ratio is out of range");
        expect(own.length_factor[row] > 0 && own.length_factor[row] <= 5,
               place(own, "length_factor", row) + " is " + std::to_string(own.length_factor[row]));
    }

    void check_list() {
        const Springs& springs = state.springs;
        const uint32_t vertices = view.shell.vertex_count();
        for (uint32_t s = 0; s < view.spring_count() && trouble.empty(); ++s) {
            const uint32_t row = view.spring(s);
            const uint32_t a = springs.a[row], b = springs.b[row], element = springs.element[row];
            expect((a == kNone && b == kNone) || (a < vertices && b < vertices && a != b),
                   place(springs, "a", row) + " and b are " + std::to_string(a) + " and " + std::to_string(b) +
                       ", of " + std::to_string(vertices));
            expect(element == kNone || element < view.shell.element_count(),
                   place(springs, "element", row) + " is " + std::to_string(element));
            expect(springs.can_crack[row] <= 1, place(springs, "can_crack", row) + " is not 0 or 1");
            expect(springs.rest_length[row] >= 0 && springs.plastic_length[row] >= 0 && springs.stiffness[row] >= 0,
                   place(springs, "rest_length", row) + ", plastic_length or stiffness is below 0");
            for (const uint32_t end : {0u, 1u}) {
                const uint32_t at = springs.place[row][end], v = end == 0 ? a : b;
                if (a == kNone || !trouble.empty()) break;
                expect(at != kNone && at % kLanes == v % kLanes && is_of_pack(v / kLanes, at / kLanes) &&
                           state.spring_slots.slot[view.slot(at / kLanes)].neighbour[at % kLanes] == (end == 0 ? b : a),
                       place(springs, "place", row) + " is " + std::to_string(at) + ", no slot of its end");
            }
        }
        for (uint32_t e = 0; e < state.shell_springs.edges[view.row].count && trouble.empty(); ++e)
            for (const uint32_t s : state.element_springs.spring[view.edges(e)])
                expect(s == kNone || s == kAsleepSpring || s < view.spring_count(),
                       place(state.element_springs, "spring", view.edges(e)) + " is " + std::to_string(s));
    }

    /// Springs run along their elements' edges, elements name springs of theirs.
    void check_edges() {
        const Springs& springs = state.springs;
        const Range edges = state.shell_springs.edges[view.row];
        const auto runs_along = [&](uint32_t s, uint32_t e, uint32_t k) {
            const auto& corner = state.elements.corner[view.shell.element(e)];
            const uint32_t a = springs.a[view.spring(s)], b = springs.b[view.spring(s)];
            const uint32_t from = corner[k], to = corner[(k + 1) % 3];
            return (a == from && b == to) || (a == to && b == from);
        };
        for (uint32_t e = 0; e < edges.count && trouble.empty(); ++e)
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t s = state.element_springs.spring[view.edges(e)][k];
                if (s >= view.spring_count() || (state.elements.flags[view.shell.element(e)] & kDead)) continue;
                expect(runs_along(s, e, k), place(state.element_springs, "spring", view.edges(e)) + " is " +
                                                std::to_string(s) + ", no spring of its edge");
            }
        for (uint32_t s = 0; s < view.spring_count() && trouble.empty(); ++s) {
            const uint32_t e = springs.element[view.spring(s)];
            if (e == kNone) continue;
            expect(e < edges.count && (runs_along(s, e, 0) || runs_along(s, e, 1) || runs_along(s, e, 2)),
                   place(springs, "element", view.spring(s)) + " is " + std::to_string(e) +
                       ", which has no edge between its ends");
        }
    }

    bool is_of_pack(uint32_t pack, uint32_t slot) const {
        const uint32_t row = view.pack(pack), first = state.spring_packs.first_slot[row];
        return slot >= first && slot - first < state.spring_packs.slot_count[row];
    }

    void check_packs() {
        const SpringPacks& packs = state.spring_packs;
        const uint32_t slots = state.shell_springs.slots[view.row].count;
        std::vector<std::pair<uint32_t, uint32_t>> taken;  // first slot and end of each pack
        for (uint32_t p = 0; p < view.pack_count() && trouble.empty(); ++p) {
            const uint32_t row = view.pack(p), first = packs.first_slot[row], room = packs.slot_capacity[row];
            expect(packs.slot_count[row] <= room && first <= slots && room <= slots - first,
                   place(packs, "first_slot", row) + " is " + std::to_string(first) + " for " + std::to_string(room) +
                       " slots of " + std::to_string(slots));
            if (room > 0) taken.emplace_back(first, first + room);
        }
        std::sort(taken.begin(), taken.end());
        for (size_t i = 1; i < taken.size(); ++i)
            expect(taken[i].first >= taken[i - 1].second, std::string(packs.name()) + ".first_slot: slot " +
                                                              std::to_string(taken[i].first) + " is of two packs");
    }

    void check_slots() {
        const SpringPacks& packs = state.spring_packs;
        const uint32_t vertices = view.pack_count() * kLanes;
        for (uint32_t p = 0; p < view.pack_count() && trouble.empty(); ++p) {
            const uint32_t row = view.pack(p), first = packs.first_slot[row], count = packs.slot_count[row];
            for (uint32_t i = first; i < first + count && trouble.empty(); ++i) {
                const SpringSlot& slot = state.spring_slots.slot[view.slot(i)];
                bool is_sound = true;
                for (uint32_t k = 0; k < kLanes; ++k)
                    is_sound &= slot.neighbour[k] < vertices && std::isfinite(slot.inverse_rest[k]) &&
                                std::isfinite(slot.stiffness_rest[k]) && std::isfinite(slot.damping[k]) &&
                                std::isfinite(slot.length[k]);
                if (view.has_layers()) {
                    const LayerSlot& more = state.layer_slots.slot[view.layer_slot(i)];
                    for (const auto* lanes :
                         {&more.inverse_rest, &more.stiffness_rest, &more.damping, &more.length, &more.first_inverse,
                          &more.first_stiffness, &more.second_inverse, &more.second_stiffness})
                        for (const float number : *lanes) is_sound &= std::isfinite(number);
                }
                expect(is_sound, place(state.spring_slots, "slot", view.slot(i)) +
                                     " names no vertex or holds a number that is not finite");
            }
        }
    }
};

}  // namespace

Result<void> check_springs(const ShellRows& state, const std::string& name, const std::string& advice) {
    const ShellSprings& own = state.shell_springs;
    std::vector<uint8_t> has_springs(state.structures.size(), 0);
    const auto refuse = [&](const std::string& what) { return Error{name + ": " + what + ". " + advice}; };
    for (uint32_t row = 0; row < own.size(); ++row) {
        const std::string place = "shell_springs.structure[" + std::to_string(row) + "]";
        if (own.is_used[row] > 1) return refuse("shell_springs.is_used[" + std::to_string(row) + "] is not 0 or 1");
        if (!own.is_used[row]) continue;
        const uint32_t shell = own.structure[row];
        if (shell >= state.structures.size() || state.structures.users[shell] == 0 || has_springs[shell]++)
            return refuse(place + " is " + std::to_string(shell) + ", which is no shell or has other springs, too");
        if (!state.shell_springs.pool.is_taken(row, 1)) return refuse(place + " is in a free row");
        const SpringView view(const_cast<ShellRows&>(state), Row<ShellSprings>(row));  // nothing is changed
        SpringChecker check{state, view, {}};
        check.check_row();
        if (check.trouble.empty()) check.check_packs();
        if (check.trouble.empty()) check.check_slots();
        if (check.trouble.empty()) check.check_list();
        if (check.trouble.empty()) check.check_edges();
        if (!check.trouble.empty()) return refuse(check.trouble);
    }
    return {};
}

}  // namespace cullet
