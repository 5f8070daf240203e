#!/usr/bin/env bash
# A cluster on this machine: `cluster.sh start [EXECUTORS [TASKS]]`, `cluster.sh stop`.
#
# It starts a scheduler and executors (2 with 1 task at a time each, if not said otherwise), prints the address of the
# scheduler and leaves process numbers and logs in a folder, LINKAGE_CLUSTER (target/cluster). LINKAGE_SQL is the binary.
set -euo pipefail
cd "$(dirname "$0")"
folder=${LINKAGE_CLUSTER:-target/cluster}
binary=${LINKAGE_SQL:-target/release/linkage-sql}

start() {
    local executors=${1:-2} tasks=${2:-1}
    [ -x "$binary" ] || { echo "$binary is missing: cargo build --release" >&2; exit 1; }
    [ ! -e "$folder/pids" ] || { echo "a cluster is running: $0 stop" >&2; exit 1; }
    mkdir -p "$folder"
    # On any failure nothing stays.
    trap stop ERR
    "$binary" scheduler --port "${LINKAGE_PORT:-0}" --executors "$executors" >"$folder/address" 2>"$folder/scheduler.log" &
    echo $! >"$folder/pids"
    for _ in $(seq 100); do
        [ ! -s "$folder/address" ] || break
        sleep 0.1
    done
    [ -s "$folder/address" ] || { cat "$folder/scheduler.log" >&2; false; }
    for number in $(seq "$executors"); do
        "$binary" executor --scheduler "$(cat "$folder/address")" --tasks "$tasks" \
            >"$folder/executor-$number.log" 2>&1 &
        echo $! >>"$folder/pids"
    done
    cat "$folder/address"
}

stop() {
    [ -e "$folder/pids" ] || { echo "no cluster is running" >&2; return; }
    # Executors first: they tell the scheduler. The last ones are those that were started last.
    for pid in $(tac "$folder/pids"); do
        kill "$pid" 2>/dev/null || true
    done
    for pid in $(tac "$folder/pids"); do
        for _ in $(seq 100); do
            kill -0 "$pid" 2>/dev/null || break
            sleep 0.1
        done
        kill -9 "$pid" 2>/dev/null || true
    done
    rm -f "$folder/pids" "$folder/address"
}

case ${1:-} in
    start) shift; start "$@" ;;
    stop) stop ;;
    *) echo "usage: $0 start [EXECUTORS [TASKS]] | stop" >&2; exit 2 ;;
esac
