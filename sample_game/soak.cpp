#include "sample_game/soak.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sample_game/meshes.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;
constexpr uint32_t kPlaces = 400;  // of panes, 1.5 m apart
constexpr size_t kRestFrames = 30;

/// Of the process, in MiB.
double resident_memory() {
    long long pages = 0, resident = 0;
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (!file) return 0;
    const int read = std::fscanf(file, "%lld %lld", &pages, &resident);
    std::fclose(file);
    return read == 2 ? static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMiB : 0;
}

/// What the line of least squares through the values rises by from the first to the last.
double rise_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double mean = 0, product = 0, square = 0;
    for (const double v : values) mean += v / n;
    for (size_t i = 0; i < values.size(); ++i) {
        const double x = static_cast<double>(i) - (n - 1) / 2;
        product += x * (values[i] - mean);
        square += x * x;
    }
    return square > 0 ? product / square * (n - 1) : 0;
}

/// That a tenth of the values do not exceed: what else runs on the machine makes frames slower, never faster, and all
/// frames of a soak have the same to do.
double low_of(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 10);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

Settings world_settings(const SoakSettings& settings) {
    Settings out;
    out.gravity = {};
    out.units_a_frame = 1'000'000'000;
    out.limits = {2 * settings.alive + 1024, 2, 1u << 20, 1u << 21, 16, 1u << 22, 4096, 256, settings.alive};
    out.generations = 0;
    out.debris_seconds = 0.5f;
    out.threads = settings.threads;
    return out;
}

}  // namespace

Result<Soak> Soak::create(const SoakSettings& settings) {
    if (settings.panes_a_frame == 0 || settings.alive < 80 * settings.panes_a_frame)
        return Error{"soak: alive is " + std::to_string(settings.alive) + ", panes_a_frame " +
                     std::to_string(settings.panes_a_frame) + "; use one pane or more, and 80 alive for each."};
    Result<World> world = World::create(world_settings(settings));
    if (!world) return Error{world.error()};
    CookSettings cooking;
    cooking.material = "glass";
    cooking.thickness = 0.012f;
    cooking.longest_edge = 100;  // the mesh is fine enough
    const Mesh mesh = make_pane(0.3f, 0.025f);
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    view.name = mesh.name.c_str();
    const Result<Model> cooked = cook(view, cooking);
    if (!cooked) return Error{cooked.error()};
    const Result<ModelId> model = world->add_model(*cooked);
    if (!model) return Error{model.error()};
    return Soak(settings, std::move(*world), *model);
}

Soak::Soak(const SoakSettings& settings, World world, ModelId model)
    : settings_(settings), world_(std::move(world)), model_(model) {
    frame_ms_.reserve(1u << 16), memory_mib_.reserve(1u << 16);  // not to be seen as growth
    fill_profiler();
}

// It keeps the times of the first 32,768 frames and half a million spans, and then of the last frame alone: 60 MiB that
// it writes to in any world. Filled now, they are no growth.
void Soak::fill_profiler() {
    Profiler& profiler = world_.contents().profiler;
    while (profiler.left_out() == 0) profiler.add_span(0, 0, 1);
    uint32_t frames = 0;
    do {
        frames = profiler.frame_count();
        profiler.begin_frame(0);
        profiler.end_frame();
    } while (profiler.frame_count() > frames);
}

void Soak::step() {
    for (uint32_t n = 0; n < settings_.panes_a_frame; ++n) cut_pane();
    while (rests_.size() > kRestFrames * settings_.panes_a_frame) {
        expect(world_.remove(rests_.front()).ok(), "what is left of a pane could not be removed");
        keep_stale(rests_.front());
        rests_.pop_front();
    }
    retire_oldest();
    const auto begin = std::chrono::steady_clock::now();
    world_.step();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    frame_ms_.push_back(took.count());
    memory_mib_.push_back(resident_memory());
    born_ += world_.events().fragments_born.count;
    refused_ += world_.events().refused.count;
    faults_ += world_.events().faults.count;
    most_alive_ = std::max(most_alive_, world_.report().fragments);
    for (const BodyId id : stale_) is_stale_refused_ = is_stale_refused_ && !world_.pose(id).ok();
    last_birth_ = world_.events().fragments_born.count ? frame_ms_.size() : last_birth_;
    expect(frame_ms_.size() < last_birth_ + 100, "nothing has been born for 100 frames");
}

// Each place is free again after kPlaces panes.
void Soak::cut_pane() {
    const uint32_t place = panes_++ % kPlaces;
    SpawnSettings pane;
    pane.motion = {{0.3f, 0.2f, -0.5f}, {1, 2, 5}};
    pane.pose.position = {1.5f * static_cast<float>(place % 20), 0, 1.5f * static_cast<float>(place / 20)};
    const Result<BodyId> body = world_.spawn(model_, pane);
    if (!body.ok()) return;
    rests_.push_back(*body);
    // Five cuts each way, all worked off at once; what turns flies apart.
    for (int k = 0; k < 10; ++k) {
        CutSettings cut;
        const float share = 0.05f * static_cast<float>(k % 5 + 1);
        cut.place = pane.pose.position + (k < 5 ? Vec3{share - 0.15f, 0, 0} : Vec3{0, share, 0});
        cut.normal = k < 5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        expect(world_.cut(*body, cut).ok(), "a pane could not be cut");
    }
}

void Soak::retire_oldest() {
    const uint32_t room = 40 * settings_.panes_a_frame;  // for what is born in a frame
    const uint32_t now = world_.report().fragments;
    if (now + room <= settings_.alive) return;
    FragmentAge oldest;
    (void)world_.fragments(&oldest, 1);
    expect(world_.retire({.count = now + room - settings_.alive}).ok(), "the oldest fragments could not be retired");
    keep_stale(oldest.fragment);
}

void Soak::expect(bool is_good, const char* what) {
    if (!is_good && wrong_.empty()) wrong_ = std::string("frame ") + std::to_string(frame_ms_.size()) + ": " + what;
}

void Soak::keep_stale(BodyId id) {
    if (stale_.size() < 64) stale_.push_back({});
    stale_[next_stale_++ % stale_.size()] = id;
}

SoakReport Soak::report() const {
    const size_t frames = frame_ms_.size(), first = frames / 10;
    SoakReport out;
    out.born = born_, out.refused = refused_, out.faults = faults_, out.frames = frames;
    out.retired = world_.report().retired;
    out.faded = world_.report().faded;
    out.most_alive = most_alive_;
    out.is_stale_refused = is_stale_refused_;
    out.wrong = wrong_.empty() ? world_.contents().data.state.validate() : wrong_;
    if (frames == 0) return out;
    for (size_t tenth = 1; tenth <= 10; ++tenth)
        out.memory_mib.push_back(memory_mib_[std::max<size_t>(frames * tenth / 10, 1) - 1]);
    out.memory_rise_mib = rise_of({memory_mib_.begin() + static_cast<std::ptrdiff_t>(first), memory_mib_.end()});
    const auto middle = frame_ms_.begin() + static_cast<std::ptrdiff_t>((first + frames) / 2);
    out.early_ms = low_of({frame_ms_.begin() + static_cast<std::ptrdiff_t>(first), middle});
    out.late_ms = low_of({middle, frame_ms_.end()});
    return out;
}

}  // namespace cullet
