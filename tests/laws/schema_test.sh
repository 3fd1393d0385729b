#!/usr/bin/env bash
# Validates reports of every kind against docs/report.schema.json.
# usage: schema_test.sh LOOPCHECK SOURCE_DIR
set -euo pipefail

loopcheck=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# report NAME CODE ARGUMENT...: runs the program, which must exit with CODE, and keeps its JSON report.
report() {
    local name=$1 expected=$2 code=0
    "$loopcheck" "${@:3}" --json "$folder/$name.json" >/dev/null 2>&1 || code=$?
    ((code == expected)) || { echo "$name: exit code $code instead of $expected" >&2; exit 1; }
}

report identical 0 compare "$source/models/cow.obj" --levels 1 --top 3
report creases 0 compare "$source/models/icosahedron.obj" --levels 2 --crease-angle 30
report differs 1 compare "$source/models/icosahedron.obj" --levels 2 --weights warren --top 3
report unsupported 3 compare "$source/models/crease-loop.obj" --levels 1 --with openmesh
report unreadable 2 compare "$source/models/reject/repeated-vertex.obj"
report limits 0 compare "$source/models/dart-valence-06.obj" "$source/models/fan-7.obj" --levels 2 --limit --top 3
report limits-unsupported 3 compare "$source/models/cow.obj" --levels 1 --boundary edge-only --with openmesh --limit
report refine 0 refine "$source/models/cow.obj" --levels 1 -o "$folder/out.obj"
report refine-lattice 0 refine "$source/models/cow.obj" --levels 1 --order lattice -o "$folder/out.obj"
report refine-adaptive 0 refine "$source/models/cow.obj" --levels 2 --adaptive -o "$folder/out.obj"
report refine-tolerance 0 refine "$source/models/torus.obj" --tolerance 0.05 --uniform --crease-angle 60 -o "$folder/out.obj"
report compare-adaptive 0 compare "$source/models/cow.obj" --levels 2 --adaptive
report bits 1 compare "$source/models/icosahedron.obj" "$source/models/cow.obj" --levels 2 --bits --weights warren --crease-angle 60
report suite 0 suite "$source/models/chaikin-overweight.obj" "$source/models/fan-2.obj" --levels 2
report atlas 0 atlas --levels 2
report limit 0 limit "$source/models/icosahedron.obj" --method bfr --samples 8
report limit-none 3 limit "$source/models/boundary-none.obj" --method bfr
report deviations 0 deviations
report curve 0 curve "$source/models/curves/lab.txt" --levels 2 --compare opensubdiv --tolerance 0.01
report grid 0 grid "$source/models/grids/ring-7x4.txt" --columns 4 --closed-u --levels 2
report curve-clamped 3 curve "$source/models/curves/lab.txt" --ends clamped --levels 2 --compare opensubdiv --tolerance 0.01
report suite-unreadable 2 suite "$source/models/reject/repeated-vertex.obj"
for shard in 0 1; do
    report "shard-$shard" 2 suite "$source/models/fan-2.obj" "$source"/models/reject/{no-such-edge,repeated-vertex}.obj --levels 1 --shard "$shard/2"
done
report shard-empty 0 suite "$source/models/fan-2.obj" --levels 1 --shard 7/8
report merge 2 merge "$folder"/shard-[01].json

# The validator must be able to say no.
sed 's/"exit_code": 0/"exit_code": 7/' "$folder/identical.json" >"$folder/bad.txt"
check() { /usr/bin/python3 -m jsonschema --instance "$1" "$source/docs/report.schema.json"; }
if check "$folder/bad.txt" >/dev/null 2>&1; then
    echo "a bad report passed" >&2
    exit 1
fi
for file in "$folder"/*.json; do
    check "$file"
    echo "valid: $(basename "$file")"
done
