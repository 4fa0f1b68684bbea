// report.html and report.json from the claims.
#pragma once
#include <span>
#include <string>

#include "sample_game/reproduce/bench.hpp"

namespace cullet::reproduce {

struct PageFacts {
    std::string title, paper_machine;  // a sentence: what published times are of
    std::string machine;
    uint32_t threads = 0;
    bool is_reduced = false;
    double seconds = 0;
    std::vector<std::string> notes;
};

/// One page without any other file but the pictures beside it.
std::string to_page(std::span<const Claim> claims, const PageFacts& facts);
std::string to_json(std::span<const Claim> claims, const PageFacts& facts);

}  // namespace cullet::reproduce
