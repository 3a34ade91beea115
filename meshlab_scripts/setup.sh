#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Brings what the build needs on Debian 12: packages, the sources of both MeshLabs, pymeshlab and meshes.
# Usage: setup.sh [packages] [sources] [python] [data]     (all four where none is named)
# What is there already is left alone. Needs root or sudo only where a package is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
here=$PWD
build=$here/build

say() { printf '== %s\n' "$*"; }
die() { printf 'setup.sh: %s\n' "$*" >&2; exit 1; }
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

packages=(
    cmake g++ ninja-build ccache pkg-config xz-utils ca-certificates
    qtbase5-dev libqt5opengl5-dev libglew-dev libglu1-mesa-dev
    libeigen3-dev libceres-dev libboost-dev libsodium-dev nlohmann-json3-dev
    meshlab libcgal-demo draco python3 python3-venv
    libgtest-dev libbenchmark-dev clang-format clang-tidy
    xvfb xauth libgl1-mesa-dri openbox xdotool imagemagick locales
)

install_packages() {
    local missing=() name
    for name in "${packages[@]}"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    say "installing ${missing[*]}"
    as_root apt-get update -q
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends "${missing[@]}"
}

# Prints the system's own entries for bookworm (deb822 or one-line) as source entries for bookworm and sid.
source_entries() {
    local file
    for file in /etc/apt/sources.list.d/*.sources; do
        [ -f "$file" ] || continue
        awk -v RS= '
            { gsub(/(^|\n)#[^\n]*/, "") }
            /(^|\n)Types:[^\n]*deb/ && /(^|\n)Suites:([^\n]*[ \t])?bookworm([ \t\n]|$)/ && !/(^|\n)Enabled: *no/ {
                sub(/Types:[^\n]*/, "Types: deb-src")
                sub(/Suites:[^\n]*/, "Suites: bookworm sid")
                sub(/Components:[^\n]*/, "Components: main")
                print $0 "\n"
            }' "$file"
    done >"$1/debian.sources"
    cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null |
        sed -nE 's/^deb[ \t]+((\[[^]]*\][ \t]+)?[^ \t]+)[ \t]+bookworm[ \t].*/deb-src \1 bookworm main\ndeb-src \1 sid main/p' \
            >"$1/debian.list" || true
}

# fetch_source VERSION: Debian's source of that MeshLab, into build/sources/meshlab-VERSION.
# The system's own source list is only read: what is changed is a private copy.
fetch_source() {
    local version=$1 target=$build/sources/meshlab-$1 work=$build/sources/.fetch full
    [ ! -e "$target" ] || return 0
    say "fetching the source of MeshLab $version"
    rm -rf "$target.part"
    mkdir -p "$work/parts" "$work/lists/partial" "$work/cache/archives/partial" "$target.part"
    local options=(-q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$work/parts"
        -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache" -o APT::Sandbox::User=root)
    if [ ! -e "$work/updated" ]; then
        source_entries "$work/parts"
        [ -s "$work/parts/debian.sources" ] || [ -s "$work/parts/debian.list" ] ||
            die "no entry for bookworm in apt's source lists. Add Debian 12's, or $(own_checkout "$version")"
        apt-get "${options[@]}" update
        touch "$work/updated"
    fi
    full=$(apt-cache "${options[@]}" showsrc --only-source meshlab | sed -nE "s/^Version: ($version[^ ]*)$/\1/p" | tail -n 1)
    [ -n "$full" ] || die "Debian no longer has the source of MeshLab $version: $(own_checkout "$version")"
    (cd "$work" && apt-get "${options[@]}" source --tar-only --download-only "meshlab=$full")
    tar -xf "$work/meshlab_${full%-*}".orig.tar.* -C "$target.part" --strip-components=1
    grep -q "^$version" "$target.part/ML_VERSION" || die "what came as MeshLab $full is another version: $(own_checkout "$version")"
    mv "$target.part" "$target"
}

own_checkout() {
    echo "put a checkout of MeshLab (tag MeshLab-$1, with submodules) at build/sources/meshlab-$1, or point CMake at it with -DMESHLAB_SOURCE_DIR=DIR."
}

fetch_sources() {
    fetch_source 2025.07
    fetch_source 2020.09
    rm -rf "$build/sources/.fetch"
}

make_venv() {
    local wanted have=$build/venv/requirements.txt
    wanted=$(echo "$here"; cat meshlab_scripts/requirements.txt meshlab_scripts/pyproject.toml) # meshmark is not copied
    [ "$wanted" != "$(cat "$have" 2>/dev/null)" ] || return 0
    say "installing pymeshlab and meshmark into build/venv"
    "$build/venv/bin/pip" --version >/dev/null 2>&1 || /usr/bin/python3 -m venv --clear "$build/venv" # a moved one is dead
    "$build/venv/bin/pip" install --quiet --disable-pip-version-check -r meshlab_scripts/requirements.txt
    printf '%s\n' "$wanted" >"$have"
}

# The meshes of libcgal-demo. Systems that install no /usr/share/doc (containers) take them from the package file itself.
unpack_data() {
    local archive=/usr/share/doc/libcgal-dev/data.tar.gz work=$build/data.part
    [ ! -e "$build/data" ] || return 0
    say "unpacking the meshes"
    rm -rf "$work"
    mkdir -p "$work"
    if [ ! -e "$archive" ]; then
        (cd "$work" && apt-get -q download libcgal-demo && dpkg-deb -x libcgal-demo_*.deb package)
        archive=$work/package/$archive
    fi
    tar -xzf "$archive" -C "$work" --strip-components=1 data/meshes
    rm -rf "$work/package" "$work"/*.deb
    mv "$work" "$build/data"
}

[ $# -gt 0 ] || set -- packages sources python data
mkdir -p "$build"
for step in "$@"; do
    case $step in
    packages) install_packages ;;
    sources) fetch_sources ;;
    python) make_venv ;;
    data) unpack_data ;;
    *) die "unknown step '$step'. Steps: packages, sources, python, data." ;;
    esac
done
