// What a script may call: globals wait, at, every, and the table game.
#pragma once
#include <cstdint>
#include <string>

#include "cullet/world.hpp"
#include "engine/mesh.hpp"

struct lua_State;

namespace cullet {

struct Stage;

/// Adds all of them.
void open_calls(lua_State* lua);

// Each adds its own to the table on top of the stack.
void open_declarations(lua_State* lua);  // scene, key, shell_keys, setting ...
void open_meshes(lua_State* lua);        // mesh.vase ...
void open_bodies(lua_State* lua);        // cook, spawn, throw, kinematic, and what a body can be asked
void open_surroundings(lua_State* lua);  // floor, box, static, camera, sun
void open_blows(lua_State* lua);         // explode, cut
void open_body_blows(lua_State* lua);    // to the methods of a body: cut, push_impact
void open_costs(lua_State* lua);         // retire, cost
void open_queries(lua_State* lua);       // expect, fragments, mass, random ...

/// Cooking leaves edges that were asked for, and splits long ones of all else: twelve triangles do not crack.
enum class Edges : uint8_t { AsAskedFor, AsLongAsItIs };
/// A mesh as a script holds it.
struct ScriptMesh {
    Mesh mesh;
    Edges edges = Edges::AsLongAsItIs;
    bool is_made_here = false;
};
ScriptMesh& mesh_at(lua_State* lua, int place, const std::string& what);
void push_mesh(lua_State* lua, ScriptMesh mesh);
/// Counts the work and the memory of a mesh that the script has made or keeps.
void hold_mesh(lua_State* lua, const Mesh& mesh);

/// The place in Stage::models of what game.cook returned.
uint32_t cooked_at(lua_State* lua, int place, const std::string& what);

void push_body(lua_State* lua, BodyId id);
/// Null when the value is no body.
BodyId* body_at(lua_State* lua, int place);

/// A sentence for the report; it counts as memory of the script.
void add_note(lua_State* lua, const std::string& sentence);

/// The world, made if it is not there; a refusal of the settings ends the script.
World& world_of(lua_State* lua, const char* call);

/// Pushes the n-th event of that name as a table; false when there is none, and pushes nothing.
bool push_event(lua_State* lua, const World& world, const std::string& event, uint32_t n);

}  // namespace cullet
