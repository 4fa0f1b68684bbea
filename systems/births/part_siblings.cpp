#include "systems/births/part_siblings.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/bodies/blows.hpp"

namespace cullet {
namespace {

constexpr float kStrikerSeconds = 0.1f;
constexpr float kTouch = 0.004f;  // m between the bounds of two siblings that count as in touch

bool are_near(const PieceBounds& a, const PieceBounds& b) {
    return a.low.x <= b.high.x + kTouch && b.low.x <= a.high.x + kTouch && a.low.y <= b.high.y + kTouch &&
           b.low.y <= a.high.y + kTouch && a.low.z <= b.high.z + kTouch && b.low.z <= a.high.z + kTouch;
}

/// Where fragments had been one, pair by pair: world axes.
class Cracks {
 public:
    /// Without room in the arena there are none.
    Cracks(const Touches& touches, Rows<Touches> of, const Pose& pose, Arena& arena)
        : of_(arena.take<Between>(of.count)), touches_(arena.take<CrackTouch>(of.count)) {
        if (of_.size() < of.count || touches_.size() < of.count) of_ = {};
        for (uint32_t k = 0; k < of_.size(); ++k) {
            const uint32_t t = of.first + k, a = touches.a[t], b = touches.b[t];
            of_[k] = {std::min(a, b), std::max(a, b), t};
        }
        std::sort(of_.begin(), of_.end());
        for (size_t k = 0; k < of_.size(); ++k) {
            const uint32_t t = of_[k].touch;
            const Vec3 normal = rotate(pose.orientation, touches.normal[t].to_float());
            touches_[k] = {to_world(pose, touches.point[t].to_float()), touches.a[t] < touches.b[t] ? normal : -normal,
                           static_cast<float>(touches.reach[t])};
        }
    }
    /// Normals from q towards p, p < q.
    std::span<const CrackTouch> between(uint32_t p, uint32_t q) const {
        const auto first = std::lower_bound(of_.begin(), of_.end(), Between{p, q, 0}),
                   last = std::lower_bound(first, of_.end(), Between{p, q + 1, 0});
        return touches_.subspan(static_cast<size_t>(first - of_.begin()), static_cast<size_t>(last - first));
    }

 private:
    struct Between {
        uint32_t p, q, touch;
        auto operator<=>(const Between& other) const = default;
    };
    std::span<Between> of_;
    std::span<CrackTouch> touches_;
};

}  // namespace

void name_siblings(Births& births, const Break& of) {
    const auto ids = births.arena.take<RigidId>(of.fragments.count);
    size_t count = 0;
    for (const Row<Fragments> f : of.fragments)
        if (count < ids.size() && births.fragments.child[f].exists()) ids[count++] = births.fragments.child[f];
    births.rigid.name_siblings(ids.first(count));
}

void part_siblings(Births& births, const Break& of, const Moment& moment, std::span<const PieceBounds> bounds) {
    const bool has_own_motion = of.task.exists() ? !is_cut_task(births.blows, of.task) : of.waited > 0;
    if (!has_own_motion) return;
    const auto& child = births.fragments.child;
    const uint32_t first = of.fragments.first, end = first + of.fragments.count;
    const Cracks cracks(births.touches, of.start.touches, moment.pose, births.arena);
    for (uint32_t p = first; p < end; ++p)
        for (uint32_t q = p + 1; q < end; ++q)
            if (child[p].exists() && child[q].exists() && are_near(bounds[p - first], bounds[q - first]))
                births.rigid.part_siblings(child[p], child[q], cracks.between(p, q));
}

void part_strikers(Births& births, const Break& of, bool is_late) {
    auto& state = births.state;
    const uint32_t first = state.tasks.first_contact[of.task], end = first + state.tasks.contact_count[of.task];
    for (const Row<Fragments> f : of.fragments) {
        const Row<Bodies> child = births.fragments.child[f];
        if (!child.exists()) continue;
        for (uint32_t c = first; c < end; ++c) {
            const Row<Bodies> striker = state.task_contacts.striker[c];
            if (!striker.exists()) continue;
            if (f == of.largest && !is_late) births.rigid.skip_contacts(of.body, striker);
            if (static_cast<BodyKind>(state.bodies.kind[striker]) == BodyKind::Dynamic)
                births.rigid.ignore_pair(child, striker, kStrikerSeconds);
        }
    }
}

}  // namespace cullet
