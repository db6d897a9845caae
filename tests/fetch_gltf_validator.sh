#!/usr/bin/env bash
# Puts the npm package gltf-validator into build/cache, for the tests of GLB files.
set -euo pipefail
source "$(dirname "$0")/../cmake/prepare.sh"

place=$root/build/cache/npm
[ -d "$place/node_modules/gltf-validator" ] && exit 0
if ! command -v npm >/dev/null || ! command -v node >/dev/null; then
  echo "gltf-validator is left out: npm is not installed." >&2
  exit 1
fi
mkdir -p "$place"
npm install --silent --no-audit --no-fund --prefix "$place" gltf-validator@2.0.0-dev.3.10 >/dev/null 2>&1 || {
  echo "gltf-validator could not be fetched: the tests of GLB files go without it." >&2
  exit 1
}
