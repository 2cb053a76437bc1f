#!/bin/sh
# Proves that the compile-time checks of core/params bite: each file of must_not_compile is refused
# by the compiler, except the control, which differs from them only in being right.
# Usage: must_not_compile_test.sh COMPILER PROJECT_ROOT
compiler=${1:?compiler} root=${2:?project root}
folder=$root/tests/core/params/must_not_compile
compiles() { "$compiler" -std=c++20 -Wall -Wextra -Werror -fsyntax-only -I"$root" "$1" 2>"$errors"; }
errors=$(mktemp) && trap 'rm -f "$errors"' EXIT
failed=0 refused=0
if ! compiles "$folder/control.cpp"; then
    echo "control.cpp must compile:" && cat "$errors" && failed=1
fi
for file in "$folder"/*.cpp; do
    [ "$file" = "$folder/control.cpp" ] && continue
    if compiles "$file"; then
        echo "$file must not compile" && failed=1
    elif ! grep -qE "static assertion failed|static_assert failed|not handled in switch" "$errors"; then
        echo "$file is refused for another reason:" && cat "$errors" && failed=1
    fi
    refused=$((refused + 1))
done
[ "$refused" -ge 3 ] || { echo "only $refused files were tried"; failed=1; }
exit $failed
