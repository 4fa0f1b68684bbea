// A world whose bodies the host moves.
#include <new>

#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/with_models.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

Result<World> World::create_hosted(const Settings& settings, const Host& host) {
    return create_hosted_with(damage_models(), settings, host);
}

Result<World> create_hosted_with(const ModelList& models, const Settings& settings, const Host& host) {
    const HostScope call(host);
    if (const Result<void> valid = check_settings(settings); !valid) return Error{valid.error()};
    if (const Result<void> valid = check_host(host); !valid) return Error{valid.error()};
    const MemoryScope memory(host.allocator);
    try {
        return World::Contents::world_of(std::make_unique<World::Contents>(settings, host, nullptr, models));
    } catch (const std::bad_alloc&) {
        return no_room_for(settings.limits);
    }
}

Result<void> World::step(const HostFrame& frame) {
    Contents& c = *contents_;
    if (!c.hosted)
        return Error{
            "a HostFrame was given to a world whose bodies Bullet moves; call step() without it, or make the "
            "world with create_hosted."};
    const HostScope call(c.host);
    if (Result<void> taken = c.hosted->take(frame); !taken) return taken;
    if (c.recorder) c.recorder->frame(frame);
    c.step();
    c.hosted->finish();
    return {};
}

HostChanges World::host_changes() const {
    return contents_->hosted ? contents_->hosted->changes() : HostChanges{};
}

}  // namespace cullet
