// How much a test plays: what is quick enough for every change, or all of it.
#pragma once
#include <cstdint>

namespace cullet::test {

/// CULLET_ALL_TESTS=1 in the environment asks for the long run, as scripts/test.sh --all does.
bool plays_all();

/// Of plays, frames or seeds: `few` in the usual run, `all` in the long one.
template <class T>
T few_or_all(T few, T all) {
    return plays_all() ? all : few;
}

}  // namespace cullet::test
