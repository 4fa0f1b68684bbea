#include "systems/api/recorder.hpp"

#include <filesystem>

#include "cullet/version.hpp"
#include "engine/checksum.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/model_hash.hpp"
#include "systems/cook/model_file.hpp"
#include "systems/settings/bytes.hpp"

namespace cullet {

std::string build_sentence() {
    std::string sentence = std::string("cullet ") + version() + ", ";
#ifdef __clang__
    sentence += "clang ";
#else
    sentence += "g++ ";
#endif
    return sentence + __VERSION__;
}

Result<void> Recorder::begin(std::span<const uint8_t> world) {
    ByteWriter begin;
    begin.text(build_sentence());
    if (world.size() > kMostChunkBytes - begin.bytes.size())
        return Error{"the world takes " + std::to_string(begin.bytes.size() + world.size()) +
                     " bytes, and a recording begins with at most " + std::to_string(kMostChunkBytes) +
                     ". Remove bodies and models, or begin to record before they are added."};
    answers_.reserve(4096);
    calls_.bytes.reserve(1 << 16);
    step_.bytes.reserve(1 << 14);
    begin.put(world.data(), world.size());
    file_.append(ChunkKind::Begin, begin.bytes);
    return {};
}

ByteWriter& Recorder::call(GameCall call) {
    calls_.number(static_cast<uint8_t>(call));
    return calls_;
}

namespace {

auto into(ByteWriter& out) {
    return [&out](const auto& number) { out.number(number); };
}

}  // namespace

void Recorder::set_gravity(Vec3 gravity) {
    for_each_number_of_vector(gravity, into(call(GameCall::SetGravity)));
}

void Recorder::add_model(const Model& model) {
    ByteWriter& out = call(GameCall::AddModel);
    out.number(static_cast<uint8_t>(model.contents != nullptr));
    if (!model.contents) return;
    const std::vector<uint8_t> bytes = encode_model_file(*model.contents);
    const Checksum hash = checksum_of(bytes);
    out.number(hash.low), out.number(hash.high);
    const std::filesystem::path path = std::filesystem::path(models_) / model_file_name(hash);
    std::error_code error;
    std::filesystem::create_directories(models_, error);
    if (std::filesystem::exists(path, error)) return;
    if (const Result<void> written = write_whole_file(bytes, path.string()); !written) trouble_ = written.error();
}

void Recorder::remove_model(ModelId id) {
    for_each_number_of_id(id, into(call(GameCall::RemoveModel)));
}

void Recorder::spawn(ModelId id, const SpawnSettings& s) {
    ByteWriter& out = call(GameCall::Spawn);
    for_each_number_of_id(id, into(out));
    for_each_number_of_pose(s.pose, into(out));
    for_each_number_of_motion(s.motion, into(out));
    for_each_number_of_contact(s.contact, into(out));
    out.number(s.user_data);
    out.number(static_cast<uint8_t>(s.is_breakable));
    out.number(s.strength_scale);
    out.number(s.strength_seed);
    out.number(s.pins || s.pin_count == 0 ? s.pin_count : 0xffffffffu);
    for (uint32_t i = 0; s.pins && i < s.pin_count; ++i) {
        for_each_number_of_vector(s.pins[i].low, into(out));
        for_each_number_of_vector(s.pins[i].high, into(out));
    }
    for (const DamageModel& model : *damage_models_) put_settings(out, model.spawn_settings(), s);
}

void Recorder::add_sphere(const SphereSettings& s) {
    ByteWriter& out = call(GameCall::AddSphere);
    for_each_number_of_pose(s.pose, into(out));
    for_each_number_of_motion(s.motion, into(out));
    out.number(s.radius), out.number(s.mass);
    for_each_number_of_contact(s.contact, into(out));
    out.number(s.user_data);
}

void Recorder::add_kinematic_box(const KinematicSettings& s) {
    ByteWriter& out = call(GameCall::AddKinematicBox);
    for_each_number_of_pose(s.pose, into(out));
    for_each_number_of_motion(s.motion, into(out));
    for_each_number_of_vector(s.half_extents, into(out));
    for_each_number_of_contact(s.contact, into(out));
    out.number(s.user_data);
}

// Places and corners are all that static triangles have.
void Recorder::add_static(const MeshView& mesh, const ContactSettings& contact, uint64_t user_data, bool one_sided) {
    ByteWriter& out = call(GameCall::AddStatic);
    const bool is_there = mesh.positions && mesh.indices;
    const size_t points = is_there ? mesh.position_count : 0, triangles = is_there ? mesh.triangle_count : 0;
    if (points > kMostMeshRows || triangles > kMostMeshRows) trouble_ = "static mesh: too large to be recorded.";
    out.number(static_cast<uint32_t>(points)), out.number(static_cast<uint32_t>(triangles));
    for (size_t v = 0; v < points; ++v) for_each_number_of_vector(mesh.positions[v], into(out));
    out.put(mesh.indices, triangles * 3 * sizeof(uint32_t));
    for_each_number_of_contact(contact, into(out));
    out.number(user_data);
    out.number(uint8_t{one_sided});
}

void Recorder::remove(BodyId id) {
    for_each_number_of_id(id, into(call(GameCall::Remove)));
}

void Recorder::set_pose(BodyId id, const Pose& pose) {
    ByteWriter& out = call(GameCall::SetPose);
    for_each_number_of_id(id, into(out));
    for_each_number_of_pose(pose, into(out));
}

void Recorder::set_motion(BodyId id, const Motion& motion) {
    ByteWriter& out = call(GameCall::SetMotion);
    for_each_number_of_id(id, into(out));
    for_each_number_of_motion(motion, into(out));
}

void Recorder::wake(BodyId id) {
    for_each_number_of_id(id, into(call(GameCall::Wake)));
}

void Recorder::snapshot() {
    call(GameCall::Snapshot);
}

void Recorder::restore(std::span<const uint8_t> bytes) {
    ByteWriter& out = call(GameCall::Restore);
    out.number(static_cast<uint64_t>(bytes.size()));
    out.put(bytes.data(), bytes.size());
}

void Recorder::shift_origin(Vec3 by) {
    for_each_number_of_vector(by, into(call(GameCall::ShiftOrigin)));
}

void Recorder::frame(const HostFrame& frame) {
    ByteWriter& out = call(GameCall::Frame);
    out.number(frame.body_count), out.number(frame.contact_count);
    for (uint32_t i = 0; i < frame.body_count; ++i) {
        const HostBody& b = frame.bodies[i];
        for_each_number_of_id(b.body, into(out));
        for_each_number_of_pose(b.pose, into(out));
        for_each_number_of_motion(b.motion, into(out));
        out.number(static_cast<uint8_t>(b.is_asleep));
    }
    for (uint32_t i = 0; i < frame.contact_count; ++i) {
        const HostContact& c = frame.contacts[i];
        for_each_number_of_id(c.a, into(out));
        for_each_number_of_id(c.b, into(out));
        for_each_number_of_vector(c.point, into(out));
        for_each_number_of_vector(c.normal, into(out));
        out.number(c.distance), out.number(c.piece_a), out.number(c.piece_b), out.number(c.impulse);
    }
}

void Recorder::push_impact(BodyId id, const PushSettings& push) {
    ByteWriter& out = call(GameCall::PushImpact);
    for_each_number_of_id(id, into(out));
    for_each_number_of_push(push, into(out));
}

void Recorder::explode(const ExplosionSettings& explosion) {
    for_each_number_of_explosion(explosion, into(call(GameCall::Explode)));
}

void Recorder::cut(BodyId id, const CutSettings& cut) {
    ByteWriter& out = call(GameCall::Cut);
    for_each_number_of_id(id, into(out));
    for_each_number_of_cut(cut, into(out));
    for (uint32_t i = 0; i < cut.point_count; ++i) for_each_number_of_vector(cut.points[i], into(out));
}

void Recorder::retire(const RetireSettings& settings) {
    ByteWriter& out = call(GameCall::Retire);
    out.number(static_cast<uint8_t>(settings.how)), out.number(static_cast<uint8_t>(settings.only_asleep));
    for_each_number_of_retirement(settings, into(out));
}

void Recorder::begin_step() {
    if (calls_.bytes.size() > kMostChunkBytes) trouble_ = "the calls before one step are too many to be recorded.";
    if (is_sound()) file_.append(ChunkKind::Calls, calls_.bytes);
    calls_.bytes.clear();
    answers_.clear();
}

void Recorder::answer(bool allows) {
    answers_.push_back(allows);
}

// Digests of the columns that changed, so that a replay that differs can name the column: a number of the column and
// four bytes of its hash.
void Recorder::end_step(uint64_t frame, const State& state) {
    step_.bytes.clear();
    step_.number(frame);
    step_.number(state.hash());
    step_.number(static_cast<uint32_t>(answers_.size()));
    step_.put(answers_.data(), answers_.size());
    state.digest_columns(digests_);
    digests_before_.resize(digests_.size());
    uint32_t changed = 0;
    for (size_t k = 0; k < digests_.size(); ++k) changed += digests_[k] != digests_before_[k];
    step_.number(changed);
    for (size_t k = 0; k < digests_.size(); ++k)
        if (digests_[k] != digests_before_[k]) step_.number(static_cast<uint16_t>(k)), step_.number(digests_[k]);
    digests_before_ = digests_;
    if (is_sound()) file_.append(ChunkKind::Step, step_.bytes);
    if (trouble_.empty() && !file_.is_sound())
        trouble_ = "the recording cannot be written on and ends here; make room on the disk and begin another.";
}

const char* Recorder::untold_trouble() {
    if (trouble_.empty() || is_told_) return nullptr;
    is_told_ = true;
    return trouble_.c_str();
}

}  // namespace cullet
