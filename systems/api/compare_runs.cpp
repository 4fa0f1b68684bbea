// Replays on several numbers of threads, and where two runs part.
#include <new>

#include "engine/mesh_file.hpp"
#include "systems/api/replay.hpp"
#include "systems/api/snapshot.hpp"

namespace cullet {
namespace {

constexpr uint64_t kLargestFile = 1ull << 36;

/// Steps, and looks at the state after each system. A recorded restore puts another world in the place of this one.
void look_after_systems(Replayer& run, const std::function<void(const std::string& system, const State& state)>& look) {
    World::Contents& world = run.world().contents();
    const auto before = std::move(world.after_each_system);
    world.after_each_system = [&](const PlannedSystem<WorldData>& system) {
        if (before) before(system);
        look(system.name, run.world().contents().data.state);
    };
    run.step();
}

/// Hashes after each system of the next step.
std::vector<std::pair<std::string, uint64_t>> hashes_of_step(Replayer& run) {
    std::vector<std::pair<std::string, uint64_t>> hashes;
    look_after_systems(
        run, [&](const std::string& system, const State& state) { hashes.emplace_back(system, state.hash()); });
    return hashes;
}

/// Steps, and looks at the state after the system of this place in the frame.
void look_after_system(Replayer& run, size_t place, const std::function<void(const State& state)>& look) {
    size_t at = 0;
    look_after_systems(run, [&](const std::string&, const State& state) {
        if (at++ == place) look(state);
    });
}

std::string name_columns(const State& state, const std::vector<uint32_t>& here, const std::vector<uint32_t>& there) {
    constexpr size_t kMostNamed = 4;
    std::string names;
    size_t named = 0;
    for (size_t k = 0; k < std::max(here.size(), there.size()); ++k) {
        const uint32_t a = k < here.size() ? here[k] : 0, b = k < there.size() ? there[k] : 0;
        if (a == b || ++named > kMostNamed) continue;
        names += (names.empty() ? "" : ", ") + state.digested_column(k);
    }
    if (named > kMostNamed) names += " and " + std::to_string(named - kMostNamed) + " more";
    return names.empty() ? "nothing but the order of rows" : names;
}

/// What the recording alone tells: frame and columns.
std::string difference_from_recording(Replayer& run) {
    const State& state = run.world().contents().data.state;
    std::vector<uint32_t> digests;
    state.digest_columns(digests);
    return "frame " + std::to_string(run.recorded().frame) + ": " +
           name_columns(state, digests, run.recorded().digests) + " differ from the recording (made by " +
           run.recorded_with() + ")";
}

}  // namespace

std::string first_difference(const std::function<std::unique_ptr<Replayer>(int which)>& make) {
    std::vector<std::pair<std::string, uint64_t>> hashes[2];
    for (int which : {0, 1}) {
        const std::unique_ptr<Replayer> run = make(which);
        if (!run) return {};
        hashes[which] = hashes_of_step(*run);
    }
    size_t place = 0;
    while (place < hashes[0].size() && place < hashes[1].size() && hashes[0][place] == hashes[1][place]) ++place;
    if (place == hashes[0].size() || place == hashes[1].size()) return {};
    const std::unique_ptr<Replayer> first = make(0), second = make(1);
    if (!first || !second) return {};
    ByteWriter rows;
    Limits limits;
    look_after_system(*first, place, [&](const State& state) {
        put_tables(rows, state);
        limits = state.limits();
    });
    const auto own = std::make_unique<State>(limits);
    State& copy = *own;
    ByteReader in(rows.bytes, "a step", "Please report this.");
    take_tables(in, copy);
    std::string found;
    look_after_system(*second, place, [&](const State& state) {
        found = in.is_sound() ? copy.first_difference(state) : in.trouble();
        if (found.empty()) found = "the rows that are taken";
    });
    return "after " + hashes[0][place].first + ", frame " + std::to_string(second->recorded().frame) + ": " + found;
}

namespace {

Result<ReplayReport> replay_runs(const ModelList& models, Replayer::Create create, const std::string& path,
                                 const ReplaySettings& settings, const Host& host) {
    if (settings.threads.empty()) return Error{path + ": no number of threads is given; replay on 1 at least."};
    const Result<std::vector<uint8_t>> bytes = read_whole_file(path, kLargestFile);
    if (!bytes) return Error{bytes.error()};
    const Replayer::Source source{*bytes, path, path + ".models", create, models};
    ReplayReport report;
    uint64_t first_bad = 0;  // in steps
    size_t bad_run = 0;      // of settings.threads
    for (size_t k = 0; k < settings.threads.size(); ++k) {
        Replayer run(source, settings.threads[k], host);
        if (const Result<void> begun = run.begin(); !begun) return Error{begun.error()};
        uint64_t steps = 0;
        const bool has_limit = !report.difference.empty();
        while (!(has_limit && steps == first_bad) && run.step()) {
            if (steps == 0) report.first_frame = run.recorded().frame;
            if (run.world().hash() != run.recorded().hash) {
                report.difference = difference_from_recording(run);
                first_bad = steps, bad_run = k;
                break;
            }
            ++steps;
            if (settings.progress)
                settings.progress(settings.progress_user,
                                  (static_cast<float>(k) + run.share()) / static_cast<float>(settings.threads.size()));
        }
        report.frames = k == 0 ? steps : std::min(report.frames, steps);
        report.recorded_with = run.recorded_with();
        if (report.difference.empty()) report.damage = run.damage();
    }
    if (report.difference.empty()) return report;
    // Two numbers of threads that part at the same place name the system and the row.
    for (size_t k = 0; k < settings.threads.size(); ++k) {
        if (k == bad_run) continue;
        const auto make = [&](int which) -> std::unique_ptr<Replayer> {
            auto run = std::make_unique<Replayer>(source, settings.threads[which == 0 ? k : bad_run], host);
            if (!run->begin()) return nullptr;
            for (uint64_t step = 0; step < first_bad; ++step) run->step();
            return run;
        };
        const std::string place = first_difference(make);
        if (place.empty()) continue;
        report.difference = place + " (" + std::to_string(settings.threads[k]) + " and " +
                            std::to_string(settings.threads[bad_run]) + " threads)";
        return report;
    }
    report.difference += settings.threads.size() > 1
                             ? "; every number of threads here gives the same other bytes, so the recording is of "
                               "another build, or of a world that the game changed behind the calls"
                             : "; replay it on two numbers of threads to learn the system and the row";
    return report;
}

}  // namespace

Result<ReplayReport> replay_all(const ModelList& models, Replayer::Create create, const std::string& path,
                                const ReplaySettings& settings, const Host& host) {
    try {
        return replay_runs(models, create, path, settings, host);
    } catch (const std::bad_alloc&) {
        return Error{path + ": no memory to replay it on " + std::to_string(settings.threads.size()) +
                     " numbers of threads, one after the other. Free memory, or replay on fewer."};
    }
}

}  // namespace cullet
