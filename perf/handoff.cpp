// A thousand new pieces enter the rigid world, beside a bare loop that makes the same bodies in plain Bullet.
#include <LinearMath/btConvexHullComputer.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "components/state.hpp"
#include "engine/arena.hpp"
#include "engine/fp_mode.hpp"
#include "perf/perf.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kFragments = 1000;
constexpr RigidId kWhole = kFragments;  // that they broke off from
constexpr int kPieces = 50;             // of one vase or wall
constexpr float kApart = 4;             // m between the things that broke
constexpr uint32_t kMostSets = 64;      // of them
constexpr size_t kArenaBytes = size_t{16} << 20;

/// Shards of vases and slabs of walls in turn, as a break leaves them: rows filled, shapes not chosen.
struct Broken {
    Broken() {
        const Row<Materials> material = sample_material(state);
        for (uint32_t set = 0; set < kMostSets && state.bodies.size() < kFragments; ++set) {
            const SampleSurface surface =
                set % 2 == 0 ? sample_vase(0.3, 0.005, 64, 60) : sample_grid(2.4, 1.8, 61, 47, 0.1, 0.5);
            const auto built = build_shell(state, surface.source(), material);
            if (!built.ok()) {
                std::printf("%s\n", built.error().c_str());
                return;
            }
            const Row<Structures> cut =
                cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), kPieces, set));
            std::vector<FragmentPart> parts(kMostParts);
            parts.resize(group_fragments(ShellView(state, cut), parts));
            for (const FragmentPart& part : parts)
                if (state.bodies.size() < kFragments && part.element_count > 2)
                    add(make_piece(state, cut, part, 1), {kApart * static_cast<float>(set), 0, 0});
            release_shell(state, built.value());
            release_shell(state, cut);
        }
    }
    void add(Row<Structures> shell, Vec3 place) {
        const Row<Bodies> body(state.bodies.append(1));
        state.bodies.structure[body] = shell;
        state.bodies.kind[body] = static_cast<uint8_t>(BodyKind::Dynamic);
        state.bodies.position.set(body, place);
        state.bodies.orientation[body] = {};
        state.bodies.layer[body] = 1;
        state.bodies.mask[body] = ~0u;
        take_mass_properties(state.bodies, state.structures, body,
                             radius_of(ShellView(state, state.bodies.structure[body])));
    }
    /// As fill_births and fill_hulls do it; numbers of shapes are spaced for all cells of all pieces.
    void choose(uint32_t b) {
        const ShellView shell(state, state.bodies.structure[Row<Bodies>(b)]);
        choose_shape(shell, shell.points().first);
        if (shape_of(shell) != ShapeKind::Cells) return empty_piece_cells(shell);
        copy_piece_hulls(shell, shell, 0, false);
        for (uint32_t c = 0; c < shell.cells().count; ++c) choose_hull(shell, c);
    }
    /// Numbers for the faces of all pieces; how many there are.
    uint32_t number_shapes() {
        uint32_t next = 0;
        for (uint32_t b = 0; b < state.bodies.size(); ++b) {
            const Row<Structures> shell = state.bodies.structure[Row<Bodies>(b)];
            const Range cells = state.structures.cells[shell];
            state.structures.made_shape[shell] = next;
            for (uint32_t c = 0; c < cells.count; ++c) state.cells.shape[cells.first + c] = next + c;
            next += cells.count;
        }
        return kMostCellParts * next;
    }
    State state;
    Arena arena{kArenaBytes};
};

std::span<const ConvexPiece> pieces_of(Broken& broken, uint32_t b) {
    pack_hulls(ShellView(broken.state, broken.state.bodies.structure[Row<Bodies>(b)]));
    return convex_pieces(broken.state, broken.state.bodies.structure[Row<Bodies>(b)], broken.arena, kFragments);
}

/// Ours: what the pieces of a fragment cover of each other is found by the next solve, on all threads, and not in it.
/// `ready` is the hand-off alone, `fitted` with the choice of shapes and their faces. The world stays from round
/// to round, as the heap of the bare loop does.
void run_ours(Broken& broken, const std::unique_ptr<RigidWorld>& world, double& ready, double& fitted) {
    const FpMode mode;
    State& state = broken.state;
    world->reserve_shapes(broken.number_shapes());
    const double chosen = seconds([&] {
        for (uint32_t b = 0; b < state.bodies.size(); ++b) {
            broken.choose(b);
            broken.arena.reset();
            for (const ConvexPiece& piece : pieces_of(broken, b)) world->make_shape(piece.shape, piece.points);
        }
    });
    const double added = seconds([&] {
        for (uint32_t b = 0; b < state.bodies.size(); ++b) {
            broken.arena.reset();
            const Row<Bodies> body(b);
            RigidDescription description = describe_rigid(state.bodies, state.structures, body, pieces_of(broken, b));
            description.parent = kWhole;
            world->add(b, description);
        }
    });
    for (uint32_t b = 0; b < state.bodies.size(); ++b) world->remove(b);
    ready = std::min(ready, added);
    fitted = std::min(fitted, chosen + added);
}

/// The same bodies: a box, a hull, or a compound of hulls, inertia given.
struct Bare {
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
};

btCollisionShape* make_shape(Bare& bare, std::span<const ConvexPiece> pieces, float margin) {
    btCompoundShape* compound = nullptr;
    if (pieces.size() > 1) {
        bare.shapes.push_back(std::make_unique<btCompoundShape>());
        compound = static_cast<btCompoundShape*>(bare.shapes.back().get());
    }
    for (const ConvexPiece& piece : pieces) {
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Vec3 p : piece.points) hull->addPoint({p.x, p.y, p.z}, false);
        hull->setMargin(margin);
        hull->recalcLocalAabb();
        if (compound) compound->addChildShape(btTransform::getIdentity(), hull.get());
        bare.shapes.push_back(std::move(hull));
    }
    return compound ? compound : bare.shapes.back().get();
}

double run_bare(Broken& broken) {
    State& state = broken.state;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    Bare bare;
    const double taken = seconds([&] {
        for (uint32_t b = 0; b < state.bodies.size(); ++b) {
            broken.arena.reset();
            const Row<Bodies> body(b);
            btCollisionShape* const shape =
                make_shape(bare, convex_pieces(state, state.bodies.structure[body], broken.arena),
                           hull_margin(ShellView(state, state.bodies.structure[body])));
            const Sym3d& i = state.bodies.inertia[body];
            btRigidBody::btRigidBodyConstructionInfo info(
                static_cast<float>(state.bodies.mass[body]), nullptr, shape,
                {static_cast<float>(i.xx), static_cast<float>(i.yy), static_cast<float>(i.zz)});
            const Vec3 p = state.bodies.position[body];
            info.m_startWorldTransform.setOrigin({p.x, p.y, p.z});
            bare.bodies.push_back(std::make_unique<btRigidBody>(info));
            world.addRigidBody(bare.bodies.back().get());
        }
    });
    for (auto& body : bare.bodies) world.removeRigidBody(body.get());
    return taken;
}

/// The hull of each piece's drawn points by Bullet.
double run_computer(Broken& broken) {
    State& state = broken.state;
    std::vector<std::vector<float>> points(state.bodies.size());
    for (uint32_t b = 0; b < state.bodies.size(); ++b) {
        const ShellView shell(state, state.bodies.structure[Row<Bodies>(b)]);
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            if (state.vertices.element[shell.vertex(v)] == kNone) continue;
            for (const Vec3 p :
                 {smoothed_place(state, shell.vertex(v)), smoothed_twin(state, shell.vertex(v)).to_float()})
                for (const float x : {p.x, p.y, p.z}) points[b].push_back(x);
        }
    }
    return seconds([&] {
        for (const auto& list : points) {
            btConvexHullComputer computer;
            computer.compute(list.data(), 3 * sizeof(float), static_cast<int>(list.size() / 3), 0, 0);
        }
    });
}

}  // namespace

bool measure_handoff(const Options& options, Figures& figures) {
    const auto broken = std::make_unique<Broken>();
    const auto world = make_bullet_world(kFragments + 1);
    RigidDescription whole;
    whole.radius = 0.1f, whole.mass = 1;
    world->add(kWhole, whole);
    double ready = 1e9, fitted = 1e9, bare = 1e9, computer = 1e9;
    for (uint32_t round = 0; round < options.rounds_of_a_pass(15); ++round) {
        run_ours(*broken, world, ready, fitted);
        bare = std::min(bare, run_bare(*broken));
        computer = std::min(computer, run_computer(*broken));
    }
    uint32_t kinds[3] = {};
    State& state = broken->state;
    const uint32_t count = state.bodies.size();
    for (uint32_t b = 0; b < count; ++b) ++kinds[state.structures.shape[state.bodies.structure[Row<Bodies>(b)]]];
    figures.add("fragments", count, "");
    figures.add("boxes", kinds[static_cast<size_t>(ShapeKind::Box)], "");
    figures.add("hulls", kinds[static_cast<size_t>(ShapeKind::Hull)], "");
    figures.add("groups of cells", kinds[static_cast<size_t>(ShapeKind::Cells)], "");
    const double us = 1e6 / count;
    figures.add_ratio("a fragment, shapes ready / bare loop", us * ready, us * bare, "us", 1.5);
    figures.add_ratio("a fragment, with shape fitting / bare loop and btConvexHullComputer", us * fitted,
                      us * (bare + computer), "us", 2.5);
    return count == kFragments;
}

}  // namespace cullet::perf
