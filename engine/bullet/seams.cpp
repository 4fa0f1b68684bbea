#include "engine/bullet/seams.hpp"

#include <algorithm>

namespace cullet::bullet {
namespace {

constexpr float kReach = 0.001f;  // m beyond the margins, more than mark_covered() looks past a face

}  // namespace

void forget_seams(Body& body, std::span<const Ball> lost) {
    Box around = empty_box();
    for (const Ball& ball : lost) {
        const Box box = grown({ball.centre, ball.centre}, ball.radius + kSeamRange);
        include(around, box.low);
        include(around, box.high);
    }
    for (Hull* hull = body.hulls; hull; hull = hull->next) {
        const Vec3 centre = hull->local.centre;
        if (!overlap({centre, centre}, around, hull->radius)) continue;
        const bool is_beside = std::any_of(lost.begin(), lost.end(), [&](const Ball& ball) {
            return !(length(centre - ball.centre) > hull->radius + ball.radius + kSeamRange);
        });
        if (!is_beside) continue;
        hull->has_seams = false;
        forget_covered(*hull);
    }
}

// Only pieces whose boxes meet can cover a face: sorted along x by the low ends, ties by order.
void list_seams(Body& body, std::vector<Seam>& seams) {
    Box changed = empty_box();
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        if (hull->has_seams) continue;
        include(changed, hull->local_box.low);
        include(changed, hull->local_box.high);
    }
    const auto first = static_cast<uint32_t>(seams.size());
    for (Hull* hull = body.hulls; hull; hull = hull->next) {
        const Box box = grown(hull->local_box, kReach);
        if (overlap(box, changed, kReach)) seams.push_back({box, hull, is_firm(body), first, 0});
    }
    const auto end = static_cast<uint32_t>(seams.size());
    for (uint32_t k = first; k < end; ++k) seams[k].end = end;
    std::sort(seams.begin() + first, seams.end(), [](const Seam& p, const Seam& q) {
        return p.box.low.x != q.box.low.x ? p.box.low.x < q.box.low.x : p.hull->ordinal < q.hull->ordinal;
    });
}

// Of what is firm faces are inner only where they are covered to their corners. What is covered in part is looked
// for where it is touched, see inner_edges.hpp. Of what moves the middle tells: there only faces that go on in one
// plane are searched. What is known of two pieces stays.
void mark_seam(std::span<const Seam> seams, uint32_t place) {
    const Seam& p = seams[place];
    for (uint32_t k = p.first; k < p.end && seams[k].box.low.x <= p.box.high.x; ++k) {
        const Seam& q = seams[k];
        if (k == place || (p.hull->has_seams && q.hull->has_seams)) continue;
        if (overlap(p.box, q.box, 0)) mark_covered(*p.hull, *q.hull, p.is_firm);
    }
}

}  // namespace cullet::bullet
