#!/usr/bin/env bash
# Runs the example of core/README.md in an empty folder, looks at the file it writes, and checks that the README quotes it word for word.
#   example_test.sh PROGRAM PROJECT_FOLDER
set -euo pipefail
program=$1 project=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program"
[ "$(head -c 4 amanita_muscaria.glb)" = glTF ] || { echo 'the example wrote no GLB'; exit 1; }
stated=$(od -An -t u4 -j 8 -N 4 amanita_muscaria.glb | tr -d ' ')
[ "$stated" = "$(stat -c %s amanita_muscaria.glb)" ] || { echo "the header says $stated bytes"; exit 1; }
sed -n '/^```cpp$/,/^```$/{/^```/d;p}' "$project/core/README.md" | diff - "$project/tests/core/example.cpp" ||
    { echo 'core/README.md quotes another example than tests/core/example.cpp'; exit 1; }
echo "$stated bytes"
