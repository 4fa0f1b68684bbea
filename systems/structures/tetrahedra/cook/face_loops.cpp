#include <algorithm>

#include "engine/assert.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cut_work.hpp"

namespace cullet {
namespace {

/// A piece of a way round what lies inside.
struct Piece {
    uint32_t part;
    CutKey from, to;
};
bool before(const Piece& a, const Piece& b) {
    if (a.part != b.part) return a.part < b.part;
    return a.from == b.from ? a.to < b.to : a.from < b.from;
}

/// Where each part begins and ends along an edge, from its lower end: each start with the next end of the same part,
/// once for all faces around the edge.
class Intervals {
 public:
    Intervals(const CutRequest& request, const Cut& cut) : request_(request), cut_(cut) {}

    /// Appends those of an edge, as they run along it or back.
    void add(uint32_t edge, bool is_forward, List<Piece>& pieces) {
        const auto [low, high] = request_.faces.edges[edge];
        if (cut_.first_piercing[edge] == cut_.first_piercing[edge + 1]) {
            // The same parts at both ends.
            for (const Winding& w : cut_.windings.of(low)) {
                const bool is_back = (w.count < 0) == is_forward;
                const CutKey a(CutKeyKind::LatticePoint, low), b(CutKeyKind::LatticePoint, high);
                for (int32_t n = 0; n < std::abs(w.count); ++n)
                    pieces.push_back({w.part, is_back ? b : a, is_back ? a : b});
            }
            return;
        }
        marks_.clear();
        mark_end(low, 1);
        for (uint32_t i = cut_.first_piercing[edge]; i < cut_.first_piercing[edge + 1]; ++i) {
            const Piercing& p = cut_.piercings[i];
            marks_.push_back(
                {request_.mesh.part_of[p.triangle], p.sign, CutKey(CutKeyKind::OnTriangle, p.triangle, edge), false});
        }
        mark_end(high, -1);
        for (size_t i = 0; i < marks_.size(); ++i) {
            if (marks_[i].is_used) continue;
            size_t other = i + 1;
            while (other < marks_.size() && (marks_[other].is_used || marks_[other].part != marks_[i].part ||
                                             marks_[other].sign == marks_[i].sign))
                ++other;
            CULLET_ASSERT(other < marks_.size(), "edge %u: what begins on it does not end", edge);
            marks_[other].is_used = true;
            const bool is_back = (marks_[i].sign < 0) == is_forward;
            const CutKey a = marks_[i].key, b = marks_[other].key;
            pieces.push_back({marks_[i].part, is_back ? b : a, is_back ? a : b});
        }
    }

 private:
    struct Mark {
        uint32_t part;
        int32_t sign;  // 1 begins, -1 ends
        CutKey key;
        bool is_used;
    };
    void mark_end(uint32_t point, int32_t sign) {
        for (const Winding& w : cut_.windings.of(point))
            for (int32_t n = 0; n < std::abs(w.count); ++n)
                marks_.push_back({w.part, w.count > 0 ? sign : -sign, CutKey(CutKeyKind::LatticePoint, point), false});
    }
    const CutRequest& request_;
    const Cut& cut_;
    List<Mark> marks_;
};

void add_loop(Cut& cut, uint32_t face, uint32_t part, size_t first) {
    cut.loops.push_back({face, part, static_cast<uint32_t>(first), static_cast<uint32_t>(cut.keys.size() - first)});
}

// Every key is left as often as it is reached, so that a walk ends where it began.
void chain(List<Piece>& pieces, uint32_t face, Cut& cut) {
    std::sort(pieces.begin(), pieces.end(), before);
    List<uint8_t> is_used(pieces.size());
    for (size_t start = 0; start < pieces.size(); ++start) {
        if (is_used[start]) continue;
        const size_t first = cut.keys.size();
        for (size_t at = start;;) {
            is_used[at] = 1;
            cut.keys.push_back(pieces[at].from);
            if (pieces[at].to == pieces[start].from) break;
            size_t next = static_cast<size_t>(
                std::lower_bound(pieces.begin(), pieces.end(), Piece{pieces[at].part, pieces[at].to, {}}, before) -
                pieces.begin());
            while (next < pieces.size() && is_used[next]) ++next;
            CULLET_ASSERT(
                next < pieces.size() && pieces[next].from == pieces[at].to && pieces[next].part == pieces[start].part,
                "face %u: its inside part is open", face);
            at = next;
        }
        add_loop(cut, face, pieces[start].part, first);
    }
}

}  // namespace

void find_loops(const CutRequest& request, const List<FaceSegment>& segments, Cut& cut) {
    const auto& faces = request.faces.faces;
    List<uint32_t> first(faces.size() + 1);
    for (const FaceSegment& s : segments) ++first[s.face + 1];
    for (size_t f = 0; f < faces.size(); ++f) first[f + 1] += first[f];
    List<uint32_t> sorted(segments.size()), next(first.begin(), first.end() - 1);
    for (uint32_t i = 0; i < segments.size(); ++i) sorted[next[segments[i].face]++] = i;

    Intervals intervals(request, cut);
    List<Piece> pieces;
    const auto add_face = [&](uint32_t f) {
        const LatticeFace& face = faces[f];
        bool is_whole = first[f] == first[f + 1];
        for (const uint32_t e : face.edge) is_whole = is_whole && cut.first_piercing[e] == cut.first_piercing[e + 1];
        if (is_whole) {
            for (const Winding& w : cut.windings.of(face.corner[0]))
                for (int32_t n = 0; n < std::abs(w.count); ++n) {
                    const size_t begin = cut.keys.size();
                    for (uint32_t k = 0; k < 3; ++k)
                        cut.keys.push_back(
                            CutKey(CutKeyKind::LatticePoint, face.corner[w.count > 0 ? k : (3 - k) % 3]));
                    add_loop(cut, f, w.part, begin);
                }
            return;
        }
        pieces.clear();
        for (uint32_t i = first[f]; i < first[f + 1]; ++i) {
            const FaceSegment& s = segments[sorted[i]];
            pieces.push_back({request.mesh.part_of[s.triangle], s.from, s.to});
        }
        for (uint32_t k = 0; k < 3; ++k) intervals.add(face.edge[k], face.is_forward[k], pieces);
        chain(pieces, f, cut);
    };
    if (request.wanted_faces.empty())
        for (uint32_t f = 0; f < faces.size(); ++f) add_face(f);
    for (const uint32_t f : request.wanted_faces) add_face(f);
}

}  // namespace cullet
