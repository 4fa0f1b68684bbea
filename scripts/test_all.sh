#!/usr/bin/env bash
# scripts/test.sh --all: every preset with its tests, the fuzz programs, and each scene at every level of SIMD on one
# thread and on 1, 2, 3 and 8 threads at AVX2, built by g++ and by clang, which must all give the same bytes. Takes hours
# on two cores; what is done stays done: stopped and started again, it goes on where it was, for as long as the sources
# are the same. --quick: few tests, frames, threads and inputs, to try this script itself. Writes tests/ALL.md.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

is_quick=0
[[ ${1:-} == --quick ]] && is_quick=1
command="scripts/test.sh --all"
presets=(release checked debug clang asan tsan)
scenes=(wall vase pane pile drop)
threads=(1 2 3 8) levels=(scalar sse4 avx2 avx512) frames=600 inputs=200000 tests=()
if ((is_quick)); then
    command+=" --quick"
    presets=(release checked clang asan tsan)
    threads=(1 3 8) levels=(scalar avx2) frames=60 inputs=500
    tests=(-R '^(jobs|table|inner_loop|frame_plan|mesh_file|math)_test$')
fi

scripts/setup.sh --all || exit 1
sources=$(git rev-parse --short HEAD)
if ! git diff --quiet HEAD -- . ':!tests/ALL.md'; then
    sources+="-changed-$(git diff HEAD -- . ':!tests/ALL.md' | sha1sum | cut -c1-8)"
fi
state=build/all/$sources$( ((is_quick)) && echo -quick)
mkdir -p "$state"
echo "$command of $sources; what is done stands in $state"

failures=0
# step NAME COMMAND...: once; its seconds go to NAME.ok, what it printed to NAME.log.
step() {
    local name=$1 file=$state/${1// /_}
    shift
    if [[ -f $file.ok ]]; then
        echo "  $name: done before"
        return 0
    fi
    printf '  %s ... ' "$name"
    local begin=$SECONDS
    if "$@" >"$file.log" 2>&1; then
        echo $((SECONDS - begin)) >"$file.ok"
        rm -f "$file.failed"
        echo "$((SECONDS - begin)) s"
    else
        echo $((SECONDS - begin)) >"$file.failed"
        failures=$((failures + 1))
        echo "FAILED, see $file.log"
        return 1
    fi
}

build() {
    cmake --preset "$1" ${2:+"$2"} && cmake --build --preset "$1"
}
test_preset() {
    CULLET_SCENE_FRAMES="$2" CULLET_FUZZ_SECONDS="$3" \
        ctest --test-dir "build/$1" --output-on-failure -j 2 "${tests[@]}"
}

for preset in "${presets[@]}"; do
    release_game=""
    [[ $preset == release ]] || release_game="-DCULLET_RELEASE_GAME=$PWD/build/release/sample_game"
    step "build $preset" build "$preset" "$release_game" || continue
    # Builds that are ten times slower play the scenes for fewer frames; nothing is left out.
    scene_frames=120
    [[ $preset == debug || $preset == asan ]] && scene_frames=40
    [[ $preset == tsan ]] && scene_frames=24
    step "test $preset" test_preset "$preset" "$scene_frames" 20
done
step "fuzz $inputs inputs" scripts/fuzz.sh "$inputs"
((is_quick)) || step "packages" scripts/test_package.sh

# The chain of all frames' hashes, or why there is none.
play() {
    local game=$1 scene=$2 count=$3 level=$4 text chain
    if ! text=$("$game" run "$scene" --frames "$frames" --threads "$count" --set "simd=$level" 2>&1); then
        echo "$text"
        [[ $text == *"this machine or this build does not have it"* ]]
        return
    fi
    grep -q " on $count threads" <<<"$text" || { echo "not on $count threads: $text"; return 1; }
    chain=$(sed -n 's/.*all frames \([0-9a-f]*\).*/\1/p' <<<"$text")
    [[ -n $chain ]] && echo "chain $chain"
}
for scene in "${scenes[@]}"; do
    for build in release clang; do
        for level in "${levels[@]}"; do
            for count in "${threads[@]}"; do
                ((count == 1)) || [[ $level == avx2 ]] || continue  # threads and levels do not touch each other
                step "play $scene $build $level $count" play "build/$build/sample_game" "$scene" "$count" "$level"
            done
        done
    done
done

seconds_of() {
    cat "$state/${1// /_}.ok" 2>/dev/null || echo "FAILED"
}
rows=""
for scene in "${scenes[@]}"; do
    chains=$(grep -hs "^chain " "$state"/play_"${scene}"_*.log | sort | uniq -c)
    kinds=$(grep -c . <<<"$chains")
    count=$(grep -ls "^chain " "$state"/play_"${scene}"_*.log | wc -l)
    hash=$(awk '{ print $3 }' <<<"$chains" | paste -sd' ')
    rows+="| $scene | \`$hash\` | $count | $( ((kinds == 1)) && [[ -n $hash ]] && echo yes || echo NO) |"$'\n'
    if ((kinds != 1)) || [[ -z $hash ]]; then
        failures=$((failures + 1))
        echo "$scene: the runs differ: $chains"
    fi
done
missing=$(grep -lsE "does not have it" "$state"/play_*.log | sed -E 's/.*_(release|clang)_([a-z0-9]+)_[0-9]+\.log/\2 of the \1 build/' | sort -u | paste -sd, | sed 's/,/, /g')

{
    echo "# The last run of everything"
    echo
    echo "Written by \`$command\`; do not edit."
    echo
    echo "- commit: $sources"
    echo "- date: $(date -u +%Y-%m-%d)"
    echo "- machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) hardware threads; $(g++ --version | head -1); $(clang++ --version | head -1)"
    echo "- result: $( ((failures)) && echo "$failures FAILED" || echo "all passed")"
    echo
    echo "Each scene for $frames frames, on one thread with kernels at ${levels[*]}, on ${threads[*]} threads at avx2, by g++ (Release) and clang (Checked):"
    echo
    echo "| scene | hash of all frames | runs | all equal |"
    echo "|---|---|---|---|"
    printf '%s' "$rows"
    [[ -n $missing ]] && printf '\nNot there on this machine: %s.\n' "$missing"
    echo
    echo "| preset | build, s | tests, s | tests |"
    echo "|---|---|---|---|"
    for preset in "${presets[@]}"; do
        summary=$(grep -hs "tests passed" "$state/test_$preset.log" | tail -1)
        echo "| $preset | $(seconds_of "build $preset") | $(seconds_of "test $preset") | $summary |"
    done
    ((is_quick)) || echo "| packages | | $(seconds_of packages) | installed, built against, removed |"
    echo "| fuzz, $inputs inputs a format | | $(seconds_of "fuzz $inputs inputs") | $(grep -hsc '^Done' "$state/fuzz_${inputs}_inputs.log") formats without a finding |"
} >"$state/ALL.md"
((is_quick)) || cp "$state/ALL.md" tests/ALL.md
cat "$state/ALL.md"
((failures == 0))
