#include "systems/structures/tetrahedra/cook/cut_cells.hpp"

#include <algorithm>

#include "engine/table.hpp"

namespace cullet {
namespace {

/// A polygon, or a loop as a tetrahedron sees it.
struct Element {
    uint32_t number;  // polygon, or polygons + loop
    uint32_t first, count, part;
    double sign;
    uint32_t cell = 0;  // in the tetrahedron: the lowest element that hangs together with it
};

class CellFinder {
 public:
    CellFinder(const CutRequest& request, const Cut& cut) : cut_(cut) {
        const size_t tetrahedra = request.lattice.fine.size();
        const std::span<const Vec3d> points =
            request.points.empty() ? std::span<const Vec3d>(request.lattice.points) : request.points;
        made.middles.resize(tetrahedra);
        for (size_t t = 0; t < tetrahedra; ++t) {
            const auto& c = request.lattice.fine[t];
            made.middles[t] = 0.25 * (points[c[0]] + points[c[1]] + (points[c[2]] + points[c[3]]));
        }
        first_.assign(tetrahedra + 1, 0);
        for (const CutPolygon& p : cut.polygons) ++first_[p.tetrahedron + 1];
        for (const CutLoop& loop : cut.loops)
            for (const uint32_t t : request.faces.faces[loop.face].tetrahedron)
                if (t != kNone) ++first_[t + 1];
        for (size_t t = 0; t < tetrahedra; ++t) first_[t + 1] += first_[t];
        elements_.resize(first_.back());
        List<uint32_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < cut.polygons.size(); ++i) {
            const CutPolygon& p = cut.polygons[i];
            elements_[next[p.tetrahedron]++] = {i, p.first, p.count, request.mesh.part_of[p.triangle], 1};
        }
        for (uint32_t i = 0; i < cut.loops.size(); ++i) {
            const CutLoop& loop = cut.loops[i];
            for (uint32_t side = 0; side < 2; ++side)
                if (const uint32_t t = request.faces.faces[loop.face].tetrahedron[side]; t != kNone)
                    elements_[next[t]++] = {static_cast<uint32_t>(cut.polygons.size()) + i, loop.first, loop.count,
                                            loop.part, side == 0 ? 1.0 : -1.0};
        }
        made.of_polygon.assign(cut.polygons.size(), kNone);
        made.of_loop.assign(cut.loops.size(), {kNone, kNone});
    }

    void find_in(uint32_t t) {
        const std::span<Element> all{elements_.data() + first_[t], elements_.data() + first_[t + 1]};
        if (all.empty()) return;
        join(all);
        // Elements point to the lowest of theirs, which stands before them.
        cells_.clear();
        for (uint32_t i = 0; i < all.size(); ++i) {
            if (all[i].cell == i) {
                all[i].cell = static_cast<uint32_t>(cells_.size());
                cells_.push_back({t, {}});
            } else {
                all[i].cell = all[all[i].cell].cell;
            }
            const Element& e = all[i];
            add_fan({cut_.places.data() + e.first, e.count}, made.middles[t], e.sign, cells_[e.cell].sums);
        }
        uint32_t largest = 0;
        for (uint32_t c = 0; c < cells_.size(); ++c)
            if (cells_[c].sums.volume > cells_[largest].sums.volume) largest = c;
        const auto is_hole = [&](uint32_t c) { return c != largest && !(cells_[c].sums.volume > 0); };
        for (uint32_t c = 0; c < cells_.size(); ++c)
            if (is_hole(c)) cells_[largest].sums += cells_[c].sums;
        number_.assign(cells_.size(), kNone);
        for (uint32_t c = 0; c < cells_.size(); ++c) {
            if (is_hole(c)) continue;
            number_[c] = static_cast<uint32_t>(made.cells.size());
            made.cells.push_back(cells_[c]);
        }
        for (uint32_t& number : number_)
            if (number == kNone) number = number_[largest];
        for (const Element& e : all) {
            const uint32_t cell = number_[e.cell];
            if (e.number < cut_.polygons.size()) {
                made.of_polygon[e.number] = cell;
            } else {
                const uint32_t loop = e.number - static_cast<uint32_t>(cut_.polygons.size());
                made.of_loop[loop][e.sign > 0 ? 0 : 1] = cell;
            }
        }
    }

    CutCells made;

 private:
    void join(std::span<Element> all) {
        for (Element& e : all) e.cell = 0;
        bool is_one_part = true, is_cut = false;
        for (const Element& e : all) {
            is_one_part = is_one_part && e.part == all[0].part;
            is_cut = is_cut || e.number < cut_.polygons.size();
        }
        if (!is_one_part || !is_cut) return;
        uses_.clear();
        for (uint32_t i = 0; i < all.size(); ++i) {
            all[i].cell = i;
            for (uint32_t k = 0; k < all[i].count; ++k) uses_.push_back({cut_.keys[all[i].first + k], i});
        }
        std::sort(uses_.begin(), uses_.end(),
                  [](const Use& a, const Use& b) { return a.key == b.key ? a.element < b.element : a.key < b.key; });
        const auto root = [&](uint32_t i) {
            while (all[i].cell != i) i = all[i].cell = all[all[i].cell].cell;
            return i;
        };
        for (size_t i = 1; i < uses_.size(); ++i) {
            if (!(uses_[i].key == uses_[i - 1].key)) continue;
            const uint32_t a = root(uses_[i - 1].element), b = root(uses_[i].element);
            all[std::max(a, b)].cell = std::min(a, b);
        }
        for (uint32_t i = 0; i < all.size(); ++i) all[i].cell = root(i);
    }

    struct Use {
        CutKey key;
        uint32_t element;
    };
    const Cut& cut_;
    List<Element> elements_;
    List<uint32_t> first_, number_;
    List<CutCell> cells_;
    List<Use> uses_;
};

}  // namespace

void add_fan(std::span<const Vec3d> places, Vec3d origin, double sign, VolumeSums& sums) {
    if (places.size() < 3) return;
    const Vec3d a = places[0] - origin;
    for (size_t k = 1; k + 1 < places.size(); ++k) {
        const Vec3d b = places[k] - origin, c = places[k + 1] - origin, s = a + b + c;
        const double volume = sign * dot(a, cross(b, c)) / 6;
        sums.volume += volume;
        sums.first += 0.25 * volume * s;
        sums.second = sums.second + 0.05 * volume * (outer(a) + outer(b) + (outer(c) + outer(s)));
    }
}

FlatSums flat_sums(std::span<const Vec3d> places, Vec3d normal) {
    FlatSums sums;
    for (size_t k = 1; k + 1 < places.size(); ++k) {
        const Vec3d area = 0.5 * cross(places[k] - places[0], places[k + 1] - places[0]);
        sums.area += area;
        sums.first += dot(area, normal) / 3 * (places[0] + places[k] + places[k + 1]);
    }
    return sums;
}

CutCells find_cells(const CutRequest& request, const Cut& cut, std::span<const uint32_t> tetrahedra) {
    CellFinder finder(request, cut);
    if (tetrahedra.empty())
        for (uint32_t t = 0; t < request.lattice.fine.size(); ++t) finder.find_in(t);
    for (const uint32_t t : tetrahedra) finder.find_in(t);
    return std::move(finder.made);
}

}  // namespace cullet
