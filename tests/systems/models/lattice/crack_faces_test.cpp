// Crack faces without teeth (solid cooking note, section 7; T10).
#include "systems/models/lattice/crack/crack_faces.hpp"

#include <gtest/gtest.h>

#include "systems/models/lattice/crack/break_run.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "tests/support/lattice_solids.hpp"

namespace cullet {
namespace {

const Vec3d kHalf{0.12, 0.035, 0.0575};

BreakableSolid brick(double cells, int elements) {
    const double volume = 8 * kHalf.x * kHalf.y * kHalf.z;
    return make_breakable(
        fill_convex(box_planes(kHalf), kHalf, {.edge = edge_for(volume, cells), .elements = elements}));
}

struct Faces {
    Arena arena;
    CrackFaces faces;
    explicit Faces(const BreakableSolid& body) : arena(faces_bytes(body)), faces(take_faces(arena, body)) {}
};

double broken_area(const BreakableSolid& body, const std::vector<uint32_t>& piece) {
    double area = 0;
    for (const SolidBond& bond : body.solid.bonds)
        if (piece[bond.a] != piece[bond.b]) area += bond.area;
    return area;
}

// How far normals of crack faces lie from the plane's, on average over their area: the sine.
double roughness(const BreakableSolid& body, const std::vector<uint32_t>& piece, std::span<const Vec3d> places,
                 Vec3d normal) {
    double sum = 0, area = 0;
    for (const SolidBond& bond : body.solid.bonds) {
        if (piece[bond.a] == piece[bond.b]) continue;
        const auto& corners = body.solid.lattice.fine[bond.tetrahedron];
        const Vec3d p = places[corners[(bond.face + 1) % 4]], q = places[corners[(bond.face + 2) % 4]],
                    r = places[corners[(bond.face + 3) % 4]];
        sum += bond.area * length(cross(normal, normalised(cross(q - p, r - p))));
        area += bond.area;
    }
    return sum / area;
}

TEST(CrackFaces, APlaneThroughTheLatticeBecomesOne) {
    const BreakableSolid body = brick(1500, 2);
    const LatticePoints points = find_lattice_points(body.solid.lattice);
    const Vec3d normal = normalised(Vec3d{1, 0.3, -0.2});
    std::vector<uint32_t> piece;
    std::vector<double> volume(2, 0.0);
    for (const SolidCell& cell : body.solid.cells) {
        piece.push_back(dot(normal, cell.centroid) > 0.01);
        volume[piece.back()] += cell.volume;
    }
    const double rough = broken_area(body, piece);
    EXPECT_GT(filter_by_majority(body, {}, piece, volume), 0u);
    EXPECT_LT(broken_area(body, piece), rough);
    Faces made(body);
    join_islands(body, piece, volume, made.faces);
    fit_planes(body, points, {}, piece, made.faces);
    EXPECT_GT(made.faces.moved_count, 20u);
    const double before = roughness(body, piece, body.solid.lattice.points, normal);
    const double after = roughness(body, piece, made.faces.places, normal);
    EXPECT_LT(after, 0.5 * before);
}

TEST(CrackFaces, TetrahedraKeepTheirVolumeAndPointsStayNear) {
    for (const int elements : {2, 4}) {
        const BreakableSolid body = brick(1000, elements);
        const LatticePoints points = find_lattice_points(body.solid.lattice);
        for (const double speed : {5.0, 20.0, 80.0}) {
            Arena arena(break_bytes(body));
            BreakRun run = take_break(arena, body);
            begin_break(body, {{12e9, 0.18}, 1900, 2.5e6, 25e6},
                        {kHalf, normalised(Vec3d{-1, -1, -1}), speed, 1.5, 0.01, {30e9, 0.2}, {}, 0.02, {}}, {}, {},
                        run);
            while (!advance_break(body, run, 1'000'000)) continue;
            Faces made(body);
            filter_by_majority(body, {}, run.piece, run.volume);
            join_islands(body, run.piece, run.volume, made.faces);
            std::vector<double> volume(run.piece_count, 0.0);
            for (size_t c = 0; c < run.piece.size(); ++c) volume[run.piece[c]] += body.solid.cells[c].volume;
            for (uint32_t p = 0; p < run.piece_count; ++p) EXPECT_NEAR(volume[p], run.volume[p], 1e-12);
            fit_planes(body, points, {}, run.piece, made.faces);
            const CoverLattice& lattice = body.solid.lattice;
            for (uint32_t t = 0; t < lattice.fine.size(); ++t)
                ASSERT_GE(volume_of(lattice, made.faces.places, t), 0.1499 * volume_of(lattice, lattice.points, t));
            for (uint32_t p = 0; p < lattice.points.size(); ++p) {
                ASSERT_LE(length(made.faces.places[p] - lattice.points[p]), 0.6001 * double{points.shortest[p]});
                ASSERT_TRUE(!points.is_rim[p] || made.faces.places[p] == lattice.points[p]);
            }
        }
    }
}

}  // namespace
}  // namespace cullet
