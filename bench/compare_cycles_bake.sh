#!/bin/bash
# Baked frames beside those of Blender Cycles: a metal that reflects all light, polished and rough, the same mesh, camera and probe.
#
#   bench/compare_cycles_bake.sh [OVERT] MESH.ply PROBE.hdr [UP] [SIZE] [SAMPLES]
#
# OVERT: the program (default: build/release/app/overt); UP: axis of the file that points up (default z);
# SIZE: width and height (default 384); SAMPLES: of each pixel (default 256). Cycles knows no spectra and no metals by n and k:
# a white one is what both can render. Needs Blender (apt-get install blender).
# Prints the figures; exit code 1 if the mean differs by more than 1 %, or the picture, softened by 2 px, by more than 3 %.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
overt=$here/../build/release/app/overt
if [[ ${1:-} != *.ply ]]; then overt=${1:?name a PLY file}; shift; fi
mesh=$(realpath "${1:?name a PLY file}")
probe=$(realpath "${2:?name a light probe}")
up=${3:-z}
size=${4:-384}
samples=${5:-256}
command -v blender > /dev/null || { echo "Blender is not installed: apt-get install blender" >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OVERT_CACHE=$work/cache
printf 'wavelength_nm,n,k\n390,0,1\n710,0,1\n' > "$work/white.csv"
cat > "$work/protocol.toml" << TOML
[protocol]
name = "compare"
[view]
width_px = $size
height_px = $size
vertical_fov_deg = 11.7
[display]
output = "native-8bit"
[light]
probe = "$probe"
[[object]]
id = "figure"
mesh = "$mesh"
up = "$up"
[[material]]
id = "smooth"
kind = "smooth-conductor"
metal = "white.csv"
[[material]]
id = "rough"
kind = "rough-conductor"
metal = "white.csv"
roughness = 0.13
[[task]]
id = "look"
question = "Look."
TOML
"$overt" lut "$work/protocol.toml" --stimulus figure --frame 7 --format png16 --out "$work" > "$work/lut.log" 2>&1 ||
    { tail -5 "$work/lut.log" >&2; exit 1; }
"$overt" bake "$work/protocol.toml" --frames 7 --samples "$samples" --out "$work/frames" --as display > "$work/bake.log" 2>&1 ||
    { tail -5 "$work/bake.log" >&2; exit 1; }

status=0
for material in smooth rough; do
    roughness=0
    [[ $material == rough ]] && roughness=0.13
    blender -b --factory-startup --python-exit-code 3 -noaudio -P "$here/cycles_bake.py" -- \
        --mesh "$mesh" --up "$up" --sidecar "$work/figure_frame_0007.json" --probe "$probe" \
        --roughness "$roughness" --samples "$samples" --ours "$work/frames/figure_$material/frame_0007.exr" \
        > "$work/blender.log" 2>&1 || { tail -20 "$work/blender.log" >&2; exit 1; }
    grep '^COMPARISON ' "$work/blender.log" | cut -d' ' -f2- > "$work/$material.json"
    python3 - "$material" "$work/$material.json" << 'PYTHON' || status=1
import json, sys
name, figures = sys.argv[1], json.load(open(sys.argv[2]))
ratios, rmse = figures["mean_ratio"], figures["blurred_relative_rmse"]
holds = all(abs(r - 1) <= 0.01 for r in ratios) and rmse <= 0.03
print(f"{name}: overt / Cycles in the mean {ratios[0]:.4f} {ratios[1]:.4f} {ratios[2]:.4f}, "
      f"softened difference {100 * rmse:.2f} %, alpha differs by {figures['mean_alpha_difference']:.1e}, "
      f"{figures['pixels']} px: {'holds' if holds else 'MISSED'}")
sys.exit(0 if holds else 1)
PYTHON
done
exit $status
