#include "sample_game/notes.hpp"

#include <fmt/format.h>

#include <map>

namespace cullet {

std::vector<std::string> counted_notes(const std::vector<std::string>& notes) {
    std::map<std::string, size_t> times;
    for (const std::string& note : notes) ++times[note];
    std::vector<std::string> lines;
    for (const std::string& note : notes) {
        size_t& count = times[note];
        if (count > 0) lines.push_back(count == 1 ? note : fmt::format("{} times: {}", count, note));
        count = 0;
    }
    return lines;
}

}  // namespace cullet
