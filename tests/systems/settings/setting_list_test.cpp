// Every setting of every damage model, by its line: what is refused, recorded and kept follows from it.
#include "cullet/setting_list.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "components/state.hpp"
#include "systems/models.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/settings.hpp"
#include "systems/settings/bytes.hpp"
#include "systems/settings/check.hpp"
#include "systems/settings/kept.hpp"
#include "tests/support/setting_values.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet {
namespace {

using test::make_world;
using test::small_settings;
using test::small_vase;

template <class Groups, class Visit>
void each_setting(const Groups& groups, const Visit& visit) {
    for (const auto& group : groups)
        for (const Setting& setting : group.list) visit(group, setting);
}

template <class Settings>
std::string path_of(const SettingGroup<Settings>& group, const Setting& setting) {
    return std::string(group.name) + (*group.name ? "." : "") + setting.name;
}

void expect_sentence(const std::string& said, const std::string& path, const Setting& setting) {
    EXPECT_NE(said.find(path + " is "), std::string::npos) << said;
    EXPECT_TRUE(said.ends_with("; use " + range_of(setting) + ".")) << said;
}

TEST(SettingList, EveryLineHasANameHelpAndADefaultInItsRange) {
    size_t count = 0;
    const auto look = [&](const auto&, const Setting& setting) {
        ++count;
        EXPECT_GT(std::string(setting.name).size(), 3u);
        EXPECT_GT(std::string(setting.help).size(), 10u) << setting.name;
        EXPECT_TRUE(is_in_range(setting, setting.standard)) << setting.name;
        EXPECT_EQ(static_cast<float>(read_setting(setting, text_of(setting, setting.standard)).value()),
                  static_cast<float>(setting.standard))
            << setting.name;
    };
    for (const std::string& model : damage_model_names()) {
        each_setting(cook_settings_of(model), look);
        each_setting(spawn_settings_of(model), look);
    }
    EXPECT_EQ(count, 38u);
    EXPECT_TRUE(cook_settings_of("no such model").empty());
}

TEST(SettingList, ASpawnRefusesWhatIsBelowOrAboveAnyRangeWithASentence) {
    World world = make_world(small_settings());
    const ModelId model = world.add_model(small_vase()).value();
    size_t refused = 0;
    each_setting(spawn_settings_of("thick_shell"), [&](const auto& group, const Setting& setting) {
        for (const double value : test::wrong_values(setting)) {
            SpawnSettings settings;
            group.set(settings, setting, value);
            const Result<BodyId> body = world.spawn(model, settings);
            ASSERT_FALSE(body.ok()) << setting.name << " " << value;
            expect_sentence(body.error(), path_of(group, setting), setting);
            ++refused;
        }
        for (const double value : test::right_values(setting)) {
            SpawnSettings settings;
            group.set(settings, setting, value);
            const Result<void> valid = check_settings(spawn_settings_of("thick_shell"), settings);
            EXPECT_TRUE(valid.ok()) << valid.error();
        }
    });
    EXPECT_GT(refused, 24u);
    EXPECT_EQ(world.bodies(nullptr, 0), 0u);
}

TEST(SettingList, CookingRefusesWhatIsOutOfAnyRangeWithASentence) {
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint32_t triangle[] = {0, 1, 2};
    const MeshView mesh{corners, 3, triangle, 1};
    size_t refused = 0;
    each_setting(cook_settings_of("thick_shell"), [&](const auto& group, const Setting& setting) {
        for (const double value : test::wrong_values(setting)) {
            CookSettings settings;
            group.set(settings, setting, value);
            const Result<Model> model = cook(mesh, settings);
            ASSERT_FALSE(model.ok()) << setting.name << " " << value;
            expect_sentence(model.error(), path_of(group, setting), setting);
            ++refused;
        }
    });
    EXPECT_GE(refused, 1u);
}

/// Other than they are when nothing is given.
SpawnSettings changed_settings() {
    SpawnSettings settings;
    each_setting(spawn_settings_of("thick_shell"), [&](const auto& group, const Setting& setting) {
        for (const double value : test::right_values(setting))
            if (value != setting.standard) group.set(settings, setting, value);
    });
    return settings;
}

TEST(SettingList, ARecordingHoldsEverySettingInTheBytesThatItAlwaysHad) {
    const SpawnSettings settings = changed_settings();
    const auto groups = spawn_settings_of("thick_shell");
    ByteWriter written, before;
    put_settings(written, groups, settings);
    const ThickShellSpawnSettings& s = settings.thick_shell;
    before.number(static_cast<uint8_t>(s.fracture));
    before.number(s.quick.layers), before.number(s.quick.steps), before.number(s.quick.crack_frequency);
    before.number(s.quick.strain_limit), before.number(s.quick.compression_limit);
    before.number(s.quick.crack_length), before.number(s.quick.bump_angle);
    before.number(static_cast<uint8_t>(s.springs.layout));
    before.number(s.springs.length_factor), before.number(s.springs.area_energy),
        before.number(s.springs.volume_energy);
    EXPECT_EQ(written.bytes, before.bytes);
    SpawnSettings taken;
    ByteReader in(written.bytes, "bytes", "");
    take_settings(in, groups, taken);
    EXPECT_TRUE(in.is_sound() && in.is_at_end());
    each_setting(groups, [&](const auto& group, const Setting& setting) {
        EXPECT_EQ(group.get(taken, setting), group.get(settings, setting)) << setting.name;
        EXPECT_NE(group.get(taken, setting), setting.standard) << setting.name;
    });
}

/// What the row holds in the column of that name.
double number_in(const AnyTable& table, uint32_t row, const std::string& name) {
    for (const ColumnInfo& c : table.columns()) {
        if (c.name != name) continue;
        const std::byte* at = table.column_memory(c, 0) + size_t{row} * c.row_bytes;
        if (c.scalar == Scalar::U8) return static_cast<double>(*at);
        if (c.scalar == Scalar::U16) return *reinterpret_cast<const uint16_t*>(at);
        return static_cast<double>(*reinterpret_cast<const float*>(at));
    }
    ADD_FAILURE() << table.name() << " has no column " << name;
    return 0;
}

TEST(SettingList, ABodyAndItsRunKeepEverySettingUnderItsName) {
    const auto state = std::make_unique<State>();
    const ThickShellSpawnSettings s = changed_settings().thick_shell;
    const Row<Bodies> body{2};
    const Row<Tasks> task{1};
    set_fracture(*state, body, FractureMode::Quick, s.quick, s.springs);
    set_quick_task(*state, task, body);
    const auto look = [&](const SettingList& list, const void* settings) {
        for (const Setting& setting : list) {
            const double degree = std::string(setting.unit) == "degrees" ? 0.017453292519943295 : 1;
            const double wanted = degree * setting.get(settings);
            EXPECT_NEAR(number_in(state->quick_bodies, body, setting.name), wanted, 1e-6 * wanted) << setting.name;
            EXPECT_EQ(number_in(state->quick_runs, task, setting.name),
                      number_in(state->quick_bodies, body, setting.name))
                << setting.name;
        }
        EXPECT_EQ(trouble_of_kept(state->quick_bodies, body, list), "");
        EXPECT_EQ(trouble_of_kept(state->quick_runs, task, list), "");
    };
    look(setting_list<QuickSettings>(), &s.quick);
    look(setting_list<LayerSettings>(), &s.springs);
    EXPECT_TRUE(is_quick_task(*state, task));
    EXPECT_EQ(state->quick_runs.softening[task], 1);
}

TEST(SettingList, ARowThatNoCallWouldHaveLetInIsNamed) {
    const auto state = std::make_unique<State>();
    const auto look = [&](const SettingList& list) {
        for (const Setting& setting : list)
            for (const double value : test::wrong_values(setting)) {
                // As radians the nearest number above 30 degrees is that of 30 degrees.
                if (std::string(setting.unit) == "degrees" && std::abs(value - setting.most) < 1e-4) continue;
                set_fracture(*state, Row<Bodies>{0}, FractureMode::Quick, {}, {});
                QuickSettings quick;
                LayerSettings layers;
                void* const settings = list.data == setting_list<QuickSettings>().data ? static_cast<void*>(&quick)
                                                                                       : static_cast<void*>(&layers);
                setting.set(settings, value);
                keep_settings(state->quick_bodies, 0, list, settings);
                const std::string said = trouble_of_kept(state->quick_bodies, 0, list);
                EXPECT_TRUE(said.starts_with(std::string("quick_bodies.") + setting.name + "[0] is ")) << said;
            }
    };
    look(setting_list<QuickSettings>());
    look(setting_list<LayerSettings>());
    set_fracture(*state, Row<Bodies>{0}, FractureMode::Quick, {}, {});
    state->quick_bodies.steps[0] = 7;
    EXPECT_EQ(trouble_of_kept(state->quick_bodies, 0, setting_list<QuickSettings>()),
              "quick_bodies.steps[0] is 7; use 8 to 100");
}

TEST(SettingList, RangesAndValuesAreSaidInWords) {
    const SettingList quick = setting_list<QuickSettings>(), springs = setting_list<LayerSettings>();
    EXPECT_EQ(range_of(quick.data[0]), "1 or 2");
    EXPECT_EQ(range_of(quick.data[1]), "8 to 100");
    EXPECT_EQ(range_of(quick.data[3]), "0, or 1e-05 to 1");
    EXPECT_EQ(range_of(quick.data[6]), "0 to 30 degrees");
    EXPECT_EQ(range_of(springs.data[0]), "sandwich or crossed");
    EXPECT_EQ(text_of(springs.data[0], 1), "crossed");
    EXPECT_EQ(range_of(setting_list<ThickShellCookSettings>().data[1]), "true or false");
    EXPECT_TRUE(is_in_range(springs.data[1], 0.577) && is_in_range(springs.data[1], 0));
    EXPECT_FALSE(is_in_range(springs.data[1], 0.5769));
    EXPECT_EQ(read_setting(springs.data[0], "tied").error(), "layout is \"tied\"; use sandwich or crossed.");
    EXPECT_EQ(read_setting(quick.data[1], "8.5").error(), "steps is \"8.5\"; use 8 to 100.");
}

}  // namespace
}  // namespace cullet
