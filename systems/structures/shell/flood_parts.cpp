#include "systems/structures/shell/flood_parts.hpp"

#include <algorithm>
#include <cstring>

namespace cullet {
namespace {

/// The visited elements, in scratch that holds anything before: place[e] is believed only when visited[place[e]] is e.
struct Visited {
    uint32_t *place, *visited, *next;
    std::array<uint32_t, 3>* flood;  // [0]
    uint32_t count = 0;

    explicit Visited(const ShellView& shell) {
        Elements& elements = shell.state.elements;
        const uint32_t first = shell.elements().first;
        place = elements.copy.data() + first, visited = elements.next_in_cell.data() + first;
        next = elements.next.data() + first, flood = elements.other_slope.data() + first;
    }
    bool has(uint32_t e) const { return place[e] < count && visited[place[e]] == e; }
    uint32_t add(uint32_t e, uint32_t of_flood) {
        place[e] = count, visited[count] = e, next[count] = kNone, flood[count][0] = of_flood;
        return count++;
    }
};

/// What each flood has not looked beyond yet: a list of places, joined in one step.
class Floods {
 public:
    Floods(const ShellView& shell, uint16_t* parent, uint32_t most)
        : shell_(shell), visited(shell), parent_(parent), most_(std::min(most, kMostFloods)) {}

    bool seed(uint32_t e) {
        if (visited.has(e)) return true;
        if (count_ == most_) return false;
        parent_[count_] = static_cast<uint16_t>(count_);
        first_[count_] = last_[count_] = visited.add(e, count_);
        ++count_;
        return true;
    }
    uint32_t root(uint32_t flood) {
        while (parent_[flood] != flood) flood = parent_[flood] = parent_[parent_[flood]];
        return flood;
    }
    /// Every open flood looks at one element, until one or none is open.
    void run() {
        uint32_t open_count = count_;
        for (uint32_t f = 0; f < count_; ++f) open_[f] = static_cast<uint16_t>(f);
        uint32_t left = count_;  // floods that are neither joined to another nor a piece
        while (left > 1) {
            uint32_t kept = 0;
            for (uint32_t i = 0; i < open_count && left > 1; ++i) {
                const uint32_t f = open_[i];
                if (parent_[f] != f) continue;
                if (first_[f] == kNone) {
                    --left;  // a piece
                    continue;
                }
                left -= advance(f);
                open_[kept++] = static_cast<uint16_t>(f);
            }
            if (left > 1) open_count = kept;
        }
    }
    bool is_exhausted(uint32_t flood) const { return first_[flood] == kNone; }
    uint32_t count() const { return count_; }

 private:
    const ShellView& shell_;

 public:
    Visited visited;

 private:
    /// Returns how many other floods it met.
    uint32_t advance(uint32_t f) {
        const uint32_t at = first_[f];
        first_[f] = visited.next[at];
        uint32_t met = 0, own = f;
        for (const uint32_t n : shell_.state.elements.neighbour[shell_.element(visited.visited[at])]) {
            if (n == kNone) continue;
            if (!visited.has(n)) {
                append(own, visited.add(n, own));
                continue;
            }
            const uint32_t other = root(visited.flood[visited.place[n]][0]);
            if (other == own) continue;
            own = join(own, other);
            ++met;
        }
        return met;
    }
    void append(uint32_t f, uint32_t place) {
        if (first_[f] == kNone)
            first_[f] = place;
        else
            visited.next[last_[f]] = place;
        last_[f] = place;
    }
    uint32_t join(uint32_t a, uint32_t b) {
        if (b < a) std::swap(a, b);
        parent_[b] = static_cast<uint16_t>(a);
        if (first_[b] == kNone) return a;
        if (first_[a] == kNone)
            first_[a] = first_[b];
        else
            visited.next[last_[a]] = first_[b];
        last_[a] = last_[b];
        return a;
    }

    uint16_t* parent_;
    uint32_t most_, count_ = 0;
    uint32_t first_[kMostFloods], last_[kMostFloods];
    uint16_t open_[kMostFloods];
};

/// Elements at a crack edge, rising; false ends it.
template <class Call>
bool for_each_at_crack(const ShellView& shell, Call&& call) {
    const Elements& elements = shell.state.elements;
    const auto* kinds = reinterpret_cast<const uint8_t*>(elements.edge_kind.data() + shell.elements().first);
    const uint8_t* const end = kinds + size_t{3} * shell.element_count();
    for (const uint8_t* at = kinds; at < end;) {
        const auto* found = static_cast<const uint8_t*>(
            std::memchr(at, static_cast<int>(EdgeKind::Crack), static_cast<size_t>(end - at)));
        if (!found) return true;
        const auto e = static_cast<uint32_t>((found - kinds) / 3);
        at = kinds + size_t{3} * e + 3;
        if (elements.flags[shell.element(e)] & kDead) continue;
        if (!call(e)) return false;
    }
    return true;
}

}  // namespace

uint16_t FloodedParts::piece_of(const ShellView& shell, uint32_t element) const {
    const Elements& elements = shell.state.elements;
    const uint32_t place = elements.copy[shell.element(element)];
    if (place >= visited || elements.next_in_cell[shell.element(place)] != element) return kRest;
    return piece_of_flood[root(elements.other_slope[shell.element(place)][0])];
}

void flood_parts(ShellView shell, FloodedParts& found, uint32_t most) {
    static_assert(sizeof(std::array<uint8_t, 3>) == 3);
    struct Work {
        Floods floods;
        uint32_t smallest[kMostFloods];
        uint16_t order[kMostFloods];
        Work(const ShellView& of, uint16_t* parent, uint32_t most_floods) : floods(of, parent, most_floods) {}
    };
    const Scratch<Work> work(shell.state.scratch, shell, found.parent, most);
    Floods& floods = work->floods;
    uint32_t* smallest = work->smallest;
    uint16_t* order = work->order;
    found.pieces = found.visited = 0;
    if (!for_each_at_crack(shell, [&](uint32_t e) { return floods.seed(e); })) {
        found.pieces = kNone;
        return;
    }
    floods.run();
    found.visited = floods.visited.count;
    // The one that is not exhausted is the rest; where all are, one more element would have told, and the first one is.
    uint32_t rest = kNone;
    for (uint32_t f = 0; f < floods.count(); ++f)
        if (floods.root(f) == f && !floods.is_exhausted(f)) rest = f;
    // Smallest elements: floods are seeded in rising order, but one may hold smaller elements than its seed.
    uint32_t roots = 0;
    for (uint32_t f = 0; f < floods.count(); ++f) smallest[f] = kNone;
    for (uint32_t i = 0; i < floods.visited.count; ++i) {
        const uint32_t f = floods.root(floods.visited.flood[i][0]);
        smallest[f] = std::min(smallest[f], floods.visited.visited[i]);
    }
    for (uint32_t f = 0; f < floods.count(); ++f)
        if (floods.root(f) == f) order[roots++] = static_cast<uint16_t>(f);
    if (rest == kNone && roots > 0) {
        rest = order[0];
        for (uint32_t i = 0; i < roots; ++i)
            if (smallest[order[i]] < smallest[rest]) rest = order[i];
    }
    std::sort(order, order + roots, [&](uint16_t a, uint16_t b) { return smallest[a] < smallest[b]; });
    for (uint32_t i = 0; i < roots; ++i)
        found.piece_of_flood[order[i]] = order[i] == rest ? FloodedParts::kRest : static_cast<uint16_t>(found.pieces++);
}

namespace {

/// Of the elements that are numbered 0.
bool has_pins(const ShellView& shell) {
    const Vertices& vertices = shell.state.vertices;
    const uint8_t* const first = vertices.is_pinned.data() + shell.vertices().first;
    const uint8_t* const end = first + shell.vertex_count();
    for (const uint8_t* at = first; at < end; ++at) {
        at = static_cast<const uint8_t*>(std::memchr(at, 1, static_cast<size_t>(end - at)));
        if (!at) return false;
        const uint32_t element = vertices.element[shell.vertex(static_cast<uint32_t>(at - first))];
        if (element != kNone && shell.state.elements.part[shell.element(element)] == 0) return true;
    }
    return false;
}

void describe_rest(const ShellView& shell, std::span<FragmentPart> parts) {
    const Elements& elements = shell.state.elements;
    FragmentPart rest;
    rest.element_count = shell.structures().live_elements[shell.structure];
    rest.mass = shell.structures().mass[shell.structure];
    for (const FragmentPart& piece : parts.subspan(1)) {
        rest.element_count -= piece.element_count;
        rest.mass -= piece.mass;
    }
    rest.has_pins = has_pins(shell);
    uint32_t e = 0;
    while (e < shell.element_count() && elements.part[shell.element(e)] != 0) ++e;
    rest.first_element = e < shell.element_count() ? e : kNone;
    parts[0] = rest;
}

}  // namespace

namespace {

/// One in so many is sorted sooner than all are looked through.
constexpr uint32_t kSortedShare = 32;
/// Where more than one element in so many lies at a crack, to number all of them is the shorter way. A vase of 10,000
/// elements in 13 pieces is flooded in 76 us and relabelled in 88 us with all lists.
constexpr uint32_t kCrackedShare = 32;

}  // namespace

uint32_t worthwhile_floods(const ShellView& shell) {
    return std::min(shell.element_count() / kCrackedShare, kMostFloods);
}

// Elements come into the lists in rising order: the floods' own list of visited ones is sorted, with the flood beside
// each, or where it is long all elements are looked through for the numbers that it has left.
uint32_t find_pieces(ShellView shell, std::span<FragmentPart> parts, uint32_t most) {
    const Scratch<FloodedParts> flooded(shell.state.scratch);
    FloodedParts& found = *flooded;
    flood_parts(shell, found, most);
    if (found.pieces == kNone || found.pieces >= parts.size()) return kNone;
    Elements& elements = shell.state.elements;
    using Entry = std::array<uint32_t, 3>;  // flood, element
    Entry* const entries = elements.other_slope.data() + shell.elements().first;
    const uint32_t* const visited = elements.next_in_cell.data() + shell.elements().first;
    uint32_t count = 0;
    for (uint32_t i = 0; i < found.visited; ++i) {
        const uint32_t flood = found.root(entries[i][0]);
        if (found.piece_of_flood[flood] == FloodedParts::kRest) continue;
        elements.part[shell.element(visited[i])] = found.piece_of_flood[flood] + 1u;
        entries[count++] = {flood, visited[i], 0};
    }
    for (uint32_t p = 0; p < found.pieces; ++p) parts[p + 1] = {};
    const auto add = [&](uint32_t e) {
        const uint32_t part = elements.part[shell.element(e)];
        if (part != 0 && part != kNone) add_to_part(shell, parts[part], e);
    };
    if (count > shell.element_count() / kSortedShare) {
        for (uint32_t e = 0; e < shell.element_count(); ++e) add(e);
    } else {
        std::sort(entries, entries + count, [](const Entry& a, const Entry& b) { return a[1] < b[1]; });
        for (uint32_t i = 0; i < count; ++i) add(entries[i][1]);
    }
    const auto all = parts.first(found.pieces + 1);
    describe_rest(shell, all);
    for (const FragmentPart& piece : all.subspan(1))
        if (!(piece.mass < all[0].mass)) return kNone;
    return found.pieces + 1;
}

uint32_t group_from_cracks(ShellView shell, std::span<FragmentPart> parts, uint32_t most) {
    struct Work {
        FloodedParts found;
        uint32_t number[kMostFloods];
    };
    const Scratch<Work> work(shell.state.scratch);
    auto& [found, number] = *work;
    flood_parts(shell, found, most);
    if (found.pieces == kNone) return group_fragments(shell, parts);
    Elements& elements = shell.state.elements;
    // By smallest element, pieces and rest alike: in the order in which they are met.
    uint32_t rest = kNone, count = 0;
    std::fill_n(number, found.pieces, kNone);
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) {
            elements.part[row] = kNone;
            continue;
        }
        const uint16_t piece = found.piece_of(shell, e);
        uint32_t& own = piece == FloodedParts::kRest ? rest : number[piece];
        if (own == kNone) {
            if (count < parts.size()) parts[count] = {};
            own = count++;
        }
        elements.part[row] = own;
        if (own < parts.size()) add_to_part(shell, parts[own], e);
    }
    return count;
}

}  // namespace cullet
