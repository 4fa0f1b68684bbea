#include "tests/support/sibling_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "components/body_id.hpp"
#include "components/state.hpp"
#include "sample_game/solid.hpp"
#include "systems/structures/shell/drawn_triangles.hpp"

namespace cullet::test {
namespace {

constexpr uint32_t kFrames = 30, kMany = kNone - 1;
constexpr float kTouch = 0.001f;       // m between bounds of pieces that were born in touch
constexpr double kSeenDepth = 0.0005;  // m
// Walls of the thinner piece between two places of a body: what turns on and strikes, or crosses a hollow, meets what
// lay farther off. And no more than this, m.
constexpr double kElsewhere = 2, kMostElsewhere = 0.01;
// m: what first meets there comes upon the surface. Deeper, hulls lie in each other since birth: that is its doing.
constexpr float kUponSurface = -0.002f;

/// One drawn triangle, whichever corner comes first.
uint64_t hash_of(const ViewVertex* corner, const Pose& pose) {
    uint64_t sum = 0;
    for (int first = 0; first < 3; ++first) {
        uint64_t h = 1469598103934665603ull;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = to_world(pose, corner[(first + k) % 3].position);
            for (const float x : {p.x, p.y, p.z}) h = (h ^ std::bit_cast<uint32_t>(x)) * 1099511628211ull;
        }
        sum += h ^ h >> 29;
    }
    return sum;
}

/// Of all that moves, about the world's origin. The scales are sums of m |v|, and of m |r| |v| + |I w|.
struct Momenta {
    Vec3d momentum, turning;
    double scale = 0, turning_scale = 0;
};

Momenta momenta_of(const State& state) {
    const Bodies& bodies = state.bodies;
    Momenta sum;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Dynamic) continue;
        const Quat turned = bodies.orientation[b];
        const Vec3d place(centre_of(bodies, Row<Bodies>(b))), impulse = bodies.mass[b] * Vec3d(bodies.velocity[b]);
        const Vec3d own = bodies.inertia[b] * Vec3d(rotate(conjugate(turned), bodies.spin[b]));
        sum.momentum += impulse;
        sum.turning += cross(place, impulse) + Vec3d(rotate(turned, own.to_float()));
        sum.scale += length(impulse);
        sum.turning_scale += length(place) * length(impulse) + length(own);
    }
    return sum;
}

Vec3d relative_speed(const State& state, BodyId a, BodyId b) {
    return Vec3d(state.bodies.velocity[a.index]) - Vec3d(state.bodies.velocity[b.index]);
}

}  // namespace

double SiblingWatch::energy() const {
    const Bodies& bodies = state_of(world_).bodies;
    double mass = 0, sum = 0;
    Vec3d momentum;
    for (const Piece& piece : pieces_) {
        const Row<Bodies> b(piece.id.index);
        const Vec3d v(bodies.velocity[b]), w(rotate(conjugate(bodies.orientation[b]), bodies.spin[b]));
        mass += bodies.mass[b];
        momentum += bodies.mass[b] * v;
        sum += 0.5 * (bodies.mass[b] * dot(v, v) + dot(w, bodies.inertia[b] * w));
    }
    return sum - dot(momentum, momentum) / (2 * mass);
}

// The faces of the shell as its cracks left it.
void SiblingWatch::begin() {
    State& state = state_of(world_);
    for (uint32_t t = 0; t < state.tasks.size(); ++t) {
        if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Broke) continue;
        const Bodies& bodies = state.bodies;
        body_ = state.tasks.body[t];
        impact_speed_ = static_cast<double>(state.tasks.approach_speed[t]);
        const Quat turned = bodies.orientation[body_];
        body_centre_ = Vec3d(centre_of(bodies, body_));
        body_velocity_ = Vec3d(rotate(turned, state.tasks.start_velocity[t]));
        body_spin_ = Vec3d(rotate(turned, state.tasks.start_spin[t]));
        const Pose pose{bodies.position[body_], turned};
        const ShellView shell(state,
                              state.tasks.working[t].exists() ? state.tasks.working[t] : bodies.structure[body_]);
        surface_ = 0;
        for (uint32_t e = 0; e < shell.element_count(); ++e) {
            if (state.elements.flags[shell.element(e)] & kDead) continue;
            ViewVertex outer[3], inner[3];
            write_faces(shell, e, outer, inner);
            surface_ += hash_of(outer, pose);
            if (is_drawn(shell, e, kInnerFace)) surface_ += hash_of(inner, pose);
        }
    }
}

void SiblingWatch::compare_surface() {
    uint64_t sum = 0;
    for (const Piece& piece : pieces_) {
        const BodyView view = world_.view(piece.id).value();
        for (uint32_t r = 0; r < view.run_count; ++r) {
            if (view.runs[r].kind == SurfaceKind::Crack) continue;
            const uint32_t first = view.runs[r].first_index;
            for (uint32_t i = first; i < first + view.runs[r].index_count; i += 3) {
                // Rims are walls too, of no face: their uv runs along the border.
                const uint32_t source =
                    state_of(world_)
                        .view_indices.source[state_of(world_).bodies.view_indices[piece.id.index].first + i];
                if (source % kMostDrawnTriangles > kInnerFace) continue;
                sum += hash_of(view.vertices + view.indices[i], view.pose_before);
            }
        }
    }
    figures_.other_surfaces += sum != surface_;
}

void SiblingWatch::measure_birth() {
    const State& state = state_of(world_);
    const Bodies& bodies = state.bodies;
    pieces_.clear();
    for (const BodyId id : shells_of(world_)) {
        const Row<Bodies> b(id.index);
        Piece piece{id, 0, Vec3d(bodies.velocity[b]), Vec3d(bodies.spin[b])};
        const Range v = state.shells.vertices[state.shell_of(bodies.structure[b])];
        for (uint32_t i = v.first; i < v.first + v.count; ++i)
            if (state.vertices.element[i] != kNone)
                piece.radius = std::max(piece.radius, length(Vec3d(state.vertices.rest[i]) - bodies.centre[b]));
        pieces_.push_back(piece);
        if (b == body_) continue;
        const Vec3d arm = Vec3d(centre_of(bodies, b)) - body_centre_;
        const double speed = length(piece.velocity - body_velocity_ - cross(body_spin_, arm));
        figures_.fastest = std::max(figures_.fastest, speed / impact_speed_);
        // What broke off a body that spins fast may keep that spin, or lose it.
        const double turning = std::min(length(piece.spin), length(piece.spin - body_spin_));
        figures_.fastest_rim = std::max(figures_.fastest_rim, turning * piece.radius / impact_speed_);
    }
}

void SiblingWatch::look(const std::string& system) {
    const uint64_t broke = world_.contents().data.counts.broke;
    if (system == "remember_poses") {
        broke_before_ = broke;
        clamped_before_ = world_.contents().data.counts.clamped;
        const Momenta now = momenta_of(state_of(world_));
        momentum_before_ = now.momentum, turning_before_ = now.turning;
    }
    if (is_broken_) return;
    if (system == "smooth_cracks") begin();
    if (system != "make_births" || broke == broke_before_) return;
    is_broken_ = true;
    const Momenta now = momenta_of(state_of(world_));
    figures_.momentum_error = std::max(figures_.momentum_error, length(now.momentum - momentum_before_) / now.scale);
    if (world_.contents().data.counts.clamped == clamped_before_)
        figures_.turning_errors.push_back(length(now.turning - turning_before_) / now.turning_scale);
    measure_birth();
    birth_energy_ = energy();
}

// Where the two that touch were in the body that they were of, whose frame both still have.
double SiblingWatch::apart_at_birth(const RigidContact& contact) const {
    const auto place_in = [&](uint32_t body) {
        return rotate(conjugate(poses_[body].orientation), contact.point - poses_[body].position);
    };
    return length(place_in(contact.a) - place_in(contact.b));
}

double SiblingWatch::thinner_wall(const RigidContact& contact) const {
    const State& state = state_of(world_);
    const auto wall = [&](uint32_t body) {
        return state.shells.thickness[state.shell_of(state.bodies.structure[body])];
    };
    return static_cast<double>(std::min(wall(contact.a), wall(contact.b)));
}

uint32_t SiblingWatch::piece_of(uint32_t body) const {
    for (uint32_t p = 0; p < pieces_.size(); ++p)
        if (pieces_[p].id.index == body) return p;
    return kNone;
}

// By what the rigid world found in the step that is over.
void SiblingWatch::measure_meetings() {
    const Bodies& bodies = state_of(world_).bodies;
    const size_t count = pieces_.size();
    partners_.assign(count, kNone);
    for (const RigidContact& c : world_.contents().data.rigid->contacts()) {
        const uint32_t p = piece_of(c.a), q = piece_of(c.b);
        if (p != kNone) partners_[p] = partners_[p] == kNone || partners_[p] == q ? q : kMany;
        if (q != kNone) partners_[q] = partners_[q] == kNone || partners_[q] == p ? p : kMany;
    }
    for (uint32_t p = 0; p < count; ++p) {
        const uint32_t q = partners_[p];
        if (q >= count || q < p || partners_[q] != p) continue;
        const auto impulse = [&](uint32_t i) {
            const Row<Bodies> b(pieces_[i].id.index);
            return bodies.mass[b] * (Vec3d(bodies.velocity[b]) - velocities_[i]);
        };
        // Not equal and opposite: the sweep has stopped one of them at a third one.
        if (length(impulse(p) + impulse(q)) > 0.001 * length(impulse(p))) continue;
        const double before = length(velocities_[p] - velocities_[q]);
        by_the_other_[p * count + q] += length(relative_speed(state_of(world_), pieces_[p].id, pieces_[q].id)) - before;
        has_met_each_other_[p * count + q] = 1;
    }
}

// A shard may cross the body and hit its other side: such blows, and what those that got one hit in their turn, are
// no matter of birth. Nor is what two neighbours do that turn on and meet elsewhere, but that is told apart.
void SiblingWatch::mark_struck() {
    for (const RigidContact& c : world_.contents().data.rigid->contacts()) {
        uint32_t p = piece_of(c.a), q = piece_of(c.b);
        if (p == kNone || q == kNone) continue;
        if (p > q) std::swap(p, q);
        const bool are_neighbours = std::binary_search(pairs_.begin(), pairs_.end(), std::pair(p, q));
        if (!are_neighbours || is_struck_[p] || is_struck_[q]) is_struck_[p] = is_struck_[q] = 1;
        const double far = std::min(kMostElsewhere, kElsewhere * thinner_wall(c));
        const bool meets_elsewhere = apart_at_birth(c) > far && c.distance > kUponSurface;
        if (is_struck_[p] || has_met_[p] || has_met_[q] || meets_elsewhere) has_met_[p] = has_met_[q] = 1;
    }
}

void SiblingWatch::measure_pairs() {
    for (const auto& [p, q] : pairs_) {
        if (is_struck_[p] || is_struck_[q]) continue;
        const double before = length(pieces_[p].velocity - pieces_[q].velocity);
        const double now = length(relative_speed(state_of(world_), pieces_[p].id, pieces_[q].id));
        figures_.gained.push_back(now - before);
        if (!has_met_[p] && !has_met_[q]) figures_.thrown.push_back(now - before);
        if (pieces_.size() == 2) figures_.gained_alone.push_back(now - before);
    }
}

void SiblingWatch::look_inside() {
    std::vector<DrawnSolid> solids;
    for (const Piece& piece : pieces_) solids.push_back(solid_of(world_.view(piece.id).value()));
    for (size_t k = 0; k < pairs_.size(); ++k) {
        const DrawnSolid &a = solids[pairs_[k].first], &b = solids[pairs_[k].second];
        const double depth = std::max(deepest(a, b), deepest(b, a));
        figures_.deepest = std::max(figures_.deepest, depth);
        is_seen_in_[k] |= depth > kSeenDepth;
    }
}

void SiblingWatch::follow(const Shape& shape, Draw draw, const SpawnSettings& spawn, bool looks_inside) {
    const Throw thrown = throw_at(world_, shape, draw, spawn);
    is_broken_ = false;
    for (int frame = 0; frame < 16 && !is_broken_; ++frame) world_.step();
    EXPECT_TRUE(world_.remove(thrown.striker).ok());
    if (!is_broken_ || pieces_.size() < 2) return clear_away(world_, thrown.model);
    ++figures_.breaks;
    figures_.pieces += static_cast<uint32_t>(pieces_.size());
    compare_surface();
    pairs_.clear();
    std::vector<Bounds> bounds(pieces_.size());
    for (size_t p = 0; p < pieces_.size(); ++p) {
        const BodyView view = world_.view(pieces_[p].id).value();
        for (uint32_t v = 0; v < view.vertex_count; ++v)
            bounds[p].include(to_world(view.pose_before, view.vertices[v].position));
    }
    for (uint32_t p = 0; p < pieces_.size(); ++p)
        for (uint32_t q = p + 1; q < pieces_.size(); ++q)
            if (bounds[p].is_within(bounds[q], kTouch)) pairs_.emplace_back(p, q);
    is_seen_in_.assign(pairs_.size(), 0);
    is_struck_.assign(pieces_.size(), 0);
    has_met_.assign(pieces_.size(), 0);
    by_the_other_.assign(pieces_.size() * pieces_.size(), 0);
    has_met_each_other_.assign(pieces_.size() * pieces_.size(), 0);
    for (uint32_t frame = 1; frame < kFrames; ++frame) {
        const Bodies& bodies = state_of(world_).bodies;
        poses_.clear();
        for (uint32_t b = 0; b < bodies.size(); ++b) poses_.push_back(pose_of(bodies, Row<Bodies>(b)));
        velocities_.clear();
        for (const Piece& piece : pieces_) velocities_.push_back(Vec3d(bodies.velocity[piece.id.index]));
        world_.step();
        measure_meetings();
        mark_struck();
        const bool is_quiet = std::find(is_struck_.begin(), is_struck_.end(), 1) == is_struck_.end();
        if (frame == 3 && is_quiet) figures_.lost.push_back(1 - energy() / birth_energy_);
        if (looks_inside) look_inside();
    }
    measure_pairs();
    for (size_t k = 0; k < by_the_other_.size(); ++k)
        if (has_met_each_other_[k]) figures_.by_the_other.push_back(by_the_other_[k]);
    figures_.pairs += static_cast<uint32_t>(pairs_.size());
    if (looks_inside) {
        figures_.looked_at += static_cast<uint32_t>(pairs_.size());
        for (const uint8_t seen : is_seen_in_) figures_.seen_in += seen;
    }
    clear_away(world_, thrown.model);
}

}  // namespace cullet::test
