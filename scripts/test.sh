#!/usr/bin/env bash
# Builds everything with all checks on and runs the tests; about a quarter of an hour on two cores, less the next time.
# CULLET_ALL_TESTS=1 in the environment plays what the usual run leaves out.
# --all [--failed] [--quick] [parts]: every preset, SIMD level and number of threads, the fuzz programs and the packages instead, which are
# installed on this machine and removed again, as root (scripts/test_all.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1:-} == --all ]]; then
    exec scripts/test_all.sh "${@:2}"
fi

scripts/setup.sh
cmake --preset checked >/dev/null
cmake --build --preset checked

# Each test program writes down its results, so that what was skipped can be counted.
results="$PWD/build/checked/test_results"
rm -rf "$results"
outcome=0
GTEST_OUTPUT="xml:$results/" ctest --preset checked "$@" || outcome=$?
skipped=$(cat "$results"/*.xml 2>/dev/null | grep -c '<skipped message="[^"]*CULLET_TEST_DATA' || true)
echo "$skipped tests skipped for want of data (CULLET_TEST_DATA, ${CULLET_TEST_DATA:-../shared/data if not given})"
exit "$outcome"
