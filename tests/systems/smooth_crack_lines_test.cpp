#include "systems/view/smooth_crack_lines.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "systems/fragments/make_piece.hpp"
#include "systems/fragments/prism.hpp"
#include "systems/view/draw_shell.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

using Place = std::array<float, 3>;

Place place_of(Vec3 p) {
    return {p.x, p.y, p.z};
}

struct Cracked {
    State state;
    Row<Shells> shell;
    std::vector<FragmentPart> parts;

    explicit Cracked(const SampleSurface& surface, int seeds) {
        const auto built = build_shell(state, surface.source(), sample_material(state));
        EXPECT_TRUE(built.ok()) << built.error();
        shell = cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), seeds, 2));
        parts.resize(100);
        parts.resize(group_fragments(view(), parts));
    }
    ShellView view() { return ShellView(state, shell); }
    Vec3 drawn(uint32_t v) {
        return state.vertices.rest[view().vertex(v)] + state.vertices.drawn_shift[view().vertex(v)];
    }
    /// Share of crack edge pairs that turn by more than 40 degrees.
    double kinks() {
        std::map<uint32_t, uint32_t> next;
        for (uint32_t e = 0; e < view().element_count(); ++e)
            for (int k = 0; k < 3; ++k)
                if (state.elements.edge_kind[view().element(e)][k] == static_cast<uint8_t>(EdgeKind::Crack)) {
                    const auto c = state.elements.corner[view().element(e)];
                    next[c[k]] = c[(k + 1) % 3];
                }
        int sharp = 0, all = 0;
        for (const auto& [a, b] : next) {
            const auto c = next.find(b);
            if (c == next.end()) continue;
            const Vec3 u = normalised(drawn(b) - drawn(a)), v = normalised(drawn(c->second) - drawn(b));
            sharp += dot(u, v) < 0.766f;
            ++all;
        }
        return static_cast<double>(sharp) / all;
    }
};

std::vector<SampleSurface> samples() {
    return {sample_sphere(0.2, 0.01, 4), sample_vase(0.3, 0.005, 48, 40), sample_grid(0.5, 0.4, 25, 20, 0.004, 0.4)};
}

TEST(SmoothCrackLines, LinesBecomeStraighterAndEveryPrismStaysSound) {
    for (const SampleSurface& surface : samples()) {
        Cracked cracked(surface, 10);
        const double before = cracked.kinks();
        const uint32_t moved = smooth_crack_lines(cracked.view());
        const double after = cracked.kinks();
        std::printf("%u vertices moved, kinks above 40 degrees %.3f -> %.3f\n", moved, before, after);
        EXPECT_GT(moved, 0u);
        EXPECT_LT(after, 0.85 * before);  // these lines zigzag at every vertex, which real cracks do not
        for (uint32_t e = 0; e < cracked.view().element_count(); ++e) {
            const double rest = prism_volume(load_prism(cracked.view(), e));
            EXPECT_GE(prism_volume(load_prism(cracked.view(), e, Surface::Drawn)), 0.19 * rest);
        }
    }
}

TEST(SmoothCrackLines, BothSidesOfACrackMoveAlikeAndJunctionsAndRimsStay) {
    for (const SampleSurface& surface : samples()) {
        Cracked cracked(surface, 10);
        smooth_crack_lines(cracked.view());
        std::map<Place, std::set<Place>> drawn;
        std::map<Place, int> copies;
        for (uint32_t v = 0; v < cracked.view().vertex_count(); ++v) {
            const uint32_t row = cracked.view().vertex(v);
            if (cracked.state.vertices.element[row] == kNone) continue;
            const Place at = place_of(cracked.state.vertices.rest[row]);
            drawn[at].insert(place_of(cracked.drawn(v)));
            ++copies[at];
        }
        for (const auto& [at, places] : drawn) {
            EXPECT_EQ(places.size(), 1u);
            EXPECT_TRUE(copies[at] == 2 || *places.begin() == at);
        }
        // Again: nothing changes, since shifts are found from rest positions.
        std::vector<Place> once;
        for (uint32_t v = 0; v < cracked.view().vertex_count(); ++v) once.push_back(place_of(cracked.drawn(v)));
        smooth_crack_lines(cracked.view());
        for (uint32_t v = 0; v < cracked.view().vertex_count(); ++v) EXPECT_EQ(place_of(cracked.drawn(v)), once[v]);
    }
}

TEST(SmoothCrackLines, DrawnPiecesAreClosedFitAndKeepTheWholesVolume) {
    for (const SampleSurface& surface : samples()) {
        Cracked cracked(surface, 10);
        State& state = cracked.state;
        smooth_crack_lines(cracked.view());
        double pieces = 0, whole = 0;
        for (uint32_t e = 0; e < cracked.view().element_count(); ++e)
            whole += prism_volume(load_prism(cracked.view(), e));
        for (const FragmentPart& part : cracked.parts) {
            const Row<Shells> row = make_piece(state, cracked.shell, part, 1);
            const ShellView piece(state, row);
            const DrawnCount count = count_drawn(piece);
            Range vertices{state.view_vertices.append(count.vertices), 0, count.vertices};
            Range indices{state.view_indices.append(count.index_count()), 0, count.index_count()};
            draw_shell(piece, vertices, indices);
            const Result<void> checked = check_drawn_mesh(piece, vertices, indices);
            EXPECT_TRUE(checked.ok()) << checked.error();
            for (uint32_t e = 0; e < piece.element_count(); ++e)
                pieces += prism_volume(load_prism(piece, e, Surface::Drawn));
            // A shift belongs to the picture alone.
            smooth_crack_lines(piece);
            EXPECT_TRUE(check_drawn_mesh(piece, vertices, indices).ok());
        }
        EXPECT_NEAR(pieces / whole, 1, 1e-3);
    }
}

}  // namespace
}  // namespace cullet
