#!/usr/bin/env bash
# Measures run time against error: Bumper, the paper's literal scheme and contact joints on the same
# impacts, against the same law computed exactly. Installs what is missing, builds and runs; tables
# and plots go to out/benchmark/.
#   --quick      fewer cases, half a minute
#   --peers      installs the optional peers too (Bullet)
#   --dry-run    shows the packages and stops
set -euo pipefail
source "$(dirname "$0")/../../cmake/prepare.sh"

quick=()
groups=(build)
for argument in "$@"; do
  case $argument in
    --quick) quick=(--quick) ;;
    --peers) groups+=(peers) ;;
    --dry-run) show_packages "${groups[@]}"; exit 0 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *) echo "usage: tests/benchmark/run.sh [--quick] [--peers] [--dry-run]" >&2; exit 2 ;;
  esac
done

mkdir -p "$root/build"
install_packages "${groups[@]}"
configure_and_build --target accuracy
for package in $(missing_of peers); do
  echo "left out: $package is not installed (--peers installs it)"
done

say "Run time against error"
out=$root/out/benchmark
mkdir -p "$out"
# Always the same processor, where that can be asked for: a move costs time.
pin=()
if command -v taskset >/dev/null; then pin=(taskset -c "$(($(nproc) - 1))"); fi
"${pin[@]}" "$build/bin/accuracy" "${quick[@]}" --out "$out/accuracy.json"
(cd "$out" && gnuplot accuracy.gp)

say "Results"
sed -n '/^## Targets/,/^## Free flight/{/^##/!p}' "$out/accuracy.md"
echo "Table: $out/accuracy.md"
echo "Plots: $out/accuracy_free_flight.png $out/accuracy_tyres.png"
