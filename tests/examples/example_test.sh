#!/usr/bin/env bash
# Runs one example of core/README.md in an empty folder, looks at the file that it writes, and checks that the README quotes its
# source word for word.
#   example_test.sh PROGRAM PROJECT_FOLDER NAME WHAT    WHAT is a word that the JSON of the file must hold
set -euo pipefail
program=$1 project=$2 name=$3 what=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program"
[ "$(ls)" = "$name.glb" ] || { echo "the example wrote other files than $name.glb:"; ls; exit 1; }
[ "$(head -c 4 "$name.glb")" = glTF ] || { echo 'the example wrote no GLB'; exit 1; }
stated=$(od -An -t u4 -j 8 -N 4 "$name.glb" | tr -d ' ')
[ "$stated" = "$(stat -c %s "$name.glb")" ] || { echo "the header says $stated bytes"; exit 1; }
json=$(od -An -t u4 -j 12 -N 4 "$name.glb" | tr -d ' ')
head -c $((20 + json)) "$name.glb" | tail -c "$json" >json
grep -qF "$what" json || { echo "the file says nothing of $what"; exit 1; }
# The README names the source in the line before its block.
sed -n '/^`tests\/examples\/'"$name"'\.cpp`/,/^```$/p' "$project/core/README.md" | sed '1,/^```cpp$/d;/^```$/d' |
    diff - "$project/tests/examples/$name.cpp" ||
    { echo "core/README.md quotes another example than tests/examples/$name.cpp"; exit 1; }
echo "$stated bytes"
