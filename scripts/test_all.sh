#!/usr/bin/env bash
# scripts/test.sh --all [parts]: the long plays, every preset with the tests that it can tell something new by, every fuzz
# program, the packages, and each scene at every level of SIMD on one thread and on 1, 2, 3 and 8 threads at AVX2, built by
# g++ and by clang, which must all give the same bytes. Takes hours on two cores, so each part that ends writes its row
# into tests/ALL.md, with the commit that it saw, and is not played again as long as nothing that it hangs on has changed
# since. Parts by name: --all tsan vase fuzz_snapshot; debug is played by its name alone.
# --failed: of a part whose last row says FAILED only the tests that failed; its row then tells of both runs.
# --quick: few tests, frames, threads and inputs, to try this script itself; the rows go to build/all/quick.md.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

presets=(checked clang release asan tsan) by_name=(debug)
scenes=(vase wall pane drop pile blows castle rubber cloth steel tear demolition panel drum car shots statue bowl table museum)
formats=(mesh_file model_file snapshot recording)
threads=(1 2 3 8) levels=(scalar sse4 avx2 avx512) frames=120 inputs=20000 fragments=200000 tests=() page=tests/ALL.md failed_only=false
if [[ ${1:-} == --failed ]]; then
    shift
    failed_only=true
fi
if [[ ${1:-} == --quick ]]; then
    shift
    threads=(1 3 8) levels=(scalar avx2) frames=60 inputs=500 fragments=10000 page=build/all/quick.md
    tests=(-R '^(jobs|table|inner_loop|frame_plan|mesh_file|math)_test$')
fi
parts=("$@")
((${#parts[@]})) || parts=("${presets[@]}" "${scenes[@]}" "${formats[@]/#/fuzz_}" soak packages)

scripts/setup.sh --all || exit 1
logs=$PWD/build/all
mkdir -p "$logs"
# The commit that stands in the folder; "-changed" when more than pages differ from it.
commit_here() {
    git diff --quiet HEAD -- . ':!*.md' && git rev-parse --short HEAD || echo "$(git rev-parse --short HEAD)-changed"
}
# What the outcome of a part hangs on.
paths_of() {
    local sources=(CMakeLists.txt CMakePresets.json engine systems components)
    if among "$1" "${scenes[@]}"; then
        printf '%s\n' "${sources[@]}" sample_game
    elif among "$1" "${formats[@]/#/fuzz_}"; then
        printf '%s\n' "${sources[@]}" tests/fuzz
    else
        printf '%s\n' .
    fi
}
# among WORD WORDS...: is it one of them?
among() {
    local word=$1
    shift
    [[ " $* " == *" $word "* ]]
}
# How much is played: rows of a page that was written with other numbers are not kept.
played="Frames of a scene: $frames. Inputs of a fuzz program: $inputs. Fragments of the soak: $fragments."
grep -qsxF "$played" "$page" || page_is_old=true
# The row of a part on the page, or nothing.
row_of() {
    ! ${page_is_old:-false} && grep -s "^| $1 |" "$page"
}
is_done() {
    local seen
    seen=$(row_of "$1" | awk -F' *[|] *' '$3 !~ /FAILED/ { print $4 }')
    # shellcheck disable=SC2046  # names of ours, without spaces
    [[ -n $seen && $seen != *-changed ]] && git diff --quiet "$seen" -- $(paths_of "$1") ':!*.md' 2>/dev/null
}
# write_row PART RESULT SECONDS COMMIT: the page anew, with this row in place of the part's old one.
write_row() {
    local rows name
    ${page_is_old:-false} || rows=$(grep -s '^| ' "$page" | grep -v -e "^| $1 |" -e '^| part |')
    rows+=$'\n'"| $1 | $2 | $4 | $(date -u +%Y-%m-%d) | $3 |"
    {
        echo "# The last run of everything"
        echo
        echo "Written by \`scripts/test.sh --all\`; do not edit."
        echo "$played"
        echo "The scenes are played on one thread with kernels at ${levels[*]}, on ${threads[*]} threads at avx2,"
        echo "by g++ (Release) and clang (Checked); the hash is that of all frames. checked plays the long run; clang leaves"
        echo "out what plays by the hundred, release plays what compares bytes or counts allocations, asan whole worlds and"
        echo "what reads files, tsan what works on several threads."
        echo
        echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) hardware threads;" \
            "$(g++ --version | head -1); $(clang++ --version | head -1)."
        echo
        echo "| part | result | commit | date | seconds |"
        echo "|---|---|---|---|---|"
        for name in "${presets[@]}" "${by_name[@]}" "${scenes[@]}" "${formats[@]/#/fuzz_}" soak packages; do
            grep "^| $name |" <<<"$rows"
        done
    } >"$page.new"
    mv "$page.new" "$page"
    page_is_old=false
}

build() {
    cmake --preset "$1" && cmake --build --preset "$1" "${@:2}" -- -k 0
}
# What plays by the hundred what others play once: nothing new for another compiler or a sanitizer.
by_the_hundred='^(bearing|closing_loads|crushing|cut_coarse|declared_writes|demolition|flight|grinding|hits|inner_edges|inner_edges_break|laid_loads|limits|loads|pressed_debris|quick_breaks|quick_thresholds|random_breaks|random_hits|real_solids|reproduce|rigid_pile|settling|siblings|squeezed|static_sides|thresholds)_test$'
# What compares bytes, counts what is asked for, or is somebody else's program: what a build without assertions may do otherwise.
without_assertions='^(allocations|host_physics|recording|scenes|script|simd_levels|small_stack|snapshot|soak|world_hash)_test$|_example$|^frames_are_small$|_of_a_step$'
# Whole worlds, what keeps them and what reads files of others: where memory is taken, given back and aimed into.
with_memory="^($(basename -s .cpp tests/engine/import/*_test.cpp tests/systems/api/*_test.cpp | paste -sd'|')|arena_test|table_test|range_pool_test|scratch_test|mesh_file_test|import_test|rigid_world_test|rigid_save_test|fuzz_corpus_test|halves_test|cut_test|cut_pins_test|births_test|soft_bodies_test|quick_world_test|metal_world_test|tear_test|solid_world_test|cook_solid_test|crack_faces_test|scenes_test|script_test|small_stack_test|world_calls_test|world_life_test|world_input_test)\$"
# What more than one thread works at.
with_threads='^(ahead|cook_on_threads|frame_plan|halves|host|host_physics|inner_loop|jobs|layers|paired_world|profiler|quick_world|query|recording|rigid_threads|scenes|slicing|solid_world|metal_world|strikers|table|world_hash|world_life|world_view)_test$|^hosted_example$'
# What follows prints its result, the second column of the page, as its last line.
preset_part() {
    local long_run=() which=("${tests[@]}") targets=() before
    # The long plays once; builds that are ten times slower play the scenes for fewer frames.
    case $1 in
    checked) long_run=(CULLET_ALL_TESTS=1) ;;
    release) which+=(-R "$without_assertions") ;;
    clang) which+=(-E "$by_the_hundred") ;;
    debug) long_run=(CULLET_SCENE_FRAMES=30) which+=(-E "$by_the_hundred") ;;
    # What threads do to each other is the thread sanitizer's.
    asan) long_run=(CULLET_SCENE_FRAMES=30 'GTEST_FILTER=-*OnAnyNumberOfThreads*:*TwoWorldsStepped*') which+=(-R "$with_memory") ;;
    tsan) long_run=(CULLET_SCENE_FRAMES=30 "TSAN_OPTIONS=suppressions=$PWD/tests/thread_sanitizer.txt") which+=(-R "$with_threads") ;;
    esac
    cmake --preset "$1" || return 1
    mapfile -t targets < <(ctest --test-dir "build/$1" -N "${which[@]}" | grep -oE '[a-z_]+_(test|example|step)$')
    build "$1" --target sample_game cullet_import "${targets[@]}" || return 1
    before=$(row_of "$1" | awk -F' *[|] *' '/FAILED/ { print $3 " at " $4 }')
    if $failed_only && [[ -n $before ]]; then
        which=(--rerun-failed)
    fi
    env "${long_run[@]}" ctest --test-dir "build/$1" --output-on-failure -j 2 "${which[@]}" >"$logs/$1_tests.log" 2>&1
    local outcome=$?
    if [[ ${which[*]} == --rerun-failed ]]; then
        printf 'Of those that had failed (%s): ' "${before#FAILED: }"
    fi
    grep -E "tests passed|\(Failed\)|\(Timeout\)|Subprocess" "$logs/$1_tests.log" | paste -sd' '
    return $outcome
}
fuzz_part() {
    scripts/fuzz.sh "$inputs" "$1" || return 1
    echo "$inputs inputs without a finding"
}
packages_part() {
    scripts/test_package.sh || return 1
    echo "installed, built against, removed"
}
# Fragments by the hundred thousand, at most 4,096 of them alive: memory and frame times flat, handles safe.
soak_part() {
    build release >/dev/null || return 1
    CULLET_SOAK_FRAGMENTS=$fragments build/release/soak_test >"$logs/soak_test.log" 2>&1
    local outcome=$?
    grep -E 'born in|memory' "$logs/soak_test.log" | paste -sd';'
    return $outcome
}
# One run: prints the chain of all frames' hashes, or why there is none.
play() {
    local scene=$1 build=$2 level=$3 count=$4 text
    text=$("build/$build/sample_game" run "$scene" --frames "$frames" --threads "$count" --set "simd=$level" 2>&1)
    if [[ $text == *"this machine or this build does not have it"* ]]; then
        echo "none: $build $level"
    elif ! grep -q " on $count threads" <<<"$text"; then
        echo "chain of $build $level on $count threads: $text" | tr '\n' ' '
    else
        sed -n 's/.*all frames \([0-9a-f]*\).*/chain \1/p' <<<"$text"
    fi
}
export -f play
scene_part() {
    local runs="" build level count chains
    build release >/dev/null && build clang >/dev/null || return 1
    for build in release clang; do
        for level in "${levels[@]}"; do
            for count in "${threads[@]}"; do
                # Threads and levels do not touch each other, so they are not tried each with each.
                ((count == 1)) || [[ $level == avx2 ]] || continue
                runs+="$build $level $count"$'\n'
            done
        done
    done
    chains=$(printf '%s' "$runs" | frames=$frames xargs -P 2 -L 1 bash -c "play $1 "'"$@"' play | sort | uniq -c)
    echo "$chains"
    [[ $(grep -c chain <<<"$chains") == 1 && $(wc -w <<<"$(grep chain <<<"$chains")") == 3 ]] || return 1
    awk '/chain/ { printf "`%s` in %d runs", $3, $1 } /none/ { printf "; no %s of the %s build here", $4, $3 }' <<<"$chains"
    echo
}

failures=0
for part in "${parts[@]}"; do
    if is_done "$part"; then
        echo "$part: done before"
        continue
    fi
    if among "$part" "${presets[@]}" "${by_name[@]}"; then
        run=(preset_part "$part")
    elif among "$part" "${scenes[@]}"; then
        run=(scene_part "$part")
    elif among "$part" "${formats[@]/#/fuzz_}"; then
        run=(fuzz_part "${part#fuzz_}")
    elif [[ $part == soak ]]; then
        run=(soak_part)
    elif [[ $part == packages ]]; then
        run=(packages_part)
    else
        echo "There is no part '$part'; there are ${presets[*]} ${by_name[*]} ${scenes[*]} ${formats[*]/#/fuzz_} soak packages." >&2
        exit 2
    fi
    printf '%s ... ' "$part"
    begin=$SECONDS
    commit=$(commit_here)
    if "${run[@]}" >"$logs/$part.log" 2>&1; then
        result=$(tail -1 "$logs/$part.log")
    else
        result="FAILED: $(tail -1 "$logs/$part.log" | tr -d '|')"
        failures=$((failures + 1))
    fi
    [[ $(commit_here) == "$commit" ]] || commit+=-changed  # while it ran
    write_row "$part" "$result" $((SECONDS - begin)) "$commit"
    echo "$result ($((SECONDS - begin)) s; $logs/$part.log)"
done
cat "$page"
((failures == 0))
