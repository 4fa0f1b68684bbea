// The mechanical energy of a world: what contacts and breaks take from and never add to.
#pragma once
#include "components/world_rows.hpp"

namespace cullet {

class DamageModels;

/// J. Of what moves by forces, and of bodies that stand on pins, whose pieces will.
struct MechanicalEnergy {
    double kinetic = 0;  // of dynamic bodies as rigid ones, of debris, of soft bodies that are awake by their points
    double height = 0;   // -m g . x, x from the world's origin
    double strain = 0;   // of the springs of soft bodies that are awake
    double waiting = 0;  // that bodies which struck each other gain when the task of the second ends, which may be
                         // negative; and of pieces that wait for room, beyond their body's motion
    uint32_t awake = 0;  // soft bodies that move by their springs
    double mass = 0;     // kg, of all that is counted
    double total() const { return kinetic + height + strain + waiting; }
    MechanicalEnergy& operator+=(const MechanicalEnergy& o);
};

/// Nothing of one that is neither dynamic nor on pins.
MechanicalEnergy body_energy(const DamageModels& models, WorldRows& state, Row<Bodies> body, Vec3 gravity);
MechanicalEnergy debris_energy(const Debris& debris, uint32_t row, Vec3 gravity);
MechanicalEnergy world_energy(const DamageModels& models, WorldRows& state, const Debris& debris, Vec3 gravity);

}  // namespace cullet
