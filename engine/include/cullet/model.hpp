// From a mesh to a model that can break. Reading and cooking are slow (milliseconds to seconds) and touch no world:
// they may run on any thread, several at once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cullet/host.hpp"
#include "cullet/lattice.hpp"
#include "cullet/material.hpp"
#include "cullet/metal_shell.hpp"
#include "cullet/result.hpp"
#include "cullet/setting_list.hpp"
#include "cullet/thick_shell.hpp"
#include "cullet/types.hpp"

namespace cullet {

/// A triangle mesh, as a view of the caller's arrays. Corner arrays hold three entries a triangle, or are null.
struct MeshView {
    const Vec3* positions = nullptr;  // m
    size_t position_count = 0;
    const uint32_t* indices = nullptr;  // 3 a triangle
    size_t triangle_count = 0;
    /// Unit. Null: made from this mesh, smooth but for edges that turn by more than 40 degrees; cracks leave them as
    /// they are.
    const Vec3* corner_normals = nullptr;
    const Vec2* corner_uvs = nullptr;
    const uint16_t* materials = nullptr;  // 1 a triangle, comes back in the drawn mesh's order
    const char* name = "mesh";            // for sentences
};

/// A mesh that owns its arrays: what a mesh file (.cmesh) holds.
class MeshData {
 public:
    MeshData();
    ~MeshData();
    MeshData(MeshData&&) noexcept;
    MeshData& operator=(MeshData&&) noexcept;
    MeshView view() const;
    struct Contents;
    std::unique_ptr<Contents> contents;
};

/// Reads a mesh file that the program cullet_import wrote. Every count, index and number is checked. A file that is not
/// sound is refused with a sentence.
Result<MeshData> read_mesh(const std::string& path);

/// What cooking would find in a mesh and repair. The mesh itself stays as it is.
struct MeshReport {
    uint32_t welded_vertices = 0;    // at the position of another, to the last bit
    uint32_t dropped_triangles = 0;  // with a repeated corner, of no area, or named twice
    uint32_t flipped_triangles = 0;  // so that neighbours agree and closed parts face outward
    uint32_t split_edges = 0;        // with more than two triangles: sheets are paired by angle
    uint32_t split_vertices = 0;     // added where several fans of triangles met in one point
    uint32_t crossing_pairs = 0;     // triangles that cut or touch each other; they stay
    uint32_t one_sided_parts = 0;    // as a Moebius strip; they get no thickness
    uint32_t parts = 0, closed_parts = 0;
    uint32_t open_borders = 0, open_edges = 0;  // they stay open
    std::string repairs;                        // all of it in one sentence
};
/// Touches no world and no thread; about 2 microseconds a triangle. Refuses what cannot be a surface.
Result<MeshReport> examine_mesh(const MeshView& mesh);

/// The damage models that this version has: how things break. CookSettings::model names one.
std::vector<std::string> damage_model_names();

struct CookSettings {
    std::string model = {};                     // one of damage_model_names(); empty: the material's
    std::string material = "porcelain";         // a name in `materials`
    const MaterialTable* materials = nullptr;   // null: the compiled table
    std::optional<FractureKind> fracture = {};  // in place of the material's
    Vec3 grain{0, 1, 0};  // of wood, along its fibres, mesh coordinates, any length; counts for no other material
    /// Of what is made of a shell, m; above 0, below the mesh's diagonal. Thinner where the opposite wall is near.
    float thickness = 0.005f;
    /// Edges longer than this are split first, m; at least 0. 0: twice the thickness, or 2.5 % of the diagonal if
    /// larger.
    float longest_edge = 0;
    /// Points that are closer than this share of the diagonal are one; 0 to 0.01. 0: equal ones only. 1e-7 heals a soup
    /// of triangles whose positions differ in the last digits.
    float weld_tolerance = 0;
    uint64_t seed = 1;  // of the spread of strength
    // Of one damage model each; those of the others count for nothing.
    ThickShellCookSettings thick_shell = {};
    MetalShellSettings metal_shell = {};
    LatticeSettings lattice = {};
    /// Called now and then on the thread that cooks; never falls, ends with 1.
    void (*progress)(void* user, float share) = nullptr;  // 0 to 1
    void* progress_user = nullptr;
    /// Its allocator holds the model's tables, its assert handler hears of our bugs. Null: the system's, and none.
    const Host* host = nullptr;
};

/// The damage model that cook() takes with these settings. An error names the materials that there are.
Result<std::string> damage_model_of(const CookSettings& settings);
/// The settings that a damage model has of its own in CookSettings, as lists. None of a name that there is not.
std::vector<SettingGroup<CookSettings>> cook_settings_of(const std::string& damage_model);

/// What cooking found, for people.
struct ModelReport {
    uint32_t vertices = 0, elements = 0, cells = 0, degenerate_elements = 0;
    double mass = 0;              // kg
    double mean_thickness = 0;    // m
    float first_crack_speed = 0;  // m/s against a floor; estimated when not measured; 0 of what does not crack
    float first_crack_force = 0;  // N that one place bears for long, likewise; a long thin thing bends and bears less
    uint64_t units_of_a_hit = 0;  // predicted
    uint32_t collisions = 0;      // moves that were taken back while the inner surface was pushed in
    uint32_t inverted_elements = 0;  // turned inside out; 0 but for the published ways of Propagation
    uint32_t crossings = 0;          // pairs of faces that meet; 0 but for Propagation::Front
    std::string walls;               // one sentence when both walls were modelled and became one sheet
    std::string repairs;             // one sentence, empty when the mesh was sound
    std::string advice;  // one sentence when a hidden run will not fit the default budget: which settings to change
};

/// A cooked model, not bound to a world. Immutable, so any number of worlds on any threads may use it.
class Model {
 public:
    struct Contents;
    const ModelReport& report() const;
    std::shared_ptr<const Contents> contents;
};

/// Turns a surface into a model that the damage model breaks. Refuses what cannot be cooked with a sentence.
Result<Model> cook(const MeshView& mesh, const CookSettings& settings);

/// A model file (.cmodel) holds the rows after cooking, so that a game cooks once.
Result<void> write_model(const Model& model, const std::string& path);
/// `host` as in CookSettings.
Result<Model> read_model(const std::string& path, const Host* host = nullptr);

}  // namespace cullet
