// How a damage task is opened on a body: what contacts, queued hits, blows and foreseen touches share.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// How a body yields to pushes along the unit normal at a world point.
struct Yielding {
    double own = 0;  // 1/m, 1/kg
    Vec3d turn;      // r x n about its centre, its axes, m
    Vec3d spin;      // I^-1 (r x n), its axes, 1/(kg m)
    float effective() const { return static_cast<float>(own + dot(turn, spin)); }
};
/// What pushes a ball without friction points at its centre. Static and kinematic bodies, and bodies held by another
/// task, do not yield.
Yielding yielding_of(const Bodies& bodies, Row<Bodies> striker, Vec3 point, Vec3 normal);

/// A blow as the task will have it: a ball's goes along the struck surface's normal, unless it does not close along
/// that.
Impact aimed(WorldRows& state, Impact impact);

ImpactEvent event_of(const Bodies& bodies, const Impact& impact, double inverse_mass);

/// Contacts of one body, fastest first: those within a patch radius of one already taken belong to its patch (6.3).
/// `first_aimed` is the first of them as aimed() has it.
void lay_contacts(std::span<const Impact> impacts, const Impact& first_aimed, WorldRows& state, Row<Tasks> task);

/// A row of QueuedHits.
struct QueuedHit {
    uint64_t frame;
    Row<Bodies> body, striker;
    Vec3 point, normal;  // body frame and axes
    float approach_speed, striker_inverse_mass, striker_radius;
    float load =
        0;  // N, see Tasks; with no speed: it comes apart across `normal` at `point`, see StructureCalls::part_by_load
};

struct Opening {
    WorldRows& state;
    QueuedHits& queued;
    Blows& blows;
    Events<TaskOpened>& opened;
    Events<RefusedEvent>& refused;
    const DamageModels& models;
    DamageCounts& counts;
    uint64_t frame;
    float dt;

    /// A task with a working copy of the body's shell and no contacts yet; it does not exist where there is no room. A
    /// cut-out waits for the contacts. Whoever opens ahead of a touch tells nobody that there was none.
    Row<Tasks> open(Row<Bodies> body, float approach_speed, bool is_ahead = false);

    /// The blow that an impact is, at `at` frame, for damage models.
    bool leaves_nothing(const Impact& impact, uint64_t at, float& bounce) const;

    /// Rows for the tasks that waited for their contacts. One that finds none is dropped; its hits ask again.
    void give_rows();

 private:
    void refuse(Row<Bodies> body, const char* setting, bool is_ahead);
    void drop(Row<Tasks> task, const char* full);
};

/// What stands in the queue without speed, for a load: it cuts its body.
inline bool is_snap(float load, float approach_speed) {
    return load > 0 && !(approach_speed > 0);
}
/// A hit waits in the queue for its body. At most one a striker: the faster, or one that snaps it. False: there is no
/// room in it.
bool queue_hit(QueuedHits& queued, const QueuedHit& hit);
/// One of them stands for a load.
bool has_waiting_load(const QueuedHits& queued, Row<Bodies> body);

}  // namespace cullet
