// The pictures of a run: single frames, twelve of them on a contact sheet, and a film.
#pragma once
#include <vector>

#include "sample_game/film.hpp"
#include "sample_game/framing.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/options.hpp"
#include "sample_game/unmoved.hpp"

namespace cullet {

/// Twelve frames that tell the story; evenly spread when the run ends before the story does, or the script names none.
std::vector<uint32_t> sheet_frames(const Story& story, double step_seconds, uint32_t frames);

class Pictures {
 public:
    Pictures(const Story& story, uint32_t threads, const RunOptions& options, uint32_t frames);

    /// Draws the world as it stands, if its frame is wanted: frame n is after n steps. Once a frame.
    Result<void> take(const GameWorld& game);
    /// Writes the sheet and ends the film.
    Result<void> finish();

 private:
    const RunOptions& options_;
    uint32_t threads_;
    std::vector<uint32_t> sheet_frames_;
    std::vector<Picture> tiles_;
    Film film_;
    Unmoved unmoved_;
    Framing framing_;      // for scenes that name no camera
    uint32_t film_every_;  // frames: about 30 pictures a second
};

}  // namespace cullet
