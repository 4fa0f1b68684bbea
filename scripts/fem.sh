#!/usr/bin/env bash
# Dents of sheet metal beside a shell FEM. Writes a deck of a clamped sheet that is pressed by a patch and let go, runs
# CalculiX on it (ccx; Debian package calculix-ccx) and compares our mid-line with its own.
#   scripts/fem.sh [OPTIONS of sample_game fem]
#   scripts/fem.sh --thickness-m 0.002 --pressure-pa 4e6
#   scripts/fem.sh --material aluminium --young-pa 69e9 --yield-pa 240e6 --pressure-pa 2e6
# A curve that is there already needs no ccx: build/release/sample_game fem --curve FILE [OPTIONS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

game=build/release/sample_game
[ -x "$game" ] || { echo "$game is not built; run scripts/play.sh, or cmake --build --preset release --target sample_game" >&2; exit 2; }
out=${CULLET_FEM_OUT:-out/fem}
mkdir -p "$out"
"$game" fem "$@" --deck "$out/sheet.inp"
if ! command -v ccx >/dev/null; then
  echo "ccx is not here (apt install calculix-ccx): the deck stands in $out/sheet.inp, and nothing is compared" >&2
  exit 2
fi
(cd "$out" && OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} ccx -i sheet >sheet.log)
"$game" fem "$@" --results "$out/sheet.dat" --out "$out"
