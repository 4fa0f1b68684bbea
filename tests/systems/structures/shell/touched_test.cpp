// After any cuts the stiffness that was rebuilt locally is the one that a new assembly gives.
#include "systems/structures/shell/touched.hpp"
#include "components/state.hpp"
#include "systems/models/thick_shell/stiffness/costs.hpp"

#include <gtest/gtest.h>

#include <map>

#include "engine/random.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/hidden/grow_cracks.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "tests/support/crack_meshes.hpp"

namespace cullet {
namespace {

using namespace crack_test;

// A copy of the shell with assembled stiffness and room to grow, in place of the first.
void assemble(Shell& shell, uint32_t spare) {
    State& state = *shell.state;
    assemble_springs(shell.view);
    measure_limits(shell.view);
    limit_all_stiffness(shell.view);
    ShellRoom room = stiffness_room(shell.view, spare);
    room.blocks *= 2, room.links *= 2;
    room.elements = shell.view.element_count() + 2 * spare;
    room.hinges = shell.view.hinge_count() + 6 * spare;
    const Row<Structures> copy = copy_shell(state, shell.view.structure, room);
    ASSERT_TRUE(copy.exists());
    new (&shell.view) ShellView(state, copy);
    ASSERT_TRUE(assemble_stiffness(shell.view));
}

// What a vertex's lane holds: blocks by neighbour, links as a sorted list.
struct LaneRow {
    std::map<uint32_t, std::array<float, 9>> block;
    std::multimap<uint32_t, std::array<float, 6>> link;
    bool operator==(const LaneRow&) const = default;
};
LaneRow row_of(ShellView shell, uint32_t v) {
    LaneRow row;
    const StiffnessPacks& packs = shell.state.stiffness_packs;
    const uint32_t p = shell.shells().packs[shell.row].first + v / kLanes, lane = v % kLanes;
    const uint32_t blocks = shell.shells().blocks[shell.row].first + packs.first_block[p];
    const uint32_t links = shell.shells().links[shell.row].first + packs.first_link[p];
    for (uint32_t i = 0; i < packs.block_count[p]; ++i) {
        const StiffnessBlock& b = shell.state.stiffness_blocks.block[blocks + i];
        if (b.neighbour[lane] == v) continue;
        for (uint32_t k = 0; k < 9; ++k) row.block[b.neighbour[lane]][k] = b.k[k][lane];
    }
    for (uint32_t i = 0; i < packs.link_count[p]; ++i) {
        const StiffnessLink& l = shell.state.stiffness_links.link[links + i];
        if (l.neighbour[lane] == v) continue;
        row.link.insert({l.neighbour[lane],
                         {l.row[0][lane], l.row[1][lane], l.row[2][lane], l.column[0][lane], l.column[1][lane],
                          l.column[2][lane]}});
    }
    return row;
}

StressField field_of(uint64_t seed) {
    const Random random{seed};
    const Vec3 k{static_cast<float>(60 * random.uniform(0)), static_cast<float>(60 * random.uniform(1)), 40};
    const Vec3 pull{static_cast<float>(random.uniform(2) - 0.5), static_cast<float>(random.uniform(3) - 0.5), 0.3f};
    return [=](Vec3 p, int) {
        double s, c;
        sine_cosine(double{dot(k, p)}, s, c);
        return tension_along(pull, 300e6 * s) + tension_along({1, 1, 0}, 100e6 * c);
    };
}

/// The stress is that of the field, so wood of these numbers cracks as the others do, but its rows reach farther.
void give_grain(State& state) {
    MaterialTraits& traits = state.material_traits;
    traits.append(1);
    const Row<Materials> m(0);
    traits.across_young_modulus[0] = 0.1f * state.materials.young_modulus[m];
    traits.shear_modulus[0] = 0.08f * state.materials.young_modulus[m];
    traits.across_strength[0] = 0.9f * state.materials.tensile_strength[m];
    traits.across_fracture_energy[0] = state.materials.fracture_energy[m];
    traits.grain.set(0, normalised(Vec3{1, 0.7f, 0.2f}));
    ASSERT_TRUE(material_traits(state, m).has_grain());
}

void compare_with_new_assembly(const TestSurface& surface, uint64_t seed, bool has_grain = false) {
    Shell shell = make_shell_of(surface, 0, 0);
    if (has_grain) give_grain(*shell.state);
    assemble(shell, 400);
    const ShellView view = shell.view;
    const Row<Tasks> task = make_task(shell);
    uint32_t cuts = 0;
    uint64_t for_cuts = 0;
    for (uint32_t i = 0; i < 30; ++i) {
        set_time(shell, task, 20e-6 * i);
        set_stress(view, field_of(seed + i / 6));
        CrackSink sink;
        const uint32_t now = grow_cracks(*shell.state, task, sink);
        cuts += now, for_cuts += units_of_crack(view.vertex_count(), false) * now;
        ASSERT_FALSE(sink.is_out_of_slots);
    }
    ASSERT_GT(cuts, 20u);
    ASSERT_EQ(broken_rule(shell), "");
    // Rows of a grain are paid for by themselves, and each refresh is local: the whole body was not assembled each
    // time.
    const uint64_t for_rows = shell.state->tasks.units_owed[task] - for_cuts;
    EXPECT_EQ(for_rows > 0, has_grain);
    EXPECT_LT(for_rows, kUnitsGrainRow * 60 * cuts);

    std::vector<LaneRow> found;
    std::vector<float> scale, hinge_scale, vertex_scale;
    const auto read = [&](std::vector<LaneRow>& rows) {
        rows.clear();
        for (uint32_t v = 0; v < view.vertex_count(); ++v) rows.push_back(row_of(view, v));
    };
    const auto scales = [&] {
        std::vector<float> all;
        for (uint32_t e = 0; e < view.element_count(); ++e)
            all.push_back(shell.state->triangle_springs.scale[view.element(e)]);
        for (uint32_t h = 0; h < view.hinge_count(); ++h)
            if (shell.state->hinges.vertex[view.hinge(h)][0] != kNone)
                all.push_back(shell.state->hinges.scale[view.hinge(h)]);
        for (uint32_t v = 0; v < view.vertex_count(); ++v)
            all.push_back(shell.state->vertices.stiffness_scale[view.vertex(v)]);
        return all;
    };
    read(found);
    const std::vector<float> scales_found = scales();
    for (uint32_t e = 0; e < view.element_count(); ++e) assemble_element(view, e);
    for (uint32_t h = 0; h < view.hinge_count(); ++h) assemble_hinge(view, h);
    limit_all_stiffness(view);
    EXPECT_EQ(scales(), scales_found);
    ASSERT_TRUE(assemble_stiffness(view));
    std::vector<LaneRow> wanted;
    read(wanted);
    uint32_t different = 0;
    for (uint32_t v = 0; v < view.vertex_count(); ++v) different += !(wanted[v] == found[v]);
    EXPECT_EQ(different, 0u) << "of " << view.vertex_count() << " rows after " << cuts << " cuts";
}

TEST(RefreshStiffness, GivesWhatANewAssemblyGivesOnASheet) {
    compare_with_new_assembly(sheet(30, 20, 0.3, 0.2, 0.3), 1);
}
TEST(RefreshStiffness, GivesWhatANewAssemblyGivesOnASphere) {
    compare_with_new_assembly(sphere(4, 0.1), 20);
}
TEST(RefreshStiffness, GivesWhatANewAssemblyGivesOnAClosedLathe) {
    compare_with_new_assembly(closed_lathe(36, 24, 0.1, 0.3), 40);
}

TEST(RefreshStiffness, GivesWhatANewAssemblyGivesOnAWoodenSheet) {
    compare_with_new_assembly(sheet(30, 20, 0.3, 0.2, 0.3), 1, true);
}
TEST(RefreshStiffness, GivesWhatANewAssemblyGivesOnAWoodenSphere) {
    compare_with_new_assembly(sphere(4, 0.1), 20, true);
}

}  // namespace
}  // namespace cullet
