// The scenes as they stand in the program, so that it needs no files of its own. CMake writes the source.
#pragma once
#include <span>

namespace cullet {

struct EmbeddedScene {
    const char *name, *text;
};
/// By name.
std::span<const EmbeddedScene> embedded_scenes();

}  // namespace cullet
