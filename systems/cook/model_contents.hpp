// A cooked model: tables of its own that hold one shell.
#pragma once
#include "components/workbench.hpp"
#include "cullet/model.hpp"
#include "engine/mesh.hpp"

namespace cullet {

struct Model::Contents {
    explicit Contents(const Limits& limits) : state(limits) {}
    Workbench state;  // the first materials and its own, and the rows of one shell
    Row<Structures> shell;
    std::string name, material, damage_model;
    ModelReport report;
};

struct MeshData::Contents {
    Mesh mesh;
    std::vector<uint32_t> indices;  // flat, as the view gives them
};

/// Room for a shell of so many vertices and elements and two damage tasks on it.
Limits cooking_limits(uint32_t vertices, uint32_t elements);

/// Copies a shell between states; kNone and the limit's name when there is no room.
Row<Structures> import_bare_shell(ShellRows& to, const ShellRows& from, Row<Structures> shell, const char** full);
/// With what it has as metal, if it is of metal.
Row<Structures> import_shell(MetalShellRows to, Read<MetalShellRows> from, Row<Structures> shell, const char** full);

}  // namespace cullet
