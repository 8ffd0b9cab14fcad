#!/usr/bin/env bash
# Whether two builds of overt do the same, byte for byte, with the same seeds: sessions and their exports, hidden maps, frames,
# baked light, signals, checks, schemas, imports.
#
#   bench/compare_builds.sh OLD_OVERT NEW_OVERT [SESSION…]
#
# Each program writes into a folder of its own, on one cache of stimuli that OLD fills; SESSION are recorded sessions that both
# export as well. What names the program itself (its commit, its hash) and the hour of the day are the same word in both before
# they are compared. Exit code 1 and a list of the files
# that differ, if any do; with KEEP=1 both folders stay. A second comparison is quick with the same OVERT_CACHE.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,11p' "$0" | cut -c3-; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
old=$(realpath "$1"); new=$(realpath "$2"); shift 2
sessions=()
for session in "$@"; do sessions+=("$(realpath "$session")"); done
scratch=$(mktemp -d "${TMPDIR:-/tmp}/overt_compare_XXXXXX")
trap '[ -n "${KEEP:-}" ] || rm -rf "$scratch"' EXIT
export OVERT_CACHE=${OVERT_CACHE:-$scratch/cache} XDG_STATE_HOME=$scratch/state

# All that one program does, into the folder $2.
exercise() {
    local overt=$1 out=$2 export_format session name
    mkdir -p "$out"; cd "$out"
    cp -r "$root/protocols" .
    "$overt" schema >schema.json
    "$overt" new new.toml >/dev/null 2>&1
    for protocol in protocols/*.toml; do
        "$overt" check "$protocol" --all-observers --seed 3 --json 2>/dev/null |
            grep -v '"seconds_left"\|"frames_there"\|_ms":\|"finding' >"check_$(basename "$protocol").json" || true
    done
    "$overt" run protocols/quick_look.toml --observer 02 --simulate-observer 5 --seed 11 --virtual-time \
        --context osmesa --sessions sessions --maps live >/dev/null 2>&1
    "$overt" run protocols/overt_2019.toml --observer 01 --simulate-observer 1 --seed 2019 --virtual-time \
        --context osmesa --trials 6 --quality live --sessions sessions >/dev/null 2>&1
    printf '[chance]\nseed = 4\nlate_share = 0.01\nlate_min_ms = 3\nlate_max_ms = 30\nskip_share = 0.01\n' >faults.toml
    "$overt" run protocols/quick_look.toml --observer 01 --simulate-observer 2 --seed 12 --virtual-time --context osmesa \
        --sessions faulty --faults faults.toml >/dev/null 2>&1
    for session in sessions/*/* faulty/*/* "${sessions[@]}"; do
        name=$(echo "${session#/}" | tr / -)
        for export_format in tsv csv jsonl asc bids; do
            "$overt" export "$session" --format $export_format --out "export/$export_format/$name" \
                $([ $export_format = bids ] || echo --cone-deg 0.5) >/dev/null 2>&1 ||
                echo "refused" >"export_${export_format}_$name"
        done
        "$overt" show "$session" --json --order >"show_$name.json" 2>&1 || true
        "$overt" show "$session" --plot "plot_$name.svg" >"text_$name.txt" 2>&1 || true
    done
    "$overt" show sessions/overt_2019/* --picture trial.png >/dev/null 2>&1
    for asc in export/asc/*/*.asc; do
        name=$(basename "$(dirname "$asc")")
        "$overt" import "$asc" --out "imported/$name" --observer 09 >/dev/null 2>&1 || continue
        "$overt" export "imported/$name" --format tsv --out "reexport/$name" >/dev/null 2>&1
    done
    "$overt" lut protocols/overt_2019.toml --stimulus runner --frame 15 --context osmesa --out lut >/dev/null 2>&1
    "$overt" play protocols/overt_2019.toml --stimulus runner/smooth --frame 15 --picture frame.png >/dev/null 2>&1
    "$overt" bake protocols/quick_look.toml --quality preview --frames 0-2 --out frames --as xyz >/dev/null 2>&1
    "$overt" display verify --context osmesa --json >display.json 2>/dev/null
    "$overt" reconstruct protocols/quick_look.toml --stimulus muse --frame 3 --out surface.ply >/dev/null 2>&1
    cd - >/dev/null
}

# The files of a folder with their hashes, what names the program and the hour taken out.
digest() {
    local folder=$1 commit
    commit=$2
    cd "$folder"
    find . -type f ! -name '*.sqlite*' ! -name 'manifest.json' ! -name 'SHA256SUMS' | sort | while read -r file; do
        printf '%s  %s\n' "$(sed -E "s/${commit:-no commit}(, with changes)?/COMMIT/g; s/20[0-9]{2}-[01][0-9]-[0-3][0-9]T[0-9:]+Z/UTC/g; s/20[0-9]{2}:[01][0-9]:[0-3][0-9] [0-9:]{8}/WHEN/g; s/[0-9a-f]{64}([^0-9a-f].*program)/HASH\1/; s/(\"?program_sha256\"?[^0-9a-f]*)[0-9a-f]{64}/\1HASH/; s/(\*\* DATE: ).*/\1DATE/" "$file" |
            sha256sum | cut -c1-64)" "$file"
    done
    cd - >/dev/null
}

commit_of() { strings -n 40 "$1" | grep -oE '^[0-9a-f]{40}(, with changes)?$' | head -1 | cut -c1-40; }

exercise "$old" "$scratch/old"
exercise "$new" "$scratch/new"
digest "$scratch/old" "$(commit_of "$old")" >"$scratch/old.txt"
digest "$scratch/new" "$(commit_of "$new")" >"$scratch/new.txt"
if differences=$(diff "$scratch/old.txt" "$scratch/new.txt"); then
    echo "the same: $(wc -l <"$scratch/new.txt") files, $(cut -d. -f2- "$scratch/new.txt" | grep -oE '\.[a-z0-9]+$' | sort | uniq -c | sort -rn | awk '{printf "%s %s  ", $1, $2}')"
else
    echo "$differences"
    [ -z "${KEEP:-}" ] || echo "kept in $scratch"
    exit 1
fi
