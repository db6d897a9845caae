#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main job: the paper's test rail and course, a
# fence that breaks, vehicles that hit each other, then a drive on a real race track. Recordings,
# pictures, films and tables go to out/.
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
configure_and_build --target test_rail course break_through hinge2_car vehicles two_hosts \
  wall_in_c any_engine threads bumper-drive bumper-replay bumper-plot bumper-read-scene
cd "$root"

# show FOLDER [OPTION of bumper-plot]...: everything that the tools make of a recording.
show() {
  local folder=$1
  "$build/bin/bumper-replay" closeups "$folder/run.jsonl" "$folder/closeups"
  "$build/bin/bumper-replay" sheet "$folder/run.jsonl" "$folder/sheet.png"
  "$build/bin/bumper-replay" glb "$folder/run.jsonl" "$folder/replay.glb"
  "$build/bin/bumper-plot" "$folder/run.jsonl" "$folder/plots" "${@:2}" >/dev/null
  "$build/bin/bumper-replay" video "$folder/run.jsonl" "$folder/replay.mp4"
  printf "  $folder/%s\n" closeups sheet.png replay.glb plots replay.mp4
}

say "The paper's test rail"
"$build/bin/test_rail" out/test_rail
show out/test_rail/restitution --sae
show out/test_rail/energy --sae

say "A lap of the course"
"$build/bin/course" out/course

say "Through a fence"
"$build/bin/break_through" out/break_through

say "A car on hinge2 wheels"
mkdir -p out/hinge2_car
"$build/bin/hinge2_car" out/hinge2_car/run.jsonl
"$build/bin/bumper-replay" sheet out/hinge2_car/run.jsonl out/hinge2_car/sheet.png

say "Vehicles against vehicles"
"$build/bin/vehicles" out/vehicles
show out/vehicles/intersection
for scene in chain motorway gate; do
  folder=out/vehicles/$scene
  "$build/bin/bumper-replay" closeups "$folder/run.jsonl" "$folder/closeups" --impacts 4
  "$build/bin/bumper-replay" sheet "$folder/run.jsonl" "$folder/sheet.png" --impacts 4
  "$build/bin/bumper-replay" glb "$folder/run.jsonl" "$folder/replay.glb"
  printf "  $folder/%s\n" closeups sheet.png replay.glb
done
"$build/bin/bumper-replay" video out/vehicles/chain/run.jsonl out/vehicles/chain/replay.mp4
printf "  %s\n" out/vehicles/chain/replay.mp4

say "Two hosts"
"$build/bin/two_hosts" --impacts 10000

say "A wall, from C"
"$build/bin/wall_in_c"

say "A car of another engine"
"$build/bin/any_engine"

say "Two worlds on two threads"
"$build/bin/threads"

say "A drive on a real track"
if [ "$download" = 1 ]; then "$root/examples/fetch_tracks.sh" road/aalborg || true; fi
aalborg=$tracks/road/aalborg/aalborg.acc
if [ -f "$aalborg" ]; then
  "$build/bin/bumper-drive" "$aalborg" --up y --start 260,484.5 --heading 3 --speed 25 --duration 14 \
    --out out/drive
  show out/drive
else
  echo "left out: the track is not there"
fi
