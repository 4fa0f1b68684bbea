#include "engine/bullet/seams.hpp"

#include <algorithm>

namespace cullet::bullet {
namespace {

constexpr float kReach = 0.001f;  // m beyond the margins, more than mark_covered() looks past a face

// `is_whole`: of what stands still faces are inner only where they are covered to their corners. What is covered in
// part is looked for where it is touched, see inner_edges.hpp. Of what moves the middle tells: there only faces that go
// on in one plane are searched.
void mark_seam(const Seam& p, const Seam& q, bool is_whole) {
    if (p.hull->has_seams && q.hull->has_seams) return;
    if (!overlap(p.box, q.box, 0)) return;
    mark_covered(*p.hull, *q.hull, is_whole);
    mark_covered(*q.hull, *p.hull, is_whole);
}

// Of the pieces listed those that have none yet, against all.
void mark_few(std::span<const Seam> near, bool is_whole) {
    for (const Seam& p : near) {
        if (p.hull->has_seams) continue;
        for (const Seam& q : near)
            if (q.hull->has_seams || q.hull->ordinal > p.hull->ordinal) mark_seam(p, q, is_whole);
    }
}

// Only pieces whose boxes meet can cover a face. Sorted along x by the low ends, ties by order.
void mark_many(std::span<Seam> near, bool is_whole) {
    std::sort(near.begin(), near.end(), [](const Seam& p, const Seam& q) {
        return p.box.low.x != q.box.low.x ? p.box.low.x < q.box.low.x : p.hull->ordinal < q.hull->ordinal;
    });
    for (size_t k = 0; k < near.size(); ++k)
        for (size_t j = k + 1; j < near.size() && near[j].box.low.x <= near[k].box.high.x; ++j)
            mark_seam(near[k], near[j], is_whole);
}

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

void mark_seams(Body& body, std::vector<Seam>& near) {
    Box changed = empty_box();
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        if (hull->has_seams) continue;
        include(changed, hull->local_box.low);
        include(changed, hull->local_box.high);
    }
    near.clear();
    size_t unknown = 0;
    for (Hull* hull = body.hulls; hull; hull = hull->next) {
        const Box box = grown(hull->local_box, kReach);
        if (!overlap(box, changed, kReach)) continue;
        near.push_back({box, hull});
        unknown += !hull->has_seams;
    }
    const bool is_whole = body.kind == RigidKind::Static;
    if (8 * unknown < near.size())
        mark_few(near, is_whole);
    else
        mark_many(near, is_whole);
    for (const Seam& seam : near) seam.hull->has_seams = true;
}

}  // namespace cullet::bullet
