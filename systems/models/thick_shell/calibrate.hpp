#pragma once
#include "components/shell_rows.hpp"
#include "cullet/layers.hpp"
#include "cullet/quick.hpp"

namespace cullet {

/// Stretch at which edges of the shell split in the quick mode. `speed` is the one at which the hidden run says that
/// the body cracks. A ball on a face at that speed is to be the first that cracks it here too. So it is the largest
/// stretch of an edge in such blows that may not crack, the median of five seeded places. Springs of one layer do not
/// bend, and a run of 60 steps sees less of a blow than the hidden one. With the material's own limit vases crack at
/// ten times the speed, and brick walls never. Falls on a floor do not serve instead: they land on corners and rims,
/// which stretch far more than a face does, so that walls never broke by a ball. 0: no speed is known, or there is no
/// room. Allocates; for spawning. About a hundredth of a second.
float calibrated_strain_limit(const ShellRows& state, Row<Structures> shell, const QuickSettings& quick,
                              const LayerSettings& layers, float speed);

}  // namespace cullet
