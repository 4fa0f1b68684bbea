// sample_game replay: a recording is played again and compared.
#pragma once
#include "sample_game/options.hpp"

namespace cullet {

/// 0: every step gave its hash; 1: one did not, or the file is damaged from some byte on; 2: it is no recording.
int replay_command(const ReplayOptions& options);

}  // namespace cullet
