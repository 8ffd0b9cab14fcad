#!/bin/bash
# How long the hidden pass takes beside Blender Cycles with one sample a pixel, the way the paper made its maps.
#
#   bench/compare_cycles.sh [OVERT] MESH.ply [UP] [ROUNDS]
#
# OVERT: the program (default: build/release/app/overt); UP: axis of the file that points up (default z);
# ROUNDS: how often both are measured in turn (default 3). Both draw the same mesh with the same camera at
# 1024 x 1024 into memory; writing files is not part of it. Needs Blender (apt-get install blender).
# Prints the times and their ratio; exit code 1 if it is above 0.3.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
overt=$here/../build/release/app/overt
if [[ ${1:-} != *.ply ]]; then overt=${1:?name a PLY file}; shift; fi
mesh=$(realpath "${1:?name a PLY file}")
up=${2:-z}
rounds=${3:-3}
command -v blender > /dev/null || { echo "Blender is not installed: apt-get install blender" >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat > "$work/protocol.toml" << TOML
[protocol]
name = "compare"
[[object]]
id = "figure"
mesh = "$mesh"
up = "$up"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[task]]
id = "look"
question = "Look."
TOML
# The sidecar of one map says where the camera stands.
"$overt" lut "$work/protocol.toml" --stimulus figure --frame 0 --format png16 --out "$work" > /dev/null 2>&1

for ((round = 1; round <= rounds; ++round)); do
    echo "round $round of $rounds" >&2
    "$overt" bench lut --context osmesa --mesh "$mesh" --up "$up" --json > "$work/overt_$round.json" || true
    blender -b --factory-startup --python-exit-code 3 -noaudio -P "$here/cycles_map.py" -- \
        --mesh "$mesh" --up "$up" --sidecar "$work/figure_frame_0000.json" --times "$work/cycles_$round.json" \
        > "$work/blender.log" 2>&1 || { tail -20 "$work/blender.log" >&2; exit 1; }
done

python3 - "$work" "$rounds" << 'PYTHON'
import json, statistics, sys
work, rounds = sys.argv[1], int(sys.argv[2])
ours, least, cycles = [], [], []
for round in range(1, rounds + 1):
    figures = {f["figure"].split(", ", 1)[1]: f["value"]
               for f in json.load(open(f"{work}/overt_{round}.json"))["figures"]}
    ours.append(figures["draw and read back a map, median"])
    least.append(figures["draw and read back a map, least"])
    cycles.append([1e3 * s for s in json.load(open(f"{work}/cycles_{round}.json"))])
for k in range(rounds):
    print(f"round {k + 1}: overt {ours[k]:.0f} ms (least {least[k]:.0f}), "
          f"Cycles {statistics.median(cycles[k]):.0f} ms (least {min(cycles[k]):.0f}), "
          f"ratio {ours[k] / statistics.median(cycles[k]):.3f}")
ratio = statistics.median(ours) / statistics.median([statistics.median(c) for c in cycles])
best = min(least) / min(min(c) for c in cycles)
print(f"medians: ratio {ratio:.3f}; least times: ratio {best:.3f}; target <= 0.3: "
      f"{'holds' if ratio <= 0.3 else 'MISSED'}")
sys.exit(0 if ratio <= 0.3 else 1)
PYTHON
