#!/usr/bin/env bash
# The commands of docs/scale.md on four small models.  GNU parallel runs four shards, one of which is killed in the middle;
# the same command again runs what is missing, and merge gives what one run gives.  Then all models, in five shards.
# usage: shards_test.sh LOOPCHECK PARALLEL SOURCE_DIR
set -euo pipefail

loopcheck=$(realpath "$1") parallel=$2 source=$(realpath "$3")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir bin models
cp "$source"/models/{cow,dart-valence-06,fan-2,tetrahedron}.obj models
export PARALLEL_HOME=$folder/parallel
fail() { echo "$*" >&2; exit 1; }

# `loopcheck` as in the page, but that a suite is short, and that shard 2 is killed once: when it has worked for a tick of
# the clock of processes.
cat >bin/loopcheck <<END
#!/usr/bin/env bash
[[ \$1 == suite ]] || exec "$loopcheck" "\$@"
echo "\$*" >>started
if [[ "\$*" == *" 2/4 "* ]] && mkdir killed 2>/dev/null; then
    while [[ -e /proc/\$\$ ]]; do
        [[ /proc/\$\$/exe -ef "$loopcheck" ]] && read -ra stat </proc/\$\$/stat || continue
        ((stat[13] > \${before:=\${stat[13]}})) && kill -KILL \$\$
    done >/dev/null 2>&1 &
fi
exec "$loopcheck" "\$@" --levels 3 --no-limit
END
chmod +x bin/loopcheck
ln -s "$parallel" bin/parallel
PATH=$folder/bin:$PATH

# Indented lines of the page that begin so, as commands.
from_page() { sed -n "s/^    \($1 .*\)/\1/p" "$source/docs/scale.md"; }
spread=$(from_page parallel) merge=$(from_page "loopcheck merge")
[[ $spread == *--resume-failed* && $merge == *part-* ]] || fail "docs/scale.md does not show the two commands"

eval "$spread" >first.txt 2>&1 && fail "parallel did not notice that a shard was killed"
[[ -d killed && -f part-0.json && -f part-1.json && -f part-3.json ]] || fail "a shard is missing"
[[ ! -e part-2.json ]] || fail "the shard was not killed in the middle"
[[ -z $(find . -name '.loopcheck-*') ]] || fail "the killed shard left a file"
code=0
eval "$merge" >merged.txt 2>merged.err || code=$?
((code == 2)) && [[ $(<merged.err) == "Missing: shard 2/4." && ! -s merged.txt && ! -e suite.json ]] ||
    fail "merge, exit code $code: $(<merged.err)"

eval "$spread" >second.txt 2>&1 || fail "the second call: $(<second.txt)"
[[ $(cut -d ' ' -f 4 started | sort | xargs) == "0/4 1/4 2/4 2/4 3/4" ]] || fail "started: $(<started)"
eval "$merge" >merged.txt

# same CODE SUITE...: the suite in one run has this exit code, and its reports are the merged ones.
same() {
    local code=0
    "$loopcheck" suite "${@:2}" --json whole.json --junit whole.xml >whole.txt || code=$?
    ((code == $1)) || fail "exit code $code instead of $1"
    cmp whole.txt merged.txt
    cmp whole.json suite.json
    cmp whole.xml suite.xml
    tail -n 1 merged.txt
}
same 0 models --levels 3 --no-limit

# Every model, and those that must be refused.
all=("$source"/models "$source"/models/reject --levels 0)
for i in 0 1 2 3 4; do
    code=0
    "$loopcheck" suite "${all[@]}" --shard "$i/5" --json "all-$i.json" >/dev/null || code=$?
    ((code == 2)) || fail "shard $i/5: exit code $code instead of 2"
done
code=0
"$loopcheck" merge all-*.json --json suite.json --junit suite.xml >merged.txt || code=$?
((code == 2)) || fail "merge: exit code $code instead of 2"
same 2 "${all[@]}"
