// What becomes of the pieces of one break while nobody else is there to hit: how they leave, whether they hinder or
// throw each other, and whether they are seen in each other.
#pragma once
#include <string>
#include <vector>

#include "engine/rigid_world.hpp"
#include "tests/support/random_hits.hpp"

namespace cullet::test {

/// Of all breaks watched.
struct SiblingFigures {
    uint32_t breaks = 0, pieces = 0, pairs = 0;
    // Of breaks, and of pairs of pieces that were born in touch, in which nobody was struck by what was born elsewhere:
    std::vector<double> lost;             // share of the kinetic energy about the common centre that 3 steps take
    std::vector<double> gained;           // m/s in half a second, all collisions counted
    std::vector<double> by_the_other;     // of all pairs that met, in frames in which both met nobody else
    std::vector<double> thrown;           // of those by which nobody came upon what had been elsewhere in the body
    std::vector<double> gained_alone;     // of those the pairs of which nothing else came
    double fastest = 0;                   // largest |v - (V + w x r)| / impact speed, of all pieces but the largest
    double fastest_rim = 0;               // largest of |w| or |w - w of the body|, the lesser, r_max / impact speed
    double momentum_error = 0;            // of breaks with their strikers, of the sum of m |v|
    std::vector<double> turning_errors;   // where nothing was cut off, of the sum of m |r| |v| + |I w|
    uint32_t seen_in = 0, looked_at = 0;  // pairs in touch at birth: in each other later, and looked at
    double deepest = 0;                   // m that a drawn point of one was found in the other
    uint32_t other_surfaces = 0;          // breaks whose drawn surface is not the one of the cracked shell
};

/// Follows the first break of each throw for half a second.
class SiblingWatch {
 public:
    explicit SiblingWatch(World& world) : world_(world) {}
    /// To be called after each system.
    void look(const std::string& system);
    /// Throws, waits up to 16 frames for a break, takes the striker away and follows the pieces; then clears away.
    /// `looks_inside` measures overlaps of what is drawn, which costs most of the time.
    void follow(const Shape& shape, Draw draw, const SpawnSettings& spawn, bool looks_inside);
    const SiblingFigures& figures() const { return figures_; }

 private:
    struct Piece {
        BodyId id;
        double radius = 0;
        Vec3d velocity, spin;  // at birth
    };
    void begin();
    void measure_birth();
    double energy() const;
    void compare_surface();
    void mark_struck();
    void measure_meetings();
    uint32_t piece_of(uint32_t body) const;
    double apart_at_birth(const RigidContact& contact) const;
    double thinner_wall(const RigidContact& contact) const;  // m
    void measure_pairs();
    void look_inside();

    World& world_;
    SiblingFigures figures_;
    bool is_broken_ = false;
    uint64_t broke_before_ = 0, clamped_before_ = 0;
    Vec3d momentum_before_, turning_before_;  // before the systems of damage
    double impact_speed_ = 0, birth_energy_ = 0;
    Vec3d body_centre_, body_velocity_, body_spin_;
    Row<Bodies> body_;
    uint64_t surface_ = 0;
    std::vector<Piece> pieces_;
    std::vector<std::pair<uint32_t, uint32_t>> pairs_;
    std::vector<uint8_t> is_seen_in_, is_struck_, has_met_, has_met_each_other_;
    std::vector<Vec3d> velocities_;     // of pieces, before the frame
    std::vector<uint32_t> partners_;    // of pieces, in the frame: whom it met, nobody, or many
    std::vector<double> by_the_other_;  // of p * pieces + q
    std::vector<Pose> poses_;           // of bodies, when their contacts were found
};

}  // namespace cullet::test
