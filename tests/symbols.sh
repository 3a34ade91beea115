#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A plugin has two vcglibs in it: the host's, and vcg_ext's own, whose namespace is renamed (vcg_ext/CMakeLists.txt). The
# linker makes one of what both define inline under one name, whatever their layouts: so no such name may be in both.
# Usage: symbols.sh LIBRARY OBJECTS...     the static library vcg_ext, and the plugin's own objects
set -euo pipefail
library=$1
shift
defined() { nm --defined-only --extern-only --format=just-symbols "$@" | grep -E '^_' | sort -u; }
both=$(comm -12 <(defined "$library") <(defined "$@") | c++filt)
[ -n "$both" ] || { echo "Nothing at all is shared: are these the right files?"; exit 1; }
renamed=$(defined "$library" | c++filt | grep -c '\bvcg_2025::' || true)
echo "$(wc -l <<<"$both") inline symbols in both, $renamed of vcg_2025 in $(basename "$library")"
[ "$renamed" -gt 0 ] || { echo "$library has no vcglib under another name."; exit 1; }
if grep -E '\bvcg(_2025)?\b' <<<"$both"; then
    echo "These of vcglib are in both."
    exit 1
fi
