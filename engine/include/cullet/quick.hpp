// How a body breaks: by the hidden run, or quickly.
#pragma once
#include <cstdint>

namespace cullet {

/// Hidden: elastic waves at true stiffness, over several frames; in large bodies only as far as they matter. Quick: the
/// paper's mode. It runs softened springs round the hit alone, and splits edges at once that stretch too far. It takes
/// a frame or a few. It is for bodies too large for the hidden run, and for games that cannot wait. The material's
/// FractureKind says how cracks run. Fine makes many small pieces, coarse keeps neighbours of a crack together, large
/// runs each crack on.
enum class FractureMode : uint8_t { Hidden = 0, Quick };

/// Of FractureMode::Quick.
struct QuickSettings {
    /// 1: springs on the outer surface, as in the paper. 2: inner ones too, so that bending counts; 2 to 4 times
    /// dearer. ThickShellSpawnSettings::springs says how both are tied.
    uint32_t layers = 1;
    uint32_t steps = 60;  // of the run, 8 to 100; the neighbourhood is a third of it wide, in edges
    /// Vertices that may split in one step, 1 to 1000; 0: 64 fine, 16 coarse, 1 large. Fewer: longer cracks.
    uint32_t crack_frequency = 0;
    /// Stretch of the softened springs at which an edge splits, 1e-5 to 1. 0: as much as a ball stretches a face at the
    /// speed at which cooking found that the body cracks. Without such a speed: the material's, 2 % for brittle ones.
    float strain_limit = 0;
    /// Squeeze at which an edge splits, in strain limits, 1 to 1e6; 10 is the paper's kind of value. 0: none does.
    float compression_limit = 0;
    float crack_length = 0.5f;  // of large fracture: how far each crack runs on, of the body's diagonal; 0 to 4
    float bump_angle = 12;      // degrees, by which a running crack's plane may turn at each vertex; 0 to 30
};

}  // namespace cullet
