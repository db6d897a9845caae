#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#   --long      adds the long suites
#   --dry-run   shows the packages and stops
set -euo pipefail
source "$(dirname "$0")/../cmake/prepare.sh"

long=0
for argument in "$@"; do
  case $argument in
    --long) long=1 ;;
    --dry-run) show_packages build; exit 0 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *) echo "usage: tests/run.sh [--long] [--dry-run]" >&2; exit 2 ;;
  esac
done

mkdir -p "$root/build"
install_packages build
"$root/examples/fetch_tracks.sh" road/aalborg oval/a-speedway road/forza || true
configure_and_build

say "Tests"
cd "$build"
if [ "$long" = 1 ]; then
  ctest --output-on-failure -j "$(nproc)"
else
  ctest --output-on-failure -j "$(nproc)" --label-exclude long
fi
