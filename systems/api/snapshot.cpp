#include "systems/api/snapshot.hpp"

#include <new>

#include "engine/file_header.hpp"
#include "engine/host_scope.hpp"
#include "engine/memory.hpp"
#include "engine/mesh_file.hpp"
#include "engine/table_bytes.hpp"
#include "systems/api/checks.hpp"
#include "systems/brittle/restart.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLargestFile = 1ull << 36;
constexpr const char* kAdvice = "The snapshot is damaged or of another build; take it again.";
constexpr FileKind kKind{{'c', 's', 'n', 'a', 'p', '\r', '\n', '\x1a'},
                         1,
                         "snapshot",
                         ".csnap",
                         "Write one with World::save.",
                         kAdvice,
                         "Take it again with this build."};

/// Numbers of the settings, the clock and the counts in the file's order, for both ways.
template <class Settings_, class Data, class F>
void for_each_setting(Settings_& s, Data& d, F&& f) {
    const auto vector = [&](auto& v) { f(v.x), f(v.y), f(v.z); };
    vector(s.gravity);
    f(s.step_seconds), f(s.units_a_frame), f(s.hold_seconds), f(s.generations), f(s.debris_share), f(s.debris_elements);
    auto& l = s.limits;
    f(l.bodies), f(l.models), f(l.vertices), f(l.elements), f(l.open_hits), f(l.view_vertices), f(l.debris),
        f(l.queued_hits);
    f(d.step_info.frame), vector(d.step_info.gravity);
}

template <class Data, class F>
void for_each_count(Data& d, F&& f) {
    auto& c = d.counts;
    f(c.opened), f(c.broke), f(c.whole), f(c.dropped), f(c.redone), f(c.late), f(c.frames_held), f(c.clamped);
    f(c.cuts), f(c.starts), f(c.cuts_refused), f(c.units_used), f(c.units_left), f(c.worst_rounding);
    for (auto& impulse : c.impulse_to_static) f(impulse);
    auto& r = d.ready_for;
    f(r.vertices), f(r.elements), f(r.hinges), f(r.blocks), f(r.links), f(r.cells), f(r.points);
}

void put_world(ByteWriter& out, World::Contents& world) {
    WorldData& d = world.data;
    const auto put = [&](const auto& number) { out.number(number); };
    for_each_setting(world.settings, d, put);
    for_each_count(d, put);
    std::apply([&](auto... table) { (put_table(out, d.state.*table, 0, (d.state.*table).size()), ...); },
               State::tables());
    for (const RangePool* pool : d.state.pools.all()) pool->save(out);
    d.rigid->save(out);
}

/// What must be known before tables of the right size can be made.
struct Beginning {
    Settings settings;
    struct {
        Step step_info;
    } clock;
};

void take_settings(ByteReader& in, Beginning& found) {
    for_each_setting(found.settings, found.clock,
                     [&](auto& number) { number = in.number<std::remove_reference_t<decltype(number)>>("a setting"); });
    const Result<void> valid = check_settings(found.settings);
    in.expect(valid.ok(), valid.error());
    const Result<void> gravity = check_gravity("gravity", found.clock.step_info.gravity);
    in.expect(gravity.ok(), gravity.error());
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
    std::apply([&](auto... table) { (take_table(state.*table), ...); }, State::tables());
    for (RangePool* pool : state.pools.all())
        if (in.is_sound()) pool->load(in);
}

/// The rigid world has the bodies that the table has.
Result<void> check_rigid(const WorldData& d, const std::string& name) {
    const Bodies& bodies = d.state.bodies;
    for (uint32_t b = 0; b < bodies.limit(); ++b) {
        const auto kind = b < bodies.size() ? static_cast<BodyKind>(bodies.kind[b]) : BodyKind::Free;
        const std::optional<RigidKind> found = d.rigid->kind(b);
        const bool fits = kind == BodyKind::Free        ? !found
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
    std::unique_ptr<RigidWorld> rebuilt = make_bullet_world(world.settings.limits.bodies);
    ByteReader in(out.bytes, "snapshot", "Please report this.");
    if (Result<void> loaded = rebuilt->load(in); !loaded) return loaded;
    world.data.rigid = std::move(rebuilt);
    return {};
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
                                                        const Host& host, uint32_t threads) {
    try {
        const auto payload = payload_of(kKind, bytes, name);
        if (!payload) return Error{payload.error()};
        ByteReader in(*payload, name, kAdvice, kFileHeaderBytes);
        Beginning found;
        take_settings(in, found);
        found.settings.threads = threads;
        if (!in.is_sound()) return Error{in.trouble()};
        const MemoryScope memory(host.allocator);
        auto world = std::make_unique<World::Contents>(found.settings, host);
        WorldData& d = world->data;
        d.step_info.frame = found.clock.step_info.frame;
        d.step_info.gravity = found.clock.step_info.gravity;
        for_each_count(d,
                       [&](auto& number) { number = in.number<std::remove_reference_t<decltype(number)>>("a count"); });
        take_tables(in, d.state);
        if (!in.is_sound()) return Error{in.trouble()};
        if (const Result<void> sound = check_state(d.state, name); !sound) return Error{sound.error()};
        if (const Result<void> loaded = d.rigid->load(in); !loaded) return Error{loaded.error()};
        if (!in.expect(in.is_at_end(), "the world ends before the file does,")) return Error{in.trouble()};
        if (const Result<void> fits = check_rigid(d, name); !fits) return Error{fits.error()};
        for (uint32_t t = 0; t < d.state.tasks.size(); ++t)
            if (static_cast<TaskState>(d.state.tasks.state[t]) == TaskState::Running)
                restore_scratch(d.state, Row<Tasks>(t));
        d.state.commit_ahead(d.ready_for);
        return world;
    } catch (const std::bad_alloc&) {
        return Error{name + ": no memory for the world of " + std::to_string(bytes.size()) + " bytes. Free memory."};
    }
}

Result<std::vector<uint8_t>> World::snapshot() {
    const HostScope call(contents_->host);
    return encode_snapshot(*contents_);
}

Result<void> World::restore(const uint8_t* bytes, size_t size, const char* name) {
    const HostScope call(contents_->host);
    if (!bytes) return Error{std::string(name) + ": no bytes are given."};
    Result<std::unique_ptr<Contents>> loaded =
        parse_snapshot({bytes, size}, name, contents_->host, contents_->settings.threads);
    if (!loaded) return Error{loaded.error()};
    Contents& fresh = **loaded;
    fresh.data.damage_settings.allows = contents_->data.damage_settings.allows;
    fresh.data.damage_settings.allows_user = contents_->data.damage_settings.allows_user;
    fresh.after_each_system = contents_->after_each_system;
    contents_ = std::move(*loaded);
    return {};
}

Result<void> World::save(const std::string& path) {
    const Result<std::vector<uint8_t>> bytes = snapshot();
    if (!bytes) return Error{path + ": " + bytes.error()};
    return write_whole_file(*bytes, path);
}

Result<void> World::load(const std::string& path) {
    const Result<std::vector<uint8_t>> bytes = read_whole_file(path, kLargestFile);
    if (!bytes) return Error{bytes.error()};
    return restore(bytes->data(), bytes->size(), path.c_str());
}

}  // namespace cullet
