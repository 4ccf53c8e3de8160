# Access to the running stack for record, replay and spy: source it after lib.sh. stack.py is the same for
# start, stop and status.
# shellcheck shell=bash

# The run directory contains all files of one running stack: supervisor's configuration,
# socket and process id, its settings, and the logs.
RUN_DIR=${NAO_REMOTE_RUN_DIR:-$ROOT/run}

# set_run_dir DIR: stores it as an absolute path.
set_run_dir() { RUN_DIR=$(realpath --canonicalize-missing "$1"); }

# setting KEY [DEFAULT]: a setting of the running stack, or of the last one.
setting() {
    local line
    line=$(grep -m 1 "^$1=" "$RUN_DIR/settings" 2>/dev/null) || line="$1=${2-}"
    printf '%s' "${line#*=}"
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

# build_tools: builds what "nao record" and "nao spy" need, which scripts/start does not, if it is missing.
build_tools() {
    [ -n "${NAO_REMOTE_BIN:-}" ] || [ -x "$(dirname "$(tool nao)")/nao-tools" ] || build_preset dev nao-tools
}
