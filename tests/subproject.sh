#!/bin/sh
# Another project that takes cullet in by add_subdirectory: nothing is forced on it, and it gets the libraries alone.
# Configures, and builds nothing. $1: the folder of the sources.
set -eu
sources=$1
work=$(mktemp -d "${TMPDIR:-/tmp}/cullet_subproject.XXXXXX")
trap 'rm -rf "$work"' EXIT
fail() {
    echo "FAILED: $*" >&2
    exit 1
}
cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(game LANGUAGES CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_subdirectory($sources cullet)
add_executable(game game.cpp)
target_link_libraries(game PRIVATE cullet::cullet)
add_executable(hosted game.cpp)
target_link_libraries(hosted PRIVATE cullet::core)
END
echo 'int main() {}' >"$work/game.cpp"
for shared in "" -DBUILD_SHARED_LIBS=ON; do
    rm -rf "$work/build"
    # shellcheck disable=SC2086  # none or one word
    cmake -S "$work" -B "$work/build" -G Ninja $shared >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "configure $shared"; }
    build=$work/build
    if grep -q -e -Werror "$build/compile_commands.json"; then fail "a warning would end a stranger's build"; fi
    if grep -q -e ' -O[0-9sgf]' -e ' -g' "$build/compile_commands.json"; then fail "flags are forced on it"; fi
    if grep -q 'ccache' "$build/build.ninja"; then fail "a program is forced on it"; fi
    if grep -E '^(CMAKE_BUILD_TYPE:[A-Z]*=.+|CMAKE_CXX_FLAGS_CHECKED|CMAKE_EXE_LINKER_FLAGS_CHECKED)' "$build/CMakeCache.txt"; then
        fail "the cache above is ours"
    fi
    if [ -z "$shared" ] && grep '^BUILD_SHARED_LIBS' "$build/CMakeCache.txt"; then fail "the cache above is ours"; fi
    if ninja -C "$build" -t targets all | grep -E '(sample_game|cullet_import|cullet_perf|_test|_example)(:|$)'; then
        fail "the targets above are built for nobody"
    fi
    ninja -C "$build" -n game hosted >/dev/null || fail "game cannot be built"
done
