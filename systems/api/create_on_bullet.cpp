// The one call of a world that needs Bullet: it is in cullet::cullet and not in cullet::core.
#include <new>

#include "engine/bullet/other_bullet.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/with_models.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

Result<World> World::create(const Settings& settings, const Host& host) {
    return create_with(damage_models(), settings, host);
}

Result<World> create_with(const ModelList& models, const Settings& settings, const Host& host) {
    const HostScope call(host);
    if (const Result<void> valid = check_settings(settings); !valid) return Error{valid.error()};
    if (const Result<void> valid = check_host(host); !valid) return Error{valid.error()};
    if (const std::string other = bullet::other_bullet(); !other.empty()) return Error{other};
    const MemoryScope memory(host.allocator);
    try {
        return World::Contents::world_of(
            std::make_unique<World::Contents>(settings, host, make_bullet_world(settings.limits.bodies), models));
    } catch (const std::bad_alloc&) {
        return no_room_for(settings.limits);
    }
}

}  // namespace cullet
