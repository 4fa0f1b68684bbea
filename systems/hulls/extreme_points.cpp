#include "systems/hulls/extreme_points.hpp"

#include <algorithm>
#include <limits>

#include "engine/assert.hpp"
#include "engine/lanes.hpp"

namespace cullet {
namespace {

using lanes::is_any;
using lanes::kLanes;
using lanes::LaneMask;
using lanes::Lanes;
using lanes::load;

constexpr uint32_t kMostCorners = kMostHullPoints + 1;  // and the tip that makes a solid of flat points
constexpr uint32_t kMostFaces = 128;                    // 62 by Euler; more only while rounding has torn the hull
constexpr uint8_t kNoFace = 0xff;
constexpr uint8_t kNearFaces = 0xfe;  // outside, and not worth a corner yet: past a sharp edge, which may move away
constexpr uint32_t kNoPoint = 0xffffffffu;

struct Face {
    uint8_t corner[3];  // counter-clockwise from outside
    bool is_used = false;
};

/// Planes of faces, four side by side: what lies above which of them is most of the work. A number that has no plane
/// has nothing above it, up to the next multiple of four.
struct Planes {
    float x[kMostFaces], y[kMostFaces], z[kMostFaces], height[kMostFaces];

    void clear(uint32_t f) { x[f] = y[f] = z[f] = 0, height[f] = std::numeric_limits<float>::infinity(); }
    void clear_four_from(uint32_t f) {
        for (uint32_t k = f; k < f + kLanes; ++k) clear(k);
    }
    /// A normal of zero: the face has no area, and nothing lies above it.
    void set(uint32_t f, Vec3 normal, float at) { x[f] = normal.x, y[f] = normal.y, z[f] = normal.z, height[f] = at; }
    void copy(uint32_t f, const Planes& from, uint32_t of) {
        x[f] = from.x[of], y[f] = from.y[of], z[f] = from.z[of], height[f] = from.height[of];
    }
    /// How far the point lies above four of them from f on, as dot(normal, p) - height.
    Lanes gaps(uint32_t f, Vec3 p) const {
        return load(x + f) * p.x + load(y + f) * p.y + load(z + f) * p.z - load(height + f);
    }
};

class Hull {
 public:
    Hull(std::span<const Vec3> points, float enough) : points_(points), enough_(enough) {
        for (auto& row : face_of_edge_) std::fill(std::begin(row), std::end(row), kNoFace);
    }

    void choose(uint32_t most, ExtremePoints& chosen) {
        chosen.count = 0;
        chosen.left_out = 0;
        chosen.face_count = 0;
        if (points_.empty()) return;
        if (start()) {
            for (uint32_t i = 0; i < points_.size(); ++i) {
                file(i, planes_, face_count_);
                if (face_of_[i] != kNoFace) outside_[outside_count_++] = static_cast<uint16_t>(i);
            }
            const uint32_t room = most + has_tip_;
            for (uint32_t next = farthest(); next != kNoPoint; next = farthest()) {
                if (is_corner(next)) {  // of a shell without depth, whose margin is 0: above itself by rounding
                    face_of_[next] = kNoFace;
                    continue;
                }
                chosen.left_out = above_[next];
                if (corner_count_ == room || !add(next)) break;
                chosen.left_out = 0;
            }
        }
        for (uint32_t k = 0; k < corner_count_; ++k)
            if (source_[k] != kNoPoint) chosen.index[chosen.count++] = source_[k];
        list_faces(chosen);
    }

 private:
    // Without a tip the corners are numbered as the points that were chosen.
    void list_faces(ExtremePoints& chosen) const {
        for (uint32_t f = 0; f < face_count_ && !has_tip_; ++f)
            if (faces_[f].is_used && chosen.face_count < 2 * kMostHullPoints)
                chosen.face[chosen.face_count++] = {faces_[f].corner[0], faces_[f].corner[1], faces_[f].corner[2]};
    }
    template <class Measure>
    uint32_t best(Measure measure, float& most) const {
        uint32_t at = 0;
        most = measure(points_[0]);
        for (uint32_t i = 1; i < points_.size(); ++i)
            if (const float m = measure(points_[i]); m > most) most = m, at = i;
        return at;
    }
    bool is_corner(uint32_t i) const {
        return std::find(source_, source_ + corner_count_, i) != source_ + corner_count_;
    }
    void add_corner(uint32_t i) {
        corner_[corner_count_] = points_[i];
        source_[corner_count_++] = i;
    }

    // A tetrahedron of far points; over flat ones with a tip of its own. False: all lie on a line.
    bool start() {
        float most;
        const Vec3 first = points_[0];
        add_corner(best([&](Vec3 p) { return dot(p - first, p - first); }, most));
        if (!(most > 0)) return false;
        const Vec3 a = corner_[0];
        add_corner(best([&](Vec3 p) { return dot(p - a, p - a); }, most));
        const float reach = std::sqrt(most);
        const Vec3 way = normalised(corner_[1] - a);
        const uint32_t third = best([&](Vec3 p) { return dot(cross(way, p - a), cross(way, p - a)); }, most);
        if (!(most > enough_ * enough_)) return false;
        add_corner(third);
        const Vec3 n = normalised(cross(corner_[1] - a, corner_[2] - a));
        const uint32_t fourth = best([&](Vec3 p) { return std::fabs(dot(n, p - a)); }, most);
        has_tip_ = !(most > enough_);
        if (has_tip_) {
            corner_[corner_count_] = (1.0f / 3.0f) * (a + corner_[1] + corner_[2]) + reach * n;
            source_[corner_count_++] = kNoPoint;
        } else {
            add_corner(fourth);
        }
        const bool is_above = dot(n, corner_[3] - a) > 0;
        const uint8_t one = is_above ? 2 : 1, two = is_above ? 1 : 2;
        make_face(0, one, two);
        make_face(0, two, 3);
        make_face(two, one, 3);
        make_face(one, 0, 3);
        return true;
    }

    uint32_t make_face(uint32_t a, uint32_t b, uint32_t c) {
        uint32_t f = 0;
        while (f < face_count_ && faces_[f].is_used) ++f;
        CULLET_ASSERT(f < kMostFaces, "no face is left for a hull of %u points", corner_count_);
        if (f == face_count_ && face_count_++ % kLanes == 0) planes_.clear_four_from(f);
        Face& face = faces_[f];
        face.is_used = true;
        const uint32_t corner[3] = {a, b, c};
        for (int k = 0; k < 3; ++k) {
            face.corner[k] = static_cast<uint8_t>(corner[k]);
            face_of_edge_[corner[k]][corner[(k + 1) % 3]] = static_cast<uint8_t>(f);
        }
        const Vec3 normal = normalised(cross(corner_[b] - corner_[a], corner_[c] - corner_[a]));
        planes_.set(f, normal, dot(normal, corner_[a]));
        return f;
    }

    // The face that point i lies farthest above, the first of equals; kNearFaces where that is no more than enough,
    // kNoFace inside of all.
    void file(uint32_t i, const Planes& planes, uint32_t count) {
        const Vec3 p = points_[i];
        Lanes farthest{};
        LaneMask from{};  // the first of the four planes
        for (uint32_t f = 0; f < count; f += kLanes) {
            const Lanes gap = planes.gaps(f, p);
            const LaneMask is_farther = gap > farthest;
            farthest = is_farther ? gap : farthest;
            from = is_farther ? LaneMask{} + static_cast<int32_t>(f) : from;
        }
        float most = 0;
        int32_t face = kNoFace;
        for (uint32_t k = 0; k < kLanes && is_any(farthest > 0); ++k) {
            const int32_t f = from[k] + static_cast<int32_t>(k);
            if (farthest[k] > most || (farthest[k] > 0 && farthest[k] == most && f < face))
                most = farthest[k], face = f;
        }
        above_[i] = most;
        face_of_[i] = most > enough_ || face == kNoFace ? static_cast<uint8_t>(face) : kNearFaces;
    }
    bool is_above(uint32_t i) const { return face_of_[i] < kMostFaces; }

    uint32_t farthest() const {
        uint32_t at = kNoPoint;
        float most = -1;
        for (uint32_t k = 0; k < outside_count_; ++k) {
            const uint32_t i = outside_[k];
            if (is_above(i) && above_[i] > most) at = i, most = above_[i];
        }
        return at;
    }

    // Faces that are seen have gone, a cone has come for them.
    void file_again(uint32_t i, const bool* is_seen, const Planes& cone, uint32_t count, const uint8_t* number) {
        const uint8_t before = face_of_[i];
        if (is_above(i) && !is_seen[before]) return;
        file(i, cone, count);
        if (is_above(i))
            face_of_[i] = number[face_of_[i]];
        else if (before != kNearFaces)
            file(i, planes_, face_count_);  // it may lie above one that was not seen
        else
            face_of_[i] = kNearFaces;
    }

    // Replaces the faces that see the point by a cone from their outline. Nearly flat ones count as not seeing it, so
    // that rounding tears nothing. False: no room.
    bool add(uint32_t i) {
        const Vec3 p = points_[i];
        bool is_seen[kMostFaces];
        uint32_t free_faces = kMostFaces - face_count_;
        for (uint32_t f = 0; f < face_count_; f += kLanes) {
            const LaneMask sees = planes_.gaps(f, p) > 0.1f * enough_;
            for (uint32_t k = 0; k < kLanes; ++k) is_seen[f + k] = sees[k] != 0;
        }
        for (uint32_t f = 0; f < face_count_; ++f) free_faces += !faces_[f].is_used || is_seen[f];
        uint32_t outline[kMostFaces][2], count = 0;
        for (uint32_t f = 0; f < face_count_; ++f) {
            if (!is_seen[f]) continue;
            for (int k = 0; k < 3; ++k) {
                const uint32_t a = faces_[f].corner[k], b = faces_[f].corner[(k + 1) % 3];
                const uint8_t across = face_of_edge_[b][a];
                if (across != kNoFace && is_seen[across]) continue;
                if (count == free_faces) return false;
                outline[count][0] = a, outline[count++][1] = b;
            }
        }
        const uint32_t apex = corner_count_;
        add_corner(i);
        for (uint32_t f = 0; f < face_count_; ++f)
            if (is_seen[f]) faces_[f].is_used = false, planes_.clear(f);
        Planes cone;
        uint8_t number[kMostFaces];
        for (uint32_t k = 0; k < count; ++k) {
            const uint32_t made = make_face(outline[k][0], outline[k][1], apex);
            if (k % kLanes == 0) cone.clear_four_from(k);
            cone.copy(k, planes_, made);
            number[k] = static_cast<uint8_t>(made);
        }
        uint32_t kept = 0;
        for (uint32_t k = 0; k < outside_count_; ++k) {
            const uint16_t q = outside_[k];
            if (face_of_[q] != kNoFace) file_again(q, is_seen, cone, count, number);
            if (face_of_[q] != kNoFace) outside_[kept++] = q;
        }
        outside_count_ = kept;
        return true;
    }

    std::span<const Vec3> points_;
    float enough_;
    bool has_tip_ = false;
    Vec3 corner_[kMostCorners];
    uint32_t source_[kMostCorners], corner_count_ = 0;
    Face faces_[kMostFaces];
    Planes planes_;
    uint32_t face_count_ = 0;  // none is used from here on
    uint8_t face_of_edge_[kMostCorners][kMostCorners];
    uint16_t outside_[kMostExtremeCandidates];  // points that are not inside of all faces, rising
    uint32_t outside_count_ = 0;
    uint8_t face_of_[kMostExtremeCandidates];
    float above_[kMostExtremeCandidates];
};

}  // namespace

void choose_extremes(ScratchMemory& scratch, std::span<const Vec3> points, uint32_t most, float enough,
                     ExtremePoints& chosen) {
    points = points.first(std::min<size_t>(points.size(), kMostExtremeCandidates));
    const Scratch<Hull> hull(scratch, points, enough);
    hull->choose(std::min(most, kMostHullPoints), chosen);
}

}  // namespace cullet
