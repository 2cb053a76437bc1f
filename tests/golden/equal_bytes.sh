#!/usr/bin/env bash
# Checks that the same request gives the same bytes from GCC and Clang, at -O0 and -O3, with every
# instruction set of this processor; and from whole servers by both compilers.
#   equal_bytes.sh SERVER ...    servers to compare with build/release's; each was built before
# SPOREPRINT_HASH_TREES="release dev" names the build trees to compare; they are reused.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. server/common.sh
jobs=${SPOREPRINT_JOBS:-$(nproc)}
requests=${SPOREPRINT_HASH_REQUESTS:-200}
# Without optimisation or under sanitizers an eighth of the requests is computed.
few=${SPOREPRINT_FEW_HASH_REQUESTS:-$((requests / 8))}
passed=0 failed=0

verdict() { # ok|bad, what
    if [ "$1" = ok ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    echo "$1  $2"
}

read -ra trees <<<"${SPOREPRINT_HASH_TREES:-release gcc-o0 clang clang-o0}"
for tree in "${trees[@]}"; do
    # Where the release tree stands already, its options stay.
    [ "$tree" = release ] && [ -f build/release/build.ninja ] || cmake --preset "$tree" >/dev/null
    build "$tree" hashes
done

# Two bodies under one name: which of them is called depends on what is inlined, and neither compiler
# nor linker says so.
if [[ " ${trees[*]} " = *" gcc-o0 "* ]]; then
    twice=$(nm -S --defined-only build/gcc-o0/core/libsporeprint_core.a | awk '
        $3 ~ /^[TWV]$/ && $4 ~ /^_ZNK?10sporeprint/ {
            kinds[$4] = kinds[$4] $3
            if ($4 in size && size[$4] != $2) differs[$4] = 1
            size[$4] = $2
        }
        END {
            for (name in kinds)
                if (name in differs || kinds[name] ~ /T./ || kinds[name] ~ /.T/) print name
        }' | c++filt)
    verdict "$([ -z "$twice" ] && echo ok || echo bad)" \
        "no name of the core has two bodies${twice:+: $twice}"
fi

out=build/equal_bytes
mkdir -p "$out"
rm -f "$out"/*
program() { echo "build/$1/tests/golden/hashes"; }
{
    for tree in "${trees[@]}"; do
        for name in $("$(program "$tree")" --simd-names); do
            count=$requests
            [[ "$tree" != dev && ("$tree" != *-o0 || "$name" = auto) ]] || count=$few
            echo "$(program "$tree") $count $name $out/$tree:$name:$count"
        done
    done
    [ "$few" = "$requests" ] || echo "$(program release) $few auto $out/release:auto:$few"
} | xargs -P "$jobs" -L 1 sh -c '"$0" print "$1" "$2" > "$3" || echo "failed: $?" >> "$3"'

reference=$out/release:auto:$requests
leaves=$(grep -cE '^[0-9a-f]{16} .* leaf/' "$reference" || true)
plants=$(grep -cE '^[0-9a-f]{16} .* tree/' "$reference" || true)
colonies=$(grep -cE '^[0-9a-f]{16} .* colony/' "$reference" || true)
pictures=$(grep -cE '^[0-9a-f]{16} .* picture/' "$reference" || true)
traces=$(grep -cE '^[0-9a-f]{16} .* trace/' "$reference" || true)
worlds=$(grep -cE '^[0-9a-f]{16} .* world/' "$reference" || true)
all=$(grep -cE '^[0-9a-f]{16} ' "$reference" || true)
mushrooms=$((all - leaves - plants - colonies - pictures - traces - worlds))
found="$mushrooms of $requests random mushrooms, $pictures pictures, $leaves leaves, $plants trees, \
$colonies colonies, $traces traces, $worlds worlds"
if [ "$mushrooms" -eq "$requests" ] && [ "$pictures" -eq $((requests / 5)) ] &&
    [ "$leaves" -ge $((requests / 10)) ] && [ "$plants" -ge $((requests / 20)) ] && [ "$colonies" -ge $((requests / 20)) ] &&
    [ "$traces" -eq $((requests / 10)) ] && [ "$worlds" -eq $((requests / 50)) ]; then
    verdict ok "$found"
else
    verdict bad "$found"
fi
for hashes in "$out"/*; do
    reference=$out/release:auto:${hashes##*:}
    if cmp -s "$reference" "$hashes"; then
        verdict ok "$(basename "$hashes")"
    else
        verdict bad "$(basename "$hashes") differs from $(basename "$reference"):"
        diff "$reference" "$hashes" | head -n 6 || true
    fi
done

. tests/e2e/server.sh
fetch_all() { # server: path and SHA-256 of the answer to each request
    start_server "$1"
    local path
    for path in "${paths[@]}"; do
        echo "$path $(curl -fsS "$url$path" | sha256sum | cut -d' ' -f1)"
    done
    stop_server
}
paths=()
for id in $(basename -s .json core/atlas/species/*.json); do
    paths+=("/v1/mushrooms/$id.glb?texture_size=256&seed=11"
        "/v1/mushrooms/$id.glb?texture_size=256&age=0.9&seed=12"
        "/v1/mushrooms/$id.glb?texture_size=128&age=0.15&lod=1&seed=13")
done
by_release=
[ $# -eq 0 ] || by_release=$(fetch_all build/release/server/sporeprint) || true
for server in "$@"; do
    what="${#paths[@]} answers of the release server and of $server"
    if [ "${#paths[@]}" -ge 20 ] && [ -n "$by_release" ] && theirs=$(fetch_all "$server") &&
        [ "$by_release" = "$theirs" ]; then
        verdict ok "$what"
    else
        verdict bad "$what"
        diff <(echo "$by_release") <(echo "${theirs:-}") | head -n 6 || true
    fi
done

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
