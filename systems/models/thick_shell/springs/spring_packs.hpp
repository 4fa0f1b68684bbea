// One step of edge springs, one fused pass over packs of 8 vertices (thick shell note B3, B6):
//
//     strain = |x| / L - 1,  pull = k L strain + (c / dt) (|x| - |x| before),  f = pull x / |x|,   x = x_n - x_v
//     v += dt (f / m + g),  x += dt v
//
// A spring is computed at both its ends, from the same numbers, so that what one end gets the other gives to the last
// bit. Any pack may run before any other, on any thread: a pack reads side `side` of the positions and writes its own
// rows of velocities, of the other side, and of its slots. A point whose inverse mass is 0 goes on at its velocity.
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

struct SpringStep {
    const uint32_t* first_slot;  // of the shell's packs
    const uint16_t* slot_count;
    uint32_t* zero_lengths;
    SpringSlot* slots;
    LayerSlot* layers;          // null: one layer
    const float* inverse_mass;  // of the shell's first vertex, and so on; of its first twin where there are two layers
    float* velocity[3];
    const Float4* position;
    Float4* next_position;
    // Two layers only.
    float* inner_velocity[3];
    const Float4* inner_position;
    Float4* next_inner_position;
    const float *twin_inverse_rest, *twin_stiffness_rest, *twin_damping;
    float* twin_length;
    float dt;             // s
    Vec3 gravity;         // m/s2
    uint32_t pack_count;  // of the shell, whatever packs are stepped

    SpringStep() = default;
    /// `side`: the current one of the positions.
    SpringStep(const SteppedView& view, uint32_t side);
};

void integrate_spring_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count);
/// Two layers tied by mid springs and shear pairs (Sandwich): with both ends' points x (outer) and y (inner),
///     m = (x_n + y_n) - (x_v + y_v),  T = (x_n - y_n) + (x_v - y_v)
///     mid spring     between the middles, |m| / 2 long
///     shear pair     |d1|^2 - |d2|^2 = m . T, the elongations e = (|d|^2 - L^2) / (2 L): to first order those of B5,
///                    free of roots, and of lengths alone, so that momentum is conserved as by springs
void integrate_sandwich_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count);
/// Two layers tied by cross springs (Crossed), which have no damping of their own.
void integrate_crossed_packs(const SpringStep& step, uint32_t first_pack, uint32_t pack_count);

}  // namespace cullet
