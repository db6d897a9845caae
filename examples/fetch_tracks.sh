#!/usr/bin/env bash
# Puts race tracks of the game TORCS into build/cache, which tests and examples share.
#   fetch_tracks.sh TRACK...   e.g. road/aalborg oval/a-speedway
#   fetch_tracks.sh --all      all 38, about 500 MB
# They come from Debian's package torcs-data; nothing is installed.
set -euo pipefail
source "$(dirname "$0")/../cmake/prepare.sh"

packed=./usr/share/games/torcs/tracks
wanted=()
for track in "$@"; do
  if [ "$track" != --all ]; then
    [ -d "$tracks/$track" ] || wanted+=("$packed/$track")
  elif [ "$(find "$tracks" -mindepth 2 -maxdepth 2 -type d 2>/dev/null | wc -l)" -lt 38 ]; then
    wanted+=("$packed/road" "$packed/oval" "$packed/dirt")
  fi
done
[ "${#wanted[@]}" -gt 0 ] || exit 0

fail() {
  echo "The tracks could not be fetched ($1): what needs them is left out." >&2
  exit 1
}
command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || fail "no apt-get here"

work=$root/build/cache/download
mkdir -p "$work" "$tracks"
trap 'rm -rf "$work"' EXIT
cd "$work"
say "Fetching race tracks: a download of about 333 MB, of which a few MB are kept"
apt-cache show torcs-data >/dev/null 2>&1 || as_root apt-get update -qq || fail "no package list"
apt-get download -qq -o APT::Sandbox::User=root torcs-data >/dev/null 2>&1 || fail "no download"
dpkg-deb --fsys-tarfile torcs-data_*.deb | tar x "${wanted[@]}" || fail "no such track"
# Moved whole, so that an interrupted call leaves no half of a track.
for track in "$packed"/*/*/; do
  place=$tracks/${track#"$packed"/}
  place=${place%/}
  [ -d "$place" ] && continue
  mkdir -p "$(dirname "$place")"
  mv "$track" "$place"
done
