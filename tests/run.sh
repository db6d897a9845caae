#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#   --long          adds the long suites, and the fuzz targets if BUMPER_FUZZ_SECONDS is set
#   --no-download   leaves out real tracks and the GLB validator unless they are there already
#   --dry-run       shows the packages and stops
set -euo pipefail
source "$(dirname "$0")/../cmake/prepare.sh"

long=0
download=1
for argument in "$@"; do
  case $argument in
    --long) long=1 ;;
    --no-download) download=0 ;;
    --dry-run) show_packages build; exit 0 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *) echo "usage: tests/run.sh [--long] [--no-download] [--dry-run]" >&2; exit 2 ;;
  esac
done

mkdir -p "$root/build"
install_packages build
if [ "$download" = 1 ]; then
  "$root/examples/fetch_tracks.sh" road/aalborg oval/a-speedway road/forza || true
  "$root/tests/fetch_gltf_validator.sh" || true
fi
configure_and_build

say "Tests"
cd "$build"
if [ "$long" = 1 ]; then
  ctest --output-on-failure -j "$(nproc)"
  # It builds the libraries once more, by clang: so many seconds each, if asked for.
  if [ "${BUMPER_FUZZ_SECONDS:-0}" != 0 ]; then "$root/tests/fuzz/fuzz.sh"; fi
else
  ctest --output-on-failure -j "$(nproc)" --label-exclude long
fi
