// report.html: a run on one page, to be opened in any browser, with nothing loaded from elsewhere.
#pragma once
#include <string>

#include "sample_game/options.hpp"
#include "sample_game/report.hpp"

namespace cullet {

/// Times of frames with the budget as a line, the contact sheet and the film where the run made them, numbers, notes.
std::string report_page(const Report& report, const RunOptions& options);

}  // namespace cullet
