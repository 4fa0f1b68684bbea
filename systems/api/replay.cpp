#include "systems/api/replay.hpp"

#include <filesystem>

#include "engine/mesh_file.hpp"
#include "systems/api/model_hash.hpp"
#include "systems/api/recorder.hpp"
#include "systems/api/settings_bytes.hpp"
#include "systems/api/snapshot.hpp"
#include "systems/api/with_models.hpp"
#include "systems/cook/model_file.hpp"
#include "systems/settings/bytes.hpp"

namespace cullet {
namespace {

constexpr const char* kAdvice = "The recording is damaged or of another build; record it again.";

auto from(ByteReader& in) {
    return [&in](auto& number) { number = in.number<std::remove_reference_t<decltype(number)>>("a call"); };
}
template <class Id>
Id take_id(ByteReader& in) {
    Id id;
    for_each_number_of_id(id, from(in));
    return id;
}
Vec3 take_vector(ByteReader& in) {
    Vec3 v;
    for_each_number_of_vector(v, from(in));
    return v;
}

}  // namespace

Replayer::Replayer(const Source& source, uint32_t threads, const Host& host)
    : source_(source), file_(source.bytes, source.name), host_(host), threads_(threads) {}
Replayer::~Replayer() = default;

Result<void> Replayer::begin() {
    if (Result<void> sound = file_.begin(); !sound) return sound;
    Chunk chunk;
    if (!file_.next(chunk) || chunk.kind != ChunkKind::Begin)
        return Error{!file_.damage().empty() ? file_.damage()
                                             : source_.name + ": does not begin with a world. " + kAdvice};
    ByteReader in(chunk.bytes, source_.name, kAdvice, chunk.first_byte);
    recorded_with_ = in.text("the build that recorded");
    is_hosted_ = in.number<uint8_t>("who moves the bodies") != 0;
    const bool has_snapshot = in.number<uint8_t>("how it begins") != 0;
    Settings settings = take_settings(in);
    settings.threads = threads_;
    const Result<void> knows = take_damage_models(in, *source_.damage_models, source_.name);
    if (!knows) return Error{knows.error()};
    const auto create = is_hosted_ ? &create_hosted_with : source_.create;
    Result<World> made = create(source_.damage_models, settings, host_);
    if (!made) return Error{source_.name + ": " + made.error()};
    world_.emplace(std::move(*made));
    if (has_snapshot) {
        const size_t size = in.left();
        const auto bytes = in.take(size, "a snapshot");
        if (Result<void> restored = world_->restore(bytes.data(), size, source_.name.c_str()); !restored)
            return restored;
    }
    world_->set_veto(
        [](void* self, [[maybe_unused]] const ImpactEvent& impact) {
            auto& replayer = *static_cast<Replayer*>(self);
            const auto& answers = replayer.recorded_.answers;
            return replayer.next_answer_ >= answers.size() || answers[replayer.next_answer_++] != 0;
        },
        this);
    return {};
}

bool Replayer::is_next(ChunkKind kind, Chunk& chunk) {
    if (!file_.next(chunk)) {
        damage_ = file_.damage();
        return false;
    }
    if (chunk.kind != kind)
        damage_ =
            source_.name + ": a chunk at byte " + std::to_string(chunk.first_byte) + " stands out of order. " + kAdvice;
    return chunk.kind == kind;
}

bool Replayer::step() {
    Chunk calls, step;
    if (!damage_.empty() || !is_next(ChunkKind::Calls, calls)) return false;
    const bool is_whole = is_next(ChunkKind::Step, step);
    std::string damage = std::move(damage_);  // told once the calls are done
    damage_.clear();
    if (is_whole)
        read_step(step);
    else
        recorded_.answers.clear();
    if (!is_whole && damage.empty())
        damage =
            source_.name + ": the step at byte " + std::to_string(calls.first_byte) +
            " has no result: the run ended in it. What stands before it was replayed; look there for what ended it.";
    next_answer_ = 0;
    is_stepped_ = false;
    if (damage_.empty()) do_calls(calls);
    if (!damage_.empty()) return false;
    if (!is_stepped_) world_->step();
    damage_ = std::move(damage);
    return is_whole;
}

void Replayer::read_step(const Chunk& chunk) {
    ByteReader in(chunk.bytes, source_.name, kAdvice, chunk.first_byte);
    recorded_.frame = in.number<uint64_t>("the number of a step");
    recorded_.hash = in.number<uint64_t>("the hash of a step");
    const auto answers = in.take(in.count("the number of answers", 1, 1u << 20), "answers");
    recorded_.answers.assign(answers.begin(), answers.end());
    const uint32_t changed = in.count("the number of changed columns", 6, 1u << 16);
    for (uint32_t k = 0; k < changed && in.is_sound(); ++k) {
        const auto column = in.number<uint16_t>("a column");
        if (recorded_.digests.size() <= column) recorded_.digests.resize(column + 1u);
        recorded_.digests[column] = in.number<uint32_t>("a column's digest");
    }
    in.expect(in.is_at_end(), "a step ends before its chunk does,");
    damage_ = in.trouble();
}

void Replayer::do_calls(const Chunk& chunk) {
    ByteReader in(chunk.bytes, source_.name, kAdvice, chunk.first_byte);
    while (in.is_sound() && !in.is_at_end()) do_call(in);
    damage_ = in.trouble();
}

// Refusals are part of the run: the recorded world refused too.
void Replayer::do_call(ByteReader& in) {
    World& world = *world_;
    const auto call = static_cast<GameCall>(in.number<uint8_t>("a call"));
    switch (call) {
        case GameCall::SetGravity: {
            const Vec3 gravity = take_vector(in);
            if (in.is_sound()) (void)world.set_gravity(gravity);
            return;
        }
        case GameCall::AddModel:
            return add_model(in);
        case GameCall::RemoveModel: {
            const auto id = take_id<ModelId>(in);
            if (in.is_sound()) (void)world.remove_model(id);
            return;
        }
        case GameCall::Spawn:
            return spawn(in);
        case GameCall::AddSphere: {
            SphereSettings s;
            for_each_number_of_pose(s.pose, from(in));
            for_each_number_of_motion(s.motion, from(in));
            from(in)(s.radius), from(in)(s.mass);
            for_each_number_of_contact(s.contact, from(in));
            from(in)(s.user_data);
            if (in.is_sound()) (void)world.add_sphere(s);
            return;
        }
        case GameCall::AddKinematicBox: {
            KinematicSettings s;
            for_each_number_of_pose(s.pose, from(in));
            for_each_number_of_motion(s.motion, from(in));
            for_each_number_of_vector(s.half_extents, from(in));
            for_each_number_of_contact(s.contact, from(in));
            from(in)(s.user_data);
            if (in.is_sound()) (void)world.add_kinematic_box(s);
            return;
        }
        case GameCall::AddStatic:
            return add_static(in);
        case GameCall::Remove: {
            const auto id = take_id<BodyId>(in);
            if (in.is_sound()) (void)world.remove(id);
            return;
        }
        case GameCall::SetPose: {
            const auto id = take_id<BodyId>(in);
            Pose pose;
            for_each_number_of_pose(pose, from(in));
            if (in.is_sound()) (void)world.set_pose(id, pose);
            return;
        }
        case GameCall::SetMotion: {
            const auto id = take_id<BodyId>(in);
            Motion motion;
            for_each_number_of_motion(motion, from(in));
            if (in.is_sound()) (void)world.set_motion(id, motion);
            return;
        }
        case GameCall::Wake: {
            const auto id = take_id<BodyId>(in);
            if (in.is_sound()) (void)world.wake(id);
            return;
        }
        case GameCall::Snapshot:
            (void)world.snapshot();
            return;
        case GameCall::Restore: {
            const auto size = in.number<uint64_t>("a snapshot");
            const auto bytes = in.take(size, "a snapshot");
            if (!in.is_sound()) return;
            const Result<void> restored = world.restore(bytes.data(), bytes.size(), source_.name.c_str());
            in.expect(restored.ok(), "a snapshot that is refused (" + restored.error() + ")");
            return;
        }
        case GameCall::ShiftOrigin: {
            const Vec3 by = take_vector(in);
            if (in.is_sound()) (void)world.shift_origin(by);
            return;
        }
        case GameCall::Frame:
            return step_hosted(in);
        case GameCall::PushImpact: {
            const auto id = take_id<BodyId>(in);
            PushSettings push;
            for_each_number_of_push(push, from(in));
            if (in.is_sound()) (void)world.push_impact(id, push);
            return;
        }
        case GameCall::Explode: {
            ExplosionSettings explosion;
            for_each_number_of_explosion(explosion, from(in));
            if (in.is_sound()) (void)world.explode(explosion);
            return;
        }
        case GameCall::Cut:
            return cut(in);
        case GameCall::Retire: {
            RetireSettings s;
            s.how = static_cast<Retirement>(in.number<uint8_t>("what becomes of fragments"));
            s.only_asleep = in.number<uint8_t>("which fragments") != 0;
            for_each_number_of_retirement(s, from(in));
            if (in.is_sound()) (void)world.retire(s);
            return;
        }
    }
    in.fail("there is no call of the kind " + std::to_string(static_cast<int>(call)));
}

void Replayer::cut(ByteReader& in) {
    const auto id = take_id<BodyId>(in);
    CutSettings cut;
    for_each_number_of_cut(cut, from(in));
    if (!in.expect(uint64_t{cut.point_count} * 12 <= in.left(), "more points of a cut than bytes")) return;
    std::vector<Vec3> points(cut.point_count);
    for (Vec3& p : points) p = take_vector(in);
    cut.points = points.data();
    if (in.is_sound()) (void)world_->cut(id, cut);
}

void Replayer::add_model(ByteReader& in) {
    const bool is_empty = in.number<uint8_t>("a model") == 0;
    Checksum hash;
    if (!is_empty) from(in)(hash.low), from(in)(hash.high);
    if (!in.is_sound() || is_empty) return;
    const std::string path = (std::filesystem::path(source_.models) / model_file_name(hash)).string();
    const Result<std::vector<uint8_t>> bytes = read_whole_file(path, uint64_t{1} << 34);
    if (!in.expect(bytes.ok(), "a model that is not there (" + bytes.error() + ")")) return;
    if (!in.expect(checksum_of(*bytes) == hash, "a model whose file " + path + " holds other bytes")) return;
    const Result<Model> model = parse_model_file(*bytes, path, *source_.damage_models);
    if (in.expect(model.ok(), "a model that cannot be read (" + model.error() + ")")) (void)world_->add_model(*model);
}

void Replayer::add_static(ByteReader& in) {
    const uint32_t points = in.count("the number of points", 12, 1u << 28);
    const uint32_t triangles = in.number<uint32_t>("the number of triangles");
    std::vector<Vec3> positions(points);
    for (Vec3& p : positions) p = take_vector(in);
    const auto bytes = in.take(uint64_t{triangles} * 12, "triangles");
    std::vector<uint32_t> indices(bytes.size() / 4);
    if (!indices.empty()) std::memcpy(indices.data(), bytes.data(), bytes.size());
    ContactSettings contact;
    for_each_number_of_contact(contact, from(in));
    uint64_t user_data = 0;
    from(in)(user_data);
    const auto one_sided = in.number<uint8_t>("whether triangles bear from one side");
    in.expect(one_sided <= 1, "triangles that bear from " + std::to_string(one_sided) + " sides but one");
    if (!in.is_sound()) return;
    const MeshView view{positions.data(), positions.size(), indices.data(), triangles};
    (void)world_->add_static(view, contact, user_data, one_sided != 0);
}

void Replayer::spawn(ByteReader& in) {
    const auto id = take_id<ModelId>(in);
    SpawnSettings s;
    for_each_number_of_pose(s.pose, from(in));
    for_each_number_of_motion(s.motion, from(in));
    for_each_number_of_contact(s.contact, from(in));
    from(in)(s.user_data);
    s.is_breakable = in.number<uint8_t>("whether it breaks") != 0;
    from(in)(s.strength_scale), from(in)(s.strength_seed);
    s.pin_count = in.number<uint32_t>("the number of pins");
    std::vector<Box> pins;
    if (s.pin_count != 0xffffffffu) {
        if (!in.expect(uint64_t{s.pin_count} * 24 <= in.left(), "more pins than bytes")) return;
        pins.resize(s.pin_count);
        for (Box& box : pins) box.low = take_vector(in), box.high = take_vector(in);
        s.pins = pins.data();
    }
    for (const DamageModel& model : *source_.damage_models) take_settings(in, model.spawn_settings(), s);
    if (in.is_sound()) (void)world_->spawn(id, s);
}

void Replayer::step_hosted(ByteReader& in) {
    const uint32_t bodies = in.count("the number of bodies", 61, 1u << 24), contacts = in.number<uint32_t>("contacts");
    std::vector<HostBody> rows(bodies);
    for (HostBody& b : rows) {
        for_each_number_of_id(b.body, from(in));
        for_each_number_of_pose(b.pose, from(in));
        for_each_number_of_motion(b.motion, from(in));
        b.is_asleep = in.number<uint8_t>("a sleep") != 0;
    }
    if (!in.expect(uint64_t{contacts} * 56 <= in.left(), "more contacts than bytes")) return;
    std::vector<HostContact> touches(contacts);
    for (HostContact& c : touches) {
        for_each_number_of_id(c.a, from(in));
        for_each_number_of_id(c.b, from(in));
        for_each_number_of_vector(c.point, from(in));
        for_each_number_of_vector(c.normal, from(in));
        from(in)(c.distance), from(in)(c.piece_a), from(in)(c.piece_b), from(in)(c.impulse);
    }
    if (!in.is_sound()) return;
    (void)world_->step(HostFrame{rows.data(), bodies, touches.data(), contacts});
    is_stepped_ = true;
}

}  // namespace cullet
