#include "sample_game/metal/truth_metal.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "sample_game/metal/fem_wanted.hpp"
#include "sample_game/metal/metal_car.hpp"

namespace cullet {

std::span<const TruthCase> metal_truth_cases() {
    static const TruthCase kCases[] = {{1, "bounce of published springs", metal_bounce},
                                       {2, "a blow on one sub-shell", metal_single_cell},
                                       {3, "distance of two faces", metal_face_distance},
                                       {4, "four sub-shells of a square", metal_square},
                                       {5, "depth of a dent", metal_depth},
                                       {6, "obstacle beside profile", metal_obstacle},
                                       {7, "clamped disc under a point load", clamped_disc},
                                       {8, "strain limit", metal_strain_limit},
                                       {9, "fifty hits on a panel", metal_fifty_hits},
                                       {9, "one crash of a car", metal_one_crash},
                                       {9, "fifty hits on a car", metal_fifty_crashes},
                                       {10, "momentum", metal_momentum},
                                       {11, "a car at a wall and a pole", metal_car_at_a_wall},
                                       {14, "dents beside a shell FEM", metal_beside_fem}};
    return kCases;
}

std::vector<Verdict> metal_beside_fem() {
    const std::filesystem::path folder = std::filesystem::path(metal_data_folder()).parent_path() / "fem";
    std::vector<Verdict> verdicts;
    for (const char* name : {"p0.5", "p1", "p2", "p4"}) {
        const Result<FemCurve> curve = read_fem_curve((folder / (std::string(name) + ".txt")).string());
        if (!curve.ok()) continue;
        FemBlow blow;
        blow.work = curve->work;
        const Result<FemDent> dent = dent_of({}, blow);
        if (!dent.ok()) return {{dent.error(), 1, 0, 0}};
        for (Verdict v : fem_verdicts(compare_with_fem(dent->line, *curve), blow.work)) {
            v.what = fmt::format("{:.0f} J: {}", blow.work, v.what);
            verdicts.push_back(v);
        }
    }
    return verdicts;
}

}  // namespace cullet
