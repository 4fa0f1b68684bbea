// What bodies are made of: a compiled table of ten materials, and tables of the game's own that add rows and change
// them. A table touches no world. Cooking takes one row and puts its values into the model. From there they come into
// worlds, model files, snapshots and recordings. After a change of a row, cook again.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

/// Brittle bodies crack and fall apart. Ductile ones stretch, flow and tear. Elastic ones stretch, spring back and
/// tear. Both are rigid until something hits them hard enough. Where a host moves the bodies, both stay rigid.
enum class MaterialKind : uint8_t { Brittle = 0, Ductile, Elastic };

/// How near to each other cracks start. Large: within three edges of a cut none starts for the rest of a hit, so few
/// cracks run far. Coarse: none starts there until a wave has gone twelve edges. Fine: nothing is banned, and cracked
/// places may crack anew.
enum class FractureKind : uint8_t { Large = 0, Coarse, Fine };

/// One row, in SI units. material_values() says what a value may be, and in which kinds of material it decides
/// something. A table keeps what decides nothing in a row's kind as 0.
struct MaterialSettings {
    std::string name;  // letters, digits, _ and -
    MaterialKind kind = MaterialKind::Brittle;
    FractureKind fracture = FractureKind::Large;
    /// The damage model that things of it have, one of damage_model_names(), unless CookSettings::model names another.
    /// Empty: the first one.
    std::string model;
    float density = 2400;            // kg/m3
    float young_modulus = 70e9f;     // Pa; of wood along the grain, as are the next two
    float poisson_ratio = 0.2f;      // of wood: contraction across for stretch along the grain
    float tensile_strength = 50e6f;  // Pa, of brittle ones, for loads of seconds; a blow's run takes twice that
    float yield_strain = 0;          // where a ductile one begins to flow
    float break_strain = 0;          // where a ductile or elastic one tears
    float fracture_energy = 20;      // J/m2, G_c, of brittle ones
    float crush_strength = 6e9f;     // Pa, of brittle ones: pressure under which the struck face gives way for good
    /// Decides about the blow while its damage is worked off, and how long a soft body swings. Rigid bounces have
    /// ContactSettings::restitution instead, 0.2 if not given; of sheet metal this.
    float restitution = 0.6f;
    float friction = 0.45f;  // of contacts, unless ContactSettings::friction is given
    // Of brittle ones, down to across_fracture_energy but for bending_stiffness.
    float heading_power = 6;    // how straight cracks run; glass 30
    float tip_factor = 0.6f;    // on Griffith's limit at the mesh's resolution; at 1 most panes stay whole
    float run_seconds = 1e-3f;  // least elastic time of a blow's run; half of it leaves a vase too whole
    /// Tips above this share of the start strength (which is twice tensile_strength) fork with probability 1/2; 0:
    /// never. Of fine and, four edges apart, coarse fracture; large cracks run on alone.
    float branching = 0;
    /// When a hit breaks the body, a crack that has stopped may go on. It does if a border or another crack lies ahead,
    /// within this times its own length: what is left would break under the pieces' weight. 0: it stays a hairline.
    float run_out = 0;
    /// N m, of ductile and elastic ones. Above 0, as for cloth, a body is a sheet of one layer. It is flat at rest and
    /// bends by this. 0: it bends as E and the thickness say.
    float bending_stiffness = 0;
    /// Pa, of ductile ones: what a body of sheet metal gives way under as a whole. 0: as an empty closed shell of its
    /// width and thickness. A car has 0.2e6.
    float crush_pressure = 0;
    // Across the grain. across_young_modulus 0: the same in all directions, and the others count for nothing.
    float across_young_modulus = 0;    // Pa
    float shear_modulus = 0;           // Pa, between along and across
    float across_strength = 0;         // Pa
    float across_fracture_energy = 0;  // J/m2, of a crack that splits along the grain
};

/// One number of a row, for readers, checks and lists: its name, unit and range, and the kinds of material in which it
/// decides something. In the others it is 0. Both ends of the range may be had.
struct MaterialValue {
    const char* name;  // as in MaterialSettings
    const char* unit;
    float MaterialSettings::*member;
    double least, most;
    uint8_t kinds;  // a bit a kind
    bool is_of(MaterialKind kind) const { return kinds >> static_cast<uint8_t>(kind) & 1; }
};
struct MaterialValues {
    const MaterialValue* data;
    size_t count;
    const MaterialValue* begin() const { return data; }
    const MaterialValue* end() const { return data + count; }
};
MaterialValues material_values();
/// "brittle", "ductile", "elastic"; "large", "coarse", "fine".
const char* name_of(MaterialKind kind);
const char* name_of(FractureKind kind);

/// Empty, or a sentence: which value, what it is, the range. Looks at values that must fit each other too.
Result<void> check_material(const MaterialSettings& material);

/// A list of materials with different names. Copies are independent.
class MaterialTable {
 public:
    /// The compiled ones: glass, porcelain, brick, concrete, steel, aluminium, copper, rubber, cloth, wood.
    MaterialTable();
    /// Refuses a name that is there already, and a row that check_material refuses. Values that decide nothing in the
    /// row's kind become 0.
    Result<void> add(const MaterialSettings& material);
    /// Replaces the row of that name.
    Result<void> change(const MaterialSettings& material);
    /// An error names those there are.
    Result<MaterialSettings> find(const std::string& name) const;
    const std::vector<MaterialSettings>& rows() const { return rows_; }
    /// "glass, porcelain, ..."
    std::string names() const;

 private:
    MaterialSettings* row_of(const std::string& name);
    std::vector<MaterialSettings> rows_;
};

}  // namespace cullet
