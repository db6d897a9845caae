#!/usr/bin/env bash
# Measures run time against error (Bumper, the paper's literal scheme and contact joints on the same
# impacts, against the same law computed exactly), and what queries and steps cost (Bumper and its
# peers over the same drives). Installs what is missing, builds and runs; tables and plots go to
# out/benchmark/.
#   --quick          fewer cases, about a minute
#   --accuracy       run time against error alone
#   --performance    query and step cost alone
#   --peers          installs the optional peers too (Bullet, Box2D, OpenSceneGraph, valgrind)
#   --dry-run        shows the packages and stops
set -euo pipefail
source "$(dirname "$0")/../../cmake/prepare.sh"

quick=()
groups=(build)
parts=(accuracy performance)
for argument in "$@"; do
  case $argument in
    --quick) quick=(--quick) ;;
    --accuracy) parts=(accuracy) ;;
    --performance) parts=(performance) ;;
    --peers) groups+=(peers) ;;
    --dry-run) show_packages "${groups[@]}"; exit 0 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"; exit 0 ;;
    *)
      echo "usage: tests/benchmark/run.sh [--quick] [--accuracy | --performance] [--peers] [--dry-run]" >&2
      exit 2
      ;;
  esac
done

mkdir -p "$root/build"
install_packages "${groups[@]}"
configure_and_build --target "${parts[@]}"
for package in $(missing_of peers); do
  echo "left out: $package is not installed (--peers installs it)"
done

out=$root/out/benchmark
mkdir -p "$out"
# Always the same processor, where that can be asked for: a move costs time.
pin=()
if command -v taskset >/dev/null; then pin=(taskset -c "$(($(nproc) - 1))"); fi

accuracy() {
  say "Run time against error"
  "${pin[@]}" "$build/bin/accuracy" "${quick[@]}" --out "$out/accuracy.json"
}

performance() {
  local counts=$build/callgrind
  rm -rf "$counts"
  if command -v valgrind >/dev/null; then
    say "Instructions per query"
    mkdir -p "$counts"
    valgrind -q --tool=callgrind --instr-atstart=no --collect-atstart=no \
      --callgrind-out-file="$counts/callgrind.out" \
      "$build/bin/performance" --count "${quick[@]}" || rm -rf "$counts"
  fi
  [ -d "$counts" ] || echo "left out: instructions are not counted"
  say "Query and step cost"
  "${pin[@]}" "$build/bin/performance" "${quick[@]}" --counts "$counts" \
    --out "$out/performance.json"
}

for part in "${parts[@]}"; do
  "$part"
  (cd "$out" && gnuplot "$part.gp")
done

for part in "${parts[@]}"; do
  say "Results: $part"
  sed -n '/^## Targets/,/^## /{/^## /!p}' "$out/$part.md"
done
echo "Tables and plots: $out"
