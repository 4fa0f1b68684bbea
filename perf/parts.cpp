// What a hit costs outside of its inner loop, and finding its pieces, on vases of 10 and 100 thousand elements.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "engine/fp_mode.hpp"
#include "perf/cook_vase.hpp"
#include "perf/perf.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "systems/structures/shell/flood_parts.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet::perf {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr float kFallSpeed = 5.4f;  // m/s, 1.5 m

/// Least time of many runs, each of them short.
double least(uint32_t rounds, const std::function<void()>& call) {
    double best = 1e9;
    for (uint32_t r = 0; r < rounds; ++r) best = std::min(best, seconds(call));
    return best;
}

/// As the frame finds them: a look at the numbers of before, then the pieces with numbers, lists and masses; what is
/// left keeps its number. Where that is not the heaviest, or has another number, all parts get theirs anew.
uint32_t find_as_the_frame_does(const ShellView& shell, std::span<FragmentPart> parts) {
    const uint32_t most = worthwhile_floods(shell);
    const uint32_t count = is_numbered_zero(shell) ? find_pieces(shell, parts, most) : kNone;
    return count != kNone ? count : group_from_cracks(shell, parts, most);
}

/// Flood and relabelling on a shell with cracks that hung together before. Both tell what the births need: the number
/// of each element, and each part's mass, pins and, of pieces, elements in order.
bool compare_ways(const char* name, const ShellView& shell, uint32_t rounds, Figures& figures) {
    std::vector<FragmentPart> parts(kMostParts);
    FloodedParts flooded;
    uint32_t* const part = shell.state.elements.part.data() + shell.elements().first;
    const auto forget = [&] {
        for (uint32_t e = 0; e < shell.element_count(); ++e)
            part[e] = shell.state.elements.flags[shell.element(e)] & kDead ? kNone : 0;
    };
    uint32_t count = 0, found = 0;
    double ours = 1e9;
    for (uint32_t r = 0; r < rounds; ++r) {
        forget();  // as after the last break; not in the time
        ours = std::min(ours, seconds([&] { found = find_as_the_frame_does(shell, parts); }));
    }
    const double relabel = least(rounds, [&] { count = group_fragments(shell, parts); });
    const double flood = least(rounds, [&] { flood_parts(shell, flooded); });
    const std::string prefix = std::string(name) + ": ";
    figures.add(prefix + "elements", shell.element_count(), "");
    figures.add(prefix + "pieces", count, "");
    figures.add(prefix + "elements that the flood visits", flooded.visited, "");
    figures.add_ratio(prefix + "relabelling / finding the pieces as the frame does", 1e6 * ours, 1e6 * relabel, "us", 5,
                      true);
    figures.add_ratio(prefix + "relabelling / flood that only counts them", 1e6 * flood, 1e6 * relabel, "us", 0, true);
    return flooded.pieces + 1 == count && found == count;
}

/// Cuts the links round the first element's neighbourhood of so many elements.
void cut_out(const ShellView& shell, uint32_t elements) {
    Elements& table = shell.state.elements;
    std::vector<uint8_t> is_in(shell.element_count(), 0);
    std::vector<uint32_t> in{0};
    is_in[0] = 1;
    for (size_t i = 0; i < in.size() && in.size() < elements; ++i)
        for (const uint32_t n : table.neighbour[shell.element(in[i])])
            if (n != kNone && !is_in[n]) is_in[n] = 1, in.push_back(n);
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& n = table.neighbour[shell.element(e)][k];
            if (n == kNone || is_in[n] == is_in[e]) continue;
            n = kNone;
            table.edge_kind[shell.element(e)][k] = static_cast<uint8_t>(EdgeKind::Crack);
        }
}

/// A whole vase in pieces, and one small piece out of a vase.
bool measure_pieces(uint32_t rounds, Figures& figures) {
    const Result<Model> model = cook_vase(0.006f);
    if (!model.ok()) {
        std::printf("%s\n", model.error().c_str());
        return false;
    }
    CookedVase vase(*model);
    const HitDescription hit = fall_on_floor(vase.state, vase.shell, normalised(Vec3{0.9f, -1.0f, 0.1f}), kFallSpeed);
    run_hit(vase.state, vase.shell, hit);
    bool agrees = compare_ways("broken vase of 10,000 elements", ShellView(vase.state, vase.state.tasks.working[kTask]),
                               rounds, figures);
    close_hit(vase.state);
    cut_out(vase.view(), 100);
    agrees &= compare_ways("one piece of 100 out of 10,000 elements", vase.view(), rounds, figures);
    return agrees;
}

}  // namespace

bool measure_parts(const Options& options, Figures& figures) {
    const FpMode mode;
    return measure_pieces(options.rounds_of_a_pass(300), figures);
}

}  // namespace cullet::perf
