// Directions where local caps bite. Evening them out there lets opposite walls go deeper; evening out all of them thins
// walls that were fine, and round lips finer than the wall lose. So each patch keeps whichever gives the thicker wall.
#include "systems/structures/shell/cook/local_caps.hpp"

namespace cullet {
namespace {

constexpr double kBites = 0.9;  // of the first cap
constexpr int kRingsAround = 2;
constexpr int kPasses = 10;
constexpr double kKeepsFacing = 0.6;  // of the facing of the first direction
constexpr double kLeastKept = 0.1;

std::vector<uint8_t> mark_pinched(const ExtrusionWork& work) {
    std::vector<uint8_t> is_marked(work.vertex_count());
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        is_marked[v] = work.caps[v] < kBites * work.first_caps[v];
    }
    for (int ring = 0; ring < kRingsAround; ++ring) {
        const std::vector<uint8_t> before = is_marked;
        for (const Triangle& t : work.surface.triangles)
            if (before[t[0]] || before[t[1]] || before[t[2]]) is_marked[t[0]] = is_marked[t[1]] = is_marked[t[2]] = 1;
    }
    for (uint32_t v = 0; v < work.vertex_count(); ++v) is_marked[v] = is_marked[v] && !work.is_frozen[v];
    return is_marked;
}

// m <- normalise(m + normalise(sum of the neighbours' m)), all at once, while m still faces the triangles well enough.
void even_out(ExtrusionWork& work, const std::vector<uint32_t>& marked) {
    const std::vector<double> facing = work.facing;
    std::vector<Vec3d> next(marked.size());
    for (int pass = 0; pass < kPasses; ++pass) {
        for (size_t k = 0; k < marked.size(); ++k) {
            const uint32_t v = marked[k];
            Vec3d sum;
            for (const uint32_t t : work.ring[v])
                for (const uint32_t w : work.surface.triangles[t])
                    if (w != v) sum += work.directions[w];
            const Vec3d m = normalised(work.directions[v] + normalised(sum));
            next[k] =
                least_facing(work, v, m) >= std::max(kLeastKept, kKeepsFacing * facing[v]) ? m : work.directions[v];
        }
        for (size_t k = 0; k < marked.size(); ++k) work.directions[marked[k]] = next[k];
    }
    for (const uint32_t v : marked) work.facing[v] = least_facing(work, v, work.directions[v]);
}

// Depth at full cap under the worst face of the vertex, times the area around: stands for the volume the wall gains.
// (The true distance from the surface decides alike and costs more than all other caps together.)
std::vector<double> wall_at_caps(const ExtrusionWork& work, const std::vector<uint32_t>& marked) {
    std::vector<double> volume;
    for (const uint32_t v : marked) {
        double area = 0;
        for (const uint32_t t : work.ring[v]) area += work.areas[t];
        volume.push_back(area * work.facing[v] * work.caps[v]);
    }
    return volume;
}

// Connected sets of marked vertices; the lowest place in `marked` names the set.
std::vector<uint32_t> find_patches(const ExtrusionWork& work, const std::vector<uint32_t>& marked) {
    std::vector<uint32_t> place(work.vertex_count(), kNone), patch(marked.size(), kNone), waiting;
    for (uint32_t k = 0; k < marked.size(); ++k) place[marked[k]] = k;
    for (uint32_t seed = 0; seed < marked.size(); ++seed) {
        if (patch[seed] != kNone) continue;
        patch[seed] = seed;
        waiting.assign(1, seed);
        while (!waiting.empty()) {
            const uint32_t v = marked[waiting.back()];
            waiting.pop_back();
            for (const uint32_t t : work.ring[v])
                for (const uint32_t w : work.surface.triangles[t])
                    if (place[w] != kNone && patch[place[w]] == kNone) {
                        patch[place[w]] = seed;
                        waiting.push_back(place[w]);
                    }
        }
    }
    return patch;
}

}  // namespace

void straighten(ExtrusionWork& work, const OppositeWall& wall) {
    const std::vector<uint8_t> is_marked = mark_pinched(work);
    std::vector<uint32_t> marked;
    for (uint32_t v = 0; v < work.vertex_count(); ++v)
        if (is_marked[v]) marked.push_back(v);
    if (marked.empty()) return;

    const std::vector<Vec3d> directions = work.directions;
    const std::vector<double> facing = work.facing, wall_caps = work.wall_caps;
    const std::vector<double> crooked = wall_at_caps(work, marked);
    even_out(work, marked);
    find_wall_caps(work, wall, is_marked);
    find_local_caps(work);
    const std::vector<double> even = wall_at_caps(work, marked);

    const std::vector<uint32_t> patch = find_patches(work, marked);
    std::vector<double> gain(marked.size());
    for (size_t k = 0; k < marked.size(); ++k) gain[patch[k]] += even[k] - crooked[k];
    for (size_t k = 0; k < marked.size(); ++k) {
        const uint32_t v = marked[k];
        if (gain[patch[k]] > 0) {
            ++work.statistics.straightened_vertices;
            continue;
        }
        work.directions[v] = directions[v];
        work.facing[v] = facing[v];
        work.wall_caps[v] = wall_caps[v];
    }
    if (work.statistics.straightened_vertices < marked.size()) find_local_caps(work);
}

}  // namespace cullet
