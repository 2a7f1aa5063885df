# Shared by the commands: progress on the terminal and logs in build/log.
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
logs="$root/build/log"
jobs="${CAROM_JOBS:-$(nproc)}"
start=$SECONDS

say() { printf '[%2d:%02d] %s\n' $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) "$*"; }

# The last line of a log that is worth showing, cut to the width of a terminal.
log_tail() { tr '\r' '\n' <"$1" | grep -av '^[[:space:]]*$' | tail -n 1 | cut -c 1-100; }

# progress <label> <log> <pid>: shows how far a running command is: in place on a terminal, after 5 s and then every 30 s elsewhere.
progress()
{
    local label="$1" log="$2" pid="$3" began=$SECONDS shown=$((SECONDS - 25))
    while kill -0 "$pid" 2>/dev/null; do
        sleep 0.5
        if [ -t 1 ]; then
            printf '\r\033[K        %s, %d s: %s' "$label" $((SECONDS - began)) "$(log_tail "$log")"
        elif ((SECONDS - shown >= 30)); then
            say "  $label, $((SECONDS - began)) s: $(log_tail "$log")"
            shown=$SECONDS
        fi
    done
    [ -t 1 ] && printf '\r\033[K'
    return 0
}

# run <label> <command>...: runs it with its output in a log, shows progress, and on failure the end of the log.
run()
{
    local label="$1" log status=0
    shift
    mkdir -p "$logs"
    log="$logs/$(printf '%s' "$label" | tr -c 'a-zA-Z0-9\n' '-').log"
    # A process group of its own, so that Ctrl-C can end the command and everything it started.
    set -m
    "$@" >"$log" 2>&1 </dev/null &
    local pid=$!
    set +m
    running=$pid
    progress "$label" "$log" "$pid"
    wait "$pid" || status=$?
    running=
    if [ "$status" -ne 0 ]; then
        say "$label failed (status $status); the end of $log:"
        tail -n "${CAROM_TAIL:-60}" "$log"
    fi
    return "$status"
}

stop_running()
{
    [ -n "${running:-}" ] && kill -- "-$running" 2>/dev/null
    echo
    say "stopped; finished parts and logs stay in build/"
    exit 130
}
trap stop_running INT TERM

# By the name of a preset.
build() { local preset="$1"; shift; run "build $preset" cmake --build "build/$preset" -j "$jobs" "$@"; }
configure() { local preset="$1"; shift; run "configure $preset" cmake --preset "$preset" "$@"; }
test_with() { run "tests $1" ctest --preset "$1" -j "$jobs"; }
ASAN_SYMBOLIZER_PATH="$(command -v llvm-symbolizer-22 || command -v llvm-symbolizer-19 || true)"
export ASAN_SYMBOLIZER_PATH
