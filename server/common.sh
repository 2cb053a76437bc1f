# Functions shared by server/run and tests/run, which source it from the project's root under `set -euo pipefail`.

# Checkouts at different paths share the compiler cache.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

# Under `sudo`, continues as the user who owns the checkout, so that no file in build/ belongs to root.
# Call when the packages are installed: become_owner "$0" "$@".
become_owner() {
    [ "$(id -u)" -eq 0 ] && [ "${SUDO_UID:-0}" -ne 0 ] || return 0
    [ "$(stat -c %u .)" -eq "$SUDO_UID" ] || return 0
    local home
    home=$(getent passwd "$SUDO_UID" | cut -d: -f6)
    exec setpriv --reuid "$SUDO_UID" --regid "$SUDO_GID" --init-groups \
        env HOME="$home" USER="$SUDO_USER" LOGNAME="$SUDO_USER" "$@"
}

# Builds targets of a configured preset; prints nothing if they are up to date.
build() { # preset [target ...]
    cmake --build "build/$1" -j "${SPOREPRINT_JOBS:-$(nproc)}" ${2:+--target "${@:2}"} |
        { grep -vE '^ninja: no work to do|Re-checking globbed directories' || true; }
}

# Builds web_viewer/dist if a file of the page has changed since the last build. Tests need more
# packages than the page, whose own packages have optional peers, of 120 MB, that it does not use.
build_page() { # [page]: installs the packages of the page alone
    local lock now kind=all options=()
    lock=$(sha256sum web_viewer/package-lock.json)
    [ "${1:-}" != page ] || kind=page options=(--omit=dev --legacy-peer-deps)
    if [ ! -d web_viewer/node_modules ] || ! grep -qxF -e "$lock all" -e "$lock $kind" \
        build/page-modules.stamp 2>/dev/null; then
        (cd web_viewer && npm ci --no-audit --no-fund --loglevel=error "${options[@]}")
        echo "$lock $kind" >build/page-modules.stamp
    fi
    now=$(find web_viewer \( -name node_modules -o -name dist \) -prune -o -type f -print0 |
        LC_ALL=C sort -z | xargs -0 sha256sum)
    if [ "$(cat build/page.stamp 2>/dev/null)" != "$now" ] || [ ! -f web_viewer/dist/index.html ]; then
        (cd web_viewer && npm run --silent build)
        echo "$now" >build/page.stamp
    fi
}
