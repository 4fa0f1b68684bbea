#include "sample_game/propagation.hpp"

#include <iterator>

namespace cullet {
namespace {

constexpr const char* kNames[] = {"guarded_front", "front", "single_vertex", "single_vertex_tets"};

}  // namespace

const char* name_of(Propagation way) {
    return kNames[static_cast<size_t>(way)];
}

bool find_propagation(const std::string& name, Propagation& way) {
    for (size_t k = 0; k < std::size(kNames); ++k)
        if (name == kNames[k]) return way = static_cast<Propagation>(k), true;
    return false;
}

}  // namespace cullet
