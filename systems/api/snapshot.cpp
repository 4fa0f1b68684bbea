#include "systems/api/snapshot.hpp"

#include <new>

#include "engine/file_header.hpp"
#include "engine/host_scope.hpp"
#include "engine/memory.hpp"
#include "engine/mesh_file.hpp"
#include "engine/packed_bytes.hpp"
#include "engine/table_bytes.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/settings_bytes.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/cook/materials.hpp"
#include "systems/drawn/bound_drawn.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"

namespace cullet {

void put_tables(ByteWriter& out, const State& state) {
    state.for_each_table([&](const AnyTable& table) { put_table(out, table, 0, table.size()); });
    state.for_each_pool([&](const RangePool& pool) { pool.save(out); });
}

void take_tables(ByteReader& in, State& state) {
    const auto take_table = [&](AnyTable& table) {
        if (!in.is_sound()) return;
        const FoundTable found = find_table(in, table);
        if (!in.expect(found.rows >= table.size() && found.rows <= table.limit(),
                       std::string(table.name()) + " has " + std::to_string(found.rows) + " rows for a limit of " +
                           std::to_string(table.limit())))
            return;
        table.append(found.rows - table.size());
        found.copy_to(table, 0);
    };
    state.for_each_table(take_table);
    state.for_each_pool([&](RangePool& pool) {
        if (in.is_sound()) pool.load(in);
    });
}

Settings take_settings(ByteReader& in) {
    Settings settings;
    for_each_setting(settings,
                     [&](auto& number) { number = in.number<std::remove_reference_t<decltype(number)>>("a setting"); });
    const Result<void> valid = check_settings(settings);
    in.expect(valid.ok(), valid.error());
    return settings;
}

Result<void> take_damage_models(ByteReader& in, const DamageModels& models, const std::string& name) {
    const std::string found = in.text("the names of damage models");
    if (!in.is_sound()) return Error{in.trouble()};
    if (found != models.names())
        return Error{name + ": is of a world that has the damage models " + found + ", and this one has " +
                     models.names() + ". Load it into a world that has the same."};
    return {};
}

namespace {

constexpr uint64_t kLargestFile = 1ull << 36, kLargestUnpacked = 1ull << 33;
constexpr const char* kAdvice = "The snapshot is damaged or of another build; take it again.";
constexpr FileKind kKind{{'c', 's', 'n', 'a', 'p', '\r', '\n', '\x1a'},
                         21,
                         "snapshot",
                         ".csnap",
                         "Write one with World::save.",
                         kAdvice,
                         "Take it again with this build."};

/// Of the clock and the counts in the file's order, for both ways.
template <class Clock, class F>
void for_each_of_clock(Clock& clock, F&& f) {
    f(clock.frame), f(clock.gravity.x), f(clock.gravity.y), f(clock.gravity.z);
}

template <class Data, class F>
void for_each_count(Data& d, F&& f) {
    auto& c = d.counts;
    f(c.opened), f(c.broke), f(c.whole), f(c.dropped), f(c.redone), f(c.late), f(c.frames_held), f(c.clamped);
    f(c.cuts), f(c.starts), f(c.cuts_refused), f(c.units_used), f(c.units_left), f(c.slow_soft_frames), f(c.retired),
        f(c.faded), f(c.worst_rounding), f(c.crushing_energy);
    for (auto& impulse : c.impulse_to_static) f(impulse);
}

void put_world(ByteWriter& out, World::Contents& world) {
    WorldData& d = world.data;
    const auto put = [&](const auto& number) { out.number(number); };
    out.number(static_cast<uint8_t>(world.hosted != nullptr));
    for_each_setting(world.settings, put);
    out.text(d.damage_models->names());
    for_each_of_clock(d.step_info, put);
    for_each_count(d, put);
    put_tables(out, d.state);
    d.query_index->save(out, d.state.bodies);
    d.rigid->save(out);
}

/// The rigid world has the bodies that the table has.
Result<void> check_rigid(const WorldData& d, const std::string& name) {
    const Bodies& bodies = d.state.bodies;
    for (uint32_t b = 0; b < bodies.limit(); ++b) {
        const auto kind = b < bodies.size() ? static_cast<BodyKind>(bodies.kind[b]) : BodyKind::Free;
        const std::optional<RigidKind> found = d.rigid->kind(b);
        const bool fits = kind == BodyKind::Free        ? !found
                          : kind == BodyKind::Scenery   ? !found
                          : kind == BodyKind::Static    ? found == RigidKind::Static
                          : kind == BodyKind::Kinematic ? found == RigidKind::Kinematic
                                                        : found == RigidKind::Dynamic;
        if (!fits)
            return Error{name + ": body " + std::to_string(b) +
                         " is not the same in the tables and in the rigid world. " + kAdvice};
    }
    return {};
}

/// The running world goes on as the one that is loaded.
Result<void> rebuild_rigid(World::Contents& world) {
    ByteWriter out;
    world.data.rigid->save(out);
    std::unique_ptr<RigidWorld> rebuilt = world.data.rigid->make_another(world.settings.limits.bodies);
    if (!rebuilt) return {};  // the host's
    ByteReader in(out.bytes, "snapshot", "Please report this.");
    if (Result<void> loaded = rebuilt->load(in); !loaded) return loaded;
    rebuilt->use_jobs(*world.jobs);
    world.data.rigid = std::move(rebuilt);
    return {};
}

/// An empty world with the host and the damage models of `like`; null: there is no memory for one.
std::unique_ptr<World::Contents> make_alike(const Settings& settings, const World::Contents& like) {
    try {
        return std::make_unique<World::Contents>(
            settings, like.host, like.data.rigid->make_another(settings.limits.bodies), like.data.damage_models);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

/// What is not in the bytes because it follows from them.
void restore_what_follows(World::Contents& world) {
    WorldData& d = world.data;
    State& state = d.state;
    const DamageModels& models = *d.damage_models;
    for (uint32_t t = 0; t < state.tasks.size(); ++t) {
        if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Running)
            models.restore_run(state, Row<Tasks>(t));
        const bool has_copy = static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free &&
                              state.tasks.working[t].exists() && !models.is_part(state, t);
        if (has_copy)  // of the whole body, whose drawn mesh it knows
            calls_of(state.structures, state.tasks.working[t])
                .remember_drawn(state, state.tasks.working[t], state.tasks.body[t]);
    }
    std::vector<bool> is_bound(state.model_meshes.size());
    for (uint32_t b = 0; b < state.bodies.size(); ++b) {
        const Row<Structures> structure = state.bodies.structure[b];
        if (static_cast<BodyKind>(state.bodies.kind[b]) == BodyKind::Free || !structure.exists()) continue;
        const Row<ModelMeshes> mesh = state.bodies.model_mesh[b];
        if (mesh.exists() && is_bound[mesh])
            state.bodies.drawn_box[b] = state.model_meshes.drawn_box[mesh];
        else
            bound_view(state.bodies, Row<Bodies>(b), state.view_vertices, state.view_indices, d.view_boxes);
        if (mesh.exists()) is_bound[mesh] = true;
        calls_of(state.structures, structure).remember_drawn(state, structure, Row<Bodies>(b));
        state.bodies.redrawn[b] = {0, state.bodies.view_indices[b].count / 3};
        models.restore_body(state, Row<Bodies>(b));
        if (state.bodies.is_breakable[b])
            if (const auto room = models.room(state, Row<Bodies>(b))) d.make_ready(*room);
        d.arena.reset();
        if (world.hosted && static_cast<BodyKind>(state.bodies.kind[b]) != BodyKind::Scenery)
            world.hosted->announce(b, convex_pieces(state, structure, d.arena));
    }
    if (world.hosted) world.hosted->finish();
    d.query_index->refresh(state.bodies);
}

}  // namespace

Result<std::vector<uint8_t>> encode_snapshot(World::Contents& world) {
    try {
        ByteWriter out;
        out.bytes.resize(kFileHeaderBytes);
        put_world(out, world);
        if (const Result<void> rebuilt = rebuild_rigid(world); !rebuilt) return Error{rebuilt.error()};
        finish_file(kKind, out.bytes);
        return std::move(out.bytes);
    } catch (const std::bad_alloc&) {
        return Error{"no memory for a snapshot of the world. Free memory, or remove bodies and models."};
    }
}

Result<std::unique_ptr<World::Contents>> parse_snapshot(std::span<const uint8_t> bytes, const std::string& name,
                                                        const World::Contents& like) {
    try {
        const auto payload = payload_of(kKind, bytes, name);
        if (!payload) return Error{payload.error()};
        ByteReader in(*payload, name, kAdvice, kFileHeaderBytes);
        const bool is_hosted = in.number<uint8_t>("who moves the bodies") != 0;
        if (is_hosted != (like.hosted != nullptr))
            return Error{name + ": is of a world whose bodies " + (is_hosted ? "the host" : "Bullet") +
                         " moves, and this one's are moved by " + (is_hosted ? "Bullet" : "the host") +
                         ". Load it into a world made by " + (is_hosted ? "create_hosted." : "create.")};
        Settings settings = take_settings(in);
        settings.threads = like.settings.threads;
        const Result<void> knows = take_damage_models(in, *like.data.damage_models, name);
        if (!knows) return Error{knows.error()};
        const MemoryScope memory(like.host.allocator);
        std::unique_ptr<World::Contents> world = make_alike(settings, like);
        if (!world) return Error{name + ": " + no_room_for(settings.limits).message};
        WorldData& d = world->data;
        const auto take = [&](auto& number) {
            number = in.number<std::remove_reference_t<decltype(number)>>("a count");
        };
        for_each_of_clock(d.step_info, take);
        const Result<void> gravity = check_gravity("gravity", d.step_info.gravity);
        in.expect(gravity.ok(), gravity.error());
        for_each_count(d, take);
        take_tables(in, d.state);
        if (!in.is_sound()) return Error{in.trouble()};
        if (const Result<void> sound = check_state(*d.damage_models, d.state, name); !sound)
            return Error{sound.error()};
        const Result<void> due = check_times(d.state, d.step_info.frame, d.step_info.dt, name);
        if (!due) return Error{due.error()};
        d.query_index->load(in, d.state.bodies);
        if (const Result<void> loaded = d.rigid->load(in); !loaded) return Error{loaded.error()};
        if (!in.expect(in.is_at_end(), "the world ends before the file does,")) return Error{in.trouble()};
        if (const Result<void> fits = check_rigid(d, name); !fits) return Error{fits.error()};
        restore_what_follows(*world);
        return world;
    } catch (const std::bad_alloc&) {
        return Error{name + ": no memory for the world of " + std::to_string(bytes.size()) + " bytes. Free memory."};
    }
}

Result<std::vector<uint8_t>> World::snapshot() {
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->snapshot();
    return encode_snapshot(*contents_);
}

Result<void> World::restore(const uint8_t* bytes, size_t size, const char* name) {
    const HostScope call(contents_->host);
    if (!bytes) return Error{std::string(name) + ": no bytes are given."};
    Result<std::unique_ptr<Contents>> loaded = parse_snapshot({bytes, size}, name, *contents_);
    if (!loaded) return Error{loaded.error()};
    Contents& fresh = **loaded;
    fresh.recorder = std::move(contents_->recorder);
    if (fresh.recorder) fresh.recorder->restore({bytes, size});
    fresh.set_veto(contents_->allows, contents_->allows_user);
    fresh.after_each_system = contents_->after_each_system;
    contents_ = std::move(*loaded);
    return {};
}

Result<void> World::save(const std::string& path) {
    const Result<std::vector<uint8_t>> bytes = snapshot();
    if (!bytes) return Error{path + ": " + bytes.error()};
    try {
        return write_whole_file(pack(*bytes), path);
    } catch (const std::bad_alloc&) {
        return Error{path + ": no memory to pack " + std::to_string(bytes->size()) + " bytes. Free memory."};
    }
}

Result<void> World::load(const std::string& path) {
    Result<std::vector<uint8_t>> bytes = read_whole_file(path, kLargestFile);
    if (!bytes) return Error{bytes.error()};
    if (is_packed(*bytes)) {  // else the bytes of snapshot(), which the game wrote
        try {
            bytes = unpack(*bytes, path, kLargestUnpacked);
        } catch (const std::bad_alloc&) {
            return Error{path + ": no memory to unpack it. Free memory."};
        }
        if (!bytes) return Error{bytes.error()};
    }
    return restore(bytes->data(), bytes->size(), path.c_str());
}

}  // namespace cullet
