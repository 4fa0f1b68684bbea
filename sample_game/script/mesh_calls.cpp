// game.mesh: shapes made from numbers, and those of files.
#include <fmt/format.h>

#include <filesystem>
#include <lua.hpp>
#include <new>

#include "engine/mesh_file.hpp"
#include "sample_game/import_model.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/script/arguments.hpp"
#include "sample_game/script/calls.hpp"
#include "sample_game/script/script.hpp"

namespace cullet {
namespace {

constexpr const char* kMeshName = "mesh";
constexpr Wanted kEdge{"an edge length in m from 0.0005 to 1", 0.0005, 1};
constexpr Wanted kSide{"a length in m from 0.001 to 1000", 1e-3, 1e3};

uint64_t seed_of(lua_State* lua, const Arguments& given) {
    const auto otherwise = static_cast<double>(script_of(lua).stage().seed());
    return static_cast<uint64_t>(given.number("seed", {"a whole number from 0 to 1e15", 0, 1e15}, otherwise));
}

// Work of a mesh in instructions, known only after it is made: no shape has more than some million vertices, which
// takes a second or two. A figure is remeshed, 0.6 s at its usual edge length and 40 s at the finest.
constexpr uint64_t kWorkAVertex = 5;  // 1 us in truth; twenty times as much would refuse the finest meshes
constexpr uint64_t kWorkAFigure = 1'000'000, kWorkAFile = 200'000;

size_t bytes_of(const Mesh& mesh) {
    return sizeof(ScriptMesh) + mesh.name.size() + mesh.positions.size() * sizeof(mesh.positions[0]) +
           mesh.triangles.size() * sizeof(mesh.triangles[0]) +
           mesh.corner_normals.size() * sizeof(mesh.corner_normals[0]) +
           mesh.corner_uvs.size() * sizeof(mesh.corner_uvs[0]) + mesh.materials.size() * sizeof(mesh.materials[0]);
}

int made(lua_State* lua, Mesh mesh, Edges edges = Edges::AsAskedFor) {
    push_mesh(lua, {std::move(mesh), edges, true});
    return 1;
}

int vase(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.vase", {"height", "edge", "seed"}, true);
    return made(lua,
                make_vase(given.real("height", kSide, 0.3), given.real("edge", kEdge, 0.0075), seed_of(lua, given)));
}

int piggy_bank(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.piggy_bank", {"length", "edge", "seed"}, true);
    spend(lua, kWorkAFigure);
    return made(
        lua, make_piggy_bank(given.real("length", kSide, 0.4), given.real("edge", kEdge, 0.0098), seed_of(lua, given)));
}

int wall(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.wall", {"width", "height", "edge", "seed"}, true);
    return made(lua, make_wall(given.real("width", kSide, 2.4), given.real("height", kSide, 1.8),
                               given.real("edge", kEdge, 0.078), seed_of(lua, given)));
}

int bowl(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.bowl", {"width", "wall", "around"}, true);
    const float width = given.real("width", kSide, 0.24);
    return made(lua, make_solid_bowl(width, given.real("wall", kSide, 0.006),
                                     static_cast<uint32_t>(given.number(
                                         "around", {"a whole number of points from 8 to 512", 8, 512}, 72))));
}

int pane(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.pane", {"side", "edge", "seed"}, true);
    return made(lua, make_pane(given.real("side", kSide, 0.5), given.real("edge", kEdge, 0.010), seed_of(lua, given)));
}

constexpr Wanted kVertices{"a whole number of vertices from 500 to 200000", 500, 200'000};

template <class Make>
int counted_mesh(lua_State* lua, const char* call, const char* side, double usual_side, double usual_vertices,
                 uint64_t work, Make make) {
    script_of(lua).act(lua);
    const Arguments given(lua, call, {side, "vertices", "seed"}, true);
    spend(lua, work);
    const auto vertices = static_cast<uint32_t>(given.number("vertices", kVertices, usual_vertices));
    return made(lua, make(given.real(side, kSide, usual_side), vertices, seed_of(lua, given)));
}

int pig(lua_State* lua) {
    return counted_mesh(lua, "game.mesh.pig", "length", 0.5, 3500, kWorkAFigure, make_pig);
}

int cow(lua_State* lua) {
    return counted_mesh(lua, "game.mesh.cow", "length", 0.6, 3000, kWorkAFigure, make_cow);
}

int car(lua_State* lua) {
    return counted_mesh(lua, "game.mesh.car", "length", 4.4, 14'658, kWorkAFigure, make_car);
}

int drum(lua_State* lua) {
    return counted_mesh(lua, "game.mesh.drum", "height", 0.88, 5000, kWorkAFigure, make_drum);
}

int castle(lua_State* lua) {
    return counted_mesh(lua, "game.mesh.castle", "width", 3, 6500, kWorkAFile, make_castle);
}

int slab(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.slab", {"width", "height", "thickness", "vertices", "seed"}, true);
    const Vec3 size{given.real("width", kSide, 2.4), given.real("height", kSide, 1.8),
                    given.real("thickness", kSide, 0.1)};
    return made(lua,
                make_slab(size, static_cast<uint32_t>(given.number("vertices", kVertices, 600)), seed_of(lua, given)));
}

int building(lua_State* lua, const char* call, BuildingShape shape) {
    script_of(lua).act(lua);
    const Arguments given(lua, call, {"width", "depth", "height", "roof", "edge", "windows", "seed"}, true);
    shape.width = given.real("width", kSide, static_cast<double>(shape.width));
    shape.depth = given.real("depth", kSide, static_cast<double>(shape.depth));
    shape.height = given.real("height", kSide, static_cast<double>(shape.height));
    shape.roof = given.real("roof", {"a height in m from 0 to 1000", 0, 1000}, static_cast<double>(shape.roof));
    shape.edge = given.real("edge", kEdge, static_cast<double>(shape.edge));
    shape.is_windowless = !given.is("windows", true);
    return made(lua, make_building(shape, seed_of(lua, given)));
}

int house(lua_State* lua) {
    return building(lua, "game.mesh.house", {});
}

int tower(lua_State* lua) {
    return building(lua, "game.mesh.tower", {.width = 3, .depth = 3, .height = 7, .roof = 2.2f, .is_round = true});
}

int ball(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.ball", {"radius", "subdivisions"});
    const double halvings = given.number("subdivisions", {"a whole number from 0 to 6", 0, 6}, 3);
    return made(lua, make_ball(static_cast<float>(given.number("radius", kSide)), static_cast<int>(halvings)));
}

int box(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.box", {"half_extents"});
    return made(lua, make_box(given.vector("half_extents", kSide)), Edges::AsLongAsItIs);
}

int pole(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.pole", {"radius", "height"}, true);
    return made(lua, make_pole(given.real("radius", kSide, 0.15), given.real("height", kSide, 2.4)),
                Edges::AsLongAsItIs);
}

int table(lua_State* lua) {
    script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.table", {"width", "depth", "height"}, true);
    return made(
        lua,
        make_table(given.real("width", kSide, 1.2), given.real("depth", kSide, 0.8), given.real("height", kSide, 0.75)),
        Edges::AsLongAsItIs);
}

/// As large as the file says, or scaled to `size`; the origin is the middle of its box, with `stands` of its foot.
int imported(lua_State* lua, const Arguments& given, const std::string& path) {
    spend(lua, kWorkAFile);
    Result<Mesh> mesh = import_model(path);
    if (!mesh.ok()) given.refuse(mesh.error());
    const bool has_extent =
        fit(*mesh, given.has("size") ? static_cast<float>(given.number("size", kSide)) : largest_side(*mesh));
    if (!has_extent) given.refuse(path + ": all of its points lie on one spot; give a mesh with an extent");
    const float low = extent_of(*mesh).low.y;  // before the mesh moves on: arguments have no order
    if (given.is("stands", false)) *mesh = moved(std::move(*mesh), {0, -low, 0});
    mesh->name = std::filesystem::absolute(path).string();  // as sentences name it
    if (mesh->name.size() > kLongestMeshName) mesh->name = "..." + mesh->name.substr(mesh->name.size() - 240);
    push_mesh(lua, {std::move(mesh).value(), Edges::AsLongAsItIs, false});
    return 1;
}

/// The mesh of --mesh, or nil without one.
int given_mesh(lua_State* lua) {
    Stage& stage = script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.given", {"size", "stands"}, true);
    stage.takes_mesh = true;
    if (!stage.plan.mesh_path.empty()) return imported(lua, given, stage.plan.mesh_path);
    lua_pushnil(lua);
    return 1;
}

/// Paths start at the script's folder.
int file(lua_State* lua) {
    Stage& stage = script_of(lua).act(lua);
    const Arguments given(lua, "game.mesh.file", {"path", "size", "stands"});
    const std::filesystem::path path = given.word("path", "the path of a model file");
    return imported(lua, given, (std::filesystem::path(stage.plan.scene.file).parent_path() / path).string());
}

int move(lua_State* lua) {
    ScriptMesh mesh = mesh_at(lua, 1, "mesh:move");
    mesh.mesh = moved(std::move(mesh.mesh), read_vector(lua, 2, "mesh:move: the way", kPlace));
    push_mesh(lua, std::move(mesh));
    return 1;
}

int fit_to(lua_State* lua) {
    ScriptMesh mesh = mesh_at(lua, 1, "mesh:fit");
    const double size = lua_tonumber(lua, 2);
    if (lua_type(lua, 2) != LUA_TNUMBER || !(size >= kSide.least && size <= kSide.most))
        refuse(lua, fmt::format("mesh:fit: the size is {}; expected {}", describe(lua, 2), kSide.text));
    if (!fit(mesh.mesh, static_cast<float>(size))) refuse(lua, "mesh:fit: all points lie on one spot");
    push_mesh(lua, std::move(mesh));
    return 1;
}

int size(lua_State* lua) {
    const MeshExtent extent = extent_of(mesh_at(lua, 1, "mesh:size").mesh);
    push_vector(lua, {extent.high.x - extent.low.x, extent.high.y - extent.low.y, extent.high.z - extent.low.z});
    return 1;
}

}  // namespace

void hold_mesh(lua_State* lua, const Mesh& mesh) {
    spend(lua, kWorkAVertex * mesh.positions.size());
    hold(lua, bytes_of(mesh));
}

ScriptMesh& mesh_at(lua_State* lua, int place, const std::string& what) {
    auto* mesh = static_cast<ScriptMesh*>(luaL_testudata(lua, place, kMeshName));
    if (!mesh)
        refuse(lua, fmt::format("{} is {}; expected a mesh, such as game.mesh.vase{{}}", what, describe(lua, place)));
    return *mesh;
}

void push_mesh(lua_State* lua, ScriptMesh mesh) {
    hold_mesh(lua, mesh.mesh);
    new (lua_newuserdatauv(lua, sizeof(ScriptMesh), 0)) ScriptMesh(std::move(mesh));
    luaL_setmetatable(lua, kMeshName);
}

void open_meshes(lua_State* lua) {
    luaL_newmetatable(lua, kMeshName);
    lua_pushcfunction(lua, [](lua_State* l) {
        auto* mesh = static_cast<ScriptMesh*>(lua_touserdata(l, 1));
        give_back(l, bytes_of(mesh->mesh));
        mesh->~ScriptMesh();
        return 0;
    });
    lua_setfield(lua, -2, "__gc");
    static constexpr luaL_Reg methods[] = {{"move", move}, {"fit", fit_to}, {"size", size}, {nullptr, nullptr}};
    lua_newtable(lua);
    add_calls(lua, methods);
    guard_names(lua, "mesh:");
    lua_setfield(lua, -2, "__index");
    lua_pop(lua, 1);
    static constexpr luaL_Reg calls[] = {{"vase", vase},     {"piggy_bank", piggy_bank},
                                         {"wall", wall},     {"pane", pane},
                                         {"pig", pig},       {"cow", cow},
                                         {"castle", castle}, {"slab", slab},
                                         {"ball", ball},     {"box", box},
                                         {"table", table},   {"given", given_mesh},
                                         {"file", file},     {"house", house},
                                         {"tower", tower},   {"car", car},
                                         {"drum", drum},     {"pole", pole},
                                         {"bowl", bowl},     {nullptr, nullptr}};
    lua_newtable(lua);
    add_calls(lua, calls);
    guard_names(lua, "game.mesh.");
    lua_setfield(lua, -2, "mesh");
}

}  // namespace cullet
