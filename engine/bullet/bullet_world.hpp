// RigidWorld on Bullet: bookkeeping of bodies, the split step, holding, sleep.
#pragma once
#include <atomic>
#include <vector>

#include "engine/bullet/body_ways.hpp"
#include "engine/bullet/box_tree.hpp"
#include "engine/bullet/contact_solver.hpp"
#include "engine/bullet/pair_list.hpp"
#include "engine/bullet/scratches.hpp"
#include "engine/bullet/seams.hpp"
#include "engine/bullet/sweep.hpp"

namespace cullet::bullet {

struct IgnoredPair {
    RigidId a, b;  // a < b
    float seconds;
};

/// How fast things go under a gravity, against g: what falls as far takes `slower` times as long, and is `speed` times
/// as fast by then. Weaker gravity asks for more patience, at most eight times as much; stronger gravity for no less.
struct Pace {
    explicit Pace(float gravity)
        : is_weightless(!(gravity > 0)),
          speed(std::min(std::sqrt(gravity / kEarth), 1.0f)),
          slower(1 / std::max(speed, 0.125f)) {}
    static constexpr float kEarth = 9.81f;  // m/s2
    bool is_weightless;
    float speed, slower;
};

class BulletWorld final : public RigidWorld {
 public:
    explicit BulletWorld(uint32_t body_limit);
    ~BulletWorld() override;

    void set_gravity(Vec3 gravity) override;
    void add_static_triangles(RigidId id, std::span<const Vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles, float friction, float restitution,
                              uint32_t layer, uint32_t mask, bool one_sided) override;
    LeftOut left_out(RigidId id) const override;
    void set_rolling_share(RigidId id, float share) override;
    void add(RigidId id, const RigidDescription& description) override;
    void remove(RigidId id) override;
    void replace(RigidId id, const RigidDescription& description) override;
    Pose pose(RigidId id) const override;
    Motion motion(RigidId id) const override;
    void set_pose(RigidId id, const Pose& pose) override;
    void set_motion(RigidId id, const Motion& motion) override;
    void shift(Vec3 by) override;
    void set_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia, std::span<const ConvexPiece> pieces) override;
    bool change_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia, std::span<const uint32_t> gone,
                      std::span<const ConvexPiece> pieces) override;
    void reserve_shapes(uint32_t count) override;
    void make_shape(uint32_t shape, std::span<const Vec3> points) const override;
    void use_jobs(JobSystem& jobs) override;
    void detect(float dt) override;
    std::span<const RigidContact> contacts() const override { return contacts_; }
    bool foresee(RigidId id, float dt, uint32_t steps, ForeseenTouch& out) override;
    void hold(RigidId id) override;
    void release(RigidId id) override;
    bool is_held(RigidId id) const override;
    void carry(RigidId id, Vec3 by) override;
    void skip_contacts(RigidId a, RigidId b) override;
    void set_bounce(RigidId a, RigidId b, float restitution) override;
    void ignore_pair(RigidId a, RigidId b, float seconds) override;
    void name_siblings(std::span<const RigidId> ids) override;
    void part_siblings(RigidId a, RigidId b, std::span<const CrackTouch> touches) override;
    void set_soft(RigidId id, bool is_soft) override;
    bool knows_surfaces() const override { return true; }
    uint32_t near_bodies(Vec3 low, Vec3 high, std::span<RigidId> out) const override;
    bool nearest_surface(RigidId id, Vec3 point, float reach, RigidSurface& out, const Vec3* seen_from) const override;
    Vec3 to_side_of(RigidId id, Vec3 place) const override;
    bool is_ignored(RigidId a, RigidId b) const override;
    bool may_meet(RigidId a, RigidId b) const override;
    bool is_touched(RigidId id) const override { return is_known(id) && bodies_[id].is_touched; }
    bool is_held_up(RigidId id) const override { return is_known(id) && bodies_[id].is_held_up; }
    void solve(float dt) override;
    std::span<const RigidContact> loads() const override { return loads_; }
    bool first_touch(Vec3 from, Vec3 to, float seconds, float radius, float least_reach,
                     RigidTouch& out) const override;
    bool is_asleep(RigidId id) const override;
    void wake(RigidId id) override;
    RigidCounts counts() const override;
    Vec3d impulse_to_static() const override { return to_static_; }
    RigidWork work() const override { return work_done_; }
    std::optional<RigidKind> kind(RigidId id) const override;
    std::unique_ptr<RigidWorld> make_another(uint32_t body_limit) const override;
    void save(ByteWriter& out) const override;
    Result<void> load(ByteReader& in) override;

    /// True when the two are not swept against each other: ignored, or both dynamic and skipped in this step. What
    /// does not move stops what is skipped all the same: a piece that broke off on the floor would else fly through it
    /// for a whole step.
    bool is_apart_by_order(RigidId a, RigidId b) const;
    /// True when the contacts of the two are left out in this step.
    bool is_skipped(RigidId a, RigidId b) const;
    /// What was born in each other in this step, a < b.
    std::span<const NewbornPieces> newborn_of(RigidId a, RigidId b) const;

    /// How a body got behind a sheet.
    struct PutThrough {
        float depth = 0;  // m that it is to go back along the normal; 0: it did not
        Vec3 normal, place;
        RigidId mesh = kNoRigid;
    };

 private:
    friend class Sweeper;
    friend class Flight;
    struct SortedManifold {
        RigidId a, b;
        uint32_t cell_a, cell_b;
        btPersistentManifold* manifold;
        bool is_at_crack;   // of siblings that are not apart yet
        float grip;         // N s, see PairAlgorithm::grip()
        bool is_born_deep;  // see PairAlgorithm::is_born_deep()
    };

    struct Scattered {
        bool is_standing;  // one of the two is not free
        float grip;        // N s, at each of its contacts
        uint64_t number;
        uint32_t first, end;  // of manifolds_
    };
    bool is_known(RigidId id) const { return id < body_limit_ && bodies_[id].is_used; }
    void set_pieces(Body& body, std::span<const ConvexPiece> pieces, float margin, const BodyFrame& old_frame);
    Hull* make_hull(const ConvexPiece& piece, const BodyFrame& frame, float margin);
    void change_pieces(Body& body, std::span<const uint32_t> gone, std::span<const ConvexPiece> pieces);
    void put_off_seams(Body& body);
    void mark_all_seams();
    void mark_listed_seams();
    void bound_pieces(Body& body);
    void seat_hulls(Body& body);
    void reseat(Body& body, const Pose& at);
    void rouse(Body& body, const Motion& moving);
    void update_leaf(Body& body);
    const Hull* find_same(const ConvexPiece& piece, const Hull* old_hulls, RigidId own, const Hull*& cursor) const;
    void drop_pieces(Body& body);
    Hull* take_shape(const ConvexPiece& piece, const BodyFrame& frame, float margin);
    void measure_body(Body& body);
    void set_mass(Body& body, double mass, Vec3d centre, const Sym3d& inertia);
    void enter(Body& body, const Pose& pose, uint32_t layer, uint32_t mask);
    void make_bullet(Body& body, const btTransform& at);
    bool load_body(ByteReader& in, Body& body);
    void load_pair(ByteReader& in, RigidId a, RigidId b);
    bool refresh_points(Body& body);
    void refresh(Body& body);
    void gather_box(Body& body);
    void enter_tree(Body& body);
    void enter_leaf(Body& body);
    void leave_leaf(Body& body);
    static bool may_touch(const Body& a, const Body& b);
    void find_pairs();
    void refresh_all();
    void meet_all();
    void meet(const Pair& pair, PairScratch& scratch);
    void list_manifolds();
    void solve_contacts(float dt);
    void gather_contacts();
    void gather_loads(float dt);
    void look_at_newborn(const Body& a, const Body& b, std::span<const CrackTouch> touches, bool is_turned);
    void wake_touching(RigidId id);
    void take_out(RigidId id);
    void wake_body(Body& body);
    std::vector<IgnoredPair>::iterator find_ignored(RigidId a, RigidId b);
    void set_velocities(Body& body, const btVector3& linear, const btVector3& angular);
    void sum_impulse_to_static();
    void sum_driven_work();
    double height_energy() const;
    double falling_power() const;
    void limit_closing(float dt);
    void take_back_gravity(float dt);
    void carry(const Body& body, btTransform& moved, float dt);
    void integrate(float dt);
    /// Calls call(mesh body) for static triangles near the box that the body meets.
    template <class Call>
    void visit_meshes(const Body& body, const Box& box, Call call) const {
        firm_tree_.visit(box, [&](uint32_t id) {
            const Body& other = bodies_[id];
            if (other.mesh && body.meets_layer_of(other) && !is_ignored(body.id, id)) call(other);
        });
    }
    PutThrough find_put_through(const Body& body) const;
    PutThrough find_born_through(const Body& body) const;
    bool first_touch_of(bool of_static, Vec3 from, Vec3 to, float seconds, float radius, float least_reach,
                        RigidTouch& out) const;
    bool find_cut_of(const Body& body, Vec3 from, Vec3 over, Vec3 to, Cut& cut) const;
    uint32_t find_middle_piece(const Body& body, Vec3 centre) const;
    bool may_be_cut(const Body& body, Vec3 centre) const;
    void move_by(Body& body, Vec3 way);
    void stop_at_sheet(Body& body, const PutThrough& put);
    void bring_back(Body& body);
    void bring_all_back();
    void list_inner_points(const Body& body);
    void settle_born(Body& body);
    void settle_laid(Body& body);
    void lift_new(Body& body, const PutThrough& put);
    void update_sleep(float dt);
    bool may_sleep(Body& body, float dt, const Pace& pace);
    bool may_come_to_rest(const Body& body, float dt, const Pace& pace) const;
    void still_settling();
    bool has_settled(Body& body, float dt);
    void fall_asleep(Body& body);
    void stop_mass(Body& body);
    void restore_mass(Body& body);
    void wake_struck();
    bool is_struck(const Body& sleeper, const Body& other, const btPersistentManifold& manifold,
                   const Pace& pace) const;
    void wake_unsettled(float dt, const Pace& pace);
    void wake_beside(Body& body);
    void sum_loads();
    Vec3 velocity_at(const Body& body, Vec3 point) const;

    uint32_t body_limit_, body_end_ = 0;  // no used id is at or above body_end_
    std::unique_ptr<Body[]> bodies_;
    Pool<Hull> hulls_;
    std::vector<Hull*> shapes_;  // made ahead, in the caller's axes; null once a body has it
    mutable std::atomic<uint64_t> shape_allocations_ = 0;
    PairWork work_;
    Scratches scratches_;
    btVector3 gravity_{0, 0, 0};
    BoxTree tree_;
    BoxTree firm_tree_;                 // of these bodies alone: all that moves asks for them in each step
    std::vector<RigidId> strayed_;      // left their leaf since pairs were looked for last
    std::vector<uint8_t> has_strayed_;  // by id, while pairs are looked for
    PairList pairs_;
    ContactSolver solver_;
    std::vector<Seam> seams_;
    std::vector<RigidId> lacking_seams_;  // bodies whose new pieces have none yet
    std::vector<Ball> lost_;              // pieces that the body at hand has lost, its hull frame
    std::vector<Vec3> inner_points_;      // of the pieces of what a body at hand comes from
    float inner_reach_ = 0;               // m, of the largest of these
    BodyWays ways_;                       // of what is put down
    uint32_t mesh_count_ = 0;             // bodies with static triangles
    std::vector<RigidContact> contacts_;
    std::vector<RigidContact> loads_;                   // of the last solve
    std::vector<RigidId> in_the_way_;                   // of the flight that is foreseen
    std::vector<SortedManifold> manifolds_;             // in rising (a, b) and pieces of a and b
    std::vector<Scattered> scattered_;                  // pairs to solve, in the order of solving
    std::vector<IgnoredPair> ignored_;                  // sorted by (a, b)
    std::vector<NewbornPieces> newborn_;                // of siblings, until the next detect()
    std::vector<std::pair<RigidId, RigidId>> skipped_;  // this step's, a < b
    Sweeper sweeper_;
    uint32_t births_ = 0;  // that siblings were named of, round and round
    RigidCounts counts_;
    Vec3d to_static_;
    RigidWork work_done_;     // in Checked and Debug builds
    float farthest_way_ = 0;  // m, that a point of a body went in the last step, at most
};

}  // namespace cullet::bullet
