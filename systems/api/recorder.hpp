// Writes down what a game asks of a world. Calls are written as they were made, refused ones too: a world that is asked
// the same refuses the same.
#pragma once
#include <memory>
#include <string>

#include "components/state.hpp"
#include "cullet/world.hpp"
#include "systems/api/recording_file.hpp"
#include "systems/models.hpp"

namespace cullet {

enum class GameCall : uint8_t {
    SetGravity = 1,
    AddModel,
    RemoveModel,
    Spawn,
    AddSphere,
    AddKinematicBox,
    AddStatic,
    Remove,
    SetPose,
    SetMotion,
    Wake,
    Snapshot,
    Restore,
    ShiftOrigin,
    Frame,  // of a host that moves the bodies: belongs to the step
    PushImpact,
    Explode,
    Cut,
    Retire,
};

class Recorder {
 public:
    /// `models`: a folder.
    Recorder(std::FILE* file, std::string models, ModelList damage_models)
        : file_(file), models_(std::move(models)), damage_models_(std::move(damage_models)) {}

    /// Refuses a world whose bytes are more than a chunk's.
    Result<void> begin(std::span<const uint8_t> world);
    void set_gravity(Vec3 gravity);
    void add_model(const Model& model);
    void remove_model(ModelId id);
    void spawn(ModelId id, const SpawnSettings& settings);
    void add_sphere(const SphereSettings& settings);
    void add_kinematic_box(const KinematicSettings& settings);
    void add_static(const MeshView& mesh, const ContactSettings& contact, uint64_t user_data, bool one_sided);
    void remove(BodyId id);
    void set_pose(BodyId id, const Pose& pose);
    void set_motion(BodyId id, const Motion& motion);
    void wake(BodyId id);
    void snapshot();
    void restore(std::span<const uint8_t> bytes);
    void shift_origin(Vec3 by);
    void frame(const HostFrame& frame);
    void push_impact(BodyId id, const PushSettings& push);
    void explode(const ExplosionSettings& explosion);
    void cut(BodyId id, const CutSettings& cut);
    void retire(const RetireSettings& settings);

    /// What was asked for since the last step goes to the file, so that a step that never ends has its calls there.
    void begin_step();
    /// The game's answer to a veto. Allocates nothing for the first 4,096 of a step.
    void answer(bool allows);
    void end_step(uint64_t frame, const State& state);

    bool is_sound() const { return file_.is_sound() && trouble_.empty(); }
    /// Once: a sentence for the log.
    const char* untold_trouble();
    /// Why the recording ended before it was stopped, or empty.
    const std::string& trouble() const { return trouble_; }

 private:
    ByteWriter& call(GameCall call);

    RecordingWriter file_;
    std::string models_;
    ModelList damage_models_;
    ByteWriter calls_, step_;
    std::vector<uint8_t> answers_;
    std::vector<uint32_t> digests_, digests_before_;
    std::string trouble_;
    bool is_told_ = false;
};

/// Numbers of a call's structures in the order of the bytes, for both ways.
template <class V, class F>
void for_each_number_of_vector(V& v, F&& f) {
    f(v.x), f(v.y), f(v.z);
}
template <class P, class F>
void for_each_number_of_pose(P& p, F&& f) {
    for_each_number_of_vector(p.position, f);
    f(p.orientation.x), f(p.orientation.y), f(p.orientation.z), f(p.orientation.w);
}
template <class M, class F>
void for_each_number_of_motion(M& m, F&& f) {
    for_each_number_of_vector(m.velocity, f);
    for_each_number_of_vector(m.angular_velocity, f);
}
template <class C, class F>
void for_each_number_of_contact(C& c, F&& f) {
    f(c.friction), f(c.restitution), f(c.rolling_friction), f(c.layer), f(c.mask);
}
template <class Id, class F>
void for_each_number_of_id(Id& id, F&& f) {
    f(id.index), f(id.generation);
}

template <class P, class F>
void for_each_number_of_push(P& p, F&& f) {
    for_each_number_of_vector(p.place, f);
    for_each_number_of_vector(p.normal, f);
    f(p.approach_speed), f(p.mass), f(p.radius);
}
template <class E, class F>
void for_each_number_of_explosion(E& e, F&& f) {
    for_each_number_of_vector(e.centre, f);
    f(e.radius), f(e.impulse), f(e.pressure), f(e.seconds);
}
/// Without the points.
template <class C, class F>
void for_each_number_of_cut(C& c, F&& f) {
    for_each_number_of_vector(c.place, f);
    for_each_number_of_vector(c.normal, f);
    for_each_number_of_vector(c.direction, f);
    f(c.point_count);
}

/// Without the way.
template <class R, class F>
void for_each_number_of_retirement(R& r, F&& f) {
    f(r.count), f(r.least_seconds);
}

/// "0.1.0, g++ 12.2.0, ..."
std::string build_sentence();

}  // namespace cullet
