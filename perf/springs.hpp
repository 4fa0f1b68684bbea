// The two yardsticks of springs: the plain loop that scatters, and the bare kernel, which is the limit.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "components/shells.hpp"

class btSoftBody;

namespace cullet::perf {

class Figures;

/// Springs of one stiffness and damping between vertices of one mass.
struct SpringNet {
    std::vector<Vec3> points;                      // at rest, m
    std::vector<std::array<uint32_t, 2>> springs;  // ends; neighbours should be near in number
    float stiffness = 0;                           // N/m
    float damping = 0;                             // N s/m, along the spring
    float mass = 0;                                // kg a vertex
    float dt = 0;                                  // s
};

/// The nodes and links of a soft body. Its stiffest mode is far from the limit of stability: dt is 0.2 sqrt(m / k).
SpringNet net_of(const btSoftBody& body);

/// Structs, a loop over springs that scatters forces, a loop over vertices. Damping from the length kept in the spring.
class PlainSprings {
 public:
    PlainSprings(const SpringNet& net, const std::vector<Vec3>& start);
    void step();
    Vec3 position(uint32_t v) const { return vertices_[v].x; }

 private:
    struct Vertex {
        Vec3 x, v, f;
        float strain;  // the largest of its springs
    };
    struct Spring {
        uint32_t a, b;
        float rest, length;
    };
    float stiffness_, damping_, dt_, inverse_mass_;
    std::vector<Vertex> vertices_;
    std::vector<Spring> springs_;
};

/// One fused pass over vertices in packs of 8: force, damping from the length kept in the slot, semi-implicit Euler,
/// largest elongation a vertex. Each spring stands in the padded lists of both its ends; positions have two sides. Raw
/// AVX2.
class BareSprings {
 public:
    BareSprings(const SpringNet& net, const std::vector<Vec3>& start);
    static bool is_supported();
    void step();
    /// Packs [first, end) of a step from this side of the positions to the other: for threads that share the step and
    /// wait for each other behind it.
    void step_packs(uint32_t side, uint32_t first, uint32_t end);
    uint32_t pack_count() const { return static_cast<uint32_t>(first_slots_.size()) - 1; }
    Vec3 position(uint32_t v) const;
    float strain(uint32_t v) const { return strain_[v]; }

 private:
    struct alignas(32) Slots {  // of 8 vertices; what is padding has a stiffness of 0 and is its own neighbour
        uint32_t neighbour[8];
        float inverse_rest[8], stiffness_rest[8], damping[8], length[8];
    };
    float dt_, inverse_mass_;
    uint32_t side_ = 0;
    std::vector<uint32_t> first_slots_;  // one a pack, and the end
    std::vector<Slots> slots_;
    std::vector<Float4> position_[2];
    std::vector<float> velocity_[3], strain_;
};

/// What our substeps cost beside iterations of Bullet's soft body where both err alike, and how both err where they
/// cost alike. Seconds of a spring and substep as the frame runs it, and of a link and iteration.
void measure_equal_error(double substep, double link_iteration, Figures& figures);

}  // namespace cullet::perf
