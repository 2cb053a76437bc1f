#!/usr/bin/env bash
# The same request gives the same bytes from GCC and Clang, at -O0 and -O3, with every instruction set of this
# processor; and from one whole server per compiler (built before as build/release and, here, build/clang).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. server/common.sh
jobs=${SPOREPRINT_JOBS:-$(nproc)}
requests=${SPOREPRINT_HASH_REQUESTS:-200}
passed=0 failed=0

verdict() { # ok|bad, what
    if [ "$1" = ok ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    echo "$1  $2"
}

ways=(g++:-O3 g++:-O0 clang++-14:-O3 clang++-14:-O0)
for way in "${ways[@]}"; do
    cmake -S . -B "build/hash/$way" -G Ninja -DSPOREPRINT_CORE_ONLY=ON -DSPOREPRINT_TESTS=OFF \
        -DCMAKE_CXX_COMPILER="${way%%:*}" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="${way##*:}" >/dev/null
    build "hash/$way" hasher
done

# Two bodies under one name: which of them is called depends on what is inlined, and neither compiler nor linker says so.
twice=$(nm -S --defined-only build/hash/g++:-O0/core/libsporeprint_core.a | awk '
    $3 ~ /^[TWV]$/ && $4 ~ /^_ZNK?10sporeprint/ {
        kinds[$4] = kinds[$4] $3
        if ($4 in size && size[$4] != $2) differs[$4] = 1
        size[$4] = $2
    }
    END { for (name in kinds) if (name in differs || kinds[name] ~ /T./ || kinds[name] ~ /.T/) print name }' | c++filt)
verdict "$([ -z "$twice" ] && echo ok || echo bad)" "no name of the core has two bodies${twice:+: $twice}"

mkdir -p build/hash/out
rm -f build/hash/out/*
hasher() { echo "build/hash/$1/tests/hasher/hasher"; }
mapfile -t simd < <("$(hasher g++:-O3)" --simd-names)
for way in "${ways[@]}"; do
    for name in "${simd[@]}"; do echo "$(hasher "$way") $requests $name build/hash/out/$way:$name"; done
done | xargs -P "$jobs" -L 1 sh -c '"$0" "$1" "$2" > "$3" || echo "failed: $?" >> "$3"'

reference=build/hash/out/g++:-O3:auto
leaves=$(grep -cE '^[0-9a-f]{16} .* leaf/' "$reference" || true)
trees=$(grep -cE '^[0-9a-f]{16} .* tree/' "$reference" || true)
colonies=$(grep -cE '^[0-9a-f]{16} .* colony/' "$reference" || true)
mushrooms=$(($(grep -cE '^[0-9a-f]{16} ' "$reference" || true) - leaves - trees - colonies))
found="$mushrooms of $requests random mushrooms, $leaves leaves, $trees trees, $colonies colonies"
if [ "$mushrooms" -eq "$requests" ] && [ "$leaves" -ge $((requests / 10)) ] && [ "$trees" -ge $((requests / 20)) ] && [ "$colonies" -ge $((requests / 20)) ]; then
    verdict ok "$found"
else
    verdict bad "$found"
fi
for out in build/hash/out/*; do
    if cmp -s "$reference" "$out"; then
        verdict ok "$(basename "$out")"
    else
        verdict bad "$(basename "$out") differs from $(basename "$reference"):"
        diff "$reference" "$out" | head -n 6 || true
    fi
done

cmake --preset clang >/dev/null
build clang sporeprint
. tests/e2e/server.sh
fetch_all() { # binary: path and SHA-256 of the answer to each request
    start_server "$1"
    local path
    for path in "${paths[@]}"; do
        echo "$path $(curl -fsS "$url$path" | sha256sum | cut -d' ' -f1)"
    done
    stop_server
}
paths=()
for id in $(basename -s .json core/atlas/*.json); do
    paths+=("/v1/mushrooms/$id.glb?texture_size=256&seed=11" "/v1/mushrooms/$id.glb?texture_size=256&age=0.9&seed=12"
        "/v1/mushrooms/$id.glb?texture_size=128&age=0.15&lod=1&seed=13")
done
if [ "${#paths[@]}" -ge 20 ] && by_gcc=$(fetch_all build/release/server/sporeprint) &&
    by_clang=$(fetch_all build/clang/server/sporeprint) && [ "$by_gcc" = "$by_clang" ]; then
    verdict ok "${#paths[@]} requests to a server by GCC and one by Clang"
else
    verdict bad "${#paths[@]} requests to a server by GCC and one by Clang"
    diff <(echo "${by_gcc:-}") <(echo "${by_clang:-}") || true
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
