#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main job: the paper's test rail and course, a
# fence that breaks, then a drive on a real race track. Pictures and tables go to out/.
#   --no-download   leaves out the real track unless it is there already
#   --dry-run       shows the packages and stops
set -euo pipefail
source "$(dirname "$0")/../cmake/prepare.sh"

download=1
for argument in "$@"; do
  case $argument in
    --no-download) download=0 ;;
    --dry-run) show_packages build; exit 0 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *) echo "usage: examples/run.sh [--no-download] [--dry-run]" >&2; exit 2 ;;
  esac
done

mkdir -p "$root/build"
install_packages build
configure_and_build --target test_rail course break_through drive bumper-read-scene
cd "$root"

say "The paper's test rail"
"$build/bin/test_rail" out/test_rail

say "A lap of the course"
"$build/bin/course" out/course

say "Through a fence"
"$build/bin/break_through" out/break_through

say "A drive on a real track"
if [ "$download" = 1 ]; then "$root/examples/fetch_tracks.sh" road/aalborg || true; fi
aalborg=$tracks/road/aalborg/aalborg.acc
if [ -f "$aalborg" ]; then
  "$build/bin/drive" "$aalborg" --up y --start 260,484.5 --heading 3 --speed 25 --duration 14 \
    --out out/drive
else
  echo "left out: the track is not there"
fi
