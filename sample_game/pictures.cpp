#include "sample_game/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sample_game/draw_world.hpp"
#include "sample_game/sheet.hpp"

namespace cullet {

std::vector<uint32_t> sheet_frames(const Story& story, double step_seconds, uint32_t frames) {
    std::vector<uint32_t> list;
    for (const uint32_t frame : story.sheet_frames)
        list.push_back(static_cast<uint32_t>(std::lround(frame / 60.0 / step_seconds)));
    if (!list.empty() && list.back() <= frames) return list;
    list.clear();
    for (uint32_t tile = 0; tile < 12; ++tile) list.push_back(static_cast<uint32_t>(uint64_t{frames} * tile / 11));
    return list;
}

Pictures::Pictures(const Story& story, uint32_t threads, const RunOptions& options, uint32_t frames)
    : options_(options),
      threads_(threads),
      film_every_(static_cast<uint32_t>(std::max(1l, std::lround(1000.0 / 30 / options.dt_ms)))) {
    if (options.has_sheet) sheet_frames_ = sheet_frames(story, 0.001 * options.dt_ms, frames);
    tiles_.resize(sheet_frames_.size());
}

Result<void> Pictures::take(const GameWorld& game) {
    const auto frame = static_cast<uint32_t>(game.frame());
    const bool has_camera = game.stage().has_camera;
    const bool has_pictures = options_.draw > 0 || options_.has_video || !tiles_.empty();
    if (has_pictures) unmoved_.remember(game);
    if (!has_camera && has_pictures) framing_.follow(game);
    const bool is_single = options_.draw > 0 && frame % options_.draw == 0;
    const bool is_filmed = options_.has_video && frame % film_every_ == 0;
    const bool is_tile = std::find(sheet_frames_.begin(), sheet_frames_.end(), frame) != sheet_frames_.end();
    if (!is_single && !is_tile && !is_filmed) return {};
    const Picture picture = draw_world(game, has_camera ? game.stage().camera : framing_.camera(), options_.look,
                                       threads_, options_.width, unmoved_);
    for (size_t t = 0; t < tiles_.size(); ++t)
        if (sheet_frames_[t] == frame) tiles_[t] = picture;
    if (is_filmed)
        if (auto added = film_.add(picture, options_.out + "/film.mp4", 1000 / (options_.dt_ms * film_every_));
            !added.ok())
            return added;
    if (!is_single) return {};
    return write_png(picture, fmt::format("{}/frame_{:06}.png", options_.out, frame));
}

Result<void> Pictures::finish() {
    if (auto ended = film_.finish(); !ended.ok()) return ended;
    if (tiles_.empty()) return {};
    std::vector<SheetTile> tiles;
    for (size_t t = 0; t < tiles_.size(); ++t) tiles.push_back({&tiles_[t], sheet_frames_[t]});
    return write_png(contact_sheet(tiles, {}), options_.out + "/sheet.png");
}

}  // namespace cullet
