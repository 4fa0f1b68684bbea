// Notes to a person, as they are told: what is said again and again is one line.
#pragma once
#include <string>
#include <vector>

namespace cullet {

/// Each sentence once, where it came first; of one that came more often, how often stands before it.
std::vector<std::string> counted_notes(const std::vector<std::string>& notes);

}  // namespace cullet
