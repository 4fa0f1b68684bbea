// Materials from TOML files, by the command line and from scripts.
#include "sample_game/read_materials.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet {
namespace {

class ReadMaterials : public testing::Test {
 protected:
    ReadMaterials() : folder_(std::filesystem::path(testing::TempDir()) / "cullet_read_materials_test") {
        std::filesystem::create_directory(folder_);
    }
    ~ReadMaterials() override { std::filesystem::remove_all(folder_); }

    std::string file(const std::string& text, const char* name = "mine.toml") const {
        const std::string path = (folder_ / name).string();
        std::ofstream(path) << text;
        return path;
    }
    /// Reads the text; the table as it then is, and "" or the sentence without the folder.
    std::string read(const std::string& text) {
        const Result<void> done = read_materials(file(text), table_);
        return done.ok() ? "" : done.error().substr(folder_.string().size() + 1);
    }
    MaterialSettings row(const char* name) const { return table_.find(name).value_or({}); }

    std::filesystem::path folder_;
    MaterialTable table_;
};

TEST_F(ReadMaterials, AFileAddsAndChangesRows) {
    EXPECT_EQ(read(R"(
        [brick]
        tensile_strength = 2e6
        [clinker]   # like a row that the same file has changed
        like = "brick"
        density = 2100
        fracture = "fine"
        [spring]
        like = "steel"
        kind = "elastic"
    )"),
              "");
    EXPECT_EQ(row("brick").tensile_strength, 2e6f);
    EXPECT_EQ(row("brick").density, 1900);
    EXPECT_EQ(row("clinker").tensile_strength, 2e6f);
    EXPECT_EQ(row("clinker").density, 2100);
    EXPECT_EQ(row("clinker").fracture, FractureKind::Fine);
    EXPECT_EQ(row("spring").kind, MaterialKind::Elastic);
    EXPECT_EQ(table_.rows().size(), 12u);
    EXPECT_EQ(read("[clinker]\ndensity = 2200"), "");  // now it changes
    EXPECT_EQ(row("clinker").density, 2200);
    EXPECT_EQ(row("clinker").tensile_strength, 2e6f);
    EXPECT_EQ(read(R"(
        [ice]
        density = 917
        young_modulus = 9e9
        poisson_ratio = 0.3
        tensile_strength = 1e6
        fracture_energy = 1
        crush_strength = 5e6
        restitution = 0.3
        friction = 0.1
    )"),
              "");
    EXPECT_EQ(row("ice").young_modulus, 9e9f);
}

TEST_F(ReadMaterials, AnErrorNamesFileLineMaterialKeyValueAndRangeAndChangesNothing) {
    const std::pair<const char*, const char*> cases[] = {
        {"[brick]\ndensity = 2000\n[clinker]\nlike = 'brick'\n\ndensity = -5",
         "mine.toml:6: [clinker] density is -5; use 1 to 100000 kg/m3."},
        {"[brick]\ndensity = 'heavy'", "mine.toml:2: [brick] density is \"heavy\"; use 1 to 100000 kg/m3."},
        {"[steel]\nyield_strain = -1", "mine.toml:2: [steel] yield_strain is -1; use 1e-07 to 10."},
        {"[brick]\ndensity = nan", "mine.toml:2: [brick] density is nan; use 1 to 100000 kg/m3."},
        {"[brick]\nkind = 'soft'", "mine.toml:2: [brick] kind is \"soft\"; use one of brittle, ductile, elastic."},
        {"[steel]\nmodel = 'jelly'",
         "mine.toml:2: [steel] model is \"jelly\"; use one of thick_shell, metal_shell, lattice."},
        {"[brick]\nfracture = 3", "mine.toml:2: [brick] fracture is 3; use one of large, coarse, fine."},
        {"[brick]\nweight = 3", "mine.toml:2: [brick] there is no weight; use like, kind, fracture, model, density,"},
        {"[jelly]\nlike = 'jam'", "mine.toml:2: [jelly] like is \"jam\"; use one of glass, porcelain,"},
        {"\n[jelly]\ndensity = 1000", "mine.toml:2: [jelly] is new and has no young_modulus; give it, or like ="},
        {"density = 3", "mine.toml:1: density = 3 stands outside of a material; write [name] above it."},
        {"[steel]\nyield_strain = 0.3", "mine.toml:1: material \"steel\": yield_strain is 0.3; a ductile"},
        {"[steel]\ntensile_strength = 1e9",
         "mine.toml:2: [steel] tensile_strength decides nothing in ductile materials; leave it out."},
        {"[brick]\nbreak_strain = 1e-3",
         "mine.toml:2: [brick] break_strain decides nothing in brittle materials; leave it out."},
        {"[clay]\nlike = 'brick'\nkind = 'ductile'\nyield_strain = 0.1",
         "mine.toml:1: material \"clay\": break_strain is 0; use 1e-07 to 100."},
        {"['a b']\nlike = 'brick'", "mine.toml:1: a material's name is \"a b\"; use 1 to 64 letters"},
        {"[brick]\ndensity == 3", "mine.toml:2: this is no TOML: "},
    };
    for (const auto& [text, sentence] : cases) {
        const std::string found = read(text);
        EXPECT_EQ(found.substr(0, std::string(sentence).size()), sentence);
        EXPECT_EQ(row("brick").density, 1900) << text;
    }
    EXPECT_FALSE(read_materials((folder_ / "none.toml").string(), table_).ok());
}

TEST_F(ReadMaterials, AScriptCooksWhatItsFileOrTheCommandLineAdds) {
    file("[clinker]\nlike = 'brick'\ndensity = 2850");
    const std::string script = R"(
        game.materials("mine.toml")
        local shell = game.shell_keys{material = "clinker"}
        local b = game.spawn{mesh = game.mesh.ball{radius = 0.1, subdivisions = 2}, material = shell.material}
        local c = game.spawn{mesh = game.mesh.ball{radius = 0.1, subdivisions = 2}, material = "brick", at = {1, 0, 0}}
        game.note(string.format("%.3f", b:mass() / c:mass()))
    )";
    const auto ratio = [&](const std::string& materials) {
        RunOptions options;
        options.threads = 1;
        options.materials = materials;
        const Result<GameWorld> game =
            GameWorld::create(plan_scene({"test", (folder_ / "test.lua").string(), script}, options));
        return game.ok() ? game->stage().notes.back() : game.error();
    };
    EXPECT_EQ(ratio(""), "1.500");
    EXPECT_EQ(ratio(file("[clinker]\nlike = 'brick'\ndensity = 3800", "more.toml")), "2.000");  // it has the last word
    EXPECT_NE(ratio((folder_ / "none.toml").string()).find("none.toml"), std::string::npos);
}

}  // namespace
}  // namespace cullet
