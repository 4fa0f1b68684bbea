#include "sample_game/hit_bench.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models/thick_shell/calibrate.hpp"
#include "systems/models/thick_shell/stiffness/stiffen_pinned.hpp"
#include "systems/structures/shell/cook/apply_pins.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"

namespace cullet {
namespace {

/// Brick as the figures know it: few large fragments, cracks that stop where the run leaves them.
MaterialTable table_of_figures() {
    MaterialTable table;
    MaterialSettings brick = table.find("brick").value();
    brick.fracture = FractureKind::Large, brick.branching = brick.run_out = 0;
    (void)table.change(brick);
    return table;
}

constexpr float kPaneSide = 0.5f, kPaneEdge = 0.010f;                       // m
constexpr float kWallWidth = 2.4f, kWallHeight = 1.8f, kWallEdge = 0.078f;  // m
constexpr double kLeastShare = 0.005;                                       // of the mass, of a piece that counts

void pin_frame(const ShellView& shell) {
    const float half = 0.5f * kPaneSide, rim = 0.25f * kPaneEdge, out = 0.01f;
    apply_pins(shell, {-half - out, -out, -out}, {half + out, rim, out});
    apply_pins(shell, {-half - out, kPaneSide - rim, -out}, {half + out, kPaneSide + out, out});
    apply_pins(shell, {-half - out, -out, -out}, {-half + rim, kPaneSide + out, out});
    apply_pins(shell, {half - rim, -out, -out}, {half + out, kPaneSide + out, out});
}

void pin_foot(const ShellView& shell) {
    apply_pins(shell, {-kWallWidth, -0.01f, -1}, {kWallWidth, 0.25f * kWallEdge, 1});
}

/// A ball against a sheet that stands in the plane z = 0 and faces it, somewhere `margin` from the edges.
HitDescription ball_on_sheet(float width, float height, float margin, uint64_t seed, uint32_t placement) {
    const Random random{seed};
    const auto place = [&](float length, uint32_t number) {
        return margin + (length - 2 * margin) * static_cast<float>(random.uniform(placement, number));
    };
    HitDescription hit;
    hit.point = {place(width, 0) - 0.5f * width, place(height, 1), 0};
    hit.normal = {0, 0, -1};
    return hit;
}

double impact_speed(const HitDescription& hit) {
    return std::fabs(static_cast<double>(hit.striker_speed - dot(hit.velocity, hit.normal)));
}

void examine_pieces(State& state, const HitDescription& hit, std::span<const FragmentPart> parts, HitResult& result) {
    const ShellView shell(state, state.tasks.working[Row<Tasks>(0)]);
    Fragments fragments(static_cast<uint32_t>(parts.size()));
    Touches touches(1);
    HandoffStart start;
    start.velocity = Vec3d(hit.velocity);
    start.spin = Vec3d(hit.spin);
    start.centre = state.structures.centre[shell.structure];
    start.impact_speed = 1e9;  // no clamps
    const HandoffReport handoff = rigid_handoff(shell, start, parts, fragments, touches);
    const double striker = static_cast<double>(result.report.striker_speed_after);
    result.kinetic = handoff.energy_unclamped;
    if (hit.striker_inverse_mass > 0)
        result.kinetic += 0.5 * striker * striker / static_cast<double>(hit.striker_inverse_mass);
    double total = 0, largest = 0;
    for (const FragmentPart& part : parts) total += part.mass, largest = std::max(largest, part.mass);
    result.largest = largest / total;
    for (size_t p = 0; p < parts.size(); ++p) {
        result.pieces += parts[p].mass > kLeastShare * total;
        const double change = length(fragments.velocity[static_cast<uint32_t>(p)] - start.velocity) / impact_speed(hit);
        if (parts.size() > 1) result.top_speed = std::max(result.top_speed, change);
    }
}

}  // namespace

Result<HitSubject> make_subject(Subject subject, uint64_t seed) {
    HitSubject made;
    Mesh mesh;
    const MaterialTable materials = table_of_figures();
    CookSettings settings;
    settings.materials = &materials;
    settings.seed = seed;
    settings.longest_edge = 100;  // the meshes have the edges that the figures are for
    settings.thick_shell.measures_threshold = false;
    switch (subject) {
        case Subject::Vase:
            made = {"vase", 5.4f, {1.49, 2.09, 9.5, 0.47, 3.2, 1798}, {}};
            mesh = make_vase(0.30f, 0.0075f, seed);
            settings.material = "porcelain", settings.thickness = 0.005f;
            break;
        case Subject::Pane:
            made = {"pane", 8, {4.18, 4.23, 6, 0.31, 0.05, 1211}, {}};
            mesh = make_pane(kPaneSide, kPaneEdge, seed);
            settings.material = "glass", settings.thickness = 0.004f;
            break;
        case Subject::Wall:
            made = {"wall", 10, {1.84, 1.94, 7.5, 0.79, 0.44, 308}, {}};
            mesh = make_wall(kWallWidth, kWallHeight, kWallEdge, seed);
            settings.material = "brick", settings.thickness = 0.1f;
            break;
    }
    Result<Model> model = cook(view_of(mesh), settings);
    if (!model.ok()) return Error{model.error()};
    made.model = std::move(model).value();
    return made;
}

HitBench::HitBench(Subject subject, const Model& model, uint64_t seed) : subject_(subject), seed_(seed) {
    const Workbench& cooked = model.contents->state;
    state_ = std::make_unique<State>(cooking_limits(model.report().vertices, model.report().elements));
    state_->materials.append(cooked.materials.size());
    state_->materials.copy_rows(cooked.materials, 0, 0, cooked.materials.size());
    state_->material_traits.append(cooked.material_traits.size());
    state_->material_traits.copy_rows(cooked.material_traits, 0, 0, cooked.material_traits.size());
    const char* full = "";
    shell_ = import_shell(*state_, cooked, model.contents->shell, &full);
    const ShellView shell(*state_, shell_);
    if (subject == Subject::Pane) pin_frame(shell);
    if (subject == Subject::Wall) pin_foot(shell);
    if (subject != Subject::Vase) stiffen_pinned(shell);
    intact_ = shell_;
}

void HitBench::break_quickly(std::optional<QuickSettings> quick, float first_crack) {
    quick_ = quick;
    if (quick_ && quick_->strain_limit == 0)
        quick_->strain_limit = calibrated_strain_limit(*state_, shell_, *quick_, {}, first_crack);
}

HitDescription HitBench::blow(uint32_t placement, float speed) const {
    HitDescription hit;
    if (subject_ == Subject::Vase) {
        hit = fall_on_floor(*state_, shell_, seeded_direction(seed_, placement), speed);
        hit.quick = quick_ ? &*quick_ : nullptr;
        return hit;
    }
    if (subject_ == Subject::Pane) {
        hit = ball_on_sheet(kPaneSide, kPaneSide, 0.1f, seed_, placement);
        hit.striker_inverse_mass = 1 / 0.1f;
        hit.striker_radius = 0.0145f;
    } else {
        hit = ball_on_sheet(kWallWidth, kWallHeight, 0.4f, seed_, placement);
        hit.striker_inverse_mass = 1 / 30.0f;
        hit.striker_radius = 0.14f;
    }
    hit.striker_speed = speed;
    hit.quick = quick_ ? &*quick_ : nullptr;
    return hit;
}

HitReport HitBench::run(const HitDescription& hit, bool ends_at_first_cut) {
    const FpMode mode;
    const auto is_cut = [](const RunRows& state) { return state.tasks.crack_count[Row<Tasks>(0)] > 0; };
    const HitReport report = run_hit(*state_, shell_, hit, ends_at_first_cut ? +is_cut : nullptr);
    close_hit(*state_);
    return report;
}

HitReport HitBench::run_and_keep_cracks(const HitDescription& hit) {
    const FpMode mode;
    const HitReport report = run_hit(*state_, shell_, hit);
    const Row<Structures> working = state_->tasks.working[Row<Tasks>(0)];
    if (!report.broke && !report.dropped && report.cracked) {
        ++state_->structures.users[working];
        clear_run(ShellView(*state_, working), true);
        drop_stiffness(*state_, working);  // as World does: the next hit assembles it anew
        if (shell_ != intact_) release_shell(*state_, shell_);
        shell_ = working;
    }
    close_hit(*state_);
    return report;
}

void HitBench::renew() {
    if (shell_ != intact_) release_shell(*state_, shell_);
    shell_ = intact_;
}

HitResult HitBench::examine(const HitDescription& hit) {
    const FpMode mode;
    HitResult result;
    std::vector<FragmentPart> parts(kMostParts);
    result.report = run_hit(*state_, shell_, hit, nullptr, parts);
    examine_pieces(*state_, hit, std::span(parts).first(result.report.parts), result);
    close_hit(*state_);
    return result;
}

}  // namespace cullet
