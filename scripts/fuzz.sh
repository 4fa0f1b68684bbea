#!/usr/bin/env bash
# Builds the fuzz programs (clang, address and undefined behaviour sanitizer) and gives each of them so many inputs:
# scripts/fuzz.sh [inputs, 200000 if not given] [formats, all if not given]
# A finding ends the program and stands in out/fuzz/FORMAT/; once it is fixed it goes to tests/fuzz/corpus/FORMAT.txt, a
# line each: the input in hexadecimal, and a name that says what it was.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

inputs=${1:-200000}
shift || true
formats=("$@")
((${#formats[@]})) || formats=(mesh_file model_file snapshot recording)

scripts/setup.sh --all
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
for format in "${formats[@]}"; do
    out=out/fuzz/$format
    rm -rf "$out/kept" && mkdir -p "$out/corpus" "$out/kept"
    FOLDER=$out/kept perl -ane 'open my $file, ">", "$ENV{FOLDER}/$." or die $!; print $file pack "H*", $F[0]' \
        <"tests/fuzz/corpus/$format.txt"
    echo "$format: $inputs inputs"
    # Inputs take milliseconds; ten seconds on one are a finding too. Leaks are the asan preset's affair: worlds give their
    # memory to the next one, which looks like a leak after each input.
    if ! "build/fuzz/${format}_fuzz" -runs="$inputs" -max_len=256 -entropic=0 -detect_leaks=0 -timeout=10 -rss_limit_mb=2048 -seed=1 \
        -artifact_prefix="$out/" -print_final_stats=1 "$out/corpus" "$out/kept" >"$out/log.txt" 2>&1; then
        grep -aE "SUMMARY|runtime error|: .*\(.*\)$|ERROR|Test unit" "$out/log.txt" | head -20
        echo "$format: a finding; $out/log.txt tells"
        exit 1
    fi
    grep -aE "Done|number_of_executed_units|average_exec_per_sec|peak_rss" "$out/log.txt"
done
