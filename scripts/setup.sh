#!/usr/bin/env bash
# Installs the Debian packages that cullet needs and that are missing. Quick when none are.
# With --all also those of the clang, sanitizer and fuzz builds.
set -euo pipefail

packages=(
    g++ cmake ninja-build ccache pkg-config
    libeigen3-dev libbullet-dev libembree-dev libtbb-dev libhwy-dev libxxhash-dev libzstd-dev
    libassimp-dev libdraco-dev libexpat1-dev libminizip-dev libseccomp-dev libcli11-dev nlohmann-json3-dev libfmt-dev libpng-dev liblua5.4-dev libtomlplusplus-dev
    libgtest-dev librapidcheck-dev dpkg-dev file binutils
    ffmpeg  # a program of its own, for films (run --video)
)
if [[ ${1:-} == --all ]]; then
    packages+=(clang libclang-rt-14-dev llvm)  # the run-time libraries of the sanitizers; llvm-symbolizer
fi

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
    [[ $status == "install ok installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "Missing packages: ${missing[*]}. Install them as root, or install sudo." >&2
        exit 1
    fi
    as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
