// RigidWorld in plain rows, for hosts whose own engine moves the bodies: what the host found comes in before detect(),
// what the world wants of it is collected until finish().
#pragma once
#include <vector>

#include "cullet/result.hpp"
#include "cullet/rigid.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

/// Room for what one step may add; calls between steps make more.
struct HostRoom {
    uint32_t bodies = 0;
    uint32_t pieces = 0, points = 0;  // of all bodies that one step bears or reshapes
    uint32_t contacts() const { return 32 * bodies + 1024; }
};

class HostRigidWorld final : public RigidWorld {
 public:
    /// `generations` names, row by row, the body that a RigidId stands for now; it outlives this.
    HostRigidWorld(const HostRoom& room, const uint32_t* generations);

    /// The host's rows of this step; nothing is taken when one of them is beyond its bounds, or there are too
    /// many.
    Result<void> take(const HostFrame& frame);
    /// The end of a step: changes() are complete, and the next change begins new lists.
    void finish();
    HostChanges changes() const;

    void set_gravity(Vec3) override {}  // the host's own affair
    void add_static_triangles(RigidId id, std::span<const Vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles, float friction, float restitution,
                              uint32_t layer, uint32_t mask, bool one_sided) override;
    void add(RigidId id, const RigidDescription& description) override;
    void remove(RigidId id) override;
    Pose pose(RigidId id) const override;
    Motion motion(RigidId id) const override;
    void set_pose(RigidId id, const Pose& pose) override;
    void set_motion(RigidId id, const Motion& motion) override;
    /// The host shifts its own rows.
    void shift(Vec3 by) override;
    void set_shape(RigidId id, double mass, Vec3d centre, Sym3d inertia, std::span<const ConvexPiece> pieces) override;
    void reserve_shapes(uint32_t) override {}
    void make_shape(uint32_t, std::span<const Vec3>) const override {}
    /// Sorts the host's contacts as RigidWorld wants them and adds how fast they close.
    void detect(float dt) override;
    std::span<const RigidContact> contacts() const override { return contacts_; }
    void hold(RigidId id) override;
    void release(RigidId id) override;
    bool is_held(RigidId id) const override;
    void skip_contacts(RigidId a, RigidId b) override;
    void ignore_pair(RigidId a, RigidId b, float seconds) override { keep_apart(a, b, seconds, false); }
    void part_siblings(RigidId a, RigidId b, std::span<const CrackTouch> touches) override;
    void solve(float) override {}  // the host does
    float height_below(Vec3 point, float fallback) const override;
    bool is_asleep(RigidId id) const override;
    void wake(RigidId id) override;
    RigidCounts counts() const override;
    Vec3d impulse_to_static() const override { return {}; }  // the host's solver knows
    std::optional<RigidKind> kind(RigidId id) const override;
    std::unique_ptr<RigidWorld> make_another(uint32_t) const override { return nullptr; }
    void save(ByteWriter& out) const override;
    /// The next changes tell of all that moves, of pairs that are apart, and of what was removed and not told. Leaves
    /// out the pieces, which only births tell: announce() gives them.
    Result<void> load(ByteReader& in) override;
    /// After a load: the next changes name this body as born.
    void announce(RigidId id, std::span<const ConvexPiece> pieces);

 private:
    struct Row {
        bool is_used = false, is_asleep = false, is_held = false;
        RigidKind kind = RigidKind::Dynamic;
        Vec3 centre;  // body frame
        HostShape shape;
        uint32_t first_piece = 0;
        // What the host has not been told yet.
        bool is_born = false, is_reshaped = false, is_moved = false, is_woken = false, was_held = false;
    };
    struct Piece {
        uint32_t first_point, point_count, name;
    };
    struct Ignored {
        RigidId a, b;  // a < b
        float seconds;
        bool until_apart, is_near;
    };
    struct StaticTriangle {
        RigidId id;
        Vec3 corner[3];
    };

    bool is_known(RigidId id) const { return id < rows_.size() && rows_[id].is_used; }
    bool is_known(BodyId id) const { return is_known(id.index) && generations_[id.index] == id.generation; }
    bool is_free(RigidId id) const;
    bool is_driven_in(RigidId a, RigidId b) const;
    BodyId body_id(RigidId id) const { return {id, generations_[id]}; }
    void begin_lists();
    void tell_all();
    void take_pieces(Row& row, std::span<const ConvexPiece> pieces);
    void make_room();
    Vec3 velocity_at(RigidId id, Vec3 point) const;
    void keep_apart(RigidId a, RigidId b, float seconds, bool until_apart);
    Ignored* find_ignored(RigidId a, RigidId b);
    bool is_apart(const RigidContact& contact);

    HostRoom room_;
    const uint32_t* generations_;
    std::vector<Row> rows_;
    std::vector<StaticTriangle> triangles_;
    std::vector<RigidContact> contacts_;
    std::vector<Ignored> ignored_;
    // Lists of changes. Those of rows are made by finish(), in row order.
    bool is_told_ = false, is_in_step_ = false;
    std::vector<Vec3> points_;
    std::vector<Piece> pieces_;
    std::vector<HostPiece> told_pieces_;
    std::vector<BodyId> removed_, held_, woken_;
    std::vector<HostShape> born_, reshaped_;
    std::vector<HostMotion> released_, moved_;
    std::vector<HostPair> apart_;
};

}  // namespace cullet
