#include "systems/structures/tetrahedra/cook/crack_region.hpp"

#include <algorithm>
#include <cmath>

#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"

namespace cullet {
namespace {

constexpr double kSlack = 1e-5;     // of the size: more than the grid of a cut moves points by
constexpr uint32_t kMostBins = 24;  // along an axis

struct Box {
    Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    void add(Vec3d p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool meets(const Box& o, double slack) const {
        return low.x <= o.high.x + slack && o.low.x <= high.x + slack && low.y <= o.high.y + slack &&
               o.low.y <= high.y + slack && low.z <= o.high.z + slack && o.low.z <= high.z + slack;
    }
};

/// Boxes by place. A box that is asked about gets all that it may meet, some of them twice.
class Bins {
 public:
    explicit Bins(std::span<const Box> boxes) {
        for (const Box& b : boxes) all_.add(b.low), all_.add(b.high);
        if (boxes.empty()) return;
        const Vec3d wide = all_.high - all_.low;
        const double each = std::max({wide.x, wide.y, wide.z, 1e-300}) / kMostBins;
        scale_ = 1 / each;
        for (int k = 0; k < 3; ++k) {
            const double along = k == 0 ? wide.x : k == 1 ? wide.y : wide.z;
            count_[k] = static_cast<uint32_t>(along * scale_) + 1;
        }
        first_.assign(size_t{count_[0]} * count_[1] * count_[2] + 1, 0);
        for (const Box& b : boxes) for_each_bin(b, [&](uint32_t bin) { ++first_[bin + 1]; });
        for (size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
        list_.resize(first_.back());
        List<uint32_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < boxes.size(); ++i)
            for_each_bin(boxes[i], [&](uint32_t bin) { list_[next[bin]++] = i; });
    }
    /// Until `use` says true.
    template <class Use>
    void for_each_near(const Box& box, double slack, Use&& use) const {
        if (first_.empty() || !all_.meets(box, slack)) return;
        bool is_enough = false;
        Box wide = box;
        wide.low = wide.low - Vec3d(slack, slack, slack), wide.high = wide.high + Vec3d(slack, slack, slack);
        for_each_bin(wide, [&](uint32_t bin) {
            for (uint32_t i = first_[bin]; i < first_[bin + 1] && !is_enough; ++i) is_enough = use(list_[i]);
        });
    }

 private:
    template <class Use>
    void for_each_bin(const Box& b, Use&& use) const {
        const auto bin = [&](double along, uint32_t count) {
            return static_cast<uint32_t>(std::clamp(along * scale_, 0.0, static_cast<double>(count - 1)));
        };
        const Vec3d from = b.low - all_.low, to = b.high - all_.low;
        for (uint32_t x = bin(from.x, count_[0]); x <= bin(to.x, count_[0]); ++x)
            for (uint32_t y = bin(from.y, count_[1]); y <= bin(to.y, count_[1]); ++y)
                for (uint32_t z = bin(from.z, count_[2]); z <= bin(to.z, count_[2]); ++z)
                    use((x * count_[1] + y) * count_[2] + z);
    }
    Box all_;
    double scale_ = 0;
    uint32_t count_[3] = {};
    List<uint32_t> first_, list_;
};

class RegionFinder {
 public:
    RegionFinder(const CookedSolid& solid, std::span<const Vec3d> points, std::span<const uint32_t> piece_of,
                 CrackRegion& region)
        : solid_(solid),
          lattice_(solid.solid.lattice),
          points_(points.empty() ? std::span<const Vec3d>(lattice_.points) : points),
          piece_of_(piece_of),
          region_(region),
          slack_(kSlack * length(solid.mesh.high - solid.mesh.low)) {}

    void run() {
        find_moved();
        label_tetrahedra();
        want_faces();
        join_to_known();
        sort_cells();
        sort_triangles();
    }

 private:
    void find_moved() {
        region_.is_known.assign(points_.size(), 1);
        for (size_t p = 0; p < points_.size(); ++p) region_.is_known[p] = points_[p] == lattice_.points[p];
        is_moved_.assign(lattice_.fine.size(), 0);
        for (size_t t = 0; t < lattice_.fine.size(); ++t)
            for (const uint32_t p : lattice_.fine[t]) is_moved_[t] |= !region_.is_known[p];
        first_raw_.assign(lattice_.fine.size() + 1, 0);
        for (const RawCell& raw : solid_.raw) ++first_raw_[raw.tetrahedron + 1];
        for (size_t t = 0; t < lattice_.fine.size(); ++t) first_raw_[t + 1] += first_raw_[t];
    }
    bool is_empty(uint32_t t) const { return first_raw_[t] == first_raw_[t + 1]; }
    /// It holds nothing of the solid, wherever cracks moved its corners.
    bool stays_empty(uint32_t t) const { return is_empty(t) && !is_moved_[t]; }

    void label_tetrahedra() {
        region_.of_tetrahedron.assign(lattice_.fine.size(), kNone);
        for (uint32_t t = 0; t < lattice_.fine.size(); ++t) {
            uint32_t& label = region_.of_tetrahedron[t];
            if (is_empty(t)) {
                if (is_moved_[t]) label = piece_of_[solid_.raw[solid_.owner_of_empty[t]].cell];
                continue;
            }
            label = piece_of_[solid_.raw[first_raw_[t]].cell];
            for (uint32_t r = first_raw_[t]; r < first_raw_[t + 1]; ++r)
                if (piece_of_[solid_.raw[r].cell] != label) label = kManyPieces;
            if (label == kManyPieces) region_.tetrahedra.push_back(t);
        }
    }

    void want_faces() {
        const auto& of = region_.of_tetrahedron;
        is_wanted_.assign(solid_.faces.faces.size(), 0);
        for (uint32_t f = 0; f < is_wanted_.size(); ++f) {
            const auto [a, b] = solid_.faces.faces[f].tetrahedron;
            if (of[a] == kManyPieces || (b != kNone && of[b] == kManyPieces))
                is_wanted_[f] = 1;
            else if (b != kNone && !stays_empty(a) && !stays_empty(b))
                is_wanted_[f] = of[a] != of[b];
        }
    }

    // Whether a point is inside is found along edges of wanted faces, from one that is known: faces that lead there are
    // wanted, too. Those first that no triangle is near.
    void join_to_known() {
        root_.resize(points_.size());
        has_known_.assign(points_.size(), 0), is_asked_.assign(points_.size(), 0);
        for (uint32_t p = 0; p < root_.size(); ++p) root_[p] = p, has_known_[p] = region_.is_known[p];
        is_forced_.assign(lattice_.fine.size(), 0);
        for (uint32_t f = 0; f < is_wanted_.size(); ++f) {
            if (!is_wanted_[f]) continue;
            join(f);
            is_asked_[root_of(solid_.faces.faces[f].corner[0])] = 1;
        }
        bool is_any = false;
        for (uint32_t p = 0; p < root_.size(); ++p)
            is_any = is_any || (is_asked_[p] && root_[p] == p && !has_known_[p]);
        if (!is_any) return;
        List<uint8_t> has_surface(lattice_.fine.size());
        List<uint8_t> is_surface(solid_.solid.cells.size());
        for (const SurfacePatch& patch : solid_.solid.patches) is_surface[patch.cell] = 1;
        for (const RawCell& raw : solid_.raw) has_surface[raw.tetrahedron] |= is_surface[raw.cell];
        while (is_any) {
            is_any = false;
            for (const bool is_free : {true, false})
                for (uint32_t f = 0; f < is_wanted_.size(); ++f) {
                    if (is_wanted_[f]) continue;
                    const LatticeFace& face = solid_.faces.faces[f];
                    const uint32_t a = face.tetrahedron[0], b = face.tetrahedron[1];
                    if (is_free && (has_surface[a] || (b != kNone && has_surface[b]))) continue;
                    bool is_lost = false;
                    for (const uint32_t p : face.corner) {
                        const uint32_t r = root_of(p);
                        is_lost = is_lost || (is_asked_[r] && !has_known_[r]);
                    }
                    if (!is_lost || !join(f)) continue;
                    is_any = true;
                    is_wanted_[f] = 1;
                    is_forced_[a] = 1;
                    if (b != kNone) is_forced_[b] = 1;
                }
        }
    }
    uint32_t root_of(uint32_t p) {
        while (root_[p] != p) p = root_[p] = root_[root_[p]];
        return p;
    }
    /// False: its corners were joined already.
    bool join(uint32_t f) {
        const auto& c = solid_.faces.faces[f].corner;
        bool is_new = false;
        for (const uint32_t q : {c[1], c[2]}) {
            const uint32_t a = root_of(c[0]), b = root_of(q);
            if (a == b) continue;
            is_new = true;
            const uint32_t low = std::min(a, b), high = std::max(a, b);
            root_[high] = low;
            has_known_[low] |= has_known_[high], is_asked_[low] |= is_asked_[high];
        }
        return is_new;
    }

    void sort_cells() {
        is_near_.assign(solid_.solid.cells.size(), 0), is_cut_.assign(solid_.solid.cells.size(), 0);
        for (const RawCell& raw : solid_.raw) {
            is_near_[raw.cell] |= is_moved_[raw.tetrahedron];
            is_cut_[raw.cell] |= region_.of_tetrahedron[raw.tetrahedron] == kManyPieces || is_forced_[raw.tetrahedron];
        }
        for (uint32_t f = 0; f < is_wanted_.size(); ++f)
            if (is_wanted_[f]) region_.faces.push_back(f);
        for (uint32_t t = 0; t < lattice_.fine.size(); ++t) {
            if (!is_moved_[t]) continue;
            moved_.push_back(t);
            Box box;
            for (const uint32_t p : lattice_.fine[t]) box.add(points_[p]);
            boxes_.push_back(box);
        }
    }

    // What tetrahedra with a moved corner fill together stays as it was: a triangle that met none of them meets none.
    void sort_triangles() {
        const Bins bins(boxes_);
        const auto& patches = solid_.solid.patches;
        region_.of_triangle.assign(solid_.mesh.triangles.size(), kManyPieces);
        size_t next = 0;
        for (uint32_t t = 0; t < solid_.mesh.triangles.size(); ++t) {
            size_t end = next;
            while (end < patches.size() && patches[end].triangle == t) ++end;
            uint32_t& label = region_.of_triangle[t];
            if (end > next) label = label_of(t, {patches.data() + next, end - next}, bins);
            next = end;
            if (label == kManyPieces) region_.triangles.push_back(t);
        }
    }
    uint32_t label_of(uint32_t t, std::span<const SurfacePatch> patches, const Bins& bins) const {
        const uint32_t label = piece_of_[patches[0].cell];
        bool is_near = false;
        for (const SurfacePatch& patch : patches) {
            if (piece_of_[patch.cell] != label || is_cut_[patch.cell]) return kManyPieces;
            is_near = is_near || is_near_[patch.cell];
        }
        if (!is_near) return label;
        Vec3d corners[3];
        Box box;
        for (size_t k = 0; k < 3; ++k) box.add(corners[k] = solid_.mesh.positions[solid_.mesh.triangles[t][k]]);
        const Vec3d normal = normalised(cross(corners[1] - corners[0], corners[2] - corners[0]));
        bool is_one = true;
        bins.for_each_near(box, slack_, [&](uint32_t i) {
            const uint32_t tetrahedron = moved_[i];
            if (region_.of_tetrahedron[tetrahedron] == label && !is_forced_[tetrahedron]) return false;
            is_one = !boxes_[i].meets(box, slack_) || are_apart(corners, normal, tetrahedron);
            return !is_one;
        });
        return is_one ? label : kManyPieces;
    }
    /// A plane of either has the other on its far side.
    bool are_apart(const Vec3d (&corners)[3], Vec3d normal, uint32_t tetrahedron) const {
        const auto& c = lattice_.fine[tetrahedron];
        double low = 1e300, high = -1e300;
        for (const uint32_t p : c) {
            const double above = dot(normal, points_[p] - corners[0]);
            low = std::min(low, above), high = std::max(high, above);
        }
        if (low > slack_ || high < -slack_) return true;
        for (const auto& face : kFaceCorners) {
            const Vec3d origin = points_[c[face[0]]];
            const Vec3d outward = normalised(cross(points_[c[face[1]]] - origin, points_[c[face[2]]] - origin));
            double least = 1e300;
            for (const Vec3d& corner : corners) least = std::min(least, dot(outward, corner - origin));
            if (least > slack_) return true;
        }
        return false;
    }

    const CookedSolid& solid_;
    const CoverLattice& lattice_;
    std::span<const Vec3d> points_;
    std::span<const uint32_t> piece_of_;
    CrackRegion& region_;
    double slack_;
    List<uint8_t> is_moved_, is_forced_;  // by tetrahedron
    List<uint32_t> first_raw_;            // by tetrahedron
    List<uint8_t> is_wanted_;             // by face
    List<uint32_t> root_;                 // by point: what hangs together over edges of wanted faces
    List<uint8_t> has_known_, is_asked_;  // by root
    List<uint8_t> is_near_, is_cut_;      // by cell
    List<uint32_t> moved_;                // tetrahedra with a moved corner
    List<Box> boxes_;                     // theirs
};

}  // namespace

std::vector<uint32_t> owners_of_empty(const CookedSolid& solid) {
    const CoverLattice& lattice = solid.solid.lattice;
    std::vector<uint32_t> first_raw(lattice.fine.size() + 1), owner(lattice.fine.size(), kNone);
    for (const RawCell& raw : solid.raw) ++first_raw[raw.tetrahedron + 1];
    for (size_t t = 0; t < lattice.fine.size(); ++t) first_raw[t + 1] += first_raw[t];
    const auto is_empty = [&](uint32_t t) { return first_raw[t] == first_raw[t + 1]; };
    const auto middle_of = [&](uint32_t t) {
        const auto& c = lattice.fine[t];
        const auto& at = lattice.points;
        return 0.25 * (at[c[0]] + at[c[1]] + (at[c[2]] + at[c[3]]));
    };
    std::vector<uint32_t> ring, next;
    for (uint32_t t = 0; t < lattice.fine.size(); ++t) {
        if (!is_empty(t)) continue;
        double most = -1, least = 1e300;
        uint32_t largest = kNone;
        for (const uint32_t other : lattice.neighbours[t]) {
            if (other == kNone || is_empty(other)) continue;
            const double size = solid.solid.cells[solid.raw[first_raw[other]].cell].volume;
            if (size > most) most = size, largest = other;
        }
        if (largest == kNone) continue;
        for (uint32_t r = first_raw[largest]; r < first_raw[largest + 1]; ++r)
            if (const double away = length(solid.raw[r].centroid - middle_of(t)); away < least)
                least = away, owner[t] = r;
        ring.push_back(t);
    }
    // Ring by ring outward: the nearest of what neighbours nearer to the solid have.
    for (; !ring.empty(); ring.swap(next)) {
        next.clear();
        for (const uint32_t t : ring)
            for (const uint32_t other : lattice.neighbours[t])
                if (other != kNone && is_empty(other) && owner[other] == kNone) next.push_back(other);
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        std::vector<uint32_t> found(next.size(), kNone);
        for (size_t i = 0; i < next.size(); ++i) {
            double least = 1e300;
            for (const uint32_t other : lattice.neighbours[next[i]]) {
                if (other == kNone || owner[other] == kNone) continue;
                const double away = length(solid.raw[owner[other]].centroid - middle_of(next[i]));
                if (away < least) least = away, found[i] = owner[other];
            }
        }
        for (size_t i = 0; i < next.size(); ++i) owner[next[i]] = found[i];
    }
    for (uint32_t t = 0; t < owner.size(); ++t)
        if (is_empty(t) && owner[t] == kNone) owner[t] = 0;  // of a lattice that does not hang together
    return owner;
}

CrackRegion find_crack_region(const CookedSolid& solid, std::span<const Vec3d> points,
                              std::span<const uint32_t> piece_of) {
    CrackRegion region;
    RegionFinder(solid, points, piece_of, region).run();
    return region;
}

}  // namespace cullet
