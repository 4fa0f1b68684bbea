// What a script sets up and plays on: the world, what is drawn beside its bodies, and what adds up over a run. The
// world is made when the first thing is put into it; until then its settings may change.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cullet/world.hpp"
#include "sample_game/picture.hpp"
#include "sample_game/props.hpp"
#include "sample_game/scene.hpp"

namespace cullet {

/// How a kind of body looks. Bodies carry its place in Stage::looks as their user data; fragments inherit it.
struct Look {
    float opacity = 1, gloss = 0.25f;
    Finish finish = Finish::Plain;
    float pattern_size = 1;
};

/// A model that was cooked for this run.
struct CookedModel {
    Model model;
    ModelId id;  // null until the world stands
    uint32_t look = 0;
    bool is_advised = false;  // its note stands in `notes`
};

/// A kinematic box, which has no drawn mesh of the world's.
struct Mover {
    BodyId body;
    Mesh mesh;  // body coordinates
    Vec3 colour;
};

/// Adds up over a run.
struct RunSums {
    std::map<std::string, uint64_t> events, refused;
    std::vector<std::string> faults;
    std::string squeezed;  // the first that was, in words; events counts them
    uint64_t born = 0, units_used = 0, most_units = 0;
    double mass_put_in = 0;
};

struct Stage {
    ScenePlan plan;
    Host host;
    Story story;
    MaterialTable materials;  // --materials, game.materials
    LimitSettings limits;
    Camera camera;
    bool has_camera = false;  // the script named one
    Sun sun;
    std::vector<Look> looks{{}};                                         // 0: everything that no other was asked for
    std::map<std::pair<std::string, float>, uint32_t> look_of_material;  // by material and size of its pattern
    std::vector<CookedModel> models;
    std::vector<Prop> props;
    std::vector<Mover> movers;
    std::vector<std::string> notes;  // what a person should know, a sentence each
    std::optional<World> world;
    uint64_t frame = 0;  // steps done
    RunSums sums;
    bool broke = false;       // something cracked or came off in the last step
    bool takes_mesh = false;  // the script asked for the mesh of --mesh

    /// Adds and changes what the file says; what --materials says has the last word.
    Result<void> read_materials(const std::string& path);
    /// The world, made with all models cooked so far when it is not there yet.
    Result<World*> stand();
    /// As the keys say now.
    Settings settings() const;
    uint64_t seed() const { return static_cast<uint64_t>(story.keys["scene.seed"]); }
    /// Whole steps in so many seconds, at least 0.
    uint64_t steps_in(double seconds) const;
    bool has_ground() const;
    float ground_height() const;
    /// Cooks; shows progress. The place in `models`. Models of strangers' meshes are kept in the cache.
    Result<uint32_t> cook(const Mesh& mesh, const CookSettings& settings, bool is_strangers);
    /// Notes, once, that hits on a body of this model that does not break quickly will be late, if so.
    void advise(uint32_t model);
    Result<BodyId> add_prop(Prop prop);
    /// Reads the step's events; once a step.
    void after_step();
};

/// Keys that every script has, filled with the library's defaults.
Keys world_keys();

}  // namespace cullet
