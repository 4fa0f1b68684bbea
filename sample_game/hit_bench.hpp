// The three bodies whose breaks are known in numbers (thick shell note, section 8), ready to be hit one blow at a time.
#pragma once
#include <array>
#include <optional>

#include "components/state.hpp"
#include "cullet/model.hpp"
#include "systems/models/thick_shell/run_hit.hpp"

namespace cullet {

/// What a first hit did, seen by its pieces.
struct HitResult {
    HitReport report;
    uint32_t pieces = 0;   // above 0.5 % of the mass
    double largest = 1;    // share of the mass
    double top_speed = 0;  // change of the fastest piece's speed before the clamps, over the impact speed
    double kinetic = 0;    // J, of the pieces as rigid bodies and of the striker; held pieces stand still
};

/// The figures that are to be met: m/s, pieces, share, 1, steps.
struct KnownHit {
    double first_crack = 0, first_piece = 0, pieces = 0, largest = 0, top_speed = 0;
    uint32_t steps = 0;
};

struct HitSubject {
    const char* name = "";
    float hit_speed = 0;  // m/s, of the blow whose pieces are known
    KnownHit known;
    Model model;
};

enum class Subject : uint8_t { Vase, Pane, Wall };
inline constexpr std::array<Subject, 3> kSubjects{Subject::Vase, Subject::Pane, Subject::Wall};

/// Vase: porcelain, 30 cm, 5 mm, falls on a floor, any side down. Pane: glass, 0.5 m, 4 mm, held along its border, a
/// steel ball of 0.1 kg at least 0.1 m from it. Wall: brick, 2.4 x 1.8 x 0.1 m, foot held, a ball of 30 kg at least
/// 0.4 m from the edges.
Result<HitSubject> make_subject(Subject subject, uint64_t seed = 1);

/// A copy of a subject to hit again and again; one a thread.
class HitBench {
 public:
    HitBench(Subject subject, const Model& model, uint64_t seed = 1);

    /// From now on blows ask for the quick mode, or with nothing for the hidden run. With a first-crack speed, m/s, its
    /// strain limit is found as a spawn finds it.
    void break_quickly(std::optional<QuickSettings> quick, float first_crack = 0);
    /// The blow of a seeded placement. Good until the bench goes.
    HitDescription blow(uint32_t placement, float speed) const;
    /// Runs it to its end, or to its first cut.
    HitReport run(const HitDescription& hit, bool ends_at_first_cut = false);
    /// Runs it to its end and looks at the pieces. `keep` leaves the working shell in place until the next call.
    HitResult examine(const HitDescription& hit);

    /// Runs it to its end; when no piece comes off the subject keeps its cracks, and later blows meet them.
    HitReport run_and_keep_cracks(const HitDescription& hit);
    /// The subject is as it was cooked.
    void renew();

    State& state() { return *state_; }
    Row<Structures> shell() const { return shell_; }  // the cracked one, where cracks were kept

 private:
    Subject subject_;
    uint64_t seed_;
    std::optional<QuickSettings> quick_;
    std::unique_ptr<State> state_;
    Row<Structures> shell_, intact_;
};

}  // namespace cullet
