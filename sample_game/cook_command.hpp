// `sample_game cook`: a stranger's mesh becomes a model file.
#pragma once
#include "sample_game/options.hpp"

namespace cullet {

/// The exit code: 0, or 2 after one sentence on standard error.
int cook_command(const CookOptions& options);

}  // namespace cullet
