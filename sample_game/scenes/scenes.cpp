#include "sample_game/scenes/scenes.hpp"

namespace cullet {

std::span<const Scene> scenes() {
    static const Scene list[] = {kWallScene, kVaseScene, kPaneScene, kPileScene, kDropScene};
    return list;
}

const Scene* find_scene(const std::string& name) {
    for (const Scene& scene : scenes())
        if (name == scene.name) return &scene;
    return nullptr;
}

}  // namespace cullet
