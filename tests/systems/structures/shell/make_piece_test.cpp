#include "systems/structures/shell/make_piece.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

uint32_t indices_of(const DrawnCount& count, SurfaceKind kind) {
    const auto first = count.indices.begin() + static_cast<uint32_t>(kind) * kMostDrawnMaterials;
    return std::accumulate(first, first + kMostDrawnMaterials, 0u);
}

struct Broken {
    State state;
    Row<Structures> intact, shell;
    std::vector<FragmentPart> parts;

    Broken(const SampleSurface& surface, int seeds, uint64_t seed = 1) {
        const auto built = build_shell(state, surface.source(), sample_material(state));
        EXPECT_TRUE(built.ok()) << built.error();
        intact = built.value();
        shell = cut_by_label(state, intact, nearest_seed(ShellView(state, intact), seeds, seed));
        group();
    }
    void group() {
        parts.resize(1000);
        parts.resize(group_fragments(ShellView(state, shell), parts));
    }
    ShellView view() { return ShellView(state, shell); }
};

std::vector<SampleSurface> samples() {
    SampleSurface tapered = sample_grid(0.4, 0.4, 20, 20, 0.01, 0.4);
    for (size_t v = 0; v < tapered.depth.size(); ++v)
        tapered.depth[v] = std::max(0.0, 0.01 * (tapered.position[v].x * 5 - 0.2));  // flat on the left
    return {sample_sphere(0.2, 0.01, 3), sample_vase(0.3, 0.005, 48, 40), sample_grid(0.5, 0.4, 25, 20, 0.004, 0.4),
            tapered};
}

TEST(GroupFragments, EachElementIsInOnePartAndPartsAreOrderedByTheirSmallestElement) {
    for (const SampleSurface& surface : samples()) {
        Broken broken(surface, 9);
        const ShellView shell = broken.view();
        std::vector<uint32_t> first(broken.parts.size(), kNone), count(broken.parts.size(), 0);
        for (uint32_t e = 0; e < shell.element_count(); ++e) {
            const uint32_t part = broken.state.elements.part[shell.element(e)];
            ASSERT_LT(part, broken.parts.size());
            first[part] = std::min(first[part], e);
            ++count[part];
            for (uint32_t n : broken.state.elements.neighbour[shell.element(e)])
                EXPECT_TRUE(n == kNone || broken.state.elements.part[shell.element(n)] == part);
        }
        for (uint32_t p = 0; p < broken.parts.size(); ++p) {
            EXPECT_EQ(broken.parts[p].first_element, first[p]);
            EXPECT_EQ(broken.parts[p].element_count, count[p]);
            EXPECT_TRUE(p == 0 || first[p - 1] < first[p]);
            uint32_t chained = 0, last = kNone;
            for (uint32_t e = first[p]; e != kNone; e = broken.state.elements.next[shell.element(e)]) {
                EXPECT_TRUE(last == kNone || e > last);
                last = e;
                ++chained;
            }
            EXPECT_EQ(chained, count[p]);
        }
    }
}

TEST(GroupFragments, PartsAreTheComponentsOfAFlood) {
    Broken broken(sample_sphere(0.2, 0.01, 3), 15, 3);
    const ShellView shell = broken.view();
    std::vector<int> found(shell.element_count(), -1);
    int count = 0;
    for (uint32_t seed = 0; seed < shell.element_count(); ++seed) {
        if (found[seed] >= 0) continue;
        std::vector<uint32_t> open{seed};
        found[seed] = count;
        while (!open.empty()) {
            const uint32_t e = open.back();
            open.pop_back();
            EXPECT_EQ(broken.state.elements.part[shell.element(e)], static_cast<uint32_t>(count));
            for (uint32_t n : broken.state.elements.neighbour[shell.element(e)])
                if (n != kNone && found[n] < 0) found[n] = count, open.push_back(n);
        }
        ++count;
    }
    EXPECT_EQ(static_cast<size_t>(count), broken.parts.size());
}

TEST(GroupFragments, DeadElementsAreInNoPartAndAShortListCountsOn) {
    Broken broken(sample_sphere(0.2, 0.01, 3), 15, 3);
    const ShellView shell = broken.view();
    std::vector<FragmentPart> two(2);
    EXPECT_EQ(group_fragments(shell, two), broken.parts.size());
    EXPECT_EQ(two[1].mass, broken.parts[1].mass);
    EXPECT_EQ(group_fragments(shell, {}), broken.parts.size());
}

void expect_sound_shell(const ShellView& shell) {
    const ShellRows& state = shell.state;
    std::set<uint32_t> hinges, used;
    uint32_t last_cell = 0;
    double mass = 0, vertex_mass = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        EXPECT_EQ(state.elements.part[row], 0u);
        EXPECT_GE(state.elements.cell[row], last_cell);
        last_cell = state.elements.cell[row];
        mass += state.elements.mass[row];
        for (int k = 0; k < 3; ++k) {
            ASSERT_LT(state.elements.corner[row][k], shell.vertex_count());
            used.insert(state.elements.corner[row][k]);
            const uint32_t n = state.elements.neighbour[row][k], h = state.elements.hinge[row][k];
            if (n == kNone) {
                EXPECT_EQ(h, kNone);
                EXPECT_NE(state.elements.edge_kind[row][k], static_cast<uint8_t>(EdgeKind::Interior));
                continue;
            }
            ASSERT_LT(n, shell.element_count());
            int back = 0;
            while (back < 3 && state.elements.neighbour[shell.element(n)][back] != e) ++back;
            ASSERT_LT(back, 3);
            EXPECT_EQ(state.elements.corner[shell.element(n)][back], state.elements.corner[row][(k + 1) % 3]);
            EXPECT_EQ(state.elements.hinge[shell.element(n)][back], h);
            ASSERT_LT(h, shell.hinge_count());
            hinges.insert(h);
            const auto& v = state.hinges.vertex[shell.hinge(h)];
            EXPECT_EQ(std::set<uint32_t>({v[0], v[1]}),
                      std::set<uint32_t>({state.elements.corner[row][k], state.elements.corner[row][(k + 1) % 3]}));
        }
    }
    EXPECT_EQ(hinges.size(), shell.hinge_count());
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), e = state.vertices.element[row];
        vertex_mass += state.vertices.mass[row];
        EXPECT_EQ(e != kNone, used.count(v) == 1);
        if (e == kNone) continue;
        const auto& c = state.elements.corner[shell.element(e)];
        EXPECT_TRUE(c[0] == v || c[1] == v || c[2] == v);
    }
    EXPECT_NEAR(vertex_mass / mass, 1, 1e-12);
    EXPECT_NEAR(state.structures.mass[shell.structure] / mass, 1, 1e-12);
    EXPECT_EQ(last_cell + 1, state.structures.cells[shell.structure].count);
}

TEST(MakePiece, PiecesAreSoundShellsAndTheirMassesAddUpToTheParents) {
    for (const SampleSurface& surface : samples()) {
        Broken broken(surface, 12);
        double mass = 0, volume = 0, parent_volume = 0;
        Moments moments;
        std::vector<Row<Structures>> pieces;
        for (const FragmentPart& part : broken.parts) {
            const Row<Structures> row = make_piece(broken.state, broken.shell, part, 1);
            ASSERT_TRUE(row.exists());
            const ShellView piece(broken.state, row);
            expect_sound_shell(piece);
            EXPECT_EQ(piece.element_count(), part.element_count);
            EXPECT_NEAR(broken.state.structures.mass[row] / part.mass, 1, 1e-12);
            mass += broken.state.structures.mass[row];
            moments = moments + moments_of({broken.state.structures.mass[row], broken.state.structures.centre[row],
                                            broken.state.structures.inertia[row]});
            for (uint32_t e = 0; e < piece.element_count(); ++e) volume += prism_volume(load_prism(piece, e));
            pieces.push_back(row);
        }
        const ShellView parent(broken.state, broken.shell);
        for (uint32_t e = 0; e < parent.element_count(); ++e) parent_volume += prism_volume(load_prism(parent, e));
        EXPECT_NEAR(mass / broken.state.structures.mass[broken.intact], 1, 1e-12);
        EXPECT_NEAR(volume / parent_volume, 1, 1e-12);  // the same tetrahedra, so order of corners was kept
        const MassProperties sum = mass_properties(moments);
        const MassProperties whole = mass_properties(shell_moments(parent));
        EXPECT_NEAR(length(sum.centre - whole.centre), 0, 1e-12);
        EXPECT_NEAR(sum.inertia.yy / whole.inertia.yy, 1, 1e-12);
        // One piece gone: by subtraction as by summing the others anew.
        const MassProperties rest =
            mass_properties(shell_moments(parent) - shell_moments(ShellView(broken.state, pieces[0])));
        Moments others;
        for (size_t p = 1; p < pieces.size(); ++p) others = others + shell_moments(ShellView(broken.state, pieces[p]));
        EXPECT_NEAR(length(rest.centre - mass_properties(others).centre), 0, 1e-12);
        EXPECT_NEAR(rest.inertia.xx / mass_properties(others).inertia.xx, 1, 1e-11);
        EXPECT_EQ(broken.state.validate(), "");
    }
}

TEST(MakePiece, JoinedPartsBecomeOneShellOfTwoComponents) {
    Broken broken(sample_vase(0.3, 0.005, 48, 40), 8);
    ASSERT_GT(broken.parts.size(), 4u);
    const double mass = broken.parts[4].mass + broken.parts[1].mass + broken.parts[3].mass;
    join_parts(broken.view(), broken.parts[4], broken.parts[1], 1);
    join_parts(broken.view(), broken.parts[1], broken.parts[3], 3);
    EXPECT_EQ(broken.parts[1].element_count, 0u);
    const Row<Structures> row = make_piece(broken.state, broken.shell, broken.parts[3], 1);
    const ShellView piece(broken.state, row);
    expect_sound_shell(piece);
    EXPECT_NEAR(broken.state.structures.mass[row] / mass, 1, 1e-12);
    std::vector<FragmentPart> again(9);
    EXPECT_EQ(group_fragments(piece, again), 3u);
}

TEST(MakePiece, CompactingAWholeShellKeepsWhatItIs) {
    Broken broken(sample_vase(0.3, 0.005, 48, 40), 1);  // no cut
    ASSERT_EQ(broken.parts.size(), 1u);
    broken.state.vertices.crack[broken.view().vertex(5)] = static_cast<uint8_t>(CrackState::Tip);
    broken.state.vertices.crack_start[broken.view().vertex(5)] = 9;
    const Row<Structures> row = make_piece(broken.state, broken.shell, broken.parts[0], 0);
    const ShellView piece(broken.state, row), old = broken.view();
    expect_sound_shell(piece);
    EXPECT_EQ(broken.state.structures.has_cracks[row], 1);
    uint32_t tips = 0;
    for (uint32_t v = 0; v < piece.vertex_count(); ++v) {
        const uint32_t r = piece.vertex(v);
        if (broken.state.vertices.crack[r] != static_cast<uint8_t>(CrackState::Tip)) continue;
        ++tips;
        EXPECT_EQ(broken.state.vertices.rest[r], broken.state.vertices.rest[old.vertex(5)]);
        EXPECT_EQ(broken.state.vertices.rest[piece.vertex(broken.state.vertices.crack_start[r])],
                  broken.state.vertices.rest[old.vertex(9)]);
    }
    EXPECT_EQ(tips, 1u);
    EXPECT_NEAR(broken.state.structures.mass[row] / broken.state.structures.mass[broken.intact], 1, 1e-14);
    EXPECT_EQ(broken.state.shells.hinges[broken.state.shell_of(row)].count,
              broken.state.shells.hinges[broken.state.shell_of(broken.intact)].count);
}

TEST(MakePiece, SmallFragmentsAreFewConvexPieces) {
    Broken broken(sample_vase(0.3, 0.005, 60, 50), 40);
    uint32_t cells = 0, elements = 0, most = 0;
    for (const FragmentPart& part : broken.parts) {
        const Row<Structures> row = make_piece(broken.state, broken.shell, part, 1);
        const uint32_t count = broken.state.structures.cells[row].count;
        EXPECT_LE(count, 2 + 2 * part.element_count / 64);
        cells += count;
        elements += part.element_count;
        most = std::max(most, count);
    }
    std::printf("%zu parts, %u elements, %u cells, at most %u a part\n", broken.parts.size(), elements, cells, most);
}

TEST(MakePiece, AFullTableRefusesAndLeavesNothingBehind) {
    Broken broken(sample_grid(0.5, 0.4, 25, 20, 0.004), 3);
    State small({.vertices = 2048, .elements = 4096});
    const auto built = build_shell(small, sample_grid(0.5, 0.4, 25, 20, 0.004).source(), sample_material(small));
    ASSERT_TRUE(built.ok());
    std::vector<FragmentPart> parts(4);
    parts.resize(group_fragments(ShellView(small, built.value()), parts));
    std::vector<Row<Structures>> made;
    const char* full = nullptr;
    while (true) {
        const Row<Structures> row = make_piece(small, built.value(), parts[0], 1, &full);
        if (!row.exists()) break;
        made.push_back(row);
        ASSERT_LT(made.size(), 100u);
    }
    EXPECT_STREQ(full, "limits.vertices");
    for (Row<Structures> row : made) release_shell(small, row);
    EXPECT_TRUE(make_piece(small, built.value(), parts[0], 1, &full).exists());
}

/// Draws the shell into ranges of its own and checks it.
void expect_closed(State& state, Row<Structures> row) {
    const ShellView shell(state, row);
    const DrawnCount count = count_drawn(shell);
    Range vertices{state.view_vertices.pool.take(count.vertices), 0, count.vertices};
    Range indices{state.view_indices.pool.take(count.index_count()), 0, count.index_count()};
    if (state.view_vertices.pool.end() > state.view_vertices.size())
        state.view_vertices.append(state.view_vertices.pool.end() - state.view_vertices.size());
    if (state.view_indices.pool.end() > state.view_indices.size())
        state.view_indices.append(state.view_indices.pool.end() - state.view_indices.size());
    const DrawnCount drawn = draw_shell(shell, {state.view_vertices, state.view_indices}, vertices, indices);
    EXPECT_EQ(drawn.indices, count.indices);
    EXPECT_EQ(vertices.count, count.vertices);
    const Result<void> checked = check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices);
    EXPECT_TRUE(checked.ok()) << checked.error();
    for (uint32_t i = 0; i < vertices.count; ++i) {
        const Vec3 n = state.view_vertices.vertex[vertices.first + i].normal;
        EXPECT_NEAR(dot(n, n), 1, 1e-4);
    }
}

TEST(DrawShell, IntactBrokenAndPiecesAreClosedAndOfTheElementsVolume) {
    int sample = 0;
    for (const SampleSurface& surface : samples()) {
        SCOPED_TRACE(sample++);
        Broken broken(surface, 12);
        expect_closed(broken.state, broken.intact);
        expect_closed(broken.state, broken.shell);
        for (const FragmentPart& part : broken.parts)
            expect_closed(broken.state, make_piece(broken.state, broken.shell, part, 1));
    }
}

TEST(DrawShell, AnOpenMeshOrAWrongVolumeIsFound) {
    State state;
    const auto built = build_shell(state, sample_grid(0.5, 0.4, 5, 5, 0.004).source(), sample_material(state));
    const ShellView shell(state, built.value());
    const DrawnCount count = count_drawn(shell);
    Range vertices{state.view_vertices.append(count.vertices), 0, count.vertices};
    Range indices{state.view_indices.append(count.index_count()), 0, count.index_count()};
    draw_shell(shell, {state.view_vertices, state.view_indices}, vertices, indices);
    EXPECT_TRUE(check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices).ok());
    EXPECT_EQ(indices_of(count, SurfaceKind::Crack), 0u);  // rims are drawn with the inner surface
    EXPECT_EQ(indices_of(count, SurfaceKind::Inner), 150u + 20u * 6u);
    Range fewer = indices;
    fewer.count -= 3;
    EXPECT_NE(check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, fewer).error().find("open"),
              std::string::npos);
    const std::span index(state.view_indices.index.data() + indices.first, indices.count);
    const std::vector<uint32_t> sound(index.begin(), index.end());
    for (size_t i = 0; i < index.size(); i += 3) std::swap(index[i], index[i + 1]);  // inside out: closed all the same
    EXPECT_NE(
        check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices).error().find("volume"),
        std::string::npos);
    for (size_t i = 0; i < index.size(); ++i)
        index[i] = sound[i % 3];  // one triangle, seen from both sides, many times
    for (size_t i = 3; i < index.size(); i += 6) std::swap(index[i], index[i + 1]);
    EXPECT_NE(check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices)
                  .error()
                  .find("times one way"),
              std::string::npos);
    std::copy(sound.begin(), sound.end(), index.begin());
    EXPECT_TRUE(check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices).ok());
    state.vertices.depth[shell.vertex(0)] *= 1.5f;
    EXPECT_NE(check_drawn_mesh(shell, {state.view_vertices, state.view_indices}, vertices, indices)
                  .error()
                  .find("is drawn at"),
              std::string::npos);
}

TEST(DrawShell, CrackTextureRunsOnAlongABorder) {
    State state;
    const auto built = build_shell(state, sample_grid(0.5, 0.4, 5, 4, 0.004).source(), sample_material(state));
    const ShellView shell(state, built.value());
    const DrawnCount count = count_drawn(shell);
    Range vertices{state.view_vertices.append(count.vertices), 0, count.vertices};
    Range indices{state.view_indices.append(count.index_count()), 0, count.index_count()};
    draw_shell(shell, {state.view_vertices, state.view_indices}, vertices, indices);
    float most = 0;
    for (uint32_t v = 6 * shell.element_count(); v < vertices.count; ++v) {
        const Vec2 uv = state.view_vertices.vertex[vertices.first + v].uv;
        most = std::max(most, uv.x);
        EXPECT_LE(uv.y, 0.0041f);
    }
    EXPECT_NEAR(most, 1.8f, 1e-5f);  // once round
}

}  // namespace
}  // namespace cullet
