// A world of Bullet's as bytes, and back: all that its next steps depend on. Bodies come in rising id, pairs in rising
// (a, b), so that one and the same world always gives the same bytes; what Bullet keeps beside them (tree of boxes,
// order of pairs, numbers of proxies) is made anew, and differs from that of a world that has been running. So the
// running world is rebuilt from its own bytes when it is saved, and goes on as the one that is loaded later.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/assert.hpp"
#include "engine/bullet/bullet_world.hpp"
#include "engine/byte_stream.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

constexpr float kMostFloat = 3e38f;

/// One list of members for both ways: a flow writes what it is given, or reads into it.
class Out {
 public:
    explicit Out(ByteWriter& out) : out_(out) {}
    static constexpr bool kReads = false;
    template <class T>
    void number(T& value) {
        out_.number(value);
    }
    void flag(bool& value) { out_.number(static_cast<uint8_t>(value)); }
    /// At most `most`, else trouble.
    void count(uint32_t& value, uint32_t, const char*) { out_.number(value); }

 private:
    ByteWriter& out_;
};

class In {
 public:
    explicit In(ByteReader& in) : in_(in) {}
    static constexpr bool kReads = true;
    template <class T>
    void number(T& value) {
        value = in_.number<T>("the rigid world");
        if constexpr (std::is_floating_point_v<T>)
            if (!(std::fabs(static_cast<double>(value)) <= static_cast<double>(kMostFloat))) {
                in_.fail("a number of the rigid world is not finite");
                value = 0;
            }
    }
    void flag(bool& value) {
        const auto byte = in_.number<uint8_t>("the rigid world");
        in_.expect(byte <= 1, "a flag of the rigid world is " + std::to_string(byte));
        value = byte == 1;
    }
    void count(uint32_t& value, uint32_t most, const char* what) {
        value = in_.number<uint32_t>(what);
        if (!in_.expect(value <= most,
                        std::string(what) + " is " + std::to_string(value) + ", more than " + std::to_string(most)))
            value = 0;
    }

 private:
    ByteReader& in_;
};

template <class F>
void flow_numbers(F& f, Vec3& v) {
    f.number(v.x), f.number(v.y), f.number(v.z);
}
template <class F>
void flow_numbers(F& f, Vec3d& v) {
    f.number(v.x), f.number(v.y), f.number(v.z);
}
template <class F>
void flow_numbers(F& f, Quat& q) {
    f.number(q.x), f.number(q.y), f.number(q.z), f.number(q.w);
}
template <class F>
void flow_numbers(F& f, btVector3& v) {
    if constexpr (F::kReads) v.setZero();  // the fourth number too: Bullet compares it
    for (int k = 0; k < 3; ++k) f.number(v[k]);
}
template <class F>
void flow_numbers(F& f, btTransform& t) {
    for (int k = 0; k < 3; ++k) flow_numbers(f, t.getBasis()[k]);
    flow_numbers(f, t.getOrigin());
}
template <class F>
void flow_numbers(F& f, Box& b) {
    flow_numbers(f, b.low), flow_numbers(f, b.high);
}

template <class F>
void flow_hull(F& f, Hull& h, ByteReader* in) {
    f.count(h.local.count, kMaxPoints, "the number of points of a hull");
    flow_numbers(f, h.local.centre);
    for (float* lane : {h.local.x, h.local.y, h.local.z})
        for (uint32_t k = 0; k < h.local.count; ++k) f.number(lane[k]);
    f.number(h.cell);
    f.count(h.point_count, h.local.count, "the number of points of a hull");
    f.count(h.face_count, kMaxFaces, "the number of faces of a hull");
    f.count(h.edge_count, kMaxEdges, "the number of edges of a hull");
    f.number(h.margin), f.number(h.radius), f.number(h.thickness);
    f.flag(h.one_sided), f.flag(h.has_seams);
    f.number(h.flush);
    for (uint32_t k = 0; k < h.face_count; ++k) {
        flow_numbers(f, h.face_normal[k]);
        f.number(h.face_height[k]);
        f.flag(h.is_face_inner[k]);
        f.number(h.covered[k]);
    }
    for (uint32_t k = 0; h.face_count > 0 && k <= h.face_count; ++k) f.number(h.first_corner[k]);
    if constexpr (F::kReads) {
        for (uint32_t k = 0; k < h.face_count; ++k)
            in->expect(h.first_corner[k] < h.first_corner[k + 1] && h.first_corner[k + 1] <= kMaxCorners,
                       "face " + std::to_string(k) + " of a hull has no corners or too many");
        in->expect(h.point_count > 0 && h.local.count % 8 == 0,
                   "a hull has no points, or not a multiple of 8 in store");
        if (!in->is_sound()) return;
    }
    const uint32_t corners = h.face_count > 0 ? h.first_corner[h.face_count] : 0;
    bool is_sound = h.face_count == 0 || h.first_corner[0] == 0;
    for (uint32_t k = 0; k < corners; ++k) {
        f.number(h.corner[k]);
        is_sound = is_sound && h.corner[k] < h.point_count;
    }
    for (uint32_t k = 0; k < h.edge_count; ++k) {
        HullEdge& e = h.edge[k];
        f.number(e.a), f.number(e.b), f.number(e.left), f.number(e.right);
        is_sound =
            is_sound && e.a < h.point_count && e.b < h.point_count && e.left < h.face_count && e.right < h.face_count;
    }
    if constexpr (F::kReads)
        if (in->expect(is_sound, "a corner or an edge of a hull names a point or a face that it does not have"))
            set_face_points(h), find_box(h), set_scale(h);
}

template <class F>
void flow_mesh(F& f, StaticMesh& mesh, ByteReader* in) {
    f.flag(mesh.one_sided);
    auto triangles = static_cast<uint32_t>(mesh.triangles.size()), nodes = static_cast<uint32_t>(mesh.nodes.size());
    if constexpr (F::kReads) {
        triangles = in->count("the number of static triangles", 42, 1u << 28);
        nodes = in->count("the number of boxes over static triangles", 32, 1u << 28);
        in->expect(triangles > 0 && nodes > 0, "a static mesh has no triangles or no boxes");
        mesh.triangles.resize(triangles);
        mesh.nodes.resize(nodes);
    } else {
        f.number(triangles), f.number(nodes);
    }
    for (StaticTriangle& t : mesh.triangles) {
        for (Vec3& corner : t.corner) flow_numbers(f, corner);
        for (bool& is_sharp : t.is_edge_sharp) f.flag(is_sharp);
        for (bool& is_sharp : t.is_edge_sharp_behind) f.flag(is_sharp);
    }
    // Children come after their parent, so that a walk down always ends, and have one, so that it ends soon; leaves
    // have no more triangles than there are. A height of 60 is more than any balanced tree's.
    std::vector<uint8_t> height;
    [[maybe_unused]] uint32_t in_leaves = 0;
    if constexpr (F::kReads) height.assign(nodes, 0);  // 0: nobody's child so far
    for (uint32_t k = 0; k < nodes; ++k) {
        StaticMesh::Node& n = mesh.nodes[k];
        flow_numbers(f, n.box);
        f.number(n.first), f.number(n.count);
        if constexpr (F::kReads) {
            const bool is_leaf = n.count > 0;
            const bool fits = is_leaf ? n.count <= triangles - in_leaves && n.first <= triangles - n.count
                                      : n.first > k && n.first < nodes - 1 && height[k] < 60 && height[n.first] == 0 &&
                                            height[n.first + 1] == 0;
            if (!in->expect(fits, "box " + std::to_string(k) + " over static triangles leads nowhere")) return;
            in_leaves += n.count;
            if (!is_leaf)
                for (uint32_t child : {n.first, n.first + 1}) height[child] = static_cast<uint8_t>(height[k] + 1);
        }
    }
}

template <class F>
void flow_body(F& f, Body& b) {
    flow_numbers(f, b.frame.centre), flow_numbers(f, b.frame.axes);
    flow_numbers(f, b.hull_frame.centre), flow_numbers(f, b.hull_frame.axes);
    f.flag(b.has_offset);
    flow_numbers(f, b.hull_offset);
    flow_numbers(f, b.hull_centre);
    f.number(b.mass);
    flow_numbers(f, b.moments);
    f.number(b.friction), f.number(b.restitution), f.number(b.rolling_friction);
    f.number(b.rolling_share), f.number(b.margin);
    flow_numbers(f, b.local_box);
    f.number(b.thickness), f.number(b.reach);
    flow_numbers(f, b.fresh_at);
    f.number(b.moves), f.number(b.shape_changes);
    f.flag(b.is_touched), f.flag(b.is_driven);
    f.number(b.slow_seconds), f.number(b.overlap), f.number(b.sunk);
    f.number(b.pressed_seconds), f.number(b.settling_seconds);
    f.flag(b.is_held);
    f.flag(b.is_soft);
    flow_numbers(f, b.kept.velocity), flow_numbers(f, b.kept.angular_velocity);
    flow_numbers(f, b.anchor);
    flow_numbers(f, b.far_anchor);
    f.number(b.still_seconds);
    f.number(b.creep_seconds);
    f.flag(b.has_left);
    f.number(b.idle_wakes);
    f.number(b.load), f.number(b.slept_load), f.number(b.moved_fraction);
    f.flag(b.is_fast);
    f.number(b.birth), f.number(b.sibling_seconds);
    flow_numbers(f, b.gained.velocity), flow_numbers(f, b.gained.angular_velocity);
    f.flag(b.is_level);
}

template <class F>
void flow_point(F& f, btManifoldPoint& p) {
    flow_numbers(f, p.m_localPointA), flow_numbers(f, p.m_localPointB);
    flow_numbers(f, p.m_positionWorldOnA), flow_numbers(f, p.m_positionWorldOnB);
    flow_numbers(f, p.m_normalWorldOnB);
    f.number(p.m_distance1);
    f.number(p.m_combinedFriction), f.number(p.m_combinedRestitution);
    f.number(p.m_combinedRollingFriction), f.number(p.m_combinedSpinningFriction);
    f.number(p.m_appliedImpulse), f.number(p.m_prevRHS);
    f.number(p.m_appliedImpulseLateral1), f.number(p.m_appliedImpulseLateral2);
    flow_numbers(f, p.m_lateralFrictionDir1), flow_numbers(f, p.m_lateralFrictionDir2);
    f.number(p.m_lifeTime);
}

template <class F>
void flow_record(F& f, PairRecord& r) {
    f.number(r.a), f.number(r.b);
    flow_numbers(f, r.guess);
    f.flag(r.is_own_guess), f.flag(r.is_through_seam), f.flag(r.is_pushed_out);
    f.number(r.good_until);
    flow_numbers(f, r.normal);
}

template <class F>
void flow_crack(F& f, CrackContact& c) {
    f.count(c.count, kPatchPoints, "the number of places of a crack");
    for (uint32_t k = 0; k < c.count; ++k) {
        flow_numbers(f, c.on_a[k]), flow_numbers(f, c.on_b[k]), flow_numbers(f, c.normal[k]);
        flow_numbers(f, c.normal_of_a[k]), f.number(c.reach[k]);
    }
    f.number(c.seconds);
}

template <class F>
void flow_newborn(F& f, NewbornPieces& n) {
    f.number(n.a), f.number(n.b), f.number(n.piece_a), f.number(n.piece_b);
    flow_crack(f, n.contact);
}

}  // namespace

/// What a pair remembers, as bytes: a friend of PairAlgorithm.
struct PairBytes {
    template <class F>
    static void flow(F& f, PairAlgorithm& pair) {
        f.number(pair.moves_a_), f.number(pair.moves_b_), f.number(pair.changes_a_), f.number(pair.changes_b_);
        f.flag(pair.is_fresh_);
        f.number(pair.travelled_), f.number(pair.step_travel_), f.number(pair.records_until_);
        f.number(pair.deep_seconds_), f.number(pair.least_deep_);
        flow_numbers(f, pair.relative_);
    }

    /// Of pieces that one of the two no longer has: the next step forgets it.
    static bool is_stale(const PairAlgorithm& pair) {
        return pair.changes_a_ != pair.work_->bodies[pair.a_].shape_changes ||
               pair.changes_b_ != pair.work_->bodies[pair.b_].shape_changes;
    }

    static void save(ByteWriter& out, PairAlgorithm& pair) {
        Out f(out);
        flow(f, pair);
        uint32_t count = 0;
        for (const PairRecord* r = pair.records_; r; r = r->next) ++count;
        out.number(count);
        for (PairRecord* r = pair.records_; r; r = r->next) {
            flow_record(f, *r);
            bool is_at_crack = r->crack != nullptr;
            f.flag(is_at_crack);
            if (is_at_crack) flow_crack(f, *r->crack);
            const int points = r->manifold ? r->manifold->getNumContacts() : -1;
            out.number(static_cast<int8_t>(points));
            for (int k = 0; k < points; ++k) flow_point(f, r->manifold->getContactPoint(k));
        }
    }

    /// Rows of the record, by ordinal: a hull, or null for a triangle; false: neither.
    static bool find_piece(const Body& body, uint32_t ordinal, const std::vector<const Hull*>& hulls,
                           const Hull*& found) {
        found = ordinal < hulls.size() ? hulls[ordinal] : nullptr;
        return found || (body.mesh && ordinal - hulls.size() < body.mesh->triangles.size());
    }

    static void load(ByteReader& in, PairAlgorithm& pair) {
        const Body &a = pair.work_->bodies[pair.a_], &b = pair.work_->bodies[pair.b_];
        std::vector<const Hull*> hulls_a, hulls_b;
        for (const Hull* h = a.hulls; h; h = h->next) hulls_a.push_back(h);
        for (const Hull* h = b.hulls; h; h = h->next) hulls_b.push_back(h);
        In f(in);
        flow(f, pair);
        const uint32_t count = in.count("the number of remembered pairs of pieces", 44, 1u << 26);
        PairRecord** link = &pair.records_;
        std::vector<std::pair<uint32_t, uint32_t>> pieces;
        for (uint32_t k = 0; k < count && in.is_sound(); ++k) {
            PairRecord* const r = pair.work_->records.take();
            *r = {};
            *link = r;
            link = &r->next;
            flow_record(f, *r);
            bool is_at_crack = false;
            f.flag(is_at_crack);
            if (is_at_crack) {
                r->crack = pair.work_->cracks.take();
                *r->crack = {};
                flow_crack(f, *r->crack);
            }
            const bool knows_a = find_piece(a, r->a, hulls_a, r->hull_a);  // both fill in their hull
            const bool knows_b = find_piece(b, r->b, hulls_b, r->hull_b);
            in.expect(knows_a && knows_b && (r->hull_a || r->hull_b),
                      "a remembered pair names pieces " + std::to_string(r->a) + " and " + std::to_string(r->b) +
                          ", which its bodies do not have,");
            pieces.emplace_back(r->a, r->b);
            const auto points = in.number<int8_t>("a number of contact points");
            in.expect(points >= -1 && points <= MANIFOLD_CACHE_SIZE,
                      "a contact of " + std::to_string(points) + " points");
            if (!in.is_sound() || points < 0) continue;
            r->manifold = pair.work_->manifolds.take();
            *r->manifold = Manifold(a, b);
            r->manifold->m_companionIdA = static_cast<int>(r->hull_a ? r->hull_a->cell : r->a);
            r->manifold->m_companionIdB = static_cast<int>(r->hull_b ? r->hull_b->cell : r->b);
            r->manifold->setNumContacts(points);
            // The first point says which pieces meet, also where none is left of the points (see list_manifolds).
            for (int p = 0; p < std::max<int>(points, 1); ++p) {
                btManifoldPoint point;
                point.m_partId0 = point.m_partId1 = -1;
                point.m_index0 = static_cast<int>(r->a), point.m_index1 = static_cast<int>(r->b);
                if (p < points) flow_point(f, point);
                r->manifold->getContactPoint(p) = point;
            }
        }
        std::sort(pieces.begin(), pieces.end());
        in.expect(std::adjacent_find(pieces.begin(), pieces.end()) == pieces.end(),
                  "a pair of pieces is remembered twice");
    }
};

void BulletWorld::save(ByteWriter& out) const {
    auto& self = const_cast<BulletWorld&>(*this);  // one list of members serves both ways; nothing is changed
    Out f(out);
    Vec3 gravity = from_bullet(gravity_);
    flow_numbers(f, gravity);
    f.number(self.counts_.sweeps), f.number(self.counts_.pairs), f.number(self.counts_.contacts);
    flow_numbers(f, self.to_static_);
    f.number(self.births_);
    out.number(body_end_);
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        f.flag(body.is_used);
        if (!body.is_used) continue;
        out.number(static_cast<uint8_t>(body.kind));
        flow_body(f, body);
        out.number(body.hull_count);
        for (Hull* h = body.hulls; h; h = h->next) flow_hull(f, *h, nullptr);
        bool has_mesh = body.mesh != nullptr;
        f.flag(has_mesh);
        if (has_mesh) flow_mesh(f, *body.mesh, nullptr);
        btRigidBody& bullet = *body.bullet;
        btTransform at = bullet.getWorldTransform();
        btVector3 velocity = bullet.getLinearVelocity(), spin = bullet.getAngularVelocity();
        flow_numbers(f, at), flow_numbers(f, velocity), flow_numbers(f, spin);
        out.number(static_cast<uint8_t>(bullet.isActive()));
        out.number(body.layer), out.number(body.mask);
    }
    const auto is_kept = [](const Pair& pair) { return !PairBytes::is_stale(*pair.algorithm); };
    const auto& pairs = pairs_.rows();
    out.number(static_cast<uint32_t>(std::count_if(pairs.begin(), pairs.end(), is_kept)));
    for (const Pair& pair : pairs) {
        if (!is_kept(pair)) continue;
        out.number(pair.a), out.number(pair.b);
        PairBytes::save(out, *pair.algorithm);
    }
    out.number(static_cast<uint32_t>(ignored_.size()));
    for (IgnoredPair pair : ignored_) {
        f.number(pair.a), f.number(pair.b), f.number(pair.seconds);
    }
    out.number(static_cast<uint32_t>(newborn_.size()));
    for (NewbornPieces pieces : newborn_) flow_newborn(f, pieces);
}

bool BulletWorld::load_body(ByteReader& in, Body& body) {
    In f(in);
    const auto kind = in.number<uint8_t>("a kind of body");
    in.expect(kind <= static_cast<uint8_t>(RigidKind::Dynamic), "kind of body " + std::to_string(kind));
    body.kind = static_cast<RigidKind>(kind);
    flow_body(f, body);
    const uint32_t hull_count = in.count("the number of pieces of a body", 64, 1u << 24);
    Hull** link = &body.hulls;
    bool lacks_seams = false;
    for (uint32_t k = 0; k < hull_count && in.is_sound(); ++k) {
        Hull* const hull = hulls_.take();
        *hull = {};
        *link = hull;
        link = &hull->next;
        flow_hull(f, *hull, &in);
        set_local_box(*hull);
        hull->ordinal = body.hull_count++;
        lacks_seams = lacks_seams || !hull->has_seams;
    }
    set_scale(body);
    if (lacks_seams && in.is_sound()) put_off_seams(body);
    bool has_mesh = false;
    f.flag(has_mesh);
    in.expect(!body.is_level || body.kind == RigidKind::Static, "a body that moves is level geometry");
    in.expect(!has_mesh || body.is_level, "static triangles of a body that is no level geometry");
    if (has_mesh && in.is_sound()) {
        body.mesh = std::make_unique<StaticMesh>();
        flow_mesh(f, *body.mesh, &in);
        ++mesh_count_;
    }
    btTransform at;
    btVector3 velocity, spin;
    flow_numbers(f, at), flow_numbers(f, velocity), flow_numbers(f, spin);
    const auto is_active = in.number<uint8_t>("a sleep"), is_dynamic = uint8_t{body.kind == RigidKind::Dynamic};
    body.layer = in.number<uint32_t>("a layer"), body.mask = in.number<uint32_t>("a mask");
    in.expect(is_dynamic ? body.mass > 0 : body.mass == 0, "a mass of " + std::to_string(body.mass) + " kg");
    in.expect(is_dynamic || !body.is_held, "a body that is held but not dynamic");
    if (!in.is_sound()) return false;
    const Mat3 rotation = rotation_of(body.fresh_at);
    for (Hull* hull = body.hulls; hull; hull = hull->next)
        refresh_world(*hull, rotation, from_bullet(body.fresh_at.getOrigin()));
    make_bullet(body, at);
    gather_box(body);
    enter_tree(body);
    if (is_dynamic && (body.is_held || !is_active)) stop_mass(body);
    body.bullet->setLinearVelocity(velocity);
    body.bullet->setAngularVelocity(spin);
    body.bullet->forceActivationState(is_active ? ACTIVE_TAG : ISLAND_SLEEPING);
    return true;
}

Result<void> BulletWorld::load(ByteReader& in) {
    CULLET_ASSERT(body_end_ == 0, "a rigid world that has %u bodies is loaded into", body_end_);
    InsideRigidEngine guard(counts_.allocations);
    In f(in);
    Vec3 gravity;
    flow_numbers(f, gravity);
    gravity_ = to_bullet(gravity);
    f.number(counts_.sweeps), f.number(counts_.pairs), f.number(counts_.contacts);
    flow_numbers(f, to_static_);
    f.number(births_);
    const uint32_t end = in.count("the number of bodies", 1, body_limit_);
    for (RigidId id = 0; id < end && in.is_sound(); ++id) {
        Body& body = bodies_[id];
        bool is_used = false;
        f.flag(is_used);
        if (!is_used) continue;
        body.id = id;
        const bool is_loaded = load_body(in, body);
        if (!is_loaded) drop_pieces(body);
        body.is_used = is_loaded;
        if (is_loaded) body_end_ = id + 1;
    }
    const uint32_t pairs = in.count("the number of pairs", 101, 1u << 26);
    std::pair<RigidId, RigidId> before(0, 0);
    for (uint32_t k = 0; k < pairs && in.is_sound(); ++k) {
        const auto a = in.number<uint32_t>("a pair"), b = in.number<uint32_t>("a pair");
        const bool is_sound = is_known(a) && is_known(b) && std::pair(a, b) > before && a < b &&
                              (bodies_[a].kind == RigidKind::Dynamic || bodies_[b].kind == RigidKind::Dynamic);
        if (!in.expect(is_sound, "a pair of bodies " + std::to_string(a) + " and " + std::to_string(b))) break;
        before = {a, b};
        load_pair(in, a, b);
    }
    const uint32_t ignored = in.count("the number of ignored pairs", 12, 1u << 26);
    for (uint32_t k = 0; k < ignored && in.is_sound(); ++k) {
        IgnoredPair pair{};
        f.number(pair.a), f.number(pair.b), f.number(pair.seconds);
        const bool is_rising =
            ignored_.empty() || std::pair(ignored_.back().a, ignored_.back().b) < std::pair(pair.a, pair.b);
        in.expect(is_known(pair.a) && is_known(pair.b) && pair.a < pair.b && is_rising,
                  "an ignored pair of bodies " + std::to_string(pair.a) + " and " + std::to_string(pair.b));
        if (in.is_sound()) ignored_.push_back(pair);
    }
    const uint32_t newborn = in.count("the number of newborn pieces", 24, 1u << 26);
    for (uint32_t k = 0; k < newborn && in.is_sound(); ++k) {
        NewbornPieces pieces{};
        flow_newborn(f, pieces);
        const auto key = [](const NewbornPieces& n) { return std::tuple(n.a, n.b, n.piece_a, n.piece_b); };
        const bool is_rising = newborn_.empty() || key(newborn_.back()) < key(pieces);
        in.expect(is_known(pieces.a) && is_known(pieces.b) && pieces.a < pieces.b && is_rising,
                  "newborn pieces of bodies " + std::to_string(pieces.a) + " and " + std::to_string(pieces.b));
        if (in.is_sound()) newborn_.push_back(pieces);
    }
    if (!in.is_sound()) return Error{in.trouble()};
    list_manifolds();
    return {};
}

void BulletWorld::load_pair(ByteReader& in, RigidId a, RigidId b) {
    if (bodies_[a].meets_layer_of(bodies_[b])) return PairBytes::load(in, pairs_.append(a, b, work_));
    // Where layers do not meet there is no pair: its memory of contacts is read and forgotten.
    PairAlgorithm forgotten(a, b, work_);
    PairBytes::load(in, forgotten);
    forgotten.forget();
}

std::unique_ptr<RigidWorld> BulletWorld::make_another(uint32_t body_limit) const {
    return make_bullet_world(body_limit);
}

std::optional<RigidKind> BulletWorld::kind(RigidId id) const {
    return is_known(id) ? std::optional(bodies_[id].kind) : std::nullopt;
}

}  // namespace cullet::bullet
