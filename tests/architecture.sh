#!/usr/bin/env bash
# Fails when a room includes what it must not know, or core uses something whose result is not the same everywhere.
#   tests/architecture.sh                    the sources
#   tests/architecture.sh --symbols LIB.a    the built core: no libm function, no clock, no printing in what it calls
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
checks=0
faults=0

# Every name whose value libm, the C library or the weather decides.
elementary='sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|sincos|erf|erfc|tgamma|lgamma'

verdict() { # reason, findings
    checks=$((checks + 1))
    [ -n "$2" ] || return 0
    faults=$((faults + 1))
    printf '%s\n  %s\n' "$2" "^ $1" | sed 's/^/  /'
}

code() { # folder ...: every line of code as file:line:text, without // comments
    find "$@" \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) -print0 2>/dev/null | sort -z |
        xargs -0 -r grep -nH '' | sed -E 's#(^[^:]+:[0-9]+:)(.*[^:"])?//.*$#\1\2#'
}

forbid() { # folder, extended regex, reason
    verdict "$1: $3" "$(code "$1" | grep -E "^[^:]+:[0-9]+:.*($2)")"
}

only_in() { # include, regex of files that may have it, reason
    verdict "$3" "$(code core api server | grep -F "#include <$1>" | grep -vE "^($2):")"
}

if [ "${1:-}" = --symbols ]; then
    verdict "$2 must not call these: own functions stand in core/math/elementary.h" "$(
        nm -A --undefined-only "$2" | grep -E " U (($elementary)f?l?|rand|srand|random|time|clock|clock_gettime|gettimeofday|printf|puts|_ZNSt6chrono.*now.*|_ZSt4cout|_ZSt4cerr)(@.*)?$")"
    echo "$((checks - faults)) passed, $faults failed"
    [ "$faults" -eq 0 ]
    exit
fi

# The arrows: server -> api -> core, web_viewer -> HTTP.
forbid core '#include "(api|server|tests)/' 'core knows nothing above it'
forbid core '#include <(httplib|sys/socket|netinet|arpa/|poll|spdlog|CLI|prometheus)' 'no HTTP, no sockets, no logs, no options'
forbid api '#include ("(server|tests)/|<httplib|<sys/socket|<netinet|<spdlog|<CLI|<prometheus)' 'api knows no sockets, logs or options'
forbid api '#include <(future|semaphore|latch|barrier)>|std::(jthread|async|thread +[a-z]|thread[({])' 'api starts no threads'
forbid server '(^|[^a-z])(mushroom|species|colon(y|ies)|gill|hymenium|silhouette|stipe|agaric|fung(us|i)|seed)s?([^a-z]|$)' 'no domain word in server'
forbid core '#include [<"](\.\./|[^/">]+\.h")' 'includes go from the project root'
forbid api '#include [<"](\.\./|[^/">]+\.h")' 'includes go from the project root'
forbid server '#include [<"](\.\./|[^/">]+\.h")' 'includes go from the project root'

# One direction between the folders inside core, api and server as well.
folder_arrows() { # [folder ...]: "including included" for each include that crosses folders, without repeats
    grep -rHoE '^#include "[^"]+/[^"/]+"' --include='*.h' --include='*.cpp' --include='*.inl' "$@" |
        sed -nE 's#^(.*)/[^/:]+:\#include "(.*)/[^/"]+"$#\1 \2#p' | sort -u | awk '$1 != $2'
}
verdict 'folders include each other in a circle' "$(
    folder_arrows core api server | tsort 2>&1 >/dev/null | sed 's/^tsort: \(-: \)\?//' | tr '\n' ' ' |
        sed 's/ *input contains a loop: */\nfolders in a circle: /g' | sed '/^$/d')"

# The same bytes everywhere.
forbid core 'std::(random_device|mt19937|minstd_rand|default_random_engine|[a-z_]+_distribution|unordered_|hash<|shuffle\b|sample\b|async\b|reduce\b|execution)|#include <(random|chrono|ctime|unordered_(map|set)|execution)>' \
    'results depend on seed and parameters only'
forbid core '(^|[^A-Za-z0-9_:.>])(::)?(time|clock|rand|srand|getenv)\(|_clock::now' 'no clock, no environment, no global state'
forbid core 'std::(cout|cerr|clog)|(^|[^A-Za-z0-9_])f?printf\(|(^|[^A-Za-z0-9_])puts\(|#include <(iostream|cstdio)>' 'core does not print'
forbid core "(std|glm)::($elementary)f?l?\\(|(^|[^A-Za-z0-9_:.>])($elementary)f?l?\\(" "libm differs between CPUs: core/math/elementary.h"
forbid core 'glm::(rotate|angleAxis|slerp|mix\(.*quat|perlin|simplex|linearRand|gaussRand|circularRand|diskRand|sphericalRand|ballRand|radians\(.*quat)|#include <glm/(gtc/(noise|random)|gtx/)' \
    'GLM for arithmetic only'
forbid core '\b(Mul(Add|Sub)|NegMul(Add|Sub))\(|\b(SumOfLanes|MinOfLanes|MaxOfLanes|ReduceSum)\(|Approximate[A-Z]' 'differs between SIMD targets'
forbid core 'std::(stof|stod|strtod|atof|ostringstream|stringstream|istringstream)\b|(^|[^A-Za-z0-9_])(strtod|atof|setlocale)\(' 'numbers go through from_chars and to_chars'

forbid core '(constexpr|const) std::uint32_t [a-z_]*purpose[a-z_]* *=|Random( [a-z_]+)?\([^,()]*(\(\))?, [0-9]' 'purposes of random streams stand in one list, core/math/purposes.h'

# Heavy or narrow headers stay where they belong.
verdict 'Highway in two places: the noise of core/math and the paint kernels of core/surface' "$(
    code core api server | grep -E '#include [<"]hwy/(highway|foreach_target|contrib)' | cut -d: -f1 | sed 's,/[^/]*$,,' |
        sort -u | grep -vxE 'core/(math|surface)'
    code core | grep -E '#include [<"]hwy/foreach_target' | cut -d: -f1 | sort -u | tail -n +3)"
only_in nlohmann/json.hpp '(core/(params|atlas)|api(/[a-z]+)?)/[a-z_]+\.cpp' 'json.hpp in .cpp files only'
only_in tiny_gltf.h 'core/gltf/[a-z_]+\.cpp' 'tinygltf reads uploads in core/gltf'
only_in CLI/CLI.hpp 'server/main\.cpp' 'CLI11 takes half a minute to compile: main.cpp only'
only_in turbojpeg.h 'core/surface/[a-z_]+\.cpp' 'image codecs live in core/surface'
only_in httplib.h 'server/[a-z]+/[a-z_]+\.(cpp|h)' 'HTTP lives in server'

# House style a glance can miss.
verdict 'a header begins with a sentence saying what it is' "$(
    find core api server -name '*.h' -exec sh -c 'head -n 1 "$1" | grep -qE "^// [A-Z].*" || echo "$1"' _ {} \;)"
verdict '#pragma once' "$(find core api server -name '*.h' -exec grep -L '^#pragma once$' {} +)"
verdict 'no work left lying: an issue says it better' "$(code core api server tests | grep -E '\b(TODO|FIXME|HACK|XXX)\b'
    grep -rnE '//.*\b(TODO|FIXME|HACK|XXX)\b' --include='*.h' --include='*.cpp' core api server tests 2>/dev/null)"
verdict 'every test runs' "$(code tests | grep -E '(DISABLED_[A-Za-z]|GTEST_SKIP)'
    grep -nE '\b(test|it|describe)\.(skip|todo|only)\b|skip: *true' tests/web_viewer/*.mjs 2>/dev/null)"
verdict 'every source of core has a test of its own name, or a line in tests/core/unmirrored.txt that says why not' "$(
    find core -name '*.cpp' | sort | while read -r source; do
        name=${source#core/}
        listed=$(grep -cE "^${name//./\\.} +[^ ]" tests/core/unmirrored.txt)
        mirrored=$(find tests/core -path "tests/core/${name%.cpp}_test.cpp" | wc -l)
        [ $((listed + mirrored)) -eq 1 ] || echo "$source: $mirrored tests, $listed lines"
    done
    grep -vE '^#' tests/core/unmirrored.txt | while read -r name _; do
        [ -f "core/$name" ] || echo "tests/core/unmirrored.txt names core/$name, which is not there"
    done)"
verdict 'each room has a README.md' "$(for room in core api server web_viewer tests; do
    [ -f "$room/README.md" ] || echo "$room"; done)"
verdict 'only the rooms stand at the top' "$(
    find . -mindepth 1 -maxdepth 1 -not -name '.*' -not -name build -printf '%f\n' |
        grep -vxE 'CMakeLists.txt|CMakePresets.json|CHANGELOG.md|LICENSE|Dockerfile|README.md|core|api|server|web_viewer|tests')"
verdict 'the page loads nothing from elsewhere' "$(
    grep -rnE '(src|href)=["'"'"']https?://|from ["'"'"']https?://|@import +(url\()?["'"'"']?https?:|url\(["'"'"']?https?:' \
        web_viewer --include='*.html' --include='*.ts' --include='*.css' --exclude-dir=node_modules --exclude-dir=dist 2>/dev/null |
        grep -vE '<a [^>]*href=')"

echo "$((checks - faults)) passed, $faults failed"
[ "$faults" -eq 0 ]
