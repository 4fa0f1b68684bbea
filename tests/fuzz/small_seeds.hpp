// The things that good files are made of: small enough to be read some hundred times a second.
#pragma once
#include "cullet/world.hpp"
#include "engine/mesh.hpp"

namespace cullet::fuzz {

/// A globe of 80 triangles; with texture coordinates, normals and materials, or without.
Mesh globe(bool has_corners);
/// Glass, 4 mm.
const Model& glass_globe();
/// Steel, 1 mm: a metal shell.
const Model& steel_globe();
Settings small_settings();
/// Its allocator keeps what is given back for the next world, which the system's takes most of the time to do. Blocks
/// come from malloc: the address sanitizer sees what is read or written behind a table's last row.
const Host& frugal_host();
/// A floor, a globe that lies on it, and another one with a ball on its way to it.
World globes_and_ball(const Model& of);
/// The same two globes where the host moves the bodies.
World hosted_globes();

/// Ends the program with the sentence when there is no value: the good files are our own.
template <class T>
T value_of(Result<T> result);
[[noreturn]] void give_up(const std::string& sentence);

template <class T>
T value_of(Result<T> result) {
    if (!result) give_up(result.error());
    return std::move(result).value();
}

}  // namespace cullet::fuzz
