#include "sample_game/draw_world.hpp"

#include <algorithm>
#include <deque>
#include <numeric>

#include "engine/jobs.hpp"
#include "engine/random.hpp"
#include "sample_game/meshes.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr Vec3 kSteel{0.20f, 0.21f, 0.22f};
constexpr float kPolished = 0.8f;

FaceKind kind_of(SurfaceKind kind) {
    return kind == SurfaceKind::Inner   ? FaceKind::Inner
           : kind == SurfaceKind::Crack ? FaceKind::Crack
                                        : FaceKind::Outer;
}

struct LookedAt {
    const GameWorld& game;
    PictureLook look;
    const Unmoved& unmoved;

    bool is_real() const { return look == PictureLook::Material; }
    const Look& of(uint64_t user_data) const {
        const std::vector<Look>& looks = game.stage().looks;
        return looks[user_data < looks.size() ? user_data : 0];
    }
};

/// What the spans of the drawn bodies point to. Deques: addresses stay.
struct Drawing {
    std::deque<std::vector<Vec3>> points;
    std::deque<std::vector<uint32_t>> indices;
    std::deque<std::vector<DrawnRun>> runs;
    std::deque<std::vector<DrawnLine>> lines;
    std::vector<DrawnBody> bodies;

    DrawnBody& add(const Mesh& mesh, float scale = 1) {
        std::vector<Vec3>& p = points.emplace_back(mesh.positions);
        for (Vec3& point : p) point = scale * point;
        std::vector<uint32_t>& i = indices.emplace_back();
        for (const auto& triangle : mesh.triangles) i.insert(i.end(), triangle.begin(), triangle.end());
        DrawnBody& body = bodies.emplace_back();
        body.positions = p;
        body.indices = i;
        return body;
    }
    DrawnBody& add(const BodyView& view, const std::vector<uint32_t>& hairlines) {
        std::vector<Vec3>&p = points.emplace_back(), &n = points.emplace_back();
        p.reserve(view.vertex_count), n.reserve(view.vertex_count);
        for (uint32_t v = 0; v < view.vertex_count; ++v) {
            p.push_back(view.vertices[v].position);
            n.push_back(view.vertices[v].normal);
        }
        std::vector<DrawnRun>& r = runs.emplace_back();
        for (uint32_t run = 0; run < view.run_count; ++run)
            r.push_back({view.runs[run].first_index, view.runs[run].index_count, kind_of(view.runs[run].kind)});
        std::vector<DrawnLine>& l = lines.emplace_back();
        for (size_t i = 0; i + 1 < hairlines.size(); i += 2) {
            const ViewVertex &from = view.vertices[hairlines[i]], &to = view.vertices[hairlines[i + 1]];
            l.push_back({from.position, to.position, from.uv.y > 0 ? FaceKind::Inner : FaceKind::Outer});
        }
        DrawnBody& body = bodies.emplace_back();
        body.pose = view.pose;
        body.positions = p;
        body.normals = n;
        body.indices = {view.indices, view.index_count};
        body.runs = r;
        body.lines = l;
        return body;
    }
};

/// Wood has its grain along y; boards and posts, which are parts of their own, have it along their longest side.
std::vector<Vec3> along_the_boards(const Mesh& mesh) {
    std::vector<uint32_t> part(mesh.positions.size());
    std::iota(part.begin(), part.end(), 0u);
    const auto first_of = [&part](uint32_t v) {
        while (part[v] != v) v = part[v] = part[part[v]];
        return v;
    };
    for (const auto& corners : mesh.triangles)
        for (const uint32_t v : corners) part[first_of(v)] = first_of(corners[0]);
    std::vector<MeshExtent> extents(mesh.positions.size(), {{1e9f, 1e9f, 1e9f}, {-1e9f, -1e9f, -1e9f}});
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        MeshExtent& extent = extents[first_of(v)];
        const Vec3 p = mesh.positions[v];
        extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y), std::min(extent.low.z, p.z)};
        extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y), std::max(extent.high.z, p.z)};
    }
    std::vector<Vec3> turned = mesh.positions;
    for (uint32_t v = 0; v < turned.size(); ++v) {
        const Vec3 size = extents[first_of(v)].high - extents[first_of(v)].low, p = turned[v];
        if (size.x >= size.y && size.x >= size.z)
            turned[v] = {p.y, p.x, p.z};
        else if (size.z >= size.y)
            turned[v] = {p.x, p.z, p.y};
    }
    return turned;
}

void add_props(Drawing& drawing, const Stage& stage) {
    for (const Prop& prop : stage.props) {
        if (prop.is_ground) continue;
        DrawnBody& body = drawing.add(prop.mesh);
        body.colour = prop.colour;
        body.gloss = 0;
        body.finish = prop.finish;
        if (prop.finish == Finish::Wood) body.unmoved = drawing.points.emplace_back(along_the_boards(prop.mesh));
        body.is_outlined = false;
    }
}

void add_movers(Drawing& drawing, const Stage& stage) {
    for (const Mover& mover : stage.movers) {
        const Result<Pose> pose = stage.world->pose(mover.body);
        if (!pose.ok()) continue;
        DrawnBody& body = drawing.add(mover.mesh);
        body.pose = *pose;
        body.colour = mover.colour;
        body.gloss = 0;
        body.is_outlined = false;
    }
}

void add_bodies(Drawing& drawing, const LookedAt& at) {
    const World& world = at.game.world();
    const Bodies& rows = world.contents().data.state.bodies;
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    const Mesh ball = make_ball(1, 4);
    const std::vector<Vec3>& outward = drawing.points.emplace_back(ball.positions);
    for (const BodyId id : ids) {
        const uint32_t b = id.index;
        if (rows.is_sphere[b]) {
            DrawnBody& body = drawing.add(ball, rows.radius[b]);
            body.pose = {rows.position[b], rows.orientation[b]};
            body.colour = kSteel;
            body.gloss = kPolished;
            body.finish = Finish::Steel;
            if (at.is_real()) body.normals = outward, body.is_outlined = false;
            continue;
        }
        const Result<BodyView> view = world.view(id);
        if (!view.ok() || view.value().index_count == 0) continue;
        std::vector<uint32_t> lines(view->index_count / 2);
        lines.resize(world.hairlines(id, lines.data(), static_cast<uint32_t>(lines.size())).value_or(0));
        DrawnBody& body = drawing.add(view.value(), lines);
        // Grey for what keeps the old body: the largest piece.
        body.colour = fragment_colour(rows.parent[b].exists() ? rows.colour[b] : 0);
        const Look& look = at.of(rows.user_data[b]);
        body.opacity = look.opacity;
        body.gloss = look.gloss;
        body.finish = look.finish;
        body.pattern_size = look.pattern_size;
        if (at.is_real()) body.unmoved = drawing.points.emplace_back(at.unmoved.of(id, *view));
        if (at.is_real()) body.is_outlined = look.finish == Finish::Glass;
    }
}

/// An icosahedron whose corners are pushed in and out, flattened: a chip of stone of about `radius`.
Mesh make_chip(uint32_t number, float radius) {
    constexpr uint64_t kSeed = 0x63686970;
    constexpr float kFlat = 0.6f;
    const Random random{kSeed};
    Mesh chip = make_ball(radius, 0);
    for (uint32_t v = 0; v < chip.positions.size(); ++v) {
        const float out = 0.7f + 0.6f * static_cast<float>(random.uniform(number, v));
        const Vec3 p = out * chip.positions[v];
        chip.positions[v] = {p.x, kFlat * p.y, p.z};
    }
    return chip;
}

/// Debris is of no piece's colour: it is too much and too small to be told apart. It looks like the inside of what it
/// came off, as long as that body's row is not another's.
void add_debris(Drawing& drawing, const LookedAt& at) {
    const State& state = at.game.world().contents().data.state;
    const Debris& debris = state.debris;
    const Random random{0x7475726e};
    for (uint32_t d = 0; d < debris.size(); ++d) {
        if (!debris.is_used[d]) continue;
        const auto turn = [&](uint64_t k) { return static_cast<float>(random.uniform(d, k) - 0.5); };
        std::vector<DrawnRun>& whole = drawing.runs.emplace_back();
        DrawnBody& body = drawing.add(make_chip(d, debris.radius[d]));
        const uint32_t came_off = debris.colour[d];
        const Look& look = at.of(came_off < state.bodies.size() ? state.bodies.user_data[came_off] : 0);
        body.finish = look.finish;
        body.opacity = at.is_real() ? look.opacity : 1;
        body.pattern_size = look.pattern_size;
        if (at.is_real()) {
            whole.push_back({0, static_cast<uint32_t>(body.indices.size()), FaceKind::Crack});
            body.runs = whole;
        }
        body.pose = {debris.position[d], normalised(Quat{turn(0), turn(1), turn(2), turn(3)})};
        body.colour = fragment_colour(0);
        body.is_outlined = false;
    }
}

}  // namespace

Picture draw_world(const GameWorld& game, const Camera& camera, PictureLook look, uint32_t threads, uint32_t width,
                   const Unmoved& unmoved) {
    const LookedAt at{game, look, unmoved};
    Drawing drawing;
    add_props(drawing, game.stage());
    add_movers(drawing, game.stage());
    add_bodies(drawing, at);
    add_debris(drawing, at);
    PictureSettings settings;
    settings.width = width / 2 * 2, settings.height = width * 9 / 32 * 2;  // even, as films want it
    settings.ground_height = game.stage().ground_height();
    settings.has_ground = game.stage().has_ground();
    settings.has_finishes = at.is_real();
    if (at.is_real()) settings.exposure = 0.55f;
    const std::unique_ptr<JobSystem> jobs = make_jobs(JobBackend::Threads, threads);
    settings.for_each = [&jobs](uint32_t count, const std::function<void(uint32_t)>& job) {
        parallel_for(*jobs, count, [&job](uint32_t i) { job(i); });
    };
    return draw(drawing.bodies, camera, game.stage().sun, settings);
}

}  // namespace cullet
