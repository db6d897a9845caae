# Sourced by the run scripts: installs what is missing, configures and builds.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=${BUMPER_PRESET:-release}
build=$root/build/$preset
tracks=$root/build/cache/torcs/tracks

say() { printf '\n== %s\n' "$*"; }

# packages_of GROUP...
packages_of() {
  local group
  for group in "$@"; do
    awk -v group="$group" '$1 == group { print $2 }' "$root/cmake/debian-packages.txt"
  done
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Abbrev}' "$1" 2>/dev/null)" = "ii " ]; }

missing_of() {
  local package
  for package in $(packages_of "$@"); do
    is_installed "$package" || echo "$package"
  done
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# show_packages GROUP...: what --dry-run prints.
show_packages() {
  say "Packages"
  packages_of "$@"
  if command -v dpkg-query >/dev/null; then
    say "Of these missing here"
    local missing
    missing=$(missing_of "$@")
    echo "${missing:-none}"
  fi
}

# install_packages GROUP...
install_packages() {
  if ! command -v apt-get >/dev/null; then
    echo "This script installs packages on Debian and Ubuntu only. Elsewhere install what these hold:"
    packages_of "$@" | tr '\n' ' '
    echo
    echo "and then run"
    echo "  cmake --preset release"
    echo "  cmake --build --preset release"
    echo "  ctest --preset release"
    exit 1
  fi
  local missing
  missing=$(missing_of "$@")
  [ -n "$missing" ] || return 0
  say "Installing" $missing
  as_root apt-get update -qq
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# configure_and_build [ARGUMENT of cmake --build]...
configure_and_build() {
  say "Configuring and building ($preset)"
  (cd "$root" && cmake --preset "$preset" >"$root/build/configure-$preset.log" 2>&1) || {
    cat "$root/build/configure-$preset.log"
    exit 1
  }
  cmake --build "$build" "$@"
}
