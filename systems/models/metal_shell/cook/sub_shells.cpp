#include "systems/models/metal_shell/cook/sub_shells.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace cullet {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::max();

/// Shortest ways over the dual graph from several sources at once. Ties go to the lowest label, then face.
class Ways {
 public:
    explicit Ways(const DualGraph& graph)
        : distance(graph.face_count(), kFarAway), label(graph.face_count(), kNone), graph_(graph) {}

    template <class Allowed>
    void run(std::span<const uint32_t> sources, Allowed allowed) {
        for (uint32_t s = 0; s < sources.size(); ++s)
            if (distance[sources[s]] > 0) set(sources[s], 0, s);
        while (!heap_.empty()) {
            const Entry next = heap_.top();
            heap_.pop();
            if (next.distance > distance[next.face] || next.label != label[next.face]) continue;
            for (const DualEdge& edge : graph_.of(next.face)) {
                if (!allowed(edge.face)) continue;
                const double way = next.distance + edge.distance;
                if (way < distance[edge.face] || (way == distance[edge.face] && next.label < label[edge.face]))
                    set(edge.face, way, next.label);
            }
        }
    }
    void forget() {
        std::fill(distance.begin(), distance.end(), kFarAway);
        std::fill(label.begin(), label.end(), kNone);
    }

    std::vector<double> distance;
    std::vector<uint32_t> label;

 private:
    struct Entry {
        double distance;
        uint32_t label, face;
        bool operator>(const Entry& o) const {
            if (distance != o.distance) return distance > o.distance;
            return label != o.label ? label > o.label : face > o.face;
        }
    };
    void set(uint32_t face, double way, uint32_t of) {
        distance[face] = way, label[face] = of;
        heap_.push({way, of, face});
    }
    const DualGraph& graph_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
};

const auto kAnywhere = [](uint32_t) { return true; };

/// Faces of one group, with what their middle is.
uint32_t nearest_to_centroid(std::span<const uint32_t> group, std::span<const FaceShape> faces) {
    Vec3d sum;
    double area = 0;
    for (const uint32_t f : group) sum += faces[f].area * faces[f].centroid, area += faces[f].area;
    if (area > 0) sum = (1 / area) * sum;
    uint32_t nearest = group[0];
    double least = kFarAway;
    for (const uint32_t f : group) {
        const double away = length(faces[f].centroid - sum);
        // What has no area has no normal, and stands for nothing.
        if ((faces[f].area > 0 || !(area > 0)) && away < least) least = away, nearest = f;
    }
    return nearest;
}

std::vector<std::vector<uint32_t>> groups_of(std::span<const uint32_t> number, size_t count) {
    std::vector<std::vector<uint32_t>> groups(count);
    for (uint32_t f = 0; f < number.size(); ++f)
        if (number[f] != kNone) groups[number[f]].push_back(f);
    return groups;
}

uint32_t wanted_count(const SubShellSettings& settings, uint32_t faces, uint32_t components) {
    const uint32_t chosen = settings.count > 0 ? settings.count : std::max(16u, std::min(128u, faces / 110));
    return std::min({std::max(chosen, components), faces, std::max(kMostSubShells, components)});
}

// Paper: the mean distance to the representatives of the same component; a face that no way reaches has none.
class Seeds {
 public:
    Seeds(const DualGraph& graph, std::span<const FaceShape> faces, Seeding seeding)
        : graph_(graph), seeding_(seeding), least_(graph.face_count(), kFarAway), sum_(graph.face_count(), 0) {
        for (const auto& group : groups_of(graph.component_of, graph.component_count))
            add(nearest_to_centroid(group, faces));
        for (const FaceShape& face : faces) has_area_.push_back(face.area > 0);
    }
    void add(uint32_t face) {
        const uint32_t source[] = {face};
        Ways ways(graph_);
        ways.run(source, kAnywhere);
        for (uint32_t f = 0; f < least_.size(); ++f) {
            if (ways.distance[f] == kFarAway) continue;
            least_[f] = std::min(least_[f], ways.distance[f]);
            sum_[f] += ways.distance[f];
        }
        chosen.push_back(face);
        seeds_of_component_.resize(graph_.component_count, 0);
        ++seeds_of_component_[graph_.component_of[face]];
    }
    struct Next {
        uint32_t face = kNone;
        double distance = 0;
    };
    Next next() const {
        Next best;
        for (uint32_t f = 0; f < least_.size(); ++f) {
            if (!has_area_[f] || !(least_[f] > 0)) continue;
            const double away =
                seeding_ == Seeding::Farthest ? least_[f] : sum_[f] / seeds_of_component_[graph_.component_of[f]];
            if (away > best.distance) best = {f, away};
        }
        return best;
    }
    std::vector<uint32_t> chosen;

 private:
    const DualGraph& graph_;
    Seeding seeding_;
    std::vector<double> least_, sum_;
    std::vector<uint32_t> seeds_of_component_;
    std::vector<uint8_t> has_area_;
};

/// Sums of distances within a cell.
class CellSums {
 public:
    CellSums(const DualGraph& graph, std::span<const uint32_t> cell_of) : ways_(graph), cell_of_(cell_of) {}
    /// From one of its faces to all of the cell.
    double from(uint32_t face, std::span<const uint32_t> cell) {
        const uint32_t source[] = {face}, own = cell_of_[face];
        ways_.run(source, [&](uint32_t f) { return cell_of_[f] == own; });
        double sum = 0;
        for (const uint32_t f : cell) {
            sum += ways_.distance[f];
            ways_.distance[f] = kFarAway, ways_.label[f] = kNone;
        }
        return sum;
    }

 private:
    Ways ways_;
    std::span<const uint32_t> cell_of_;
};

// Descent: to the neighbour of least sum, as long as there is a better one.
uint32_t exact_representative(const DualGraph& graph, CellSums& sums, std::span<const uint32_t> cell_of,
                              std::span<const uint32_t> cell, std::span<const FaceShape> faces, uint32_t from) {
    double least = sums.from(from, cell);
    for (uint32_t best = from;; from = best) {
        for (const DualEdge& edge : graph.of(from)) {
            if (cell_of[edge.face] != cell_of[from] || !(faces[edge.face].area > 0)) continue;
            const double sum = sums.from(edge.face, cell);
            if (sum < least || (sum == least && edge.face < best)) least = sum, best = edge.face;
        }
        if (best == from) return best;
    }
}

struct Assigned {
    std::vector<uint32_t> cell_of;
    double sum = 0, radius = 0;
};
Assigned assign(const DualGraph& graph, std::span<const uint32_t> representatives) {
    Ways ways(graph);
    ways.run(representatives, kAnywhere);
    Assigned made;
    made.cell_of = std::move(ways.label);
    for (const double d : ways.distance) made.sum += d, made.radius = std::max(made.radius, d);
    return made;
}

// Cells with too little area join the neighbour with which they share most of their border.
void merge_small(const Surface& surface, std::span<const FaceShape> faces, double share, std::vector<uint32_t>& cell_of,
                 std::vector<uint32_t>& representative) {
    const auto count = representative.size();
    std::vector<double> area(count, 0);
    double whole = 0;
    for (uint32_t f = 0; f < cell_of.size(); ++f) area[cell_of[f]] += faces[f].area, whole += faces[f].area;
    const double least = share * whole / static_cast<double>(count);
    for (uint32_t small = 0; small < count; ++small) {
        if (!(area[small] < least)) continue;
        std::map<uint32_t, double> border;
        for (uint32_t f = 0; f < cell_of.size(); ++f) {
            if (cell_of[f] != small) continue;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t beside = surface.neighbours[f][k];
                if (beside == kNone || cell_of[beside] == small) continue;
                border[cell_of[beside]] += length(surface.positions[surface.triangles[f][(k + 1) % 3]] -
                                                  surface.positions[surface.triangles[f][k]]);
            }
        }
        uint32_t into = kNone;
        double longest = 0;
        for (const auto& [cell, length_of] : border)
            if (length_of > longest) longest = length_of, into = cell;
        if (into == kNone) continue;  // a part of its own
        for (uint32_t& cell : cell_of)
            if (cell == small) cell = into;
        area[into] += area[small], area[small] = least;
        representative[small] = kNone;
    }
    std::vector<uint32_t> number(count, kNone);
    uint32_t next = 0;
    for (uint32_t c = 0; c < count; ++c)
        if (representative[c] != kNone) representative[next] = representative[c], number[c] = next++;
    representative.resize(next);
    for (uint32_t& cell : cell_of) cell = number[cell];
}

}  // namespace

Segmentation find_sub_shells(const Surface& surface, const DualGraph& graph, const SubShellSettings& settings) {
    std::vector<FaceShape> faces;
    for (uint32_t f = 0; f < graph.face_count(); ++f) faces.push_back(shape_of(surface, f));
    Segmentation made;
    made.wanted = wanted_count(settings, graph.face_count(), graph.component_count);
    Seeds seeds(graph, faces, settings.seeding);
    while (seeds.chosen.size() < made.wanted) {
        const auto next = seeds.next();
        if (next.face == kNone || (settings.threshold > 0 && next.distance <= settings.threshold)) break;
        seeds.add(next.face);
    }
    std::vector<uint32_t> representative = seeds.chosen;
    Assigned now = assign(graph, representative);
    made.sums.push_back(now.sum);
    bool is_exact = settings.representatives == Representatives::Exact;
    for (uint32_t round = 0; round < settings.rounds; ++round) {
        const auto cells = groups_of(now.cell_of, representative.size());
        std::vector<uint32_t> better = representative;
        CellSums sums(graph, now.cell_of);
        for (uint32_t c = 0; c < cells.size(); ++c)
            better[c] = is_exact ? exact_representative(graph, sums, now.cell_of, cells[c], faces, representative[c])
                                 : nearest_to_centroid(cells[c], faces);
        if (better == representative) {
            if (is_exact || settings.representatives == Representatives::Centroid) break;
            is_exact = true;
            continue;
        }
        Assigned then = assign(graph, better);
        if (then.sum > now.sum && settings.representatives != Representatives::Centroid) {
            if (is_exact) break;  // by rounding alone
            is_exact = true;
            continue;
        }
        representative = std::move(better), now = std::move(then);
        made.sums.push_back(now.sum);
    }
    made.radius = now.radius;
    merge_small(surface, faces, settings.least_area, now.cell_of, representative);
    made.representative = std::move(representative);
    for (const uint32_t cell : now.cell_of) made.cell_of.push_back(static_cast<uint16_t>(cell));
    return made;
}

}  // namespace cullet
