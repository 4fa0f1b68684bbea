// The closed surfaces of the pieces of a solid: what they have of its triangles, and crack faces that meet them in the
// same points (solid cooking note, section 7, step 4).
#pragma once
#include <optional>
#include <span>
#include <string>

#include "cullet/result.hpp"
#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

namespace cullet {

struct PieceTriangle {
    std::array<uint32_t, 3> corners;  // of places, counter-clockwise from outside
    uint32_t source = 0;              // triangle of the closed mesh; kNone: of a crack
};
struct PieceSkin {
    List<Vec3d> places;  // m, each once
    List<PieceTriangle> triangles;
};

/// What is cut: near cracks is enough, and all gives the same.
enum class CutExtent : uint8_t { NearCracks, All };

/// Such a cut bit by bit, since no frame is long enough for all of it. What it is given must stay as long as it does.
///
/// `piece_of`: of each cell, below `count`; kNone: it left with others before. `points`: of the lattice, those that
/// cracks moved included; empty: as cooked. Triangles whose polygons all have one piece go to it whole. Every directed
/// edge of a skin runs back as often.
class PieceCut {
 public:
    PieceCut(const CookedSolid& solid, std::span<const Vec3d> points, std::span<const uint32_t> piece_of,
             uint32_t count, CutExtent extent = CutExtent::NearCracks);
    ~PieceCut();
    PieceCut(const PieceCut&) = delete;
    PieceCut& operator=(const PieceCut&) = delete;

    /// A millisecond of it, or less. True: it is done, and skins may be asked for if there is no error.
    bool advance();
    /// That the last step took, or the last skin, by counts of what it looked at.
    double nanoseconds() const { return ns_; }
    const std::string& error() const { return error_; }
    PieceSkin skin_of(uint32_t piece);
    /// So many triangles did not go to one piece whole without being looked at.
    size_t cut_triangles() const;

 private:
    struct Work;
    enum class Stage : uint8_t { Region, Begin, Cut, Label, Divide, Faces, Done };
    List<std::optional<Work>> work_;  // one: it stands where lists stand
    Stage stage_ = Stage::Region;
    CutExtent extent_;
    double ns_ = 0;
    std::string error_;
};

Result<List<PieceSkin>> cut_pieces(const CookedSolid& solid, std::span<const Vec3d> points,
                                   std::span<const uint32_t> piece_of, uint32_t count,
                                   CutExtent extent = CutExtent::NearCracks);

}  // namespace cullet
