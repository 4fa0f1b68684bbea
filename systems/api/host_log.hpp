// What a world tells its host in sentences. Always on the thread that calls the world, outside the parallel passes.
#pragma once
#include <array>

#include "cullet/host.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/world_data.hpp"

namespace cullet {

class HostLog {
 public:
    /// Limits that the last step met, each at most once in kQuietSeconds of simulated time, and every fault. Allocates
    /// nothing.
    void tell(const Host& host, const WorldData& data);
    /// That a hit on this model will be late in a world whose holds have so many units.
    void advise(const Host& host, const Model::Contents& model, uint64_t hold_units) const;

    static constexpr float kQuietSeconds = 1;

 private:
    struct Told {
        const char* setting = nullptr;
        uint64_t frame = 0;
    };
    bool is_new(const char* setting, const Step& step);
    std::array<Told, 16> told_;  // more than there are limits
};

}  // namespace cullet
