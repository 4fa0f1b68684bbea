#include "sample_game/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "engine/profiler.hpp"

namespace cullet {
namespace {

constexpr uint64_t kBarEvery = 50'000'000, kLineEvery = 5'000'000'000;  // ns
constexpr int kBarWidth = 32;

}  // namespace

Progress::Progress(std::string title)
    : title_(std::move(title)),
      is_terminal_(isatty(STDERR_FILENO) == 1),
      started_ns_(now_ns()),
      shown_ns_(started_ns_) {}

Progress::~Progress() {
    if (has_bar_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(double share, const std::string& detail) {
    const uint64_t now = now_ns();
    if (now - shown_ns_ < (is_terminal_ ? kBarEvery : kLineEvery)) return;
    shown_ns_ = now;
    share = std::clamp(share, 0.0, 1.0);
    if (is_terminal_) {
        const int full = static_cast<int>(share * kBarWidth);
        fmt::print(stderr, "\r{} [{}{}] {:3.0f} %  {}\033[K", title_, std::string(static_cast<size_t>(full), '#'),
                   std::string(static_cast<size_t>(kBarWidth - full), '.'), 100 * share, detail);
        std::fflush(stderr);
        has_bar_ = true;
    } else {
        fmt::print(stderr, "{}: {:.0f} % after {:.0f} s  {}\n", title_, 100 * share,
                   1e-9 * static_cast<double>(now - started_ns_), detail);
    }
}

void Progress::cooked(void* user, float share) {
    static_cast<Progress*>(user)->show(static_cast<double>(share));
}

}  // namespace cullet
