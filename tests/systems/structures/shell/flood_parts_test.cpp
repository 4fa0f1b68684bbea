// Pieces found by a flood from the cracks, against relabelling all elements.
#include "systems/structures/shell/flood_parts.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include "systems/structures/shell/group_fragments.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

struct Fixture {
    State state;
    Row<Structures> whole;
    explicit Fixture(const SampleSurface& surface)
        : whole(build_shell(state, surface.source(), sample_material(state)).value()) {}
    ShellView cut(const std::function<int(uint32_t)>& label) {
        const ShellView shell(state, cut_by_label(state, whole, label));
        for (uint32_t e = 0; e < shell.element_count(); ++e)
            for (uint32_t column = 0; column < 3; ++column) {
                // What the scratch holds must not matter.
                state.elements.copy[shell.element(e)] = (e * 7) % shell.element_count();
                state.elements.next_in_cell[shell.element(e)] = e % 5;
                state.elements.next[shell.element(e)] = e;
            }
        return shell;
    }
};

/// Every link cut and no vertex split: connectivity is all that floods look at.
void cut_all_links(ShellView shell) {
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        elements.neighbour[shell.element(e)] = {kNone, kNone, kNone};
        elements.edge_kind[shell.element(e)].fill(static_cast<uint8_t>(EdgeKind::Crack));
    }
}

std::vector<uint32_t> list_of(const ShellView& shell, const FragmentPart& part) {
    std::vector<uint32_t> list;
    for (uint32_t e = part.first_element; e != kNone; e = shell.state.elements.next[shell.element(e)])
        list.push_back(e);
    return list;
}

/// find_pieces tells of pieces and rest what relabelling does; the rest's elements keep the number 0.
void compare_pieces(ShellView shell) {
    Elements& elements = shell.state.elements;
    std::vector<FragmentPart> parts(kMostParts), all(kMostParts);
    all.resize(std::min(group_fragments(shell, all), kMostParts));
    std::vector<std::vector<uint32_t>> lists;
    for (const FragmentPart& part : all) lists.push_back(list_of(shell, part));
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (elements.part[shell.element(e)] != kNone) elements.part[shell.element(e)] = 0;
    ASSERT_TRUE(is_numbered_zero(shell));
    const uint32_t count = find_pieces(shell, parts);
    if (count == kNone) return;
    ASSERT_EQ(count, all.size());
    const auto rest = static_cast<uint32_t>(
        std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.mass < b.mass; }) -
        all.begin());
    uint32_t next = 1;
    for (uint32_t p = 0; p < count; ++p) {
        const FragmentPart& found = parts[p == rest ? 0 : next++];
        EXPECT_EQ(is_listed(found), p != rest);
        EXPECT_EQ(found.first_element, all[p].first_element);
        EXPECT_EQ(found.element_count, all[p].element_count);
        EXPECT_EQ(found.has_pins, all[p].has_pins);
        EXPECT_NEAR(found.mass, all[p].mass, p == rest ? 1e-12 * shell.structures().mass[shell.structure] : 0);
        for (const uint32_t e : lists[p])
            ASSERT_EQ(elements.part[shell.element(e)], p == rest ? 0 : next - 1) << "element " << e;
        if (p == rest) list_part(shell, parts[0], 0);
        EXPECT_EQ(list_of(shell, found), lists[p]);
    }
}

/// The flood's pieces are relabelling's parts, but for one, which is the rest.
void compare(ShellView shell, uint32_t least_parts) {
    FloodedParts flooded;
    flood_parts(shell, flooded);
    std::vector<uint16_t> piece(shell.element_count());
    for (uint32_t e = 0; e < shell.element_count(); ++e) piece[e] = flooded.piece_of(shell, e);
    std::vector<FragmentPart> parts(kMostParts), from_cracks(kMostParts);
    ASSERT_EQ(group_from_cracks(shell, from_cracks), flooded.pieces + 1);
    const auto numbers = [&] {
        std::vector<uint32_t> all;
        for (const auto* column : {&shell.state.elements.part, &shell.state.elements.next})
            if (column == &shell.state.elements.part || flooded.pieces < kMostParts)  // more are not chained
                all.insert(all.end(), column->data() + shell.element(0),
                           column->data() + shell.element(shell.element_count()));
        return all;
    };
    const std::vector<uint32_t> found = numbers();
    const uint32_t count = group_fragments(shell, parts);
    EXPECT_EQ(numbers(), found) << "numbers and chains";
    for (uint32_t p = 0; p < std::min(count, kMostParts); ++p)
        EXPECT_TRUE(parts[p].mass == from_cracks[p].mass && parts[p].element_count == from_cracks[p].element_count &&
                    parts[p].first_element == from_cracks[p].first_element &&
                    parts[p].last_element == from_cracks[p].last_element &&
                    parts[p].has_pins == from_cracks[p].has_pins)
            << "part " << p;
    ASSERT_EQ(flooded.pieces + 1, count);
    EXPECT_GE(count, least_parts);
    std::vector<uint32_t> piece_of_part(count, kNone);
    uint32_t next = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        uint32_t& own = piece_of_part[shell.state.elements.part[shell.element(e)]];
        // Met in rising order: each new part is the next piece, or the rest.
        if (own == kNone) {
            own = piece[e];
            if (own != FloodedParts::kRest) {
                EXPECT_EQ(own, next++);
            }
        }
        ASSERT_EQ(own, piece[e]) << "element " << e;
    }
    EXPECT_EQ(next + 1, count);
    compare_pieces(shell);
}

TEST(FloodParts, AShellWithoutACrackIsOnePartAndNothingIsVisited) {
    Fixture f(sample_sphere(0.1, 0.004, 4));
    const ShellView shell = f.cut([](uint32_t) { return 0; });
    FloodedParts flooded;
    flood_parts(shell, flooded);
    EXPECT_EQ(flooded.pieces, 0u);
    EXPECT_EQ(flooded.visited, 0u);
    compare(shell, 1);
}

TEST(FloodParts, FindWhatRelabellingFindsForCracksLikeVoronois) {
    Fixture f(sample_sphere(0.1, 0.004, 5));
    for (const int count : {2, 3, 7, 30, 60})
        compare(f.cut(nearest_seed(ShellView(f.state, f.whole), count, static_cast<uint64_t>(count))), 2);
}

TEST(FloodParts, FindEveryElementFreeOfTheOthers) {
    Fixture f(sample_sphere(0.1, 0.004, 2));
    const ShellView shell(f.state, f.whole);
    cut_all_links(shell);
    compare(shell, 128);
}

TEST(FloodParts, SayThatTheyFoundNothingOutWhereCrackEdgesAreTooMany) {
    Fixture f(sample_sphere(0.1, 0.004, 5));
    const ShellView shell(f.state, f.whole);
    cut_all_links(shell);
    FloodedParts flooded;
    flood_parts(shell, flooded);
    EXPECT_EQ(flooded.pieces, kNone);
}

TEST(FloodParts, ASmallPieceCostsAFloodOfItsSizeWhateverTheBody) {
    uint32_t visited[2];
    for (const int rounds : {5, 6}) {
        Fixture f(sample_sphere(0.1, 0.004, rounds));
        const ShellView whole(f.state, f.whole);
        // The elements round one: a triangle halved twice.
        const Vec3d centre = element_middle(whole, 100);
        const double reach = rounds == 5 ? 0.02 : 0.01;
        const ShellView shell =
            f.cut([&](uint32_t e) { return length(element_middle(whole, e) - centre) < reach ? 1 : 0; });
        FloodedParts flooded;
        flood_parts(shell, flooded);
        EXPECT_EQ(flooded.pieces, 1u);
        visited[rounds - 5] = flooded.visited;
        compare(shell, 2);
    }
    EXPECT_LT(visited[1], 1.2 * visited[0]);
}

TEST(FloodParts, MoreCracksThanAreWorthAFloodGiveTheSameParts) {
    Fixture f(sample_vase(0.3, 0.005, 48, 40));
    const ShellView shell = f.cut(nearest_seed(ShellView(f.state, f.whole), 12, 3));
    std::vector<FragmentPart> flooded(kMostParts), numbered(kMostParts);
    const uint32_t count = group_from_cracks(shell, flooded);
    const uint32_t* const part = f.state.elements.part.data() + shell.elements().first;
    const std::vector<uint32_t> labels(part, part + shell.element_count());
    ASSERT_GT(count, 1u);
    const uint32_t few = worthwhile_floods(shell);
    EXPECT_EQ(few, shell.element_count() / 32);
    FloodedParts found;
    flood_parts(shell, found, few);
    EXPECT_EQ(found.pieces, kNone);  // there are more
    EXPECT_EQ(group_from_cracks(shell, numbered, few), count);
    EXPECT_EQ(std::vector<uint32_t>(part, part + shell.element_count()), labels);
    for (uint32_t p = 0; p < count; ++p) EXPECT_EQ(numbered[p].mass, flooded[p].mass);
    for (uint32_t e = 0; e < shell.element_count(); ++e) f.state.elements.part[shell.element(e)] = 0;
    EXPECT_EQ(find_pieces(shell, numbered, few), kNone);
}

}  // namespace
}  // namespace cullet
