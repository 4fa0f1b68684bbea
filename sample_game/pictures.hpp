// The pictures of a run: single frames, and twelve of them on a contact sheet.
#pragma once
#include <vector>

#include "sample_game/game_world.hpp"
#include "sample_game/options.hpp"

namespace cullet {

/// Twelve frames that tell the scene's story; evenly spread when the run ends before the story does.
std::vector<uint32_t> sheet_frames(const Scene& scene, double step_seconds, uint32_t frames);

class Pictures {
 public:
    Pictures(const Scene& scene, const ScenePlan& plan, const RunOptions& options, uint32_t frames);

    /// Draws the world as it stands, if its frame is wanted: frame n is after n steps.
    Result<void> take(const GameWorld& game);
    /// Writes the sheet.
    Result<void> finish();

 private:
    const RunOptions& options_;
    uint32_t threads_;
    std::vector<uint32_t> sheet_frames_;
    std::vector<Picture> tiles_;
};

}  // namespace cullet
