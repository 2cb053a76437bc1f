# Starts a server for a test on a free port and ends it with the script; sourced.

# start_server BINARY [options]: sets url, server_pid, server_log
start_server() {
    local port try
    server_log=$(mktemp)
    for try in 1 2 3 4 5; do
        port=$((20000 + RANDOM % 12000))
        (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null && continue
        "$1" --host 127.0.0.1 --port "$port" "${@:2}" >"$server_log" 2>&1 &
        server_pid=$!
        trap stop_server EXIT
        url=http://127.0.0.1:$port
        for _ in $(seq 300); do
            ! curl -fsS -o /dev/null "$url/livez" 2>/dev/null || return 0
            kill -0 "$server_pid" 2>/dev/null || break
            sleep 0.1
        done
    done
    echo "the server did not start:" >&2
    cat "$server_log" >&2
    return 1
}

# Prints the token that a server with an empty library prints once, when it is ready.
first_token() {
    local token
    for _ in $(seq 100); do
        token=$(sed -nE 's/.*#token=(spk_.*)$/\1/p' "$server_log")
        [ -z "$token" ] || break
        sleep 0.1
    done
    echo "$token"
}

# Asks for a graceful end and returns the server's exit status.
stop_server() {
    [ -n "${server_pid:-}" ] || return 0
    local pid=$server_pid
    server_pid=
    kill -TERM "$pid" 2>/dev/null
    wait "$pid"
}
