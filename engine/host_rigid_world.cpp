#include "engine/host_rigid_world.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "engine/byte_stream.hpp"
#include "engine/rigid_bounds.hpp"

namespace cullet {
namespace {

constexpr float kSiblingSeconds = 0.25f;  // that siblings are ignored for at most
constexpr float kPushedApart = 0.0001f;   // m of overlap at which ignored siblings meet again
constexpr float kLargestSaved = 1e12f;    // of any float: far beyond what a host may tell, and its square is a float

bool is_unit(double square) {
    return std::fabs(square - 1) < 1e-3;  // false for what is no number
}
bool is_unit(Quat q) {
    return is_unit(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}

/// Null, or what of it is not within bounds; no number is.
const char* trouble_of(const HostBody& b) {
    if (!is_within(b.pose.position, kFarthest))
        return "the position is not within 1000000 m of the origin along each axis";
    if (!is_unit(b.pose.orientation)) return "the orientation is no unit quaternion";
    if (!is_within(b.motion.velocity, kFastest)) return "the velocity is not within 100000 m/s a component";
    if (!is_within(b.motion.angular_velocity, kFastest))
        return "the angular velocity is not within 100000 rad/s a component";
    return nullptr;
}
constexpr float kMostImpulse = 1e20f;  // N s
const char* trouble_of(const HostContact& c) {
    if (!is_within(c.point, kFarthest)) return "the point is not within 1000000 m of the origin along each axis";
    if (!is_unit(dot(c.normal, c.normal))) return "the normal has not the length 1";
    if (!(std::fabs(c.distance) <= kFarthest)) return "the distance is not within 1000000 m";
    if (!(c.impulse >= 0 && c.impulse <= kMostImpulse)) return "the impulse is not between 0 and 1e20 N s";
    return nullptr;
}

template <class T>
EventSpan<T> span_of(const std::vector<T>& list) {
    return {list.data(), static_cast<uint32_t>(list.size())};
}

// Height of a triangle at (x, z), or `fallback` when the vertical line misses it.
float height_of(const Vec3 (&corner)[3], Vec3 p, float fallback) {
    const Vec3 a = corner[0], b = corner[1] - a, c = corner[2] - a, q = p - a;
    const float area = b.x * c.z - c.x * b.z;
    if (area == 0) return fallback;
    const float u = (q.x * c.z - c.x * q.z) / area, v = (b.x * q.z - q.x * b.z) / area;
    return u < 0 || v < 0 || u + v > 1 ? fallback : a.y + u * b.y + v * c.y;
}

}  // namespace

HostRigidWorld::HostRigidWorld(const HostRoom& room, const uint32_t* generations)
    : room_(room), generations_(generations), rows_(room.bodies) {
    make_room();
    contacts_.reserve(room.contacts());
    ignored_.reserve(16 * size_t{room.bodies} + 1024);
    apart_.reserve(32 * size_t{room.bodies} + 2048);
    for (auto* list : {&held_, &woken_}) list->reserve(room.bodies);
    for (auto* list : {&born_, &reshaped_}) list->reserve(room.bodies);
    for (auto* list : {&released_, &moved_}) list->reserve(room.bodies);
}

// ---- in

Result<void> HostRigidWorld::take(const HostFrame& frame) {
    if (frame.contact_count > room_.contacts())
        return Error{"HostFrame has " + std::to_string(frame.contact_count) + " contacts; give at most " +
                     std::to_string(room_.contacts()) + ", or raise limits.bodies."};
    if ((frame.body_count > 0 && !frame.bodies) || (frame.contact_count > 0 && !frame.contacts))
        return Error{"HostFrame has " + std::to_string(frame.body_count) + " bodies and " +
                     std::to_string(frame.contact_count) +
                     " contacts, and a null pointer to them; give the rows, or 0."};
    for (uint32_t i = 0; i < frame.body_count; ++i)
        if (const char* wrong = trouble_of(frame.bodies[i]))
            return Error{"HostFrame::bodies[" + std::to_string(i) + "], body " +
                         std::to_string(frame.bodies[i].body.index) + ": " + wrong + "; the step was not done."};
    for (uint32_t i = 0; i < frame.contact_count; ++i)
        if (const char* wrong = trouble_of(frame.contacts[i]))
            return Error{"HostFrame::contacts[" + std::to_string(i) + "]: " + wrong + "; the step was not done."};
    for (uint32_t i = 0; i < frame.body_count; ++i) {
        const HostBody& b = frame.bodies[i];
        if (!is_known(b.body) || rows_[b.body.index].is_held) continue;
        Row& row = rows_[b.body.index];
        if (row.kind == RigidKind::Static) continue;
        row.shape.pose = b.pose;
        row.shape.motion = b.motion;
        row.is_asleep = b.is_asleep && row.kind == RigidKind::Dynamic;
    }
    contacts_.clear();
    for (uint32_t i = 0; i < frame.contact_count; ++i) {
        const HostContact& c = frame.contacts[i];
        if (!is_known(c.a) || !is_known(c.b) || c.a.index == c.b.index) continue;
        RigidContact contact{c.a.index, c.b.index, c.piece_a, c.piece_b, c.point, c.normal, c.distance, 0, c.impulse};
        if (contact.a > contact.b) {
            std::swap(contact.a, contact.b);
            std::swap(contact.cell_a, contact.cell_b);
            contact.normal = -contact.normal;
        }
        contacts_.push_back(contact);
    }
    is_in_step_ = true;
    return {};
}

bool HostRigidWorld::is_free(RigidId id) const {
    const Row& row = rows_[id];
    return row.kind == RigidKind::Dynamic && !row.is_held && !row.is_asleep;
}

Vec3 HostRigidWorld::velocity_at(RigidId id, Vec3 point) const {
    const Row& row = rows_[id];
    if (!is_free(id) && row.kind != RigidKind::Kinematic) return {};
    const Motion& m = row.shape.motion;
    return m.velocity + cross(m.angular_velocity, point - to_world(row.shape.pose, row.centre));
}

HostRigidWorld::Ignored* HostRigidWorld::find_ignored(RigidId a, RigidId b) {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(ignored_.begin(), ignored_.end(), key,
                                        [](const Ignored& p, auto k) { return std::pair(p.a, p.b) < k; });
    return found != ignored_.end() && found->a == key.first && found->b == key.second ? &*found : nullptr;
}

bool HostRigidWorld::is_apart(const RigidContact& contact) {
    Ignored* const pair = find_ignored(contact.a, contact.b);
    if (!pair) return false;
    pair->is_near = pair->is_near || contact.distance < -kPushedApart;
    return true;
}

// One is driven and the other static: no solver moves them, but what is pinned may break.
bool HostRigidWorld::is_driven_in(RigidId a, RigidId b) const {
    if (rows_[a].kind == RigidKind::Static) std::swap(a, b);
    return rows_[a].kind == RigidKind::Kinematic && rows_[b].kind == RigidKind::Static;
}

// By content and not by the host's order, so that a host whose threads race gives the same bytes.
void HostRigidWorld::detect(float dt) {
    for (Ignored& pair : ignored_) pair.is_near = false;
    std::erase_if(contacts_, [this](const RigidContact& c) {
        return !is_known(c.a) || !is_known(c.b) || (!is_free(c.a) && !is_free(c.b) && !is_driven_in(c.a, c.b)) ||
               is_apart(c);
    });
    for (Ignored& pair : ignored_) pair.seconds -= dt;
    std::erase_if(ignored_, [](const Ignored& p) { return !(p.seconds > 0) || (p.until_apart && !p.is_near); });
    for (RigidContact& c : contacts_)
        c.approach_speed = dot(velocity_at(c.b, c.point) - velocity_at(c.a, c.point), c.normal);
    std::sort(contacts_.begin(), contacts_.end(), [](const RigidContact& p, const RigidContact& q) {
        const auto key = [](const RigidContact& c) {
            return std::tuple(c.a, c.b, c.cell_a, c.cell_b, c.point.x, c.point.y, c.point.z, c.distance,
                              c.approach_speed, c.normal.x, c.normal.y, c.normal.z, c.impulse);
        };
        return key(p) < key(q);
    });
}

// ---- out

// The first change after finish() forgets what has been told.
void HostRigidWorld::begin_lists() {
    if (!is_told_) return;
    is_told_ = false;
    points_.clear();
    pieces_.clear();
    removed_.clear();
    apart_.clear();
}

void HostRigidWorld::take_pieces(Row& row, std::span<const ConvexPiece> pieces) {
    row.first_piece = static_cast<uint32_t>(pieces_.size());
    for (const ConvexPiece& piece : pieces) {
        if (piece.points.empty()) continue;
        const auto first = static_cast<uint32_t>(points_.size());
        points_.insert(points_.end(), piece.points.begin(), piece.points.end());
        pieces_.push_back({first, static_cast<uint32_t>(piece.points.size()), piece.cell});
    }
    row.shape.piece_count = static_cast<uint32_t>(pieces_.size()) - row.first_piece;
    if (!is_in_step_) make_room();
}

// For the step to come, which must not allocate.
void HostRigidWorld::make_room() {
    const auto grow = [](auto& list, size_t more) {
        if (list.capacity() < list.size() + more) list.reserve(2 * list.size() + more);
    };
    grow(points_, room_.points);
    grow(pieces_, room_.pieces);
    grow(removed_, room_.bodies);
    told_pieces_.reserve(pieces_.capacity());
}

void HostRigidWorld::add_static_triangles(RigidId id, std::span<const Vec3> positions,
                                          std::span<const std::array<uint32_t, 3>> triangles, float, float, uint32_t,
                                          uint32_t, bool) {
    if (id >= rows_.size() || rows_[id].is_used) return;
    rows_[id] = {};
    rows_[id].is_used = true;
    rows_[id].kind = RigidKind::Static;
    for (const auto& t : triangles) triangles_.push_back({id, {positions[t[0]], positions[t[1]], positions[t[2]]}});
}

// Spheres and what the game moves are the host's own.
void HostRigidWorld::add(RigidId id, const RigidDescription& d) {
    if (id >= rows_.size() || rows_[id].is_used) return;
    begin_lists();
    Row& row = rows_[id];
    row = {};
    row.is_used = true;
    row.kind = d.kind;
    row.centre = d.centre.to_float();
    HostShape& s = row.shape;
    s = {{}, d.kind == RigidKind::Static, d.pose, d.motion, d.mass};
    s.centre[0] = d.centre.x, s.centre[1] = d.centre.y, s.centre[2] = d.centre.z;
    const double inertia[] = {d.inertia.xx, d.inertia.yy, d.inertia.zz, d.inertia.xy, d.inertia.xz, d.inertia.yz};
    std::copy(std::begin(inertia), std::end(inertia), s.inertia);
    s.margin = d.margin, s.friction = d.friction, s.restitution = d.restitution;
    s.rolling_friction = d.rolling_friction;
    s.layer = d.layer, s.mask = d.mask;
    if (d.radius > 0 || d.kind == RigidKind::Kinematic) return;
    row.is_born = true;
    take_pieces(row, d.pieces);
}

void HostRigidWorld::set_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia,
                               std::span<const ConvexPiece> pieces) {
    if (!is_known(id)) return;
    begin_lists();
    Row& row = rows_[id];
    HostShape& s = row.shape;
    const Vec3 shift = rotate(s.pose.orientation, centre.to_float() - row.centre);
    s.motion.velocity += cross(s.motion.angular_velocity, shift);
    row.centre = centre.to_float();
    s.mass = mass;
    s.centre[0] = centre.x, s.centre[1] = centre.y, s.centre[2] = centre.z;
    const double six[] = {inertia.xx, inertia.yy, inertia.zz, inertia.xy, inertia.xz, inertia.yz};
    std::copy(std::begin(six), std::end(six), s.inertia);
    row.is_reshaped = !row.is_born;
    row.is_asleep = false;
    take_pieces(row, pieces);
}

// What the host never heard of is not told as gone.
void HostRigidWorld::remove(RigidId id) {
    if (!is_known(id)) return;
    begin_lists();
    if (!rows_[id].is_born) removed_.push_back(body_id(id));
    if (!is_in_step_) make_room();
    rows_[id] = {};
    std::erase_if(triangles_, [id](const StaticTriangle& t) { return t.id == id; });
    std::erase_if(ignored_, [id](const Ignored& p) { return p.a == id || p.b == id; });
    std::erase_if(apart_, [id](const HostPair& p) { return p.a.index == id || p.b.index == id; });
}

Pose HostRigidWorld::pose(RigidId id) const {
    return is_known(id) ? rows_[id].shape.pose : Pose{};
}
Motion HostRigidWorld::motion(RigidId id) const {
    return is_known(id) ? rows_[id].shape.motion : Motion{};
}

void HostRigidWorld::set_pose(RigidId id, const Pose& pose) {
    if (!is_known(id)) return;
    begin_lists();
    rows_[id].shape.pose = pose;
    rows_[id].is_moved = true;
}

void HostRigidWorld::set_motion(RigidId id, const Motion& motion) {
    if (!is_known(id)) return;
    begin_lists();
    rows_[id].shape.motion = motion;
    rows_[id].is_moved = true;
    rows_[id].is_asleep = false;
}

void HostRigidWorld::shift(Vec3 by) {
    for (Row& row : rows_) row.shape.pose.position += by;
    for (StaticTriangle& triangle : triangles_)
        for (Vec3& corner : triangle.corner) corner += by;
    for (RigidContact& contact : contacts_) contact.point += by;
}

void HostRigidWorld::hold(RigidId id) {
    if (!is_known(id) || rows_[id].kind != RigidKind::Dynamic) return;
    begin_lists();
    rows_[id].is_held = true;
    rows_[id].is_asleep = false;
}

void HostRigidWorld::release(RigidId id) {
    if (!is_known(id)) return;
    begin_lists();
    rows_[id].is_held = false;
}

bool HostRigidWorld::is_held(RigidId id) const {
    return is_known(id) && rows_[id].is_held;
}

void HostRigidWorld::skip_contacts(RigidId a, RigidId b) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    begin_lists();
    apart_.push_back({body_id(a), body_id(b), 0, false});
}

// A host has a narrow phase of its own, which knows of no cracks.
void HostRigidWorld::part_siblings(RigidId a, RigidId b, std::span<const CrackTouch>) {
    keep_apart(a, b, kSiblingSeconds, true);
}

void HostRigidWorld::keep_apart(RigidId a, RigidId b, float seconds, bool until_apart) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    begin_lists();
    apart_.push_back({body_id(a), body_id(b), seconds, until_apart});
    if (a > b) std::swap(a, b);
    if (Ignored* const pair = find_ignored(a, b)) {
        pair->seconds = std::max(pair->seconds, seconds);
        pair->until_apart = pair->until_apart && until_apart;
        return;
    }
    const auto place = std::lower_bound(ignored_.begin(), ignored_.end(), std::pair(a, b),
                                        [](const Ignored& p, auto k) { return std::pair(p.a, p.b) < k; });
    ignored_.insert(place, {a, b, seconds, until_apart, true});
}

float HostRigidWorld::height_below(Vec3 point, float fallback) const {
    float height = fallback;
    for (const StaticTriangle& t : triangles_) {
        const float candidate = height_of(t.corner, point, fallback);
        if (candidate <= point.y) height = std::max(height, candidate);
    }
    return height;
}

bool HostRigidWorld::is_asleep(RigidId id) const {
    return is_known(id) && rows_[id].is_asleep;
}

void HostRigidWorld::wake(RigidId id) {
    if (!is_known(id)) return;
    begin_lists();
    rows_[id].is_woken = rows_[id].is_woken || rows_[id].is_asleep;
    rows_[id].is_asleep = false;
}

RigidCounts HostRigidWorld::counts() const {
    RigidCounts counts;
    counts.contacts = static_cast<uint32_t>(contacts_.size());
    return counts;
}

void HostRigidWorld::finish() {
    begin_lists();
    for (auto* list : {&held_, &woken_}) list->clear();
    for (auto* list : {&born_, &reshaped_}) list->clear();
    for (auto* list : {&released_, &moved_}) list->clear();
    told_pieces_.clear();
    for (const Piece& p : pieces_) told_pieces_.push_back({points_.data() + p.first_point, p.point_count, p.name});
    for (RigidId id = 0; id < rows_.size(); ++id) {
        Row& row = rows_[id];
        if (!row.is_used) continue;
        row.shape.body = body_id(id);
        row.shape.pieces = told_pieces_.data() + row.first_piece;
        const HostMotion motion{row.shape.body, row.shape.pose, row.shape.motion};
        const bool is_whole = row.is_born || row.is_reshaped;  // tells its motion too
        if (is_whole) (row.is_born ? born_ : reshaped_).push_back(row.shape);
        if (row.is_held && !row.was_held) held_.push_back(row.shape.body);
        if (!row.is_held && row.was_held) released_.push_back(motion);
        if (row.is_moved && !is_whole) moved_.push_back(motion);
        if (row.is_woken) woken_.push_back(row.shape.body);
        row.was_held = row.is_held;
        row.is_born = row.is_reshaped = row.is_moved = row.is_woken = false;
    }
    is_told_ = true;
    is_in_step_ = false;
}

std::optional<RigidKind> HostRigidWorld::kind(RigidId id) const {
    return is_known(id) ? std::optional(rows_[id].kind) : std::nullopt;
}

namespace {

/// Of a row, in the order of the bytes, for both ways.
template <class Shape, class F>
void for_each_number(Shape& s, F&& f) {
    auto &at = s.pose.position, &velocity = s.motion.velocity, &spin = s.motion.angular_velocity;
    auto& turn = s.pose.orientation;
    f(at.x), f(at.y), f(at.z), f(turn.x), f(turn.y), f(turn.z), f(turn.w);
    f(velocity.x), f(velocity.y), f(velocity.z), f(spin.x), f(spin.y), f(spin.z);
    f(s.mass);
    for (auto& c : s.centre) f(c);
    for (auto& i : s.inertia) f(i);
    f(s.margin), f(s.friction), f(s.restitution), f(s.rolling_friction), f(s.layer), f(s.mask);
}

}  // namespace

void HostRigidWorld::save(ByteWriter& out) const {
    out.number(static_cast<uint32_t>(rows_.size()));
    for (const Row& row : rows_) {
        out.number(static_cast<uint8_t>(row.is_used));
        if (!row.is_used) continue;
        for (const uint8_t byte : {static_cast<uint8_t>(row.kind), static_cast<uint8_t>(row.is_asleep),
                                   static_cast<uint8_t>(row.is_held), static_cast<uint8_t>(row.shape.is_static)})
            out.number(byte);
        for_each_number(row.shape, [&](const auto& number) { out.number(number); });
    }
    out.number(static_cast<uint32_t>(triangles_.size()));
    for (const StaticTriangle& t : triangles_) {
        out.number(t.id);
        for (const Vec3 p : t.corner) out.number(p.x), out.number(p.y), out.number(p.z);
    }
    out.number(static_cast<uint32_t>(ignored_.size()));
    for (const Ignored& p : ignored_) {
        out.number(p.a), out.number(p.b), out.number(p.seconds);
        out.number(static_cast<uint8_t>(p.until_apart));
    }
    const uint32_t untold = is_told_ ? 0 : static_cast<uint32_t>(removed_.size());
    out.number(untold);
    for (uint32_t k = 0; k < untold; ++k) out.number(removed_[k].index), out.number(removed_[k].generation);
}

Result<void> HostRigidWorld::load(ByteReader& in) {
    const auto number = [&]<class T>(T& value) {
        value = in.number<T>("a body of the host's");
        if constexpr (std::is_same_v<T, float>)
            in.expect(std::fabs(value) <= kLargestSaved, "a number of " + std::to_string(value));
        else if constexpr (std::is_floating_point_v<T>)
            in.expect(std::isfinite(value), "a number that is not finite");
    };
    const auto flag = [&] {
        const auto byte = in.number<uint8_t>("a flag");
        in.expect(byte <= 1, "a flag of " + std::to_string(byte));
        return byte == 1;
    };
    in.expect(in.number<uint32_t>("the number of bodies") == rows_.size(), "another limit of bodies");
    for (RigidId id = 0; id < rows_.size() && in.is_sound(); ++id) {
        Row& row = rows_[id];
        row.is_used = flag();
        if (!row.is_used) continue;
        const auto kind = in.number<uint8_t>("a kind of body");
        in.expect(kind <= static_cast<uint8_t>(RigidKind::Dynamic), "kind of body " + std::to_string(kind));
        row.kind = static_cast<RigidKind>(kind);
        row.is_asleep = flag(), row.is_held = flag(), row.shape.is_static = flag();
        for_each_number(row.shape, number);
        const double* const c = row.shape.centre;
        row.centre = Vec3d{c[0], c[1], c[2]}.to_float();
    }
    const uint32_t triangles = in.count("the number of static triangles", 40, 1u << 28);
    for (uint32_t t = 0; t < triangles && in.is_sound(); ++t) {
        StaticTriangle found{};
        number(found.id);
        for (Vec3& p : found.corner) number(p.x), number(p.y), number(p.z);
        in.expect(is_known(found.id) && rows_[found.id].kind == RigidKind::Static,
                  "a triangle of body " + std::to_string(found.id) + ", which is not static");
        triangles_.push_back(found);
    }
    const uint32_t ignored = in.count("the number of ignored pairs", 13, 1u << 26);
    for (uint32_t k = 0; k < ignored && in.is_sound(); ++k) {
        Ignored p{};
        number(p.a), number(p.b), number(p.seconds);
        p.until_apart = flag();
        const bool is_rising =
            ignored_.empty() || std::pair(ignored_.back().a, ignored_.back().b) < std::pair(p.a, p.b);
        in.expect(is_known(p.a) && is_known(p.b) && p.a < p.b && is_rising,
                  "an ignored pair of bodies " + std::to_string(p.a) + " and " + std::to_string(p.b));
        ignored_.push_back(p);
    }
    const uint32_t removed = in.count("the number of removed bodies", 8, 1u << 28);
    for (uint32_t k = 0; k < removed && in.is_sound(); ++k) {
        const auto row = in.number<uint32_t>("a removed body"), generation = in.number<uint32_t>("a removed body");
        const BodyId body{row, generation};
        in.expect(row < rows_.size() && !is_known(body), "a removed body " + std::to_string(row) + " that is there");
        removed_.push_back(body);
    }
    if (!in.is_sound()) return Error{in.trouble()};
    tell_all();
    return {};
}

// What a host cannot know from births, which announce() tells.
void HostRigidWorld::tell_all() {
    for (Row& row : rows_) row.is_moved = row.is_used && row.kind != RigidKind::Static;
    for (const Ignored& p : ignored_) apart_.push_back({body_id(p.a), body_id(p.b), p.seconds, p.until_apart});
    make_room();
}

void HostRigidWorld::announce(RigidId id, std::span<const ConvexPiece> pieces) {
    if (!is_known(id)) return;
    begin_lists();
    rows_[id].is_born = true;
    take_pieces(rows_[id], pieces);
}

HostChanges HostRigidWorld::changes() const {
    return {span_of(removed_),  span_of(born_),  span_of(reshaped_), span_of(held_),
            span_of(released_), span_of(moved_), span_of(woken_),    span_of(apart_)};
}

}  // namespace cullet
