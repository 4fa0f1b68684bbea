// The compiled table, tables of the game's own, and where a material's values go.
#include "systems/cook/materials.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cullet/world.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/cook/model_file.hpp"
#include "systems/models/thick_shell/stiffness/grain_stiffness.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

MaterialSettings row_of(const MaterialTable& table, const char* name) {
    const Result<MaterialSettings> found = table.find(name);
    EXPECT_TRUE(found.ok()) << found.error();
    return found.value_or({});
}

Result<Model> cook_ball(const CookSettings& given) {
    CookSettings settings = given;
    settings.thickness = 0.005f;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    return cook(view_of(make_ball(0.1f, 2)), settings);
}

MaterialSettings toffee() {
    MaterialSettings m;
    m.name = "toffee";
    m.density = 1300, m.young_modulus = 3e9f, m.tensile_strength = 8e6f, m.fracture_energy = 5;
    return m;
}
MaterialSettings caramel(MaterialKind kind) {
    MaterialSettings m = toffee();
    m.kind = kind, m.yield_strain = 0.01f, m.break_strain = 0.5f;
    return m;
}

// But for those that decide nothing in a row's kind: strains of brittle ones, strengths and G_c of the others. These
// are 0, in the compiled rows as in all.
TEST(Materials, TheCompiledTableHasTheTenRowsOfTheNoteWithItsValuesAndKinds) {
    struct Wanted {
        const char* name;
        double density, giga_young, poisson, mega_tensile, break_strain, fracture_energy, restitution, friction;
        MaterialKind kind;
    };
    using enum MaterialKind;
    const Wanted wanted[] = {{"glass", 2500, 70, .22, 45, 0, 8, .65, .4, Brittle},
                             {"porcelain", 2400, 70, .20, 50, 0, 20, .6, .45, Brittle},
                             {"brick", 1900, 12, .20, 3, 0, 50, .3, .65, Brittle},
                             {"concrete", 2400, 30, .20, 3, 0, 100, .2, .6, Brittle},
                             {"steel", 7850, 205, .29, 0, .25, 0, .2, .4, Ductile},
                             {"aluminium", 2700, 69, .33, 0, .12, 0, .15, .4, Ductile},
                             {"copper", 8960, 117, .34, 0, .4, 0, .1, .4, Ductile},
                             {"rubber", 1100, .005, .49, 0, 5, 0, .8, .9, Elastic},
                             {"cloth", 500, .1, .3, 0, .15, 0, 0, .5, Elastic},
                             {"wood", 500, 10, .35, 80, 0, 12e3, .5, .45, Brittle}};
    const MaterialTable table;
    ASSERT_EQ(table.rows().size(), std::size(wanted));
    for (const Wanted& w : wanted) {
        const MaterialSettings m = row_of(table, w.name);
        EXPECT_TRUE(check_material(m).ok()) << check_material(m).error();
        const double is[] = {m.density,      m.young_modulus * 1e-9, m.poisson_ratio, m.tensile_strength * 1e-6,
                             m.break_strain, m.fracture_energy,      m.restitution,   m.friction};
        const double should[] = {w.density,      w.giga_young,      w.poisson,     w.mega_tensile,
                                 w.break_strain, w.fracture_energy, w.restitution, w.friction};
        for (size_t k = 0; k < std::size(is); ++k)
            EXPECT_NEAR(is[k], should[k], 1e-6 * should[k]) << w.name << " " << k;
        EXPECT_EQ(m.kind, w.kind) << w.name;
        for (const MaterialValue& value : material_values())
            if (!value.is_of(m.kind)) {
                EXPECT_EQ(m.*value.member, 0) << w.name << " " << value.name;
            }
    }
    EXPECT_EQ(row_of(table, "steel").yield_strain, 1.2e-3f);
    EXPECT_EQ(row_of(table, "aluminium").yield_strain, 3.5e-3f);
    EXPECT_EQ(row_of(table, "copper").yield_strain, 6e-4f);
    EXPECT_EQ(row_of(table, "cloth").bending_stiffness, 1e-5f);
    const MaterialSettings wood = row_of(table, "wood");
    EXPECT_EQ(wood.across_young_modulus, 0.5e9f);
    EXPECT_EQ(wood.across_strength, 3e6f);
    EXPECT_EQ(wood.across_fracture_energy, 250);
    EXPECT_EQ(row_of(table, "concrete").fracture, FractureKind::Coarse);
    EXPECT_EQ(row_of(table, "glass").fracture, FractureKind::Large);
}

TEST(Materials, ATableTakesNewRowsAndChangesOldOnesAndRefusesTheRestWithASentence) {
    MaterialTable table;
    ASSERT_TRUE(table.add(toffee()).ok());
    EXPECT_EQ(row_of(table, "toffee").density, 1300);
    const auto refused = [&](const Result<void>& result, const std::string& with) {
        EXPECT_FALSE(result.ok());
        EXPECT_NE(result.error().find(with), std::string::npos) << result.error();
        EXPECT_EQ(result.error().back(), '.');
    };
    refused(table.add(toffee()), "\"toffee\": is in the table already");
    MaterialSettings brick = row_of(table, "brick");
    brick.tensile_strength = 2e6f;
    EXPECT_TRUE(table.change(brick).ok());
    EXPECT_EQ(row_of(table, "brick").tensile_strength, 2e6f);
    EXPECT_EQ(row_of(MaterialTable(), "brick").tensile_strength, 3e6f);  // another table
    brick.name = "jelly";
    refused(table.change(brick), "\"jelly\": is not in the table, which has glass, porcelain");
    brick.name = "a b";
    refused(table.add(brick), "name is \"a b\"; use 1 to 64 letters");
    for (const MaterialValue& value : material_values()) {
        for (const MaterialKind kind : {MaterialKind::Brittle, MaterialKind::Ductile, MaterialKind::Elastic})
            if (!value.is_of(kind)) {
                MaterialSettings idle = caramel(kind);
                idle.*value.member = 1;
                EXPECT_TRUE(check_material(idle).ok()) << value.name;
                MaterialTable sweets;
                ASSERT_TRUE(sweets.add(idle).ok());
                EXPECT_EQ(row_of(sweets, "toffee").*value.member, 0) << value.name << " decides nothing";
            }
        MaterialSettings m = value.is_of(MaterialKind::Brittle)   ? toffee()
                             : value.is_of(MaterialKind::Ductile) ? caramel(MaterialKind::Ductile)
                                                                  : caramel(MaterialKind::Elastic);
        for (const float bad : {-1.0f, 3e13f, std::numeric_limits<float>::quiet_NaN()}) {
            m.*value.member = bad;
            refused(check_material(m), std::string("material \"toffee\": ") + value.name + " is ");
        }
    }
    MaterialSettings wood = row_of(table, "wood");
    wood.shear_modulus = 0;
    refused(check_material(wood), "shear_modulus is 0, but");
    using M = MaterialSettings;
    for (float M::*value :
         {&M::across_young_modulus, &M::shear_modulus, &M::across_strength, &M::across_fracture_energy}) {
        wood = row_of(table, "wood");
        wood.*value = 1e-30f;
        refused(check_material(wood), "; a material with a grain needs ");
    }
    MaterialSettings steel = row_of(table, "steel");
    steel.yield_strain = 0;
    refused(check_material(steel), "yield_strain is 0; use");
    steel.yield_strain = 0.3f;
    refused(check_material(steel), "yield_strain is 0.3; a ductile material flows before it tears");
}

// Where the bound is passed some plane's stiffness is indefinite; a little below it none is.
TEST(Materials, AGrainWhoseStiffnessIsIndefiniteIsRefused) {
    MaterialSettings m = row_of(MaterialTable(), "wood");
    for (const float nu : {0.1f, 0.35f, 0.45f}) {
        m.poisson_ratio = nu;
        const double bound = m.young_modulus * (1 - double{nu}) / (2 * double{nu} * nu);
        const auto least_minor = [&] {
            double least = 1e300;
            for (double angle = 0; angle < 1.5708; angle += 0.001) {
                const GrainModuli moduli{
                    m.young_modulus, m.across_young_modulus, m.shear_modulus, double{nu}, {0, 0, 1}};
                const PlaneStiffness k = grain_stiffness(moduli, {0, std::sin(angle), std::cos(angle)}, {1, 0, 0});
                least = std::min({least, k.c11, k.c22, k.c11 * k.c22 - k.c12 * k.c12, k.c66});
            }
            return least;
        };
        m.across_young_modulus = static_cast<float>(0.99 * bound);
        m.shear_modulus = 10 * m.young_modulus;  // softness under shear would hide it
        EXPECT_TRUE(check_material(m).ok()) << check_material(m).error();
        EXPECT_GT(least_minor(), 0) << nu;
        m.across_young_modulus = static_cast<float>(1.01 * bound);
        EXPECT_FALSE(check_material(m).ok());
        m.across_young_modulus = static_cast<float>(2 * bound);
        if (m.across_young_modulus > 1e13f) continue;
        m.shear_modulus = 1e13f;
        EXPECT_LT(least_minor(), 0) << nu;
        EXPECT_NE(check_material(m).error().find("across_young_modulus is "), std::string::npos);
    }
}

TEST(Materials, CookingTakesTheTablesRowAndTheModelFileKeepsIt) {
    MaterialTable table;
    ASSERT_TRUE(table.add(toffee()).ok());
    CookSettings settings{.material = "toffee", .materials = &table, .fracture = FractureKind::Fine};
    const Result<Model> model = cook_ball(settings);
    ASSERT_TRUE(model.ok()) << model.error();
    const Result<Model> porcelain = cook_ball({});
    EXPECT_NEAR(model->report().mass / porcelain->report().mass, 1300.0 / 2400, 1e-6);
    const Result<Model> read = parse_model_file(encode_model_file(*model->contents), "t", *damage_models());
    ASSERT_TRUE(read.ok()) << read.error();
    const Workbench& state = read->contents->state;
    const Row<Materials> row = state.structures.material[read->contents->shell];
    const MaterialSettings found = material_settings(state, row);
    for (const MaterialValue& value : material_values())
        EXPECT_EQ(found.*value.member, toffee().*value.member) << value.name;
    EXPECT_EQ(found.fracture, FractureKind::Fine);
    EXPECT_EQ(encode_model_file(*read->contents), encode_model_file(*model->contents));
    settings.material = "jelly";
    EXPECT_NE(cook_ball(settings).error().find("\"jelly\" is not known; use one of glass"), std::string::npos);
}

TEST(Materials, AWorldHoldsARowForEachMaterialOnceAndSnapshotsKeepIt) {
    MaterialTable table;
    ASSERT_TRUE(table.add(toffee()).ok());
    Result<World> world =
        World::create({.limits = {.bodies = 16, .models = 128, .vertices = 1 << 18, .elements = 1 << 18}});
    ASSERT_TRUE(world.ok()) << world.error();
    const State& state = world->contents().data.state;
    const uint64_t empty = world->hash();
    ASSERT_TRUE(world->add_model(*cook_ball({})).ok());
    EXPECT_EQ(state.materials.size(), kFirstMaterials);
    EXPECT_EQ(state.material_traits.size(), 0u);
    const Model sweet = cook_ball({.material = "toffee", .materials = &table}).value();
    for (int n = 0; n < 2; ++n) {
        const Result<ModelId> id = world->add_model(sweet);
        ASSERT_TRUE(id.ok()) << id.error();
        EXPECT_EQ(state.materials.size(), kFirstMaterials + 1);
        EXPECT_EQ(state.material_traits.size(), kFirstMaterials + 1);
    }
    EXPECT_NE(world->hash(), empty);
    const Result<std::vector<uint8_t>> bytes = world->snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    Result<World> other = World::create({});
    ASSERT_TRUE(other->restore(bytes->data(), bytes->size()).ok());
    EXPECT_EQ(other->hash(), world->hash());
    // Rows that nothing is made of give way to new ones, and the world says when there are none.
    std::vector<ModelId> models;
    std::string refused;
    for (uint32_t n = 0; n < kMostMaterials && refused.empty(); ++n) {
        MaterialSettings m = toffee();
        m.density = 1400 + static_cast<float>(n);
        ASSERT_TRUE(table.change(m).ok());
        const Result<ModelId> id = world->add_model(*cook_ball({.material = "toffee", .materials = &table}));
        if (id.ok())
            models.push_back(*id);
        else
            refused = id.error();
    }
    EXPECT_EQ(models.size(), kMostMaterials - kFirstMaterials - 1);
    EXPECT_NE(refused.find("the world holds 64 materials already"), std::string::npos) << refused;
    ASSERT_TRUE(world->remove_model(models[7]).ok());
    EXPECT_TRUE(world->add_model(*cook_ball({.material = "toffee", .materials = &table})).ok());
}

TEST(Materials, ASnapshotWithAMaterialThatCannotBeIsRefused) {
    Result<World> world = World::create({});
    Materials& materials = const_cast<State&>(world->contents().data.state).materials;
    materials.restitution[1] = 7;
    const Result<std::vector<uint8_t>> bytes = world->snapshot();
    ASSERT_TRUE(bytes.ok());
    const Result<void> restored = world->restore(bytes->data(), bytes->size());
    EXPECT_NE(restored.error().find("\"row-1\": restitution is 7; use 0 to 1. The "), std::string::npos)
        << restored.error();
}

TEST(Materials, DuctileAndElasticBodiesThatFallHardMoveByTheirSpringsAndDoNotCrack) {
    for (const char* name : {"steel", "rubber"}) {
        const Result<Model> model = cook_ball({.model = "thick_shell", .material = name});
        ASSERT_TRUE(model.ok()) << model.error();
        EXPECT_EQ(model->report().advice, "") << "of hidden runs, which it has none of";
        Result<World> world = World::create({});
        const Mesh floor = make_box({2, 0.1f, 2});
        ASSERT_TRUE(world->add_static(view_of(floor)).ok());
        SpawnSettings falls;
        falls.pose.position = {0, 0.5f, 0};
        falls.motion.velocity = {0, -8, 0};
        const Result<BodyId> body = world->spawn(*world->add_model(*model), falls);
        ASSERT_TRUE(body.ok()) << body.error();
        const SoftBodies& soft = world->contents().data.state.soft_bodies;
        ASSERT_EQ(soft.size(), 1u);
        bool has_woken = false;
        for (int n = 0; n < 60; ++n) {
            world->step();
            has_woken = has_woken || soft.is_awake[0];
            EXPECT_EQ(world->events().fragments_born.count, 0u) << name << ", frame " << n;
            EXPECT_EQ(world->events().cracks_started.count, 0u) << name << ", frame " << n;
            for (const FaultEvent& fault : world->events().faults) {
                const std::string reason = fault.reason;
                const bool is_energy = reason.starts_with("This frame made energy");
                // Not repaired: where the wall of a hollow steel ball buckles, its springs hold six times the energy
                // that it fell with.
                EXPECT_TRUE(is_energy && std::string(name) == "steel") << name << ", frame " << n << ": " << reason;
            }
        }
        EXPECT_TRUE(has_woken) << name;
        EXPECT_GT(world->pose(*body)->position.y, 0.1f);
        EXPECT_LT(world->pose(*body)->position.y, 3);
    }
}

}  // namespace
}  // namespace cullet
