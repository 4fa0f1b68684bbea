#!/usr/bin/env bash
# From a clean clone to pictures of things that shatter: sets up, builds, plays the show reel without a window.
# With a film of each scene, which takes a quarter of an hour more; CULLET_FILMS=0 leaves them out.
#   scripts/play.sh [OPTIONS of sample_game run show_reel]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release --target sample_game cullet_import
out=out/show_reel
mkdir -p "$out"
# Films in this size take half of the time; a sheet's pictures are smaller still.
size=(--width 640)
[[ " $* " == *" --width"* ]] && size=()
films=()
if [[ ${CULLET_FILMS:-1} != 0 ]]; then
    if command -v ffmpeg >/dev/null; then
        films=(--video)
    else
        echo "ffmpeg is not here (apt install ffmpeg), so there are pictures and no films."
    fi
fi
build/release/sample_game run show_reel --out "$out" --contact-sheet "${size[@]}" "${films[@]}" "$@"
# What dents and does not break, and what is solid.
for scene in panel drum car shots statue table bowl museum; do
    build/release/sample_game run $scene --hash off --out "$out/$scene" --contact-sheet --width 640 "${films[@]}"
done

cat <<END

What there is to see, in $PWD/$out:
  wall/sheet.png   a ball of 30 kg goes through a brick wall: a star of cracks that run to its edges, slabs that fall behind it
  vase/sheet.png   a porcelain vase meets a table's edge, its shards fall to the floor and break again
  pane/sheet.png   a steel ball goes through a framed pane: nearly straight cracks to the frame
  drop/sheet.png   a hollow porcelain pig is thrown at a wall
  demolition/sheet.png   a street of 20 brick houses, towers and walls, under 100 explosions in 20 seconds: houses swell, come
                         down in slabs, and lie in heaps (a minute or two)
  panel/sheet.png  balls of 100 kg dent a clamped steel panel, and one comes to rest in its dent
  drum/sheet.png   an empty steel drum falls on its rim, which folds
  car/sheet.png    car bodies of sheet steel are thrown into a wall, a pole and another car
  shots/sheet.png  balls go through a sheet of steel and leave holes with petals; one goes into the side of a drum
  statue/sheet.png a ball hits a solid statue of stone on its plinth: head and legs come off, and fall to the floor
  table/sheet.png  a ball falls on a table top of solid glass, which comes down in large pieces
  bowl/sheet.png   a bowl of solid porcelain falls on the floor: shards with rim and foot
  museum/sheet.png a stone statue, vases, a steel drum and a brick wall in one room: a ball, an explosion, a cut
  */film.mp4       each as a film
  */report.html    each run on a page: times of its frames, pictures, notes
  */report.json    each run in numbers: frame times, hits, fragments, mass, hash (README.md says how to read it)
  */trace.json     where the time went: open it at https://ui.perfetto.dev
Every picture holds twelve moments, numbered by their frame (60 a second).
END
