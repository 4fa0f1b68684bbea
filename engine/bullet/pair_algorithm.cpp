#include "engine/bullet/pair_algorithm.hpp"

#include <algorithm>

#include "engine/bullet/sides.hpp"
#include "engine/lanes.hpp"

namespace cullet::bullet {

using namespace lanes;
namespace {

// Lengths are those of bodies of scale 1, see lengths.hpp.

// A point of last step's patch within this distance hands its impulse on (warm starting); the nearest one not yet
// taken.
constexpr float kSamePoint = 0.01f;  // m

// Impulses are handed on while the two move less than this against each other in a step. The impulse of a blow is none
// to begin the next step with: twenty iterations do not take it back, and a heap that is hit throws its shards about.
constexpr double kRestingTravel = 0.002;  // m
// Nor more of it than this many weights of the lighter body: what lies in a heap that is hit moves little too.
constexpr float kRestingWeights = 5;

// Contacts of a pair of bodies. Half of it and curved shards rock, twice it and the solver's time doubles.
constexpr uint32_t kPairContacts = 12;
// Pieces are watched from this far, so that their axis is known before they overlap.
constexpr float kCandidateRange = 0.01f;  // m
constexpr float kAhead = 0.01f;           // m, of travel until pieces are looked through again
// A patch is followed, not found anew, while the bodies move less than this against each other. At five times it a
// stack of boxes drifts by millimetres.
constexpr float kSmallTravel = 0.00001f;  // m
constexpr float kTurnLength = 0.1f;       // m, that opposite normals count half of
constexpr float kDepthWeight = 20;        // a millimetre deeper counts as 20 mm farther
constexpr float kDeepEnough = 0.002f;     // m, deeper than which place alone counts
constexpr float kPastBonus = 0.01f;       // m
constexpr float kSeamNear = 0.01f;        // m, between touches of one seam
constexpr float kAsDeep = 0.0002f;        // m
constexpr float kDeepInside = 0.005f;     // m, in an inner face
constexpr float kOutOfInside = 0.001f;    // m, in an inner face: what is pushed out of it comes out as far as this
constexpr float kDeepBehind = 0.01f;      // m, an open one
constexpr float kSameWay = 0.9f;          // cosine of normals of one touch in two steps

// Shards with holes and hooks can be threaded through each other, so that each way out of one piece leads deeper into
// another: pushed out, they tremble for ever. What came this deep into something, and in so long not out to this share
// of it, is wedged: not pushed any more, and held as friction holds a wedge, with this many weights of the lighter body
// in all. With five weights at each contact, after one and a half seconds one of 16 heaps of fifty shards keeps a
// contact 10 mm deep that would have come out.
constexpr float kWedgedDepth = 0.003f, kFreeDepth = 0.0015f;  // m, from and until which a pair counts as deep
constexpr float kComesOut = 0.8f;
constexpr float kWedgedSeconds = 2;
constexpr float kWedgedWeights = 10;
constexpr float kBornDeep = -1;  // s

// Displacement is convex in the point: the corner of a box that moved farthest bounds all points in it. Of the middle
// and of the half sides: (R' - R) p + (o' - o).
double farthest_way(const Box& box, const btTransform& before, const btTransform& now) {
    const Mat3 from = rotation_of(before), to = rotation_of(now);
    const Vec3 middle = 0.5f * (box.low + box.high), half = 0.5f * (box.high - box.low);
    const Lanes x = Lanes{-1, 1, -1, 1} * half.x, y = Lanes{-1, -1, 1, 1} * half.y;
    Lanes low{}, high{};
    for (int k = 0; k < 3; ++k) {
        const Vec3 row = to.row[k] - from.row[k];
        const float straight = now.getOrigin()[k] - before.getOrigin()[k] + dot(row, middle);
        const Lanes across = x * row.x + y * row.y + straight, below = across - row.z * half.z,
                    above = across + row.z * half.z;
        low = low + below * below, high = high + above * above;
    }
    const Lanes squares = most(low, high);
    return std::sqrt(std::max(std::max(squares[0], squares[1]), std::max(squares[2], squares[3])));
}

void gather_near(const Body& body, const Box& box, float grown, std::vector<const Hull*>& out) {
    out.clear();
    for (const Hull* hull = body.hulls; hull; hull = hull->next)
        if (overlap(hull->world_box, box, grown)) out.push_back(hull);
}

// Triangles of a static mesh that a piece comes near to; `is_a` says which side of the pair the mesh is.
void add_triangles(const Body& mesh_body, const std::vector<const Hull*>& pieces, bool is_mesh_a, float reach,
                   PairScratch& scratch) {
    if (!mesh_body.mesh) return;
    for (const Hull* piece : pieces) {
        visit_triangles(*mesh_body.mesh, grown(piece->world_box, reach), [&](uint32_t t) {
            const uint32_t ordinal = mesh_body.hull_count + t;
            if (is_mesh_a)
                scratch.candidates.push_back({ordinal, piece->ordinal, nullptr, piece});
            else
                scratch.candidates.push_back({piece->ordinal, ordinal, piece, nullptr});
        });
    }
}

// m, by which the point that bears one of the two may miss its middle: see ContactSettings::rolling_friction.
float rolling_arm(const Body& a, const Body& b) {
    if (!is_ball(a) && !is_ball(b)) return a.rolling_friction + b.rolling_friction;
    const float radius = !is_ball(a) ? b.margin : !is_ball(b) ? a.margin : std::min(a.margin, b.margin);
    return std::max(a.rolling_share, b.rolling_share) * radius;
}

// Of those that have one.
float lighter_mass(const Body& a, const Body& b) {
    return a.mass > 0 && b.mass > 0 ? std::min(a.mass, b.mass) : std::max(a.mass, b.mass);
}

// The touch of a triangle is from behind, or that of a side that its piece is not on: past a ridge the far side's plane
// rises over the piece, which lies behind it but on the near side. (Thin panes on hills were held from both sides.) A
// core that is apart from the triangle is on the side that it is touched from.
bool is_out_of_sight(const Body& body, const Hull& triangle, const Body& other, const Hull& piece, Vec3 normal,
                     Vec3 place, float distance) {
    if (dot(triangle.face_normal[0], normal) < -0.01f) return true;
    if (body.mesh->one_sided || distance > -piece.margin) return false;
    return is_hidden(*body.mesh, triangle.ordinal - body.hull_count, inner_point(piece, other.fresh_at), place);
}

}  // namespace

const Hull& hull_of(const Hull* hull, const Body& body, uint32_t ordinal, Vec3 seen_from, PairScratch& scratch) {
    if (hull) return *hull;
    build_seen_triangle(scratch.triangle, *body.mesh, ordinal - body.hull_count, ordinal, seen_from);
    scratch.triangle.ordinal = ordinal;
    return scratch.triangle;
}

void find_candidates(const Body& a, const Body& b, float grown, PairScratch& scratch) {
    scratch.candidates.clear();
    if (!overlap(a.shape.box, b.shape.box, grown)) return;
    gather_near(a, b.shape.box, grown, scratch.near_a);
    gather_near(b, a.shape.box, grown, scratch.near_b);
    for (const Hull* p : scratch.near_a)
        for (const Hull* q : scratch.near_b)
            if (overlap(p->world_box, q->world_box, grown))
                scratch.candidates.push_back({p->ordinal, q->ordinal, p, q});
    if (!a.mesh && !b.mesh) return;
    add_triangles(a, scratch.near_b, true, grown, scratch);
    add_triangles(b, scratch.near_a, false, grown, scratch);
    std::sort(scratch.candidates.begin(), scratch.candidates.end(),
              [](const Candidate& p, const Candidate& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

void PairAlgorithm::release(PairRecord& record) {
    if (record.manifold) work_->manifolds.give(record.manifold);
    record.manifold = nullptr;
}

void PairAlgorithm::drop(PairRecord* record) {
    release(*record);
    if (record->crack) work_->cracks.give(record->crack);
    work_->records.give(record);
}

void PairAlgorithm::forget() {
    while (records_) {
        PairRecord* const record = records_;
        records_ = record->next;
        drop(record);
    }
    is_fresh_ = false;
    travelled_ = records_until_ = 0;
    deep_seconds_ = 0, least_deep_ = kFar;
}

// How far the two moved against each other since the last call.
void PairAlgorithm::follow(const Body& a, const Body& b) {
    const bool is_a_smaller = b.kind == RigidKind::Static || (a.kind != RigidKind::Static && a.reach < b.reach);
    const Body &small = is_a_smaller ? a : b, &large = is_a_smaller ? b : a;
    const btTransform now = large.fresh_at.inverseTimes(small.fresh_at);
    step_travel_ = is_fresh_ ? farthest_way(small.local_box, relative_, now) : 0;
    travelled_ += step_travel_;
    relative_ = now;
}

// Records for all pieces that are near, or soon will be: slow pairs are looked through again only after a while.
void PairAlgorithm::find_records(const Body& a, const Body& b, PairScratch& scratch) {
    const float scale = this->scale();
    find_candidates(a, b, scale * (kCandidateRange + kAhead), scratch);
    records_until_ = travelled_ + scale * kAhead;
    PairRecord** link = &records_;
    const auto drop_first = [&] {
        PairRecord* const record = *link;
        *link = record->next;
        drop(record);
    };
    const PairRecord* last = nullptr;
    for (const Candidate& c : scratch.candidates) {
        while (*link && ((*link)->a < c.a || ((*link)->a == c.a && (*link)->b < c.b))) drop_first();
        if (!*link || (*link)->a != c.a || (*link)->b != c.b) {
            PairRecord* const record = work_->records.take();
            // A new pair of pieces begins with the axis of its neighbour of the same piece.
            *record = {};
            record->a = c.a, record->b = c.b;
            if (last && last->a == c.a) record->guess = last->guess;
            record->hull_a = c.hull_a, record->hull_b = c.hull_b;
            record->good_until = travelled_;
            record->next = *link;
            *link = record;
        }
        last = *link;
        link = &(*link)->next;
    }
    while (*link) drop_first();
}

void PairAlgorithm::take_newborn(std::span<const NewbornPieces> newborn) {
    PairRecord* r = records_;
    for (const NewbornPieces& n : newborn) {
        while (r && (r->a < n.piece_a || (r->a == n.piece_a && r->b < n.piece_b))) r = r->next;
        if (!r || r->a != n.piece_a || r->b != n.piece_b || r->crack) continue;
        r->crack = work_->cracks.take();
        *r->crack = n.contact;
    }
}

void PairAlgorithm::process(PairScratch& scratch, std::span<const NewbornPieces> newborn) {
    const Body &a = work_->bodies[a_], &b = work_->bodies[b_];
    if (changes_a_ != a.shape_changes || changes_b_ != b.shape_changes) forget();
    if (is_fresh_ && moves_a_ == a.moves && moves_b_ == b.moves) return;
    // Nothing to remember and nothing near: the next look begins anew.
    if (!records_ && !overlap(a.shape.box, b.shape.box, scale() * (kCandidateRange + kAhead))) {
        is_fresh_ = false;
        return;
    }
    follow(a, b);
    const bool is_new = !is_fresh_;
    if (!is_fresh_ || travelled_ >= records_until_) find_records(a, b, scratch);
    is_fresh_ = true;
    take_newborn(newborn);
    moves_a_ = a.moves, moves_b_ = b.moves, changes_a_ = a.shape_changes, changes_b_ = b.shape_changes;
    const Mat3 rotation_a = rotation_of(a.fresh_at), rotation_b = rotation_of(b.fresh_at);
    for (PairRecord* record = records_; record; record = record->next) {
        // Skipped in the gap: its points are gone.
        const bool is_emptied = record->manifold && record->manifold->getNumContacts() == 0;
        if (travelled_ >= record->good_until || is_emptied)
            meet(*record, a, rotation_a, b, rotation_b, scratch);
        else if (record->manifold)
            follow_points(*record, a, b);
    }
    const float deepest = choose_best(scratch.offers);
    if (is_new && newborn.empty() && are_siblings(a, b)) note_born_deep(deepest);
    note_wedged(deepest);
}

// A cut goes along cells, whose hulls lie in each other by centimetres there. Pushed out of that, a window of 40 kg was
// out of its pane in five steps.
void PairAlgorithm::note_born_deep(float deepest) {
    if (deepest > scale() * kWedgedDepth) deep_seconds_ = kBornDeep;
}

// What stands in the ground is pushed out for as long as it takes.
void PairAlgorithm::note_wedged(float deepest) {
    if (is_born_deep() && deepest > scale() * kFreeDepth) return;
    const bool is_ground = work_->bodies[a_].is_level || work_->bodies[b_].is_level;
    const bool is_deep = deepest > scale() * (least_deep_ < kFar ? kFreeDepth : kWedgedDepth);
    if (!is_deep || is_ground) {
        deep_seconds_ = 0, least_deep_ = kFar;
    } else if (deepest < kComesOut * least_deep_) {
        deep_seconds_ = 0, least_deep_ = deepest;
    } else {
        deep_seconds_ = std::min(deep_seconds_ + work_->dt, kWedgedSeconds);
    }
}

float PairAlgorithm::grip() const {
    if (deep_seconds_ < kWedgedSeconds) return 0;
    return kWedgedWeights * lighter_mass(work_->bodies[a_], work_->bodies[b_]) * work_->weight_speed;
}

// As long as they lie in each other, and not for long; false from then on.
bool PairAlgorithm::write_crack(PairRecord& record, const Body& a, const Hull& hull_a, const Body& b,
                                const Hull& hull_b) {
    record.crack->seconds -= work_->dt;
    const float scale = scale_of(hull_a, hull_b), range = scale * kContactRange;
    if (!(record.crack->seconds > 0) || separation(hull_a, hull_b, record.guess, range) >= range) {
        work_->cracks.give(record.crack);
        record.crack = nullptr;
        return false;
    }
    record.good_until = travelled_;
    const Patch patch = crack_patch(*record.crack, a.fresh_at, b.fresh_at, scale);
    if (patch.count > 0)
        write(record, patch, hull_a.cell, hull_b.cell);
    else
        release(record);
    return true;
}

// Of a patch that pushes along an edge inside of what is flat, what lies over an open face of the same piece stays.
// What lies deep in an inner face, or much deeper behind the open one, did not come in through that: it is wedged among
// pieces, and goes the way that it was found. Turned out by 7 cm it shook for as long as anybody looked, and a slab
// that was pushed out of a wall's stump only while it was deep fell back in for ever.
void PairAlgorithm::keep_to_open_faces(Patch& patch, PairRecord& record, const Body& a, const Hull& hull_a,
                                       const Body& b, const Hull& hull_b) {
    const float inside = record.is_pushed_out ? kOutOfInside : kDeepInside;
    record.is_pushed_out = false;
    if (!may_have_inner_edges(a, hull_a) && !may_have_inner_edges(b, hull_b)) return;
    const auto keep = [&](const Body& body, const Hull& hull, const Body& other, const Hull& piece, bool is_a) {
        if (patch.count == 0 || !may_have_inner_edges(body, hull)) return;
        const float scale = scale_of(hull, piece);
        Vec3 places[kPatchPoints + 1];
        int deepest = 0, count = patch.count;
        for (int k = 0; k < patch.count; ++k) {
            places[k] = is_a ? patch.point[k].on_a : patch.point[k].on_b;
            if (patch.point[k].distance < patch.point[deepest].distance) deepest = k;
        }
        std::swap(places[0], places[deepest]);
        // A triangle has no sides that points could lie on.
        if (patch.has_nearest && !hull.one_sided) {
            places[count++] = places[0];
            places[0] = is_a ? patch.nearest_on_a : patch.nearest_on_b;
        }
        Vec3 normal = is_a ? -patch.normal : patch.normal;
        if (hull.one_sided &&
            is_out_of_sight(body, hull, other, piece, normal, places[0], patch.point[deepest].distance))
            return (void)(patch.count = 0);
        const Push push = turn_to_open_face(work_->around, {body, hull, other, piece, piece.world},
                                            {places, static_cast<size_t>(count)}, normal);
        if (push == Push::AsFound) return;
        // Triangles are no pieces to be wedged among: a ball at 20 m/s is as deep in a hill that rises before it.
        const bool may_be_wedged = !hull.one_sided || push == Push::None;
        if (may_be_wedged && patch.point[deepest].distance < -scale * inside)
            return (void)(record.is_pushed_out = true);
        if (push == Push::None) return (void)(patch.count = 0);
        const Vec3 turned = is_a ? -normal : normal;
        const Patch along = patch_along(hull_a, rotation_of(a.fresh_at), hull_b, rotation_of(b.fresh_at), turned);
        for (int k = 0; k < along.count; ++k)
            if (along.point[k].distance < -scale * kDeepBehind) return;
        record.guess = turned;
        patch = along;
    };
    // First a piece that no solver moves: the faces of a shard or a pane are as wavy as its cells.
    const bool is_a_first = is_firm(a) && !is_firm(b) && !hull_a.one_sided;
    if (is_a_first) keep(a, hull_a, b, hull_b, true);
    keep(b, hull_b, a, hull_a, false);
    if (!is_a_first) keep(a, hull_a, b, hull_b, true);
}

void PairAlgorithm::meet(PairRecord& record, const Body& a, const Mat3& rotation_a, const Body& b,
                         const Mat3& rotation_b, PairScratch& scratch) {
    Vec3 seen_from;
    if (!record.hull_b) seen_from = inner_point(*record.hull_a, a.fresh_at);
    if (!record.hull_a) seen_from = inner_point(*record.hull_b, b.fresh_at);
    const Hull &hull_a = hull_of(record.hull_a, a, record.a, seen_from, scratch),
               &hull_b = hull_of(record.hull_b, b, record.b, seen_from, scratch);
    if (record.crack && write_crack(record, a, hull_a, b, hull_b)) return;
    Patch patch = contact_patch(hull_a, rotation_a, hull_b, rotation_b, record.guess, record.is_own_guess);
    record.is_own_guess = true;
    record.good_until = travelled_ + std::max(patch.room, scale_of(hull_a, hull_b) * kSmallTravel);
    if (patch.count > 0)
        keep_to_open_faces(patch, record, a, hull_a, b, hull_b);
    else
        record.is_pushed_out = false;
    if (patch.count > 0)
        write(record, patch, hull_a.cell, hull_b.cell);
    else
        release(record);
}

// The points of a patch go on with their bodies while these hardly move against each other.
void PairAlgorithm::follow_points(PairRecord& record, const Body& a, const Body& b) {
    btPersistentManifold& manifold = *record.manifold;
    const btVector3 normal = b.fresh_at.getBasis() * to_bullet(record.normal);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
        btManifoldPoint& p = manifold.getContactPoint(k);
        p.m_positionWorldOnA = a.fresh_at * p.m_localPointA;
        p.m_positionWorldOnB = b.fresh_at * p.m_localPointB;
        p.m_normalWorldOnB = normal;
        p.m_distance1 = (p.m_positionWorldOnA - p.m_positionWorldOnB).dot(normal);
        ++p.m_lifeTime;
    }
}

// What comes back is how deep the deepest is, m.
float PairAlgorithm::list_offers(std::vector<Offer>& offers) {
    offers.clear();
    const float bonus = scale() * kPastBonus / kDepthWeight;
    float deepest = 0;
    for (PairRecord* r = records_; r; r = r->next)
        for (int k = 0; r->manifold && k < r->manifold->getNumContacts(); ++k) {
            const btManifoldPoint& p = r->manifold->getContactPoint(k);
            const float past = p.m_lifeTime > 0 ? bonus : 0.0f;
            deepest = std::max(deepest, -p.m_distance1);
            offers.push_back({r->manifold, k, from_bullet(p.m_positionWorldOnB), from_bullet(p.m_normalWorldOnB),
                              p.m_distance1, p.m_distance1 - past, kFar, r->is_through_seam});
        }
    return deepest;
}

// A corner of another body above a seam is met by the pieces on both sides of it, by one of them sideways: that touch
// goes where the other one is there and as deep. (Dropping all touches through seams let shards that stand on the end
// of a seam sink by 3 mm, until their cores overlapped the floor.)
void PairAlgorithm::drop_through_seams(std::vector<Offer>& offers) {
    const float near = scale() * kSeamNear, as_deep = scale() * kAsDeep;
    bool is_any = false;
    for (Offer& doubtful : offers) {
        if (!doubtful.is_through_seam) continue;
        bool is_met = false;
        for (const Offer& sound : offers) {
            const Vec3 between = sound.point - doubtful.point;
            is_met |= !sound.is_through_seam && sound.distance < doubtful.distance + as_deep &&
                      dot(between, between) < near * near;
        }
        doubtful.is_chosen = is_met;
        is_any |= is_met;
    }
    if (!is_any) return;
    for (Offer& offer : offers) offer.is_chosen = !offer.is_chosen;
    remove_unchosen(offers);
    list_offers(offers);
}

// Points of one manifold are removed from the last on: Bullet puts the last one in the gap.
void PairAlgorithm::remove_unchosen(const std::vector<Offer>& offers) {
    for (size_t k = offers.size(); k-- > 0;)
        if (!offers[k].is_chosen) offers[k].manifold->removeContactPoint(offers[k].index);
    for (PairRecord* r = records_; r; r = r->next)
        if (r->manifold && r->manifold->getNumContacts() == 0) release(*r);
}

// Two shells that lie in each other touch in hundreds of points, of which the solver needs a dozen. The deepest comes
// first, then always the one farthest from those chosen; turned normals, depth and a past as contact count as distance.
// What comes back is how deep the deepest is, m.
float PairAlgorithm::choose_best(std::vector<Offer>& offers) {
    const float deepest = list_offers(offers);
    drop_through_seams(offers);
    if (offers.size() <= kPairContacts) return deepest;
    const float scale = this->scale(), deep_enough = scale * kDeepEnough, turn_length = scale * kTurnLength;
    for (uint32_t round = 0; round < kPairContacts; ++round) {
        Offer* best = nullptr;
        float best_score = -kFar;
        for (Offer& offer : offers) {
            const float depth = round == 0 ? offer.held : std::max(offer.held, -deep_enough);
            const float score = (round == 0 ? 0 : offer.apart) - kDepthWeight * depth;
            if (!offer.is_chosen && score > best_score) best = &offer, best_score = score;
        }
        best->is_chosen = true;
        for (Offer& offer : offers) {
            const Vec3 p = offer.point - best->point, n = turn_length * (offer.normal - best->normal);
            offer.apart = std::min(offer.apart, std::sqrt(dot(p, p) + dot(n, n)));
        }
    }
    remove_unchosen(offers);
    return deepest;
}

// Friction and restitution of two bodies: the geometric mean, so that equal materials keep their own value. What was
// one does not bounce at its crack.
void PairAlgorithm::write(PairRecord& record, const Patch& patch, uint32_t cell_a, uint32_t cell_b) {
    const Body &a = work_->bodies[a_], &b = work_->bodies[b_];
    if (!record.manifold) {
        record.manifold = work_->manifolds.take();
        *record.manifold = Manifold(a, b);
    }
    btPersistentManifold& manifold = *record.manifold;
    record.normal = transposed_times(rotation_of(b.fresh_at), patch.normal);
    record.is_through_seam = patch.is_through_seam;
    manifold.m_companionIdA = static_cast<int>(cell_a);
    manifold.m_companionIdB = static_cast<int>(cell_b);
    btManifoldPoint before[kPatchPoints];
    const int before_count = manifold.getNumContacts();
    for (int k = 0; k < before_count; ++k) before[k] = manifold.getContactPoint(k);
    bool is_taken[kPatchPoints] = {};
    const float friction = std::sqrt(a.friction * b.friction),
                restitution = record.crack ? 0 : std::sqrt(a.restitution * b.restitution);
    const float mass = lighter_mass(a, b);
    const float arm = rolling_arm(a, b);
    const float most = kRestingWeights * mass * work_->weight_speed, scale = this->scale();
    manifold.setNumContacts(patch.count);
    for (int k = 0; k < patch.count; ++k) {
        const btVector3 on_a = to_bullet(patch.point[k].on_a), on_b = to_bullet(patch.point[k].on_b);
        btManifoldPoint point(a.fresh_at.invXform(on_a), b.fresh_at.invXform(on_b), to_bullet(patch.point[k].normal),
                              patch.point[k].distance);
        point.m_index0 = static_cast<int>(record.a);
        point.m_index1 = static_cast<int>(record.b);
        point.m_positionWorldOnA = on_a;
        point.m_positionWorldOnB = on_b;
        point.m_combinedFriction = friction;
        point.m_combinedRestitution = restitution;
        int nearest = -1;
        float least = scale * scale * kSamePoint * kSamePoint;
        for (int j = 0; j < before_count; ++j) {
            const float square = (before[j].m_localPointA - point.m_localPointA).length2();
            if (!is_taken[j] && square < least) nearest = j, least = square;
        }
        const bool is_known = nearest >= 0;
        if (is_known) {
            is_taken[nearest] = true;
            point.m_lifeTime = before[nearest].m_lifeTime + 1;
        }
        if (is_known && step_travel_ < static_cast<double>(scale) * kRestingTravel &&
            before[nearest].m_normalWorldOnB.dot(point.m_normalWorldOnB) > kSameWay) {
            const float impulse = before[nearest].m_appliedImpulse, share = impulse > most ? most / impulse : 1;
            point.m_appliedImpulse = share * impulse;
            point.m_appliedImpulseLateral1 = share * before[nearest].m_appliedImpulseLateral1;
            point.m_appliedImpulseLateral2 = share * before[nearest].m_appliedImpulseLateral2;
        }
        point.m_combinedRollingFriction = point.m_combinedSpinningFriction = arm;
        manifold.getContactPoint(k) = point;
    }
}

Vec3 PairAlgorithm::axis_of(uint32_t a, uint32_t b) const {
    const PairRecord* r = records_;
    while (r && (r->a < a || (r->a == a && r->b < b))) r = r->next;
    return r && r->a == a && r->b == b && r->manifold ? r->guess : Vec3{};
}

bool PairAlgorithm::meet_at_crack(uint32_t a, uint32_t b) const {
    const PairRecord* r = records_;
    while (r && (r->a < a || (r->a == a && r->b < b))) r = r->next;
    return r && r->a == a && r->b == b && r->crack;
}

}  // namespace cullet::bullet
