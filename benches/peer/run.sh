#!/usr/bin/env bash
# Measures sawflutter and SciPy in one run on one machine. It needs Python 3.11 or later and cargo.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/python"
"$work/python/bin/pip" install --quiet -r benches/peer/requirements.txt
cargo build --release --locked
program=${CARGO_TARGET_DIR:-target}/release/sawflutter
for basis in 6,6 16,8 24,10; do
    "$program" export --matrices --basis "$basis" --out "$work/$basis" > /dev/null
done
cargo bench --locked --bench peer > "$work/rust.json"
SAWFLUTTER=$program OPENBLAS_NUM_THREADS=1 "$work/python/bin/python" benches/peer/peer.py \
    "$work/rust.json" "$work/6,6" "$work/16,8" "$work/24,10"
