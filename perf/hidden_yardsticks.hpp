// The two yardsticks of the hidden step: the bare kernel (the limit) and plain element loops.
#pragma once
#include <memory>
#include <vector>

#include "components/state.hpp"

namespace cullet::perf {

/// The least that the step can be: slots in one interleaved stream without spare ones, raw AVX2 intrinsics, no task, no
/// dispatch, no contact. A shell that stores the pairs of a pair cell once is stepped so here, too; `run_packs` then
/// takes whole cells.
class BareHidden {
 public:
    BareHidden(ShellView shell, float dt, float beta);
    static bool is_supported();
    uint32_t pack_count() const { return static_cast<uint32_t>(packs_.size()); }
    void run_packs(uint32_t side, uint32_t first, uint32_t count);
    Vec3 displacement(uint32_t vertex) const { return {u_[0][vertex], u_[1][vertex], u_[2][vertex]}; }
    /// Of stiffness, all vertices.
    size_t bytes() const { return 4 * (stream_.size() - kPadding); }

 private:
    static constexpr size_t kPadding = 1024;  // floats: prefetched beyond the end
    struct Pack {
        size_t offset;  // floats
        uint32_t blocks, links;
    };
    struct alignas(64) Line {
        float f[16];
    };
    float dt_, beta_;
    bool has_pair_cells_;
    std::vector<Pack> packs_;
    std::vector<float> stream_;  // aligned by hand: base_
    float* base_ = nullptr;
    std::vector<Float4> probe_[2];
    std::vector<float> u_[3], v_[3], inverse_mass_;
    void integrate(uint32_t side, uint32_t first, uint32_t count);
    void integrate_cell(uint32_t side, uint32_t first_pack);
};

/// What a C++ programmer writes: structs, loops over triangles and hinges that scatter forces, a loop over vertices.
class PlainHidden {
 public:
    PlainHidden(ShellView shell, float dt, float beta);
    void step();

 private:
    struct Vertex {
        Vec3 u, v, w, f;
        float inverse_mass;
    };
    struct Triangle {
        uint32_t corner[3];
        Vec3 x, y, inverse_edges;
        float volume;
    };
    struct Hinge {
        uint32_t vertex[4];
        Vec3 gradient[4];
        float stiffness;
    };
    float dt_, beta_, c11_, c12_, c33_;
    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    std::vector<Hinge> hinges_;
};

struct Options;
class Figures;
/// Rows of scene hidden_step: a body of 98,000 vertices hit as in a frame. False: it was not opened so.
bool measure_hidden_region_step(const Options& options, Figures& figures);

}  // namespace cullet::perf
