// One run of a recording: a world that is asked what the recorded one was asked.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cullet/recording.hpp"
#include "cullet/world.hpp"
#include "systems/api/recording_file.hpp"
#include "systems/models.hpp"

namespace cullet {

/// What a step of the recording gave.
struct RecordedStep {
    uint64_t frame = 0, hash = 0;
    std::vector<uint8_t> answers;   // to vetoes
    std::vector<uint32_t> digests;  // of all columns, see State::digest_columns
};

class Replayer {
 public:
    using Create = Result<World> (*)(const ModelList& models, const Settings& settings, const Host& host);
    struct Source {
        std::span<const uint8_t> bytes;  // the file's; they outlive this
        std::string name;                // for sentences
        std::string models;              // the folder
        Create create = nullptr;         // create_with: this part of the library has no Bullet in it
        ModelList damage_models = cullet::damage_models();
    };
    Replayer(const Source& source, uint32_t threads, const Host& host);
    ~Replayer();
    Replayer(const Replayer&) = delete;
    Replayer& operator=(const Replayer&) = delete;

    /// Makes the world.
    Result<void> begin();
    /// Asks what was asked before the next step, and steps. False: the file has no further step that is whole; what
    /// was recorded of a step that did not end is done all the same, since that may be the step that crashed.
    bool step();
    const RecordedStep& recorded() const { return recorded_; }
    World& world() { return *world_; }
    /// Of the file; empty while all was good.
    const std::string& damage() const { return damage_; }
    const std::string& recorded_with() const { return recorded_with_; }
    float share() const { return file_.share(); }

 private:
    /// False: the file ends, or another kind stands there; damage_ tells, unless the file ends with its last chunk.
    bool is_next(ChunkKind kind, Chunk& chunk);
    void read_step(const Chunk& chunk);
    void do_calls(const Chunk& chunk);
    void do_call(ByteReader& in);
    void add_model(ByteReader& in);
    void add_static(ByteReader& in);
    void spawn(ByteReader& in);
    void step_hosted(ByteReader& in);
    void cut(ByteReader& in);

    Source source_;
    RecordingReader file_;
    Host host_;
    uint32_t threads_;
    std::optional<World> world_;
    bool is_hosted_ = false, is_stepped_ = false;
    RecordedStep recorded_;
    size_t next_answer_ = 0;
    std::string damage_, recorded_with_;
};

/// The next recorded step, done by two worlds that are alike until then: the first system after which they differ,
/// "after integrate, frame 41: vertices.velocity[812].y: 1.5 here, 1.25 there", with the number that the step was
/// recorded under. Empty when they do not. `make` gives each of the two at that point, twice.
std::string first_difference(const std::function<std::unique_ptr<Replayer>(int which)>& make);

/// The whole of cullet/recording.hpp's replay(), for worlds that `create` makes.
Result<ReplayReport> replay_all(const ModelList& models, Replayer::Create create, const std::string& path,
                                const ReplaySettings& settings, const Host& host);

}  // namespace cullet
