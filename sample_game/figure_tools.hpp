// Figures from implicit functions: parts that are blended into one smooth solid, and the way from there to a mesh with
// a wanted number of vertices.
#pragma once
#include <functional>

#include "sample_game/mesh_tools.hpp"

namespace cullet {

/// About the distance to an ellipsoid, negative inside: k (k - 1) / |grad k| with k = |p / r|. Exact on the surface,
/// where it counts.
double ellipsoid(Vec3d p, Vec3d centre, Vec3d r);
/// Distance to a rod from a to b with round ends.
double rod(Vec3d p, Vec3d a, Vec3d b, double radius);
/// A rod whose radius goes from `radius_a` to `radius_b`: about the distance, exact where both are the same.
double tapered_rod(Vec3d p, Vec3d a, Vec3d b, double radius_a, double radius_b);
/// Union with a fillet about `width` wide: the quadratic polynomial minimum.
double blend(double a, double b, double width);

/// A solid {f < 0} in a box: f grows about as the distance does. Lengths in units of the figure.
struct Figure {
    std::function<double(Vec3d)> f;
    Vec3d low, high;
};

/// The nearest point of the surface, for points near it: Newton steps along the gradient.
Vec3d onto(const Figure& figure, Vec3d p);

/// Polygonised and remeshed to near-equilateral triangles, then the longest edges split until it has exactly so many
/// vertices (500 to 200,000). The surface must be one closed piece.
MeshDraft figure_of(const Figure& figure, size_t vertices, uint64_t seed);

/// Stands the figure on y = 0, middle of x and z = 0 over the origin, scaled to `length` along x.
void stand(MeshDraft& surface, double length);

}  // namespace cullet
