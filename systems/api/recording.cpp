// A world's recording begins and ends.
#include "engine/host_scope.hpp"
#include "systems/api/recorder.hpp"
#include "systems/api/settings_bytes.hpp"
#include "systems/api/snapshot.hpp"
#include "systems/models.hpp"

namespace cullet {

// A world that nothing was done with yet is told by its settings; any other by a snapshot, which rebuilds its rigid
// bodies.
Result<void> World::start_recording(const std::string& path) {
    Contents& c = *contents_;
    const HostScope call(c.host);
    if (c.recorder) return Error{path + ": another recording is running; stop it first."};
    const bool is_fresh =
        c.data.step_info.frame == 0 && c.data.state.bodies.size() == 0 && c.data.state.models.size() == 0;
    ByteWriter begin;
    begin.number(static_cast<uint8_t>(c.hosted != nullptr));
    begin.number(static_cast<uint8_t>(!is_fresh));
    for_each_setting(c.settings, [&](const auto& number) { begin.number(number); });
    begin.text(c.data.damage_models->names());
    if (!is_fresh) {
        const Result<std::vector<uint8_t>> bytes = encode_snapshot(c);
        if (!bytes) return Error{path + ": " + bytes.error()};
        begin.put(bytes->data(), bytes->size());
    }
    const Result<std::FILE*> file = RecordingWriter::open(path);
    if (!file) return Error{file.error()};
    auto recorder = std::make_unique<Recorder>(*file, path + ".models", c.data.damage_models);
    if (const Result<void> begun = recorder->begin(begin.bytes); !begun) return Error{path + ": " + begun.error()};
    c.recorder = std::move(recorder);
    if (is_fresh) c.recorder->set_gravity(c.data.step_info.gravity);
    return {};
}

Result<void> World::stop_recording() {
    Contents& c = *contents_;
    if (!c.recorder) return {};
    const std::string trouble = c.recorder->trouble();
    c.recorder.reset();
    if (!trouble.empty()) return Error{trouble};
    return {};
}

}  // namespace cullet
