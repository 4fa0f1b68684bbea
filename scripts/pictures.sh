#!/usr/bin/env bash
# Makes the pictures of README.md anew, in docs/pictures, by the program itself: a moment of four scenes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# picture SCENE FRAME [OPTIONS of run]: the last frame of a run of so many.
picture() {
    local out=out/pictures/$1
    rm -rf "$out"
    build/release/sample_game run "$1" --frames "$2" --draw "$2" --width 600 --hash off --out "$out" "${@:3}" >/dev/null
    cp "$out/$(printf 'frame_%06d.png' "$2")" "docs/pictures/$1.png"
}
picture vase 36
picture wall 34
picture pane 30
picture car 20
ls -l docs/pictures
