// A closed mesh as convex pieces for the rigid world: its surface halved by planes (solid cooking note, section 8).
#pragma once
#include <optional>
#include <span>

#include "engine/math.hpp"
#include "engine/ray_scene.hpp"
#include "engine/room.hpp"
#include "engine/scratch.hpp"

namespace cullet {

struct HalvingSettings {
    double most_excess = 1.2;  // a hull's volume over that of what it wraps, before that is halved
    uint32_t depth = 6;        // halvings, one after the other; 4 after a break
};

struct SolidHull {
    List<Vec3> points;       // at most 32, of the mesh's frame
    double volume = 0;       // m3, of the solid in it
    double hull_volume = 0;  // m3
};

/// Hulls of all of the solid, and as little more as the settings ask for. Each piece is cut at a quarter, the middle or
/// three quarters along one of its principal axes, where the hulls of both sides are smallest. Self-crossing meshes and
/// those with cavities will do.
List<SolidHull> convex_pieces(ScratchMemory& scratch, std::span<const Vec3d> places,
                              std::span<const Triangle> triangles, const HalvingSettings& settings = {});

/// The same, one halving after the other.
class ConvexHalving {
 public:
    ConvexHalving(std::span<const Vec3d> places, std::span<const Triangle> triangles,
                  const HalvingSettings& settings = {});
    ~ConvexHalving();
    ConvexHalving(const ConvexHalving&) = delete;
    ConvexHalving& operator=(const ConvexHalving&) = delete;

    /// True: all hulls are there.
    bool advance(ScratchMemory& scratch);
    /// Triangles that the next step looks at.
    size_t next_rows() const;
    List<SolidHull> take();

 private:
    class Halver;
    List<std::optional<Halver>> halver_;  // one: it stands where lists stand
};

}  // namespace cullet
