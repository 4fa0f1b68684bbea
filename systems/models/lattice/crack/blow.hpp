// What a blow does to a solid: its force, how long it lasts and over what patch (solid cooking note, 6.1 and 6.2).
#pragma once
#include "systems/models/lattice/solve/stiffness.hpp"

namespace cullet {

struct BrittleSolid {
    ElasticSolid elastic;
    double density = 2400;                // kg/m3
    double tensile_strength = 50e6;       // Pa
    double compressive_strength = 500e6;  // Pa
};

/// What an explosion is to a body, in its frame. Pressure lasts as long as sound in air takes over its reach.
struct SolidBlast {
    Vec3d centre;         // m
    double radius = 0;    // m, its reach; 0: there is none
    double strength = 0;  // N s/m2 at the centre
    double duration() const { return radius / 340; }
    /// N s, of so much of the surface.
    Vec3d impulse(Vec3d place, Vec3d normal, double area) const;
};

/// In the body's frame.
struct SolidBlow {
    Vec3d point;                // m
    Vec3d push;                 // unit, into the body
    double speed = 0;           // m/s, along the push
    double effective_mass = 0;  // kg, of both at the point
    double radius = 0;          // m: 1 / R = 1 / R1 + 1 / R2 of both surfaces
    ElasticSolid striker;
    Vec3d spin;                 // of the body, rad/s
    double longest = 1.0 / 60;  // s that a contact may last
    SolidBlast blast;           // with a reach it is all that the blow is
};

struct HertzContact {
    double force = 0;     // N, the most
    double duration = 0;  // s
    double radius = 0;    // m, of the touching patch
};
HertzContact hertz_contact(const SolidBlow& blow, const ElasticSolid& body);

/// The contact crushes until its pressure is about twice the compressive strength; and what the lattice cannot resolve
/// is no patch. The floor by volume keeps the first crack the same on finer lattices.
double patch_radius(const HertzContact& contact, const BrittleSolid& brittle, double edge, double volume);

/// Contact and body are springs in series: how much of the contact's force is left of a blow that brings so much energy
/// (J), when at this force the body takes up the strain energy.
double force_share(double brought, double strain_energy);

/// Cracks begin at 1 / ratio of the load, and it goes on rising while the first one runs: what share of it comes.
double load_share(double ratio, double duration, double volume, const BrittleSolid& brittle);

/// x^y for x > 0, by the library's own functions; 0 for x = 0.
double power(double x, double y);

}  // namespace cullet
