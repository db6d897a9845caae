#!/usr/bin/env bash
# Installs Debian packages of Bumper and uses them: a tool draws a run, a program is compiled by
# pkg-config and another by CMake, and both run.
#   debian_packages.sh FOLDER-OF-PACKAGES [ROOT]
# As root with debootstrap that is done in a bare system of the same release, made in ROOT (default: a
# new folder) from the mirror that apt uses here; --unpack, or without debootstrap: from a folder.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

unpack=0
if [ "${1:-}" = --unpack ]; then
  unpack=1
  shift
fi
[ $# -ge 1 ] || { echo "usage: debian_packages.sh [--unpack] FOLDER-OF-PACKAGES [ROOT]" >&2; exit 2; }
packages=$(cd "$1" && pwd)
root=${2:-$(mktemp -d)}
mkdir -p "$root"

# What the packages are tried with, within the root: PREFIX is where they are.
try() {
  cat <<'TRY'
set -eu
printf 'v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nv -9 9 1\nf 1 2 3 4\nf 3 4 5\n' >yard.obj
"$PREFIX/bin/bumper-drive" yard.obj --up z --duration 0.01 --out drive >/dev/null
"$PREFIX/bin/bumper-replay" glb drive/run.jsonl drive/run.glb
test -s drive/run.glb
g++ -std=c++20 main.cpp -o by_pkg_config $(pkg-config --cflags --libs bumper)
./by_pkg_config
cmake -S borders -B build -D CMAKE_PREFIX_PATH="$PREFIX" >/dev/null
cmake --build build >/dev/null
./build/borders
TRY
}

if [ "$unpack" = 0 ] && [ "$(id -u)" = 0 ] && command -v debootstrap >/dev/null; then
  . /etc/os-release
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
    awk -v name="$VERSION_CODENAME" '$2 == name { print $1; exit }')
  debootstrap --variant=minbase "$VERSION_CODENAME" "$root" "$mirror" >"$root.log" 2>&1 ||
    { tail -20 "$root.log" >&2; exit 1; }
  mount -t proc proc "$root/proc"
  trap 'umount "$root/proc"' EXIT
  mkdir "$root/try"
  cp "$packages"/*.deb "$root/try"
  cp -r "$here/main.cpp" "$here/borders" "$root/try"
  chroot "$root" apt-get update -qq
  # The tools first, with what they ask for and no more: a compiler brings much along.
  chroot "$root" sh -c "cd /try && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 \
    --no-install-recommends ./*.deb >/dev/null && bumper-drive --help >/dev/null"
  chroot "$root" sh -c "DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 \
    --no-install-recommends g++ cmake make pkg-config >/dev/null"
  try >"$root/try/try.sh"
  chroot "$root" env -i PATH="$PATH" PREFIX=/usr MESA_SHADER_CACHE_DISABLE=true \
    sh -c "cd /try && sh try.sh"
  chroot "$root" sh -c "DEBIAN_FRONTEND=noninteractive apt-get remove -y -qq -o Dpkg::Use-Pty=0 \
    'libbumper*' >/dev/null"
  left=$(find "$root/usr" -path "$root/usr/share/doc" -prune -o -name '*bumper*' -print)
  [ -z "$left" ] || { echo "left by removing the packages: $left" >&2; exit 1; }
  echo "installed, used and removed in a bare $PRETTY_NAME"
else
  for package in "$packages"/*.deb; do dpkg -x "$package" "$root"; done
  cp -r "$here/main.cpp" "$here/borders" "$root"
  libraries=$(dirname "$(find "$root" -name libbumper_base.so)")
  export PREFIX=$root/usr LD_LIBRARY_PATH=$libraries PKG_CONFIG_PATH=$libraries/pkgconfig
  export MESA_SHADER_CACHE_DISABLE=true
  (cd "$root" && try | sh)
  echo "unpacked and used in $root"
fi
