#!/usr/bin/env bash
# Fails if a module includes what it must not depend on, or if core uses functions whose results differ between machines.
#   tests/architecture.sh                    checks the sources
#   tests/architecture.sh --symbols LIB.a    checks the built core: it calls no libm function, clock or output function
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
checks=0
failures=0

# Functions whose results depend on libm.
elementary='sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|sincos|erf|erfc|tgamma|lgamma'

verdict() { # reason, findings
    checks=$((checks + 1))
    [ -n "$2" ] || return 0
    failures=$((failures + 1))
    printf '%s\n  %s\n' "$2" "^ $1" | sed 's/^/  /'
}

code() { # folder ...: prints every line of code as file:line:text, without // comments
    find "$@" \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) -print0 2>/dev/null | sort -z |
        xargs -0 -r grep -nH '' | sed -E 's#(^[^:]+:[0-9]+:)(.*[^:"])?//.*$#\1\2#'
}

forbid() { # folder, extended regex, reason
    verdict "$1: $3" "$(code "$1" | grep -E "^[^:]+:[0-9]+:.*($2)")"
}

only_in() { # include, regex of files that may include it, reason
    verdict "$3" "$(code core api server | grep -F "#include <$1>" | grep -vE "^($2):")"
}

if [ "${1:-}" = --symbols ]; then
    verdict "$2 must not call these: use core/math/elementary.h" "$(
        nm -A --undefined-only "$2" | grep -E " U (($elementary)f?l?|rand|srand|random|time|clock|clock_gettime|gettimeofday|printf|puts|_ZNSt6chrono.*now.*|_ZSt4cout|_ZSt4cerr)(@.*)?$")"
    echo "$((checks - failures)) passed, $failures failed"
    [ "$failures" -eq 0 ]
    exit
fi

# Dependencies between modules: server -> api -> core, web_viewer -> HTTP.
forbid core '#include "(api|server|tests)/' 'core must not depend on the modules above it'
forbid core '#include <(httplib|sys/socket|netinet|arpa/|poll|spdlog|CLI|prometheus)' 'core must not use HTTP, sockets, logs or options'
forbid api '#include ("(server|tests)/|<httplib|<sys/socket|<netinet|<spdlog|<CLI|<prometheus)' 'api must not use sockets, logs or options'
forbid api '#include <(future|semaphore|latch|barrier)>|std::(jthread|async|thread +[a-z]|thread[({])' 'api must not start threads'
forbid server '(^|[^a-z])(mushroom|species|colon(y|ies)|gill|hymenium|silhouette|stipe|agaric|fung(us|i)|seed)s?([^a-z]|$)' 'server must not use words of the domain'
forbid core '#include [<"](\.\./|[^/">]+\.h")' 'includes must be relative to the project root'
forbid api '#include [<"](\.\./|[^/">]+\.h")' 'includes must be relative to the project root'
forbid server '#include [<"](\.\./|[^/">]+\.h")' 'includes must be relative to the project root'

# No cycles between the folders inside core, api and server either.
folder_dependencies() { # [folder ...]: prints "including included" once for each pair of folders
    grep -rHoE '^#include "[^"]+/[^"/]+"' --include='*.h' --include='*.cpp' --include='*.inl' "$@" |
        sed -nE 's#^(.*)/[^/:]+:\#include "(.*)/[^/"]+"$#\1 \2#p' | sort -u | awk '$1 != $2'
}
verdict 'folders include each other in a cycle' "$(
    folder_dependencies core api server | tsort 2>&1 >/dev/null | sed 's/^tsort: \(-: \)\?//' | tr '\n' ' ' |
        sed 's/ *input contains a loop: */\nfolders in a cycle: /g' | sed '/^$/d')"

# Reproducible bytes on all machines.
forbid core 'std::(random_device|mt19937|minstd_rand|default_random_engine|[a-z_]+_distribution|unordered_|hash<|shuffle\b|sample\b|async\b|reduce\b|execution)|#include <(random|chrono|ctime|unordered_(map|set)|execution)>' \
    'results must depend on seed and parameters only'
forbid core '(^|[^A-Za-z0-9_:.>])(::)?(time|clock|rand|srand|getenv)\(|_clock::now' 'core must not use clocks, the environment or global state'
forbid core 'std::(cout|cerr|clog)|(^|[^A-Za-z0-9_])f?printf\(|(^|[^A-Za-z0-9_])puts\(|#include <(iostream|cstdio)>' 'core must not print'
forbid core "(std|glm)::($elementary)f?l?\\(|(^|[^A-Za-z0-9_:.>])($elementary)f?l?\\(" "libm differs between CPUs: use core/math/elementary.h"
forbid core 'glm::(rotate|angleAxis|slerp|mix\(.*quat|perlin|simplex|linearRand|gaussRand|circularRand|diskRand|sphericalRand|ballRand|radians\(.*quat)|#include <glm/(gtc/(noise|random)|gtx/)' \
    'GLM must be used for arithmetic only'
forbid core '\b(Mul(Add|Sub)|NegMul(Add|Sub))\(|\b(SumOfLanes|MinOfLanes|MaxOfLanes|ReduceSum)\(|Approximate[A-Z]' 'results differ between SIMD targets'
forbid core 'std::(stof|stod|strtod|atof|ostringstream|stringstream|istringstream)\b|(^|[^A-Za-z0-9_])(strtod|atof|setlocale)\(' 'numbers must be converted by from_chars and to_chars'

forbid core '(constexpr|const) std::uint32_t [a-z_]*purpose[a-z_]* *=|Random( [a-z_]+)?\([^,()]*(\(\))?, [0-9]' 'purposes of random streams must be listed in core/math/purposes.h'

forbid core 'for \(.*: *([a-z_]+_(of_world|in)|emerging|standing)\(.*\)->' 'a range-for does not keep the shared object that a function returns'
forbid tests 'for \(.*: *(test::)?(json_of|json_chunk|expect_scene|parse)\(.*\)(\.[a-z_]+[([]|->)' 'a range-for does not keep the object that a function returns'

# Headers that are slow to compile or of one purpose are included in few places.
verdict 'Highway may be used only by the noise of core/math and the paint kernels of core/surface and core/world' "$(
    code core api server | grep -E '#include [<"]hwy/(highway|foreach_target|contrib)' | cut -d: -f1 | sed 's,/[^/]*$,,' |
        sort -u | grep -vxE 'core/(math|surface|world)'
    code core | grep -E '#include [<"]hwy/foreach_target' | cut -d: -f1 | sort -u | tail -n +4)"
only_in nlohmann/json.hpp '(core/(params|atlas)|api(/[a-z]+)?)/[a-z_]+\.cpp' 'json.hpp may be included in .cpp files only'
only_in tiny_gltf.h 'core/gltf/[a-z_]+\.cpp' 'tinygltf may be used in core/gltf only'
only_in CLI/CLI.hpp 'server/main\.cpp' 'CLI11 takes half a minute to compile: it may be included in main.cpp only'
only_in turbojpeg.h 'core/surface/[a-z_]+\.cpp' 'image codecs may be used in core/surface only'
only_in httplib.h 'server/[a-z]+/[a-z_]+\.(cpp|h)' 'the HTTP library may be used in server only'

# Coding style.
verdict 'each header must begin with a sentence that describes it' "$(
    find core api server -name '*.h' -exec sh -c 'head -n 1 "$1" | grep -qE "^// [A-Z].*" || echo "$1"' _ {} \;)"
verdict 'each header must have #pragma once' "$(find core api server -name '*.h' -exec grep -L '^#pragma once$' {} +)"
verdict 'no TODO comments: file an issue instead' "$(code core api server tests | grep -E '\b(TODO|FIXME|HACK|XXX)\b'
    grep -rnE '//.*\b(TODO|FIXME|HACK|XXX)\b' --include='*.h' --include='*.cpp' core api server tests 2>/dev/null)"
verdict 'no test may be disabled or skipped' "$(code tests | grep -E '(DISABLED_[A-Za-z]|GTEST_SKIP)'
    grep -nE '\b(test|it|describe)\.(skip|todo|only)\b|skip: *true' tests/web_viewer/*.mjs 2>/dev/null)"
verdict 'names of tests must be sentences in CamelCase' "$(
    grep -rnE '^(TEST|TEST_F|TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\( *[A-Za-z0-9_]+, *([a-z]|[A-Za-z0-9]*_)' \
        tests --include='*.cpp')"
verdict 'standard terms must be used instead of the private words of tests/words.txt' "$(
    node tests/words.mjs | grep -v 'words of before$')"
verdict 'every source of core must have a test of the same name, or a line with the reason in tests/core/unmirrored.txt' "$(
    find core -name '*.cpp' | sort | while read -r source; do
        name=${source#core/}
        listed=$(grep -cE "^${name//./\\.} +[^ ]" tests/core/unmirrored.txt)
        mirrored=$(find tests/core -path "tests/core/${name%.cpp}_test.cpp" | wc -l)
        [ $((listed + mirrored)) -eq 1 ] || echo "$source: $mirrored tests, $listed lines"
    done
    grep -vE '^#' tests/core/unmirrored.txt | while read -r name _; do
        [ -f "core/$name" ] || echo "tests/core/unmirrored.txt names core/$name, which does not exist"
    done)"
verdict 'each module must have a README.md' "$(for module in core api server web_viewer tests; do
    [ -f "$module/README.md" ] || echo "$module"; done)"
verdict 'the top folder may contain modules and project files only' "$(
    find . -mindepth 1 -maxdepth 1 -not -name '.*' -not -name build -printf '%f\n' |
        grep -vxE 'CMakeLists.txt|CMakePresets.json|CHANGELOG.md|LICENSE|Dockerfile|README.md|core|api|server|web_viewer|tests')"
verdict 'the page must not load resources from other servers' "$(
    grep -rnE '(src|href)=["'"'"']https?://|from ["'"'"']https?://|@import +(url\()?["'"'"']?https?:|url\(["'"'"']?https?:' \
        web_viewer --include='*.html' --include='*.ts' --include='*.css' --exclude-dir=node_modules --exclude-dir=dist 2>/dev/null |
        grep -vE '<a [^>]*href=')"

echo "$((checks - failures)) passed, $failures failed"
[ "$failures" -eq 0 ]
