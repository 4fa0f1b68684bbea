// Contacts of one pair of bodies, of whatever pieces.
#pragma once
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <vector>

#include "engine/bullet/body.hpp"
#include "engine/bullet/contact_patch.hpp"
#include "engine/bullet/crack_contact.hpp"
#include "engine/bullet/inner_edges.hpp"
#include "engine/bullet/pool.hpp"

namespace cullet::bullet {

/// Contact points of two pieces, in the form that Bullet keeps them in.
struct Manifold : btPersistentManifold {
    Manifold() = default;
    Manifold(const Body& a, const Body& b)
        : btPersistentManifold(&*a.bullet, &*b.bullet, 0, kContactRange, BT_LARGE_FLOAT) {}
    Manifold* next = nullptr;  // while it is free
};

/// Pieces of siblings that lie in each other, or within the range of contacts, when these are born.
struct NewbornPieces {
    RigidId a, b;               // a < b
    uint32_t piece_a, piece_b;  // ordinals
    CrackContact contact;
};

/// Two pieces whose boxes are near: what is remembered of them from step to step.
struct PairRecord {
    uint32_t a, b;                  // ordinals of the pieces; triangles of a static mesh follow its convex parts
    const Hull *hull_a, *hull_b;    // null: a triangle
    Vec3 guess;                     // last axis from b towards a
    bool is_own_guess = false;      // no longer borrowed from a neighbour
    bool is_through_seam = false;   // of the manifold's points, see Patch
    bool is_pushed_out = false;     // it lay deep in an inner face and has not come out yet
    double good_until = 0;          // what the two found last holds while PairAlgorithm::travelled_ is less
    Vec3 normal;                    // of the manifold's points, in the frame of b
    CrackContact* crack = nullptr;  // of siblings' pieces that have lain in each other since birth
    Manifold* manifold = nullptr;   // null while they do not touch
    PairRecord* next = nullptr;
};

struct Candidate {
    uint32_t a, b;
    const Hull *hull_a, *hull_b;  // null: a triangle
};

/// One contact point of a pair of bodies while its best ones are chosen.
struct Offer {
    Manifold* manifold;
    int index;  // in the manifold
    Vec3 point, normal;
    float distance;
    float held;          // m: the distance, and less where there was one a step ago, to keep what is held
    float apart = kFar;  // from the nearest chosen one, in the measure of choose_best()
    bool is_through_seam = false;
    bool is_chosen = false;
};

/// What the pairs of one world share.
struct PairWork {
    explicit PairWork(uint32_t body_limit)
        : records(128 * static_cast<size_t>(body_limit) + 16384),
          manifolds(16 * static_cast<size_t>(body_limit) + 1024),
          cracks(4 * static_cast<size_t>(body_limit) + 1024) {}
    SharedPool<PairRecord> records;
    SharedPool<Manifold> manifolds;
    SharedPool<CrackContact> cracks;
    Body* bodies = nullptr;  // by id
    Surroundings around;
    float dt = 0;            // s, of the step
    float weight_speed = 0;  // m/s that gravity gives in it
};

/// Working memory for one pair at a time: one for each thread.
struct PairScratch {
    explicit PairScratch(uint32_t body_limit) {
        // The largest two bodies, of at most all hulls that there are room for.
        const size_t hulls = 4 * static_cast<size_t>(body_limit) + 4096;
        candidates.reserve(4 * hulls);
        offers.reserve(8 * hulls);
        near_a.reserve(hulls);
        near_b.reserve(hulls);
        touches.reserve(hulls);
        bodies.reserve(body_limit), fast.reserve(body_limit);
    }
    std::vector<Candidate> candidates;
    std::vector<Offer> offers;
    std::vector<const Hull*> near_a, near_b;
    std::vector<const CrackTouch*> touches;  // of the pieces at hand
    std::vector<RigidId> bodies;             // near a sweep,
    std::vector<uint32_t> fast;              // and the fast ones, as Sweeper numbers them
    Hull triangle;
};

/// Pieces of the two bodies whose boxes come within `grown` of each other, sorted by (a, b), into scratch.candidates.
void find_candidates(const Body& a, const Body& b, float grown, PairScratch& scratch);
/// The hull of a candidate's side; triangles are built in `scratch.triangle`, with the face that sees `seen_from`.
const Hull& hull_of(const Hull* hull, const Body& body, uint32_t ordinal, Vec3 seen_from, PairScratch& scratch);

/// What it remembers goes back to `work` only by forget().
class PairAlgorithm {
    friend struct PairBytes;  // saving and loading

 public:
    PairAlgorithm() = default;
    PairAlgorithm(RigidId a, RigidId b, PairWork& work) : a_(a), b_(b), work_(&work) {}  // a < b
    /// Calls found(manifold, record) for the pieces that touch, in rising (a, b).
    template <class Found>
    void visit_manifolds(Found found) const {
        for (const PairRecord* r = records_; r; r = r->next)
            if (r->manifold) found(*r->manifold, *r);
    }

    /// N s that hold the two to each other in this step, all contacts together and in any direction; 0 unless they are
    /// wedged.
    float grip() const;
    /// They were cut from one body and have lain in each other since: what cells overlap by is no touch to push out of.
    bool is_born_deep() const { return deep_seconds_ < 0; }
    /// Whether two pieces, by their ordinals, have lain in each other since birth.
    bool meet_at_crack(uint32_t a, uint32_t b) const;
    /// The axis of two pieces that touch, by their ordinals; zero when they do not.
    Vec3 axis_of(uint32_t a, uint32_t b) const;
    /// What lay in each other at birth is named once, in the first step after it. Different pairs may be processed at
    /// once.
    void process(PairScratch& scratch, std::span<const NewbornPieces> newborn = {});
    /// Drops all contacts and what was remembered.
    void forget();

 private:
    float scale() const { return scale_of(work_->bodies[a_], work_->bodies[b_]); }
    void follow(const Body& a, const Body& b);
    void find_records(const Body& a, const Body& b, PairScratch& scratch);
    void meet(PairRecord& record, const Body& a, const Mat3& rotation_a, const Body& b, const Mat3& rotation_b,
              PairScratch& scratch);
    void keep_to_open_faces(Patch& patch, PairRecord& record, const Body& a, const Hull& hull_a, const Body& b,
                            const Hull& hull_b);
    void take_newborn(std::span<const NewbornPieces> newborn);
    void drop(PairRecord* record);
    bool write_crack(PairRecord& record, const Body& a, const Hull& hull_a, const Body& b, const Hull& hull_b);
    void write(PairRecord& record, const Patch& patch, uint32_t cell_a, uint32_t cell_b);
    void follow_points(PairRecord& record, const Body& a, const Body& b);
    void release(PairRecord& record);
    float list_offers(std::vector<Offer>& offers);
    void drop_through_seams(std::vector<Offer>& offers);
    void remove_unchosen(const std::vector<Offer>& offers);
    float choose_best(std::vector<Offer>& offers);
    void note_born_deep(float deepest);
    void note_wedged(float deepest);

    RigidId a_ = kNoRigid, b_ = kNoRigid;  // a_ < b_
    PairWork* work_ = nullptr;
    PairRecord* records_ = nullptr;  // sorted by (a, b)
    uint32_t moves_a_ = 0, moves_b_ = 0, changes_a_ = 0, changes_b_ = 0;
    bool is_fresh_ = false;
    // The farthest way of any point of the smaller body in the frame of the larger one, summed over the steps: no gap
    // between their pieces changed by more.
    double travelled_ = 0, step_travel_ = 0;
    // That they have lain deep in each other, and came out of it by nothing; negative: since they were born.
    float deep_seconds_ = 0;
    float least_deep_ = kFar;   // m of overlap in that time
    double records_until_ = 0;  // records_ holds all pieces within kCandidateRange while travelled_ is less
    btTransform relative_ = btTransform::getIdentity();  // the smaller body in the frame of the larger one

 public:
    PairAlgorithm* next = nullptr;  // while it is free
};

}  // namespace cullet::bullet
