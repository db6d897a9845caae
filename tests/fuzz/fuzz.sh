#!/usr/bin/env bash
# Builds the fuzz targets with clang and runs each for BUMPER_FUZZ_SECONDS (10), or those named.
# What a target finds stays in build/fuzz/found.
set -euo pipefail
export BUMPER_PRESET=fuzz
source "$(dirname "$0")/../../cmake/prepare.sh"

seconds=${BUMPER_FUZZ_SECONDS:-10}
targets=("$@")
[ $# -gt 0 ] || targets=(walls pictures recording png stream)

mkdir -p "$root/build"
install_packages build fuzz
configure_and_build --target fuzz_corpus "${targets[@]/%/_fuzz}"
corpus=$build/corpus
found=$build/found
mkdir -p "$found"
"$build/bin/fuzz_corpus" "$corpus"

# What OSMesa keeps is not counted as a leak.
export LSAN_OPTIONS=suppressions=$root/tests/render/osmesa_leaks.txt:print_suppressions=0
export MESA_SHADER_CACHE_DISABLE=true
fuzz() {
  local log=$found/$1.log
  "$build/bin/$1_fuzz" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 \
    -artifact_prefix="$found/$1-" "$corpus/$1" >"$log" 2>&1 || { cat "$log"; return 1; }
  echo "$1: $(grep '^Done' "$log")"
}
say "Fuzzing, $seconds s each"
failed=0
for target in "${targets[@]}"; do fuzz "$target" || failed=1; done
exit "$failed"
