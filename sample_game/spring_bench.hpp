// Springs without a game: one shell, straight in the tables, its substeps run one by one with forces and holds between
// them. What truth, tests and pictures of springs are made with.
#pragma once
#include <functional>
#include <memory>

#include "components/state.hpp"
#include "systems/models/thick_shell/springs/give_springs.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"

namespace cullet {

/// Points and triangles, counter-clockwise from outside.
struct BenchMesh {
    std::vector<Vec3d> points;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// `rows` rows of equilateral triangles with edges of `edge` along x, symmetric about x = 0: even rows of points have
/// one at 0 and at +-half_edges * edge, odd rows half an edge more at both ends. The plane z = 0, y from 0 up.
BenchMesh bench_strip(uint32_t half_edges, uint32_t rows, double edge);
/// Equilateral lattice over a disc in the plane z = 0, the middle a point: what lies within `rings` edges of it, and
/// the triangles' other corners.
BenchMesh bench_disc(uint32_t rings, double edge);
/// Geodesic sphere: an icosahedron's edges halved `rounds` times.
BenchMesh bench_sphere(double radius, int rounds);

struct BenchMaterial {
    double young_modulus = 1e7, poisson_ratio = 1.0 / 3, density = 1000;
};

class SpringBench {
 public:
    /// A shell of constant thickness, at rest, in the body frame, vertices in the mesh's order. `spare` vertices of
    /// room for splits, or for inserts with their elements.
    SpringBench(const BenchMesh& mesh, double thickness, const BenchMaterial& material, const SpringSettings& settings,
                const std::function<bool(Vec3d)>& is_pinned = {}, uint32_t spare = 0);
    /// A chain, net or the like: masses at points.
    SpringBench(const std::vector<Vec3d>& points, const std::vector<double>& masses,
                const std::vector<GivenSpring>& springs, const SpringSettings& settings,
                const std::function<bool(uint32_t)>& is_pinned = {});

    State& state() { return *state_; }
    SpringView view() { return SpringView(*state_, springs_); }
    Row<ShellSprings> springs() const { return springs_; }
    Row<Structures> shell() const { return shell_; }
    uint32_t size() const { return state_->shells.vertices[state_->shell_of(shell_)].count; }
    double time_step() const { return double{state_->shell_springs.time_step[springs_]}; }

    /// Middle of both layers' points, m.
    Vec3d middle(uint32_t v);
    Vec3 velocity(uint32_t v) const { return state_->vertices.velocity[row(v)]; }
    void set_velocity(uint32_t v, Vec3 speed);
    /// A force on a vertex from now on, shared by its layers, N.
    void load(uint32_t v, Vec3d force);
    void step();
    /// Steps for `seconds` with a damping that is critical at `omega`, 1/s: v falls by exp(-2 omega t) beside the rest.
    void settle(double omega, double seconds);

 private:
    uint32_t row(uint32_t v) const { return state_->shells.vertices[state_->shell_of(shell_)].first + v; }
    void push_loads();

    std::unique_ptr<State> state_;
    Row<Structures> shell_;
    Row<ShellSprings> springs_;
    struct Load {
        uint32_t vertex;
        Vec3d force;
    };
    std::vector<Load> loads_;
};

}  // namespace cullet
