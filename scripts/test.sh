#!/usr/bin/env bash
# Builds everything with all checks on and runs the tests; about a quarter of an hour on two cores, less the next time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
# The Release game is there to be compared with the Checked one, hash by hash.
cmake --preset release >/dev/null
cmake --build --preset release --target sample_game cullet_import
cmake --preset checked -DCULLET_RELEASE_GAME="$PWD/build/release/sample_game" >/dev/null
cmake --build --preset checked
ctest --preset checked "$@"
