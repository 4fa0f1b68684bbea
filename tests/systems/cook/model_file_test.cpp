#include "systems/cook/model_file.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "cullet/world.hpp"
#include "engine/checksum.hpp"
#include "engine/random.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

constexpr size_t kHeader = 64;

Result<Model> parse_model_file(std::span<const uint8_t> bytes, const std::string& name) {
    return cullet::parse_model_file(bytes, name, *damage_models());
}

/// A globe with texture coordinates and materials, some of its vertices in padded packs.
const Model& sample() {
    static const Model model = [] {
        const Mesh mesh = test::sphere_mesh(0.1, 2);
        std::vector<Vec2> uvs;
        std::vector<uint16_t> materials;
        for (const auto& triangle : mesh.triangles) {
            for (const uint32_t v : triangle) uvs.push_back({mesh.positions[v].x, mesh.positions[v].y});
            materials.push_back(mesh.positions[triangle[0]].z > 0 ? 9 : 2);
        }
        MeshView view;
        view.positions = mesh.positions.data(), view.position_count = mesh.positions.size();
        view.indices = mesh.triangles[0].data(), view.triangle_count = mesh.triangles.size();
        view.corner_uvs = uvs.data(), view.materials = materials.data();
        view.name = "globe";
        CookSettings settings;
        settings.material = "glass";
        settings.thickness = 0.004f;
        settings.longest_edge = 0.05f;
        settings.thick_shell.measures_threshold = false;
        Result<Model> cooked = cook(view, settings);
        EXPECT_TRUE(cooked.ok()) << cooked.error();
        return std::move(cooked).value();
    }();
    return model;
}

const std::vector<uint8_t>& good_bytes() {
    static const std::vector<uint8_t> bytes = encode_model_file(*sample().contents);
    return bytes;
}

template <class T>
void put(std::vector<uint8_t>& bytes, size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// Makes size and checksums fit again, so that the checks behind them are reached.
void seal(std::vector<uint8_t>& bytes) {
    const std::span<const uint8_t> all = bytes;
    put(bytes, 16, uint64_t{bytes.size() - kHeader});
    put(bytes, 32, checksum_of(all.subspan(kHeader)));
    put(bytes, 48, checksum_of(all.first(48)));
}

void expect_refused(std::span<const uint8_t> bytes, const std::string& part = "") {
    const Result<Model> result = parse_model_file(bytes, "vase.cmodel");
    ASSERT_FALSE(result.ok()) << part;
    EXPECT_EQ(result.error().rfind("vase.cmodel: ", 0), 0u) << result.error();
    EXPECT_NE(result.error().find(part), std::string::npos) << result.error();
    EXPECT_EQ(result.error().find('\n'), std::string::npos);
    EXPECT_EQ(result.error().back(), '.') << result.error();
}

/// Refused, or a model that says again what the file said.
bool is_refused_or_the_same(std::span<const uint8_t> bytes) {
    const Result<Model> result = parse_model_file(bytes, "vase.cmodel");
    if (!result.ok()) return true;
    const std::vector<uint8_t> again = encode_model_file(*result->contents);
    return again.size() == bytes.size() && std::memcmp(again.data(), bytes.data(), bytes.size()) == 0;
}

/// Thrown on the floor; the hash after each frame.
std::vector<uint64_t> hashes_of_a_fall(const Model& model, int frames, uint32_t* fragments = nullptr) {
    Settings settings;
    settings.units_a_frame = 100'000'000;
    settings.limits = {64, 2, 1u << 14, 1u << 15, 2, 1u << 17, 256};
    World world = std::move(World::create(settings)).value();
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    MeshView floor;
    floor.positions = corners, floor.position_count = 4, floor.indices = quad, floor.triangle_count = 2;
    EXPECT_TRUE(world.add_static(floor).ok());
    SpawnSettings spawn;
    spawn.pose.position = {0, 0.2f, 0};
    spawn.motion.velocity = {0, -30, 0};
    EXPECT_TRUE(world.spawn(world.add_model(model).value(), spawn).ok());
    std::vector<uint64_t> hashes;
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        hashes.push_back(world.hash());
        for (const FragmentBornEvent& born : world.events().fragments_born)
            if (fragments) *fragments += born.mass > 0;
    }
    return hashes;
}

TEST(ModelFile, AWorldOfTheReadModelRunsAsOneOfTheCooked) {
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    ASSERT_TRUE(read.ok()) << read.error();
    uint32_t fragments = 0;
    const auto cooked_hashes = hashes_of_a_fall(sample(), 20, &fragments);
    EXPECT_GT(fragments, 1u);
    EXPECT_EQ(cooked_hashes, hashes_of_a_fall(*read, 20));
}

TEST(ModelFile, ReportAndNamesComeBack) {
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    ASSERT_TRUE(read.ok()) << read.error();
    const ModelReport &a = sample().report(), &b = read->report();
    EXPECT_EQ(read->contents->name, "globe");
    EXPECT_EQ(read->contents->material, "glass");
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.first_crack_speed, b.first_crack_speed);
    EXPECT_EQ(a.units_of_a_hit, b.units_of_a_hit);
    EXPECT_EQ(a.repairs, b.repairs);
    EXPECT_EQ(a.advice, b.advice);
    EXPECT_EQ(encode_model_file(*read->contents), good_bytes());
}

TEST(ModelFile, AModelWithAMeasuredThresholdAndBordersComesBack) {
    const Mesh mesh =
        test::grid_mesh(8, 6, false, false, [](uint32_t i, uint32_t j) { return Vec3d(0.03 * i, 0.03 * j, 0); });
    MeshView view;
    view.positions = mesh.positions.data(), view.position_count = mesh.positions.size();
    view.indices = mesh.triangles[0].data(), view.triangle_count = mesh.triangles.size();
    CookSettings settings;
    settings.thickness = 0.006f;
    settings.longest_edge = 0.1f;
    const Result<Model> model = cook(view, settings);
    ASSERT_TRUE(model.ok()) << model.error();
    const std::vector<uint8_t> bytes = encode_model_file(*model->contents);
    const Result<Model> read = parse_model_file(bytes, "t");
    ASSERT_TRUE(read.ok()) << read.error();
    EXPECT_EQ(encode_model_file(*read->contents), bytes);
}

TEST(ModelFile, EveryTruncationIsRefused) {
    const std::vector<uint8_t>& good = good_bytes();
    for (size_t size = 0; size < good.size(); size += size < 4096 ? 1 : 499)
        ASSERT_FALSE(parse_model_file(std::span(good).first(size), "t").ok()) << size;
    for (size_t size = good.size() - 256; size < good.size(); ++size)
        ASSERT_FALSE(parse_model_file(std::span(good).first(size), "t").ok()) << size;
}

TEST(ModelFile, EveryTruncationUnderFittingChecksumsIsRefused) {
    const std::vector<uint8_t>& good = good_bytes();
    for (size_t size = kHeader; size < good.size(); size += size < 2048 ? 13 : 4093) {
        std::vector<uint8_t> bytes(good.begin(), good.begin() + static_cast<ptrdiff_t>(size));
        seal(bytes);
        ASSERT_FALSE(parse_model_file(bytes, "t").ok()) << size;
    }
    std::vector<uint8_t> longer = good;
    longer.push_back(0);
    expect_refused(longer);
    seal(longer);
    expect_refused(longer, "the last table ends before the file does");
}

TEST(ModelFile, TwoThousandFlippedBytesAreRefused) {
    const Random random{5};
    for (uint32_t i = 0; i < 2000; ++i) {
        std::vector<uint8_t> bytes = good_bytes();
        const size_t at = random.bits(i, 0) % bytes.size();
        bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1 + random.bits(i, 1) % 255));
        ASSERT_FALSE(parse_model_file(bytes, "t").ok()) << at;
    }
}

TEST(ModelFile, AFlippedByteUnderFittingChecksumsIsRefusedOrAModelThatRuns) {
    const Random random{6};
    const uint32_t flips = test::few_or_all(200u, 400u);
    uint32_t refused = 0;
    for (uint32_t i = 0; i < flips; ++i) {
        std::vector<uint8_t> bytes = good_bytes();
        // Half of them in the texts, counts and the shell's own row, where there is most to break.
        const size_t at = kHeader + random.bits(i, 0) % ((i % 2 ? bytes.size() : size_t{2048}) - kHeader);
        bytes[at] = static_cast<uint8_t>(bytes[at] ^ (1 + random.bits(i, 1) % 255));
        seal(bytes);
        ASSERT_TRUE(is_refused_or_the_same(bytes)) << at;
        const Result<Model> read = parse_model_file(bytes, "t");
        refused += !read.ok();
        if (read.ok() && i % 8 == 1) hashes_of_a_fall(*read, 4);
    }
    EXPECT_GT(refused, flips / 4);
}

/// Where the table's number of rows stands: after its name.
size_t rows_of(const std::vector<uint8_t>& bytes, const std::string& table, const std::string& first_column) {
    // Name, rows, columns, name of the first column, in the file's form.
    for (size_t at = kHeader; at + 64 < bytes.size(); ++at) {
        const auto* text = reinterpret_cast<const char*>(bytes.data()) + at;
        if (std::memcmp(text, table.data(), table.size()) != 0) continue;
        if (std::memcmp(text + table.size() + 12, first_column.data(), first_column.size()) == 0)
            return at + table.size();
    }
    ADD_FAILURE() << table;
    return 0;
}

TEST(ModelFile, ForgedCountsUnderFittingChecksumsAreRefused) {
    State state(Limits{1, 1, 64, 64, 1, 1, 64, 1});
    std::vector<const AnyTable*> tables{&state.shells,           &state.vertices,        &state.elements,
                                        &state.triangle_springs, &state.hinges,          &state.stiffness_packs,
                                        &state.stiffness_blocks, &state.stiffness_links, &state.cells,
                                        &state.hull_points};
    for (const AnyTable* table : tables) {
        const size_t at = rows_of(good_bytes(), table->name(), table->columns()[0].name);
        uint32_t rows = 0;
        std::memcpy(&rows, good_bytes().data() + at, 4);
        for (const uint32_t forged :
             {0u, 1u, rows - 1, rows + 1, rows + 8, 2 * rows, 0x10000000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
            if (forged == rows) continue;
            std::vector<uint8_t> bytes = good_bytes();
            put(bytes, at, forged);
            seal(bytes);
            expect_refused(bytes);
        }
        for (const uint32_t columns : {0u, 1u, 0xffffffffu}) {
            if (columns == 1 && table->columns().size() == 1) continue;
            std::vector<uint8_t> bytes = good_bytes();
            put(bytes, at + 4, columns);
            seal(bytes);
            expect_refused(bytes);
        }
    }
}

TEST(ModelFile, ForgedLengthsOfTextsAreRefused) {
    for (const uint32_t length : {4097u, 0x7fffffffu, 0xffffffffu}) {
        std::vector<uint8_t> bytes = good_bytes();
        put(bytes, kHeader, length);
        seal(bytes);
        expect_refused(bytes, "bytes of text");
    }
    std::vector<uint8_t> bytes = good_bytes();
    bytes[kHeader + 4] = '\n';
    seal(bytes);
    expect_refused(bytes, "control character 10");
}

/// Calls with every State column of the model's rows but the shell's ranges.
template <class F>
void for_each_column(Model::Contents& contents, F&& f) {
    Workbench& s = contents.state;
    const Shells& shells = s.shells;
    const Row<Shells> shell = s.shell_of(contents.shell);
    const std::pair<AnyTable*, Range> parts[] = {{&s.structures, {contents.shell, 1, 1}},
                                                 {&s.shells, {shell, 1, 1}},
                                                 {&s.vertices, shells.vertices[shell]},
                                                 {&s.elements, shells.elements[shell]},
                                                 {&s.triangle_springs, shells.elements[shell]},
                                                 {&s.hinges, shells.hinges[shell]},
                                                 {&s.stiffness_packs, shells.packs[shell]},
                                                 {&s.stiffness_blocks, shells.blocks[shell]},
                                                 {&s.stiffness_links, shells.links[shell]},
                                                 {&s.cells, s.structures.cells[contents.shell]},
                                                 {&s.hull_points, s.structures.points[contents.shell]}};
    for (const auto& [table, range] : parts)
        for (const ColumnInfo& c : table->columns()) {
            const bool is_range =
                (table == &s.structures || table == &s.shells) && c.components == 3 && c.scalar == Scalar::U32;
            if (c.is_state() && !is_range && range.count > 0) f(*table, c, range);
        }
}

TEST(ModelFile, AValueOutOfItsRangeInAnyColumnIsRefused) {
    // Whatever stands in these does no harm: ids of the game, and numbers that are written before they are read.
    const std::set<std::string> free{"elements.part", "elements.drawn_material", "vertices.crack_start"};
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    ASSERT_TRUE(read.ok()) << read.error();
    auto& contents = const_cast<Model::Contents&>(*read->contents);
    uint32_t columns = 0;
    for_each_column(contents, [&](AnyTable& table, const ColumnInfo& c, const Range& range) {
        const std::string full = std::string(table.name()) + "." + c.name;
        for (const uint32_t row : {0u, range.count / 2, range.count - 1})
            for (int a = 0; a < c.lanes * c.sides; ++a) {
                std::byte* place = table.column_memory(c, a) + size_t{range.first + row} * c.row_bytes;
                const std::vector<std::byte> before(place, place + c.row_bytes);
                std::memset(place, 0xff, c.row_bytes);  // not a number, or an index far out
                const bool is_changed = std::memcmp(place, before.data(), before.size()) != 0;  // a padding row
                if (is_changed && full != "structures.users" && full != "structures.rows") {    // the writer sets them
                    const Result<Model> result = parse_model_file(encode_model_file(contents), "vase.cmodel");
                    EXPECT_EQ(result.ok(), free.count(full) > 0) << full << " " << row;
                    EXPECT_TRUE(result.ok() || result.error().ends_with("write it.")) << result.error();
                    EXPECT_TRUE(result.ok() || result.error().find(". at byte") == std::string::npos) << result.error();
                }
                std::memcpy(place, before.data(), before.size());
            }
        ++columns;
    });
    EXPECT_GT(columns, 60u);
    EXPECT_EQ(encode_model_file(contents), good_bytes());
}

TEST(ModelFile, AnInfiniteOrNegativeNumberIsNamed) {
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    auto& contents = const_cast<Model::Contents&>(*read->contents);
    Workbench& s = contents.state;
    const uint32_t vertex = s.shells.vertices[s.shell_of(contents.shell)].first;
    const auto refuses = [&](float& value, float wrong, const std::string& part) {
        const float before = value;
        value = wrong;
        expect_refused(encode_model_file(contents), part);
        value = before;
    };
    refuses(s.vertices.depth[vertex + 3], -0.001f, "vertices.depth[3] is -0.001");
    refuses(s.vertices.depth[vertex + 3], std::numeric_limits<float>::infinity(), "vertices.depth[3] is inf");
    refuses(s.shells.time_step[s.shell_of(contents.shell)], 0, "shells.time_step[0] is 0");
    refuses(s.vertices.inverse_mass[vertex], 1, "vertices.inverse_mass[0] is 1");
    refuses(s.shells.thickness[s.shell_of(contents.shell)], 1, "thickness");
    double& mass = s.structures.mass[contents.shell];
    mass = -mass;
    expect_refused(encode_model_file(contents), "structures.mass[0] is -");
}

TEST(ModelFile, LinksThatDoNotLeadBackAreRefused) {
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    auto& contents = const_cast<Model::Contents&>(*read->contents);
    const uint32_t first = contents.state.shells.elements[contents.state.shell_of(contents.shell)].first;
    Elements& elements = contents.state.elements;
    const auto refuses = [&](auto& value, auto wrong, const std::string& part) {
        const auto before = value;
        value = wrong;
        expect_refused(encode_model_file(contents), part);
        value = before;
    };
    std::swap(elements.neighbour[first][0], elements.neighbour[first][1]);
    expect_refused(encode_model_file(contents), "elements.neighbour[0]");
    std::swap(elements.neighbour[first][0], elements.neighbour[first][1]);
    refuses(elements.neighbour[first][2], kNone, "elements.edge_kind[0]");
    refuses(elements.corner[first][1], elements.corner[first][0], "elements.corner[0]");
    refuses(elements.hinge[first][0], elements.hinge[first][1], "elements.hinge[0]");
    refuses(elements.cell[first], 1u, "elements.cell");
    Hinges& hinges = contents.state.hinges;
    auto& held = hinges.vertex[contents.state.shells.hinges[contents.state.shell_of(contents.shell)].first];
    refuses(held[0], held[2], "hinges.vertex[0]");
    const uint32_t vertex = contents.state.shells.vertices[contents.state.shell_of(contents.shell)].first;
    refuses(contents.state.vertices.element[vertex], kNone, "vertices.element[0]");
    StiffnessPacks& packs = contents.state.stiffness_packs;
    refuses(packs.first_block[1], packs.first_block[0], "two packs use the slot");
    refuses(packs.block_count[0], uint16_t{1000}, "stiffness_packs.first_block[0]");
}

TEST(ModelFile, OtherFilesVersionsAndMaterialsAreToldApart) {
    expect_refused(std::vector<uint8_t>{'P', 'K', 3, 4}, "is no model file");
    std::vector<uint8_t> bytes = good_bytes();
    put(bytes, 8, 11u);
    expect_refused(bytes, "has version 11, this build reads version 14");
    const Result<Model> read = parse_model_file(good_bytes(), "t");
    auto& contents = const_cast<Model::Contents&>(*read->contents);
    contents.material = "a jelly";
    expect_refused(encode_model_file(contents), "a material's name is \"a jelly\"");
    contents.material = "jelly";
    Materials& materials = contents.state.materials;
    materials.poisson_ratio[contents.state.structures.material[contents.shell]] = 0.7f;
    expect_refused(encode_model_file(contents), "poisson_ratio is 0.7");
}

TEST(ModelFile, AFileIsWrittenWholeAndReadAgain) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "cullet_model_file_test";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    const std::string path = (folder / "globe.cmodel").string();
    ASSERT_TRUE(write_model(sample(), path).ok());
    ASSERT_TRUE(write_model(sample(), path).ok());  // over itself
    const Result<Model> read = read_model(path);
    ASSERT_TRUE(read.ok()) << read.error();
    EXPECT_EQ(encode_model_file(*read->contents), good_bytes());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);  // nothing half written beside it
    EXPECT_FALSE(read_model((folder / "none.cmodel").string()).ok());
    EXPECT_FALSE(read_model(folder.string()).ok());
    EXPECT_FALSE(write_model(sample(), (folder / "no" / "x.cmodel").string()).ok());
    EXPECT_FALSE(write_model(Model{}, path).ok());
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cullet
