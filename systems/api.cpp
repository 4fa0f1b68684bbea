// The public face, made true: checks what the game gives, keeps rows and the rigid world in step. Everything here runs
// between steps, on the thread that owns the world.
#include <algorithm>
#include <cmath>

#include "cullet/version.hpp"
#include "engine/fp_mode.hpp"
#include "systems/cook/apply_pins.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/damage/damage_loop.hpp"
#include "systems/damage/working_room.hpp"
#include "systems/fragments/body_rows.hpp"
#include "systems/fragments/rigid_shape.hpp"
#include "systems/rigid/body_id.hpp"
#include "systems/view/draw_shell.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Farther and faster, floats of the rigid solver run over when squared.
constexpr float kFarthest = 1e6f, kFastest = 1e5f, kHeaviest = 1e12f;

bool is_within(Vec3 v, float most) {
    return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most;  // false for what is no number
}
std::string text(Vec3 v) {
    return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

Result<void> check_motion(const Motion& motion) {
    if (!is_within(motion.velocity, kFastest))
        return Error{"motion.velocity is " + text(motion.velocity) + "; give m/s, at most 100000 a component."};
    if (!is_within(motion.angular_velocity, kFastest))
        return Error{"motion.angular_velocity is " + text(motion.angular_velocity) +
                     "; give rad/s, at most 100000 a component."};
    return {};
}

Result<void> check_pose(const Pose& pose) {
    const Quat q = pose.orientation;
    const float norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (!is_within(pose.position, kFarthest))
        return Error{"pose.position is " + text(pose.position) +
                     "; give metres, at most 1000000 from the origin along each axis."};
    if (!(std::fabs(norm - 1) < 1e-3f))
        return Error{"pose.orientation has length " + std::to_string(std::sqrt(norm)) + "; give a unit quaternion."};
    return {};
}

Result<void> check_contact(const ContactSettings& contact) {
    if (!(contact.friction <= 100))
        return Error{"contact.friction is " + std::to_string(contact.friction) +
                     "; use 0 to 100, or less than 0 for the material's."};
    if (!(contact.restitution <= 1))
        return Error{"contact.restitution is " + std::to_string(contact.restitution) +
                     "; use 0 to 1, or less than 0 for 0.2."};
    return {};
}

// What every kind of body is asked.
Result<void> check_body(const Pose& pose, const Motion& motion, const ContactSettings& contact) {
    if (Result<void> valid = check_pose(pose); !valid) return valid;
    if (Result<void> valid = check_motion(motion); !valid) return valid;
    return check_contact(contact);
}

Error stale(const char* what, uint32_t index) {
    return Error{std::string(what) + " handle " + std::to_string(index) +
                 " names nothing that is alive; it was removed, or never was."};
}

Error no_room(const Bodies& bodies) {
    return Error{"limits.bodies is reached (" + std::to_string(bodies.limit()) + "); raise it or remove a body."};
}

Pose normalised_pose(const Pose& pose) {
    return {pose.position, normalised(pose.orientation)};
}

// What every kind of body has.
void fill_body(Bodies& bodies, Row<Bodies> b, BodyKind kind, const Pose& pose, const Motion& motion,
               const ContactSettings& contact, float friction, uint64_t user_data) {
    bodies.kind[b] = static_cast<uint8_t>(kind);
    const Pose unit = normalised_pose(pose);
    bodies.position.set(b, unit.position);
    bodies.orientation[b] = unit.orientation;
    bodies.previous_position.set(b, unit.position);
    bodies.previous_orientation[b] = unit.orientation;
    bodies.velocity.set(b, motion.velocity);
    bodies.spin.set(b, motion.angular_velocity);
    bodies.friction[b] = contact.friction >= 0 ? contact.friction : friction;
    bodies.restitution[b] = contact.restitution >= 0 ? contact.restitution : 0.2f;
    bodies.layer[b] = contact.layer;
    bodies.mask[b] = contact.mask;
    bodies.user_data[b] = user_data;
}

RigidDescription description_of(const Bodies& bodies, Row<Bodies> b, RigidKind kind) {
    RigidDescription d;
    d.kind = kind;
    d.pose = pose_of(bodies, b);
    d.motion = {bodies.velocity[b], bodies.spin[b]};
    d.mass = bodies.mass[b];
    d.centre = bodies.centre[b];
    d.inertia = bodies.inertia[b];
    d.friction = bodies.friction[b];
    d.restitution = bodies.restitution[b];
    d.layer = bodies.layer[b];
    d.mask = bodies.mask[b];
    return d;
}

constexpr uint64_t kMostUnits = 1'000'000'000'000'000;

Result<void> check_settings(const Settings& s) {
    if (!(s.step_seconds >= 1.0f / 1000 && s.step_seconds <= 1.0f / 20))
        return Error{"Settings::step_seconds is " + std::to_string(s.step_seconds) + "; use 0.001 to 0.05."};
    if (!is_within(s.gravity, 1e4f))
        return Error{"Settings::gravity is " + text(s.gravity) + "; give m/s2, at most 10000 a component."};
    if (s.units_a_frame < 1000 || s.units_a_frame > kMostUnits)
        return Error{"Settings::units_a_frame is " + std::to_string(s.units_a_frame) + "; use 1000 to 1e15."};
    if (s.generations > 100)
        return Error{"Settings::generations is " + std::to_string(s.generations) + "; use 0 to 100."};
    if (!(s.debris_share >= 0 && s.debris_share <= 1))
        return Error{"Settings::debris_share is " + std::to_string(s.debris_share) + "; use 0 to 1."};
    if (!(s.hold_seconds >= 0 && s.hold_seconds <= 1))
        return Error{"Settings::hold_seconds is " + std::to_string(s.hold_seconds) + "; use 0 to 1."};
    if (s.threads == 0 || s.threads > 256)
        return Error{"Settings::threads is " + std::to_string(s.threads) + "; use 1 to 256."};
    const LimitSettings& l = s.limits;
    const struct {
        const char* name;
        uint32_t value, least, most;
    } limits[] = {{"bodies", l.bodies, 1, 1u << 20},        {"models", l.models, 1, 1u << 20},
                  {"vertices", l.vertices, 4096, 1u << 26}, {"elements", l.elements, 4096, 1u << 26},
                  {"open_hits", l.open_hits, 1, 1024},      {"view_vertices", l.view_vertices, 4096, 1u << 28},
                  {"debris", l.debris, 1, 1u << 24},        {"queued_hits", l.queued_hits, 1, 1u << 16}};
    for (const auto& limit : limits)
        if (limit.value < limit.least || limit.value > limit.most)
            return Error{std::string("Settings::limits.") + limit.name + " is " + std::to_string(limit.value) +
                         "; use " + std::to_string(limit.least) + " to " + std::to_string(limit.most) + "."};
    return {};
}

}  // namespace

World::Contents::Contents(const Settings& s, const Host& h)
    : settings(s),
      host(h),
      jobs(h.jobs.parallel_for ? make_host_jobs(h.jobs) : make_jobs(JobBackend::Tbb, s.threads)),
      data(s) {
    fill_materials(data.state.materials);
    data.rigid = make_bullet_world(s.limits.bodies);
    data.rigid->set_gravity(s.gravity);
    data.damage_loop = std::make_unique<DamageLoop>(data.state, *jobs, profiler);
    plan = make_frame_plan([this] { return data.damage_loop->describe(); });
    plan.finish(profiler);
}
World::Contents::~Contents() = default;

World::World(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;
World::Contents& World::contents() {
    return *contents_;
}
const World::Contents& World::contents() const {
    return *contents_;
}

#define CULLET_TEXT_OF(number) #number
#define CULLET_TEXT(number) CULLET_TEXT_OF(number)
const char* version() {
    return CULLET_TEXT(CULLET_VERSION_MAJOR) "." CULLET_TEXT(CULLET_VERSION_MINOR) "." CULLET_TEXT(
        CULLET_VERSION_PATCH);
}
#undef CULLET_TEXT
#undef CULLET_TEXT_OF

Result<World> World::create(const Settings& settings, const Host& host) {
    if (const Result<void> valid = check_settings(settings); !valid) return Error{valid.error()};
    if ((host.allocator.allocate == nullptr) != (host.allocator.release == nullptr))
        return Error{"Host::allocator has one of allocate and release; give both or neither."};
    if ((host.jobs.parallel_for == nullptr) != (host.jobs.worker_count == nullptr))
        return Error{"Host::jobs has one of worker_count and parallel_for; give both or neither."};
    const FpMode mode;
    const MemoryScope scope(host.allocator);
    return World(std::make_unique<Contents>(settings, host));
}

void World::step() {
    Contents& c = *contents_;
    WorldData& d = c.data;
    const FpMode mode;
    if (c.host.assertion_failed)
        set_assert_handler(
            [](const char* sentence, void* host) {
                const auto* h = static_cast<const Host*>(host);
                h->assertion_failed(h->user, sentence);
            },
            &c.host);
    if (c.host.zone_begin) c.host.zone_begin(c.host.user, "cullet step");
    d.impact_events.clear();
    d.crack_events.clear();
    d.born_events.clear();
    d.debris_events.clear();
    d.refused_events.clear();
    d.fault_events.clear();
    d.asleep_events.clear();
    d.shells_changed.clear();
    d.arena.reset();
    c.profiler.begin_frame(d.step_info.frame);
    c.plan.step(d, *c.jobs, c.profiler, d.arena, c.after_each_system ? &c.after_each_system : nullptr);
    c.profiler.end_frame();
    if (d.counts.units_used == 0) d.state.commit_ahead(d.ready_for, 1);  // a quiet frame
    ++d.step_info.frame;
    if (c.host.zone_end) c.host.zone_end(c.host.user);
    if (c.host.assertion_failed) set_assert_handler(nullptr, nullptr);
}

StepReport World::report() const {
    const WorldData& d = contents_->data;
    StepReport report;
    report.frame = d.step_info.frame;
    report.units_used = d.counts.units_used;
    report.units_left = d.counts.units_left;
    const Tasks& tasks = d.state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        report.open_hits += static_cast<TaskState>(tasks.state[t]) != TaskState::Free;
        report.held_bodies += tasks.is_held[t] && static_cast<TaskState>(tasks.state[t]) != TaskState::Free;
    }
    const Bodies& bodies = d.state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        report.bodies += kind != BodyKind::Free;
        report.awake += kind == BodyKind::Dynamic && !bodies.is_asleep[b];
    }
    for (uint32_t i = 0; i < d.state.debris.size(); ++i) report.debris += d.state.debris.is_used[i];
    return report;
}

RigidReport World::rigid_report() const {
    const RigidCounts counts = contents_->data.rigid->counts();
    return {counts.pairs, counts.contacts, counts.sweeps};
}

StepEvents World::events() const {
    const WorldData& d = contents_->data;
    const auto span = [](const auto& queue) {
        using E = typename std::remove_cvref_t<decltype(queue)>::Value;
        return EventSpan<E>{queue.all().data(), queue.size()};
    };
    return {span(d.impact_events),  span(d.crack_events), span(d.born_events),  span(d.debris_events),
            span(d.refused_events), span(d.fault_events), span(d.asleep_events)};
}

uint64_t World::hash() const {
    return contents_->data.state.hash();
}

void World::set_gravity(Vec3 gravity) {
    if (!is_within(gravity, 1e4f)) return;
    const FpMode mode;
    contents_->data.step_info.gravity = gravity;
    contents_->data.rigid->set_gravity(gravity);
}

void World::set_veto(bool (*allows)(void* user, const ImpactEvent& impact), void* user) {
    contents_->data.damage_settings.allows = allows;
    contents_->data.damage_settings.allows_user = user;
}

// ---- models
// -----------------------------------------------------------------------------------------------------------

Result<ModelId> World::add_model(const Model& model) {
    if (!model.contents) return Error{"the model is empty; cook or read one first."};
    State& state = contents_->data.state;
    const FpMode mode;
    uint32_t row = 0;
    while (row < state.models.size() && state.models.is_used[row]) ++row;
    if (row == state.models.size() && state.models.append(1) == kNone)
        return Error{"limits.models is reached (" + std::to_string(state.models.limit()) +
                     "); raise it or remove a model."};
    const char* full = "";
    const Row<Shells> shell = import_shell(state, model.contents->state, model.contents->shell, &full);
    if (!shell.exists()) return Error{model.contents->name + ": no room for the model; raise " + full + "."};
    state.models.is_used[row] = 1;
    state.models.shell[row] = shell;
    const uint32_t generation = ++state.models.generation[row];
    return ModelId{row, generation};
}

namespace {
Row<Models> model_row(const Models& models, ModelId id) {
    const bool is_alive = id.generation != 0 && id.index < models.size() && models.is_used[id.index] &&
                          models.generation[id.index] == id.generation;
    return is_alive ? Row<Models>(id.index) : Row<Models>();
}
}  // namespace

Result<void> World::remove_model(ModelId id) {
    State& state = contents_->data.state;
    const Row<Models> model = model_row(state.models, id);
    if (!model.exists()) return stale("model", id.index);
    release_shell(state, state.models.shell[model]);
    state.models.is_used[model] = 0;
    return {};
}

// ---- bodies
// -----------------------------------------------------------------------------------------------------------

namespace {

// From here on nothing cracks; columns hold no infinity.
constexpr float kNeverCracks = 1e9f;

// A shell of the body's own with these vertices pinned, its limits and rows made anew (B7: pins change what an unpinned
// item is).
Result<Row<Shells>> pinned_copy(State& state, Row<Shells> source, const SpawnSettings& settings) {
    const char* full = "";
    const Row<Shells> copy = copy_shell(state, source, room_of(state, source), &full);
    if (!copy.exists()) return Error{std::string("no room for a pinned body; raise ") + full + "."};
    const ShellView shell(state, copy);
    uint32_t pinned = 0;
    for (uint32_t i = 0; i < settings.pin_count; ++i)
        pinned += apply_pins(shell, settings.pins[i].low, settings.pins[i].high);
    if (pinned == 0) {
        release_shell(state, copy);
        return Error{"no vertex lies in any of the " + std::to_string(settings.pin_count) +
                     " pin boxes; they are in body coordinates, in metres."};
    }
    if (!stiffen_pinned(shell)) {
        release_shell(state, copy);
        return Error{"the pinned body's stiffness does not fit the model's rows; please report this mesh."};
    }
    return copy;
}

}  // namespace

Result<BodyId> World::spawn(ModelId id, const SpawnSettings& settings) {
    WorldData& d = contents_->data;
    State& state = d.state;
    const FpMode mode;
    const Row<Models> model = model_row(state.models, id);
    if (!model.exists()) return stale("model", id.index);
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    if (!(settings.strength_scale > 0))
        return Error{"strength_scale is " + std::to_string(settings.strength_scale) + "; use more than 0."};
    if (settings.pin_count > 0 && !settings.pins)
        return Error{"pin_count is " + std::to_string(settings.pin_count) + " but pins is null; give the boxes."};
    Row<Shells> shell = state.models.shell[model];
    if (settings.pin_count > 0) {
        Result<Row<Shells>> pinned = pinned_copy(state, shell, settings);
        if (!pinned) return Error{pinned.error()};
        shell = pinned.value();
    } else {
        ++state.shells.users[shell];
    }
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        release_shell(state, shell);
        return no_room(state.bodies);
    }
    Bodies& bodies = state.bodies;
    bodies.shell[body] = shell;
    if (!take_view(state, body)) {
        free_body(state, body);
        return Error{"limits.view_vertices is reached (" + std::to_string(state.view_vertices.limit()) +
                     "); raise it."};
    }
    const bool is_static = settings.pin_count > 0;
    fill_body(bodies, body, is_static ? BodyKind::Static : BodyKind::Dynamic, settings.pose,
              is_static ? Motion{} : settings.motion, settings.contact,
              state.materials.friction[state.shells.material[shell]], settings.user_data);
    bodies.model[body] = model;
    bodies.has_pins[body] = is_static;
    bodies.strength_scale[body] = std::min(settings.strength_scale, kNeverCracks);
    bodies.is_breakable[body] = settings.is_breakable && settings.strength_scale < kNeverCracks;
    if (bodies.is_breakable[body]) d.make_ready(room_of(state, shell));
    take_mass_properties(state, body);
    d.arena.reset();
    d.rigid->add(body, describe_rigid(state, body, convex_pieces(state, shell, d.arena)));
    draw_body(state, body);
    return body_id(bodies, body);
}

Result<BodyId> World::add_sphere(const SphereSettings& settings) {
    WorldData& d = contents_->data;
    const FpMode mode;
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    if (!(settings.radius > 0 && settings.radius <= kFarthest && settings.mass > 0 && settings.mass <= kHeaviest))
        return Error{"a sphere needs a radius above 0, at most 1e6 m, and a mass above 0, at most 1e12 kg; got " +
                     std::to_string(settings.radius) + " m and " + std::to_string(settings.mass) + " kg."};
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Dynamic, settings.pose, settings.motion, settings.contact, 0.45f,
              settings.user_data);
    bodies.mass[body] = settings.mass;
    const double inertia = 0.4 * settings.mass * settings.radius * settings.radius;
    bodies.inertia[body] = {inertia, inertia, inertia, 0, 0, 0};
    bodies.radius[body] = settings.radius;
    bodies.is_sphere[body] = 1;
    RigidDescription description = description_of(bodies, body, RigidKind::Dynamic);
    description.radius = settings.radius;
    // Times the floor's friction: a ball at 1 m/s rolls for about four seconds.
    description.rolling_friction = 0.3f * settings.radius;
    d.rigid->add(body, description);
    return body_id(bodies, body);
}

Result<BodyId> World::add_kinematic_box(const KinematicSettings& settings) {
    WorldData& d = contents_->data;
    const FpMode mode;
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    const Vec3 h = settings.half_extents;
    if (!(h.x > 0 && h.y > 0 && h.z > 0 && is_within(h, kFarthest)))
        return Error{"half_extents of a box are " + text(h) + "; use more than 0 and at most 1e6 m."};
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Kinematic, settings.pose, settings.motion, settings.contact, 0.45f,
              settings.user_data);
    Vec3 corners[8];
    RigidDescription description = description_of(bodies, body, RigidKind::Kinematic);
    const float margin = std::min(description.margin, 0.2f * std::min({h.x, h.y, h.z}));
    const Vec3 pulled_in = h - Vec3{margin, margin, margin};
    for (int k = 0; k < 8; ++k)
        corners[k] = {k & 1 ? pulled_in.x : -pulled_in.x, k & 2 ? pulled_in.y : -pulled_in.y,
                      k & 4 ? pulled_in.z : -pulled_in.z};
    const ConvexPiece piece{corners, 0};
    description.margin = margin;
    description.pieces = {&piece, 1};
    d.rigid->add(body, description);
    return body_id(bodies, body);
}

Result<BodyId> World::add_static(const MeshView& mesh, const ContactSettings& contact, uint64_t user_data) {
    WorldData& d = contents_->data;
    const FpMode mode;
    const std::string name = mesh.name ? mesh.name : "static mesh";
    if (!mesh.positions || !mesh.indices || mesh.triangle_count == 0)
        return Error{name + ": has no triangles; give positions and indices."};
    if (const Result<void> valid = check_contact(contact); !valid) return Error{name + ": " + valid.error()};
    std::vector<std::array<uint32_t, 3>> triangles(mesh.triangle_count);
    for (size_t t = 0; t < mesh.triangle_count; ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = mesh.indices[3 * t + k];
            if (v >= mesh.position_count)
                return Error{name + ": triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                             std::to_string(mesh.position_count) + "; give indices below the number of positions."};
            if (!is_within(mesh.positions[v], kFarthest))
                return Error{name + ": vertex " + std::to_string(v) + " stands at " + text(mesh.positions[v]) +
                             "; give metres, at most 1000000 from the origin along each axis."};
            triangles[t][k] = v;
        }
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Static, {}, {}, contact, 0.45f, user_data);
    d.rigid->add_static_triangles(body, {mesh.positions, mesh.position_count}, triangles, bodies.friction[body],
                                  bodies.restitution[body], bodies.layer[body], bodies.mask[body]);
    return body_id(bodies, body);
}

Result<void> World::remove(BodyId id) {
    WorldData& d = contents_->data;
    State& state = d.state;
    const Row<Bodies> body = body_row(state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    const FpMode mode;
    Tasks& tasks = state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) == TaskState::Free) continue;
        const uint32_t first = tasks.first_contact[t];
        for (uint32_t c = first; c < first + tasks.contact_count[t]; ++c) {
            // A striker that is gone takes no impulse: it counts as something that does not yield from here on.
            if (state.task_contacts.striker[c] == body) state.task_contacts.striker[c] = {};
        }
        if (tasks.body[t] != body) continue;
        if (tasks.is_held[t])
            for (uint32_t c = first; c < first + tasks.contact_count[t]; ++c) {
                const Row<Bodies> striker = state.task_contacts.striker[c];
                bool is_repeated = false;
                for (uint32_t before = first; before < c; ++before)
                    is_repeated = is_repeated || state.task_contacts.striker[before] == striker;
                if (is_repeated || !striker.exists() || state.bodies.hold_count[striker] == 0) continue;
                if (--state.bodies.hold_count[striker] == 0) d.rigid->release(striker);
            }
        release_shell(state, tasks.shell[t]);
        release_shell(state, tasks.source[t]);
        tasks.state[t] = static_cast<uint8_t>(TaskState::Free);
    }
    QueuedHits& queued = state.queued_hits;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q]) continue;
        if (queued.striker[q] == body) queued.striker[q] = {};
        if (queued.body[q] == body) queued.clear_rows(q, 1);
    }
    // Rows are used again: nobody may take the next one for a parent.
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.parent[b] == body) state.bodies.parent[b] = {};
    d.rigid->remove(body);
    free_body(state, body);
    return {};
}

bool World::is_alive(BodyId id) const {
    return body_row(contents_->data.state.bodies, id).exists();
}

Result<Pose> World::pose(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return pose_of(bodies, body);
}

Result<Motion> World::motion(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return Motion{bodies.velocity[body], bodies.spin[body]};
}

Result<double> World::mass(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.mass[body];
}

Result<uint64_t> World::user_data(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.user_data[body];
}

Result<bool> World::is_asleep(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.is_asleep[body] != 0;
}

namespace {
void wake_body(WorldData& d, Row<Bodies> body) {
    if (static_cast<BodyKind>(d.state.bodies.kind[body]) != BodyKind::Dynamic) return;
    d.rigid->wake(body);
    d.state.bodies.is_asleep[body] = 0;
}
}  // namespace

Result<void> World::set_pose(BodyId id, const Pose& pose) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (const Result<void> valid = check_pose(pose); !valid) return valid;
    Bodies& bodies = d.state.bodies;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static && !bodies.shell[body].exists())
        return Error{"body " + std::to_string(id.index) +
                     " is made of static triangles in world coordinates; remove it and add it where it is to stand."};
    const FpMode mode;
    const Pose unit = normalised_pose(pose);
    // Put there, not moved there: nothing to draw between the two places.
    bodies.position.set(body, unit.position);
    bodies.orientation[body] = unit.orientation;
    bodies.previous_position.set(body, unit.position);
    bodies.previous_orientation[body] = unit.orientation;
    d.rigid->set_pose(body, unit);
    wake_body(d, body);
    return {};
}

Result<void> World::set_motion(BodyId id, const Motion& motion) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (const Result<void> valid = check_motion(motion); !valid) return valid;
    if (static_cast<BodyKind>(d.state.bodies.kind[body]) == BodyKind::Static)
        return Error{"body " + std::to_string(id.index) +
                     " is static (level geometry, or pinned) and has no motion; use a kinematic body."};
    const FpMode mode;
    d.state.bodies.velocity.set(body, motion.velocity);
    d.state.bodies.spin.set(body, motion.angular_velocity);
    d.rigid->set_motion(body, motion);
    wake_body(d, body);
    return {};
}

Result<void> World::apply_impulse(BodyId id, Vec3 impulse, Vec3 place) {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (!is_finite(impulse) || !is_finite(place))
        return Error{"impulse is " + text(impulse) + " at " + text(place) + "; give finite N s and m."};
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic) return {};  // nothing moves it
    const FpMode mode;
    const Pose pose = pose_of(bodies, body);
    const Vec3 arm = place - to_world(pose, bodies.centre[body].to_float());
    const Vec3d turn(rotate(conjugate(pose.orientation), cross(arm, impulse)));
    const Vec3 spin = rotate(pose.orientation, (inverse(bodies.inertia[body]) * turn).to_float());
    return set_motion(
        id, {bodies.velocity[body] + static_cast<float>(1.0 / bodies.mass[body]) * impulse, bodies.spin[body] + spin});
}

Result<void> World::wake(BodyId id) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    wake_body(d, body);
    return {};
}

uint32_t World::bodies(BodyId* out, uint32_t capacity) const {
    const Bodies& bodies = contents_->data.state.bodies;
    uint32_t count = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free) continue;
        if (count < capacity) out[count] = body_id(bodies, Row<Bodies>(b));
        ++count;
    }
    return count;
}

Result<BodyView> World::view(BodyId id) const {
    const State& state = contents_->data.state;
    const Bodies& bodies = state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    BodyView view;
    view.pose = pose_of(bodies, body);
    view.pose_before = {bodies.previous_position[body], bodies.previous_orientation[body]};
    if (!bodies.shell[body].exists()) return view;
    view.vertices = state.view_vertices.vertex.data() + bodies.view_vertices[body].first;
    view.vertex_count = bodies.view_vertices[body].count;
    view.indices = state.view_indices.index.data() + bodies.view_indices[body].first;
    view.index_count = bodies.view_indices[body].count;
    uint32_t first = 0;
    for (size_t run = 0; run < kMostRuns; ++run) {
        const uint32_t count = bodies.run_indices[body][run];
        const auto kind = static_cast<SurfaceKind>(run / kMostDrawnMaterials);
        const uint16_t material = bodies.drawn_materials[body][run % kMostDrawnMaterials];
        if (count > 0) view.runs[view.run_count++] = {kind, material, first, count};
        first += count;
    }
    view.stamp = bodies.view_stamp[body];
    for (const ShellChanged& changed : contents_->data.shells_changed)
        if (changed.body == body) {
            view.dirty_vertices = {0, view.vertex_count};
            view.dirty_indices = {0, view.index_count};
        }
    return view;
}

std::string World::describe_frame() {
    Settings settings;
    settings.limits = {16, 1, 4096, 4096, 1, 4096, 16};
    const Contents contents(settings, {});
    return contents.plan.describe();
}

}  // namespace cullet
