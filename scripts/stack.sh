# Access to the running stack for start, stop, status, record, replay and spy: source it after lib.sh.
# shellcheck shell=bash

# The run directory contains all files of one running stack: supervisor's configuration,
# socket and process id, its settings, and the logs.
RUN_DIR=${NAO_REMOTE_RUN_DIR:-$ROOT/run}

# All programs of a stack.
# shellcheck disable=SC2034
PROGRAMS=(nao-sim nao-motion nao-head-camera nao-phone-gateway)

# Targets that scripts/start builds beside them.
# shellcheck disable=SC2034
COMPANIONS=(nao nao_robot_files scenes nao_phone_app)

# set_run_dir DIR: stores it as an absolute path.
set_run_dir() { RUN_DIR=$(realpath --canonicalize-missing "$1"); }

# setting KEY [DEFAULT]: a setting of the running stack, or of the last one.
setting() {
    local line
    line=$(grep -m 1 "^$1=" "$RUN_DIR/settings" 2>/dev/null) || line="$1=${2-}"
    printf '%s' "${line#*=}"
}

# Process id of the stack's supervisor; exit status 1 if it does not run. A stale file may name a process
# that has ended or that is unrelated to this stack.
supervisor_pid() {
    local pid
    pid=$(cat "$RUN_DIR/supervisord.pid" 2>/dev/null) || return 1
    tr '\0' ' ' 2>/dev/null <"/proc/$pid/cmdline" | grep -qF "$RUN_DIR/supervisord.conf" || return 1
    printf '%s' "$pid"
}

# Process ids of all programs of this stack, identified by an environment variable; this includes orphans of
# a killed supervisor.
stack_pids() {
    grep -lsxzF "NAO_REMOTE_STACK=$RUN_DIR" /proc/[0-9]*/environ 2>/dev/null |
        sed 's|/proc/\([0-9]*\)/.*|\1|' || true
}

# wait_for_no_pids SECONDS: waits until no process of the stack is left; exit status 1 on timeout.
wait_for_no_pids() {
    local deadline=$((SECONDS + $1))
    while [ -n "$(stack_pids)" ]; do
        if [ "$SECONDS" -ge "$deadline" ]; then return 1; fi
        sleep 0.05
    done
}

# signal_stack SIGNAL: to every process of the stack.
signal_stack() {
    local pids
    mapfile -t pids < <(stack_pids)
    if [ ${#pids[@]} -gt 0 ]; then kill -s "$1" "${pids[@]}" 2>/dev/null || true; fi
}

# Ends every process of the stack: SIGTERM to the supervisor, which ends its programs; SIGTERM to the
# remaining processes; then SIGKILL.
stop_stack() {
    local pid
    if pid=$(supervisor_pid); then
        kill -s TERM "$pid"
        wait_for_no_pids 10 || true
    fi
    signal_stack TERM
    wait_for_no_pids 5 || signal_stack KILL
    wait_for_no_pids 5 || die "these processes do not end: $(stack_pids | tr '\n' ' ')"
    rm -f "$RUN_DIR/supervisord.pid" "$RUN_DIR/supervisor.sock"
}

# Bus URL of the running stack, of the last one, or the default.
bus_url() { setting lcm_url "${LCM_DEFAULT_URL:-udpm://239.255.76.67:7667?ttl=0}"; }

# tool NAME: path of one of the project's command-line programs.
tool() {
    local dir
    for dir in "$(setting bin_dir "$ROOT/build/dev/bin")" "$ROOT/build/dev/bin"; do
        if [ -x "$dir/$1" ]; then
            printf '%s' "$dir/$1"
            return
        fi
    done
    die "$1 is not built yet; ${CALL}start builds it"
}
