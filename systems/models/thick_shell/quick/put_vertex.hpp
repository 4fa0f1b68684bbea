// A vertex on an edge of a shell that moves by springs.
#pragma once
#include "systems/models/thick_shell/quick/region.hpp"
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// insert_vertex, and what the springs need: the inner point lies between the inner points, the edge's springs are
/// forgotten, the vertex is in the region if its edge is. Lumping moves mass inwards, which takes angular momentum. The
/// vertices round the new one and their neighbours get it back, a turn about their centre. So momentum and angular
/// momentum of any piece that they are part of stay as they were. The method spreads it over the piece. To know the
/// pieces in the middle of a run takes a pass over the body. Not where one of them is pinned or asleep. Returns the
/// vertex.
uint32_t put_vertex(const RegionView& region, uint32_t element, uint32_t edge, float tau, Touched& touched);

}  // namespace cullet
