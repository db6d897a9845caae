#!/usr/bin/env bash
# Checks GLB files with the npm package gltf-validator.
#   validate_glb.sh NODE_MODULES FILE...
# Ends with 77 if node or the package, which tests/fetch_gltf_validator.sh gets, is not there.
set -euo pipefail

skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "node is not installed"
[ -d "$1/gltf-validator" ] || skip "gltf-validator is not in $1: see tests/fetch_gltf_validator.sh"

NODE_PATH=$1 node - "${@:2}" <<'SCRIPT'
const fs = require('fs');
const validator = require('gltf-validator');
(async () => {
  let defects = 0;
  for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    const { numErrors, numWarnings, messages } = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    for (const m of messages.slice(0, 10)) console.log(`  ${m.code} ${m.pointer}: ${m.message}`);
    defects += numErrors + numWarnings;
  }
  process.exit(defects > 0 ? 1 : 0);
})();
SCRIPT
