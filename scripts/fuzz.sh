#!/usr/bin/env bash
# Builds the fuzz programs (clang, address and undefined behaviour sanitizer) and gives each of them so many inputs, on all
# cores: scripts/fuzz.sh [inputs, 200000 if not given] [formats, all if not given]
# A finding ends the program and stands in out/fuzz/FORMAT/; once it is fixed it goes to tests/fuzz/corpus/FORMAT.txt, a
# line each: the input in hexadecimal, and a name that says what it was.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

inputs=${1:-200000}
shift || true
formats=("$@")
((${#formats[@]})) || formats=(mesh_file model_file snapshot recording)
workers=$(nproc)

# worker FORMAT NUMBER: its share of the inputs. They take milliseconds; ten seconds on one are a finding too. Leaks are
# the asan preset's affair: worlds give their memory to the next one, which looks like a leak after each input.
worker() {
    local out=out/fuzz/$1
    mkdir -p "$out/corpus_$2"
    ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=4 "build/fuzz/$1_fuzz" -runs=$(((inputs + workers - 1) / workers)) \
        -seed="$2" -max_len=256 -entropic=0 -detect_leaks=0 -timeout=10 -rss_limit_mb=2048 -artifact_prefix="$out/" \
        -print_final_stats=1 "$out/corpus_$2" "$out/kept" >"$out/log_$2.txt" 2>&1
}

scripts/setup.sh --all
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
for format in "${formats[@]}"; do
    out=out/fuzz/$format
    rm -rf "$out/kept" "$out"/log_*.txt && mkdir -p "$out/kept"
    FOLDER=$out/kept perl -ane 'open my $file, ">", "$ENV{FOLDER}/$." or die $!; print $file pack "H*", $F[0]' \
        <"tests/fuzz/corpus/$format.txt"
    echo "$format: $inputs inputs, $workers at a time"
    running=()
    for ((n = 1; n <= workers; ++n)); do
        worker "$format" "$n" &
        running+=($!)
    done
    outcome=0
    for n in "${!running[@]}"; do
        wait "${running[n]}" && continue
        outcome=1
        grep -aE "SUMMARY|runtime error|: .*\(.*\)$|ERROR|Test unit" "$out/log_$((n + 1)).txt" | head -20
        echo "$format: a finding; $out/log_$((n + 1)).txt tells"
    done
    ((outcome == 0)) || exit 1
    grep -haE "number_of_executed_units|average_exec_per_sec|peak_rss" "$out"/log_*.txt
done
