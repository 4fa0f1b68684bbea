#!/usr/bin/env bash
# Packages, as their users meet them.
#   scripts/test_package.sh                        static and shared into folders, then the Debian packages: installs
#                                                  them on this machine, builds against them, removes them (as root)
#   scripts/test_package.sh --installed-from DIR   installs what is built in DIR into a folder and builds against it
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
sources=$PWD
work=$(mktemp -d "${TMPDIR:-/tmp}/cullet_package.XXXXXX")
trap 'rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*" >&2
    exit 1
}
quietly() {  # a command, whose words are shown when it fails
    "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "$*"; }
}

# Programs that cullet's users write, copied away from our sources. $1: how; $2...: for CMake.
build_with_cmake() {
    local folder=$work/cmake_$1
    shift
    rm -rf "$folder"
    cp -r "$sources/tests/consumer" "$folder"
    quietly cmake -S "$folder" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release "$@"
    quietly cmake --build "$folder/build"
    for program in hosted consumer embedding; do quietly "$folder/build/$program"; done
    if ldd "$folder/build/hosted" | grep -qE 'Bullet|LinearMath'; then fail "a program on cullet::core links Bullet"; fi
    sed -i 's/find_package(cullet 0.1 /find_package(cullet 0.2 /' "$folder/CMakeLists.txt"
    if cmake -S "$folder" -B "$folder/newer" -G Ninja "$@" >/dev/null 2>&1; then fail "0.1 passes for 0.2"; fi
}

# $1: a name; $2: --static or nothing; PKG_CONFIG_PATH and LD_LIBRARY_PATH say where.
build_with_pkg_config() {
    local folder=$work/pc_$1 options
    mkdir -p "$folder"
    cp "$sources"/tests/consumer/{main,hosted}.cpp "$folder"
    for pair in main:cullet hosted:cullet-core; do
        options=$(pkg-config ${2:-} --cflags --libs "${pair#*:} >= 0.1")
        # shellcheck disable=SC2086  # words on purpose
        quietly g++ -std=c++20 -O1 -o "$folder/${pair%:*}" "$folder/${pair%:*}.cpp" $options
        quietly "$folder/${pair%:*}"
    done
    if readelf -d "$folder/hosted" | grep -qE 'Bullet|LinearMath'; then fail "cullet-core.pc links Bullet"; fi
}

# Every name that a shared library shows is cullet's, and every free function of its headers is among them.
check_symbols() {
    local library names function
    for library in "$@"; do
        names=$(nm -D --defined-only "$library" | awk '{print $3}' | sed 's/@.*//')
        [[ -n $names ]] || fail "$library shows nothing"
        if grep -vE '^_Z(N|NK|T[ISV]N)6cullet' <<<"$names"; then fail "$library shows the names above"; fi
    done
    names=$(c++filt <<<"$names")  # of the last one
    for function in $(grep -hoP '^(?!using|struct|class|enum|#|/|\}|namespace)[A-Za-z].*?\b\K\w+(?=\()' \
        engine/include/cullet/*.hpp | sort -u); do
        grep -qE "^cullet::${function}[(]" <<<"$names" ||
            fail "${!#} lacks cullet::$function; add it to engine/cmake/exported_symbols.map"
    done
    echo "  $(wc -l <<<"$names") names, all cullet's"
}

# The programs do their work from wherever they are. $1: their folder.
run_programs() {
    printf 'v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nv 0 0 0.3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >"$work/tetrahedron.obj"
    (
        cd "$work"
        export XDG_CACHE_HOME=$work/cache
        quietly "$1/sample_game" run vase --frames 60
        quietly "$1/sample_game" run drop --mesh tetrahedron.obj --frames 2  # calls cullet_import
        quietly "$1/cullet_import" tetrahedron.obj tetrahedron.cmesh
        [[ ! -e $1/mesh_cache ]] || fail "$1/mesh_cache is no file of the package"
    )
}

try_prefix() {  # $1: a build folder, $2: static or shared
    local prefix=$work/$2
    quietly cmake --install "$1" --prefix "$prefix"
    if grep -rl "$sources" "$prefix"/lib*/cmake "$prefix"/lib*/pkgconfig; then fail "the files above name our sources"; fi
    mv "$prefix" "$prefix.moved"  # a package may be put elsewhere
    prefix+=.moved
    local flag=""
    [[ $2 == shared ]] || flag=--static
    build_with_cmake "$2" -DCMAKE_PREFIX_PATH="$prefix"
    PKG_CONFIG_PATH="$prefix/lib/pkgconfig" LD_LIBRARY_PATH="$prefix/lib" build_with_pkg_config "$2" "$flag"
    if [[ $2 == shared ]]; then check_symbols "$prefix"/lib/libcullet_core.so "$prefix"/lib/libcullet.so; fi
    if [[ -x $prefix/bin/sample_game ]]; then run_programs "$prefix/bin"; fi
    echo "$2: installed, moved, built against with CMake and pkg-config, run"
}

try_debian() {  # $1: a build folder
    local as_root=() package
    if ((EUID != 0)); then
        command -v sudo >/dev/null || fail "the Debian packages are installed as root; run this as root, or install sudo"
        as_root=(sudo)
    fi
    if dpkg-query -W cullet cullet-dev >/dev/null 2>&1; then fail "cullet is installed here; remove it first"; fi
    (cd "$1" && rm -rf debian && quietly cpack -G DEB -B debian)
    for package in "$1"/debian/*.deb; do
        echo "  $(basename "$package"): $(dpkg-deb -f "$package" Depends)"
        dpkg-deb -c "$package" | awk '{print $6}' | grep -v '/$' | sed 's/^\.//' >>"$work/files"
    done
    [[ $(dpkg-deb -f "$1"/debian/cullet_*.deb Depends) == *libbullet* ]] || fail "the package does not depend on Bullet"
    quietly "${as_root[@]}" dpkg -i "$1"/debian/*.deb
    trap 'rm -rf "$work"; "${as_root[@]}" dpkg -P cullet-dev cullet >/dev/null' EXIT
    build_with_cmake debian
    build_with_pkg_config debian
    run_programs /usr/bin
    quietly "${as_root[@]}" dpkg -r cullet-dev cullet
    trap 'rm -rf "$work"' EXIT
    while read -r file; do [[ ! -e $file && ! -L $file ]] || fail "$file is left"; done <"$work/files"
    local folder
    for folder in /usr/include/cullet /usr/lib/cmake/cullet /usr/share/doc/cullet; do
        [[ ! -e $folder ]] || fail "$folder is left"
    done
    if ldconfig -p | grep -q libcullet; then fail "the linker's cache still knows libcullet"; fi
    quietly "${as_root[@]}" dpkg -P cullet  # CPack gives what holds a library a script to run after removal: it is left
    if dpkg-query -W cullet cullet-dev >/dev/null 2>&1; then fail "dpkg still knows the packages"; fi
    echo "debian: $(wc -l <"$work/files") files installed, built against, run, removed"
}

if [[ ${1:-} == --installed-from ]]; then
    kind=static
    grep -q '^BUILD_SHARED_LIBS:BOOL=ON' "$2/CMakeCache.txt" && kind=shared
    try_prefix "$2" "$kind"
    exit
fi
[[ $# == 0 ]] || fail "$1: unknown; see the top of this file"
for kind in static shared; do
    shared=$([[ $kind == shared ]] && echo ON || echo OFF)
    folder=$sources/build/package_$kind
    quietly cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS="$shared" \
        -DCULLET_BUILD_TESTS=OFF -DCULLET_BUILD_PERF=OFF
    quietly cmake --build "$folder"
    try_prefix "$folder" "$kind"
done
try_debian "$sources/build/package_shared"
