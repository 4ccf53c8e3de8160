# Shared by the scripts in this folder: source it first.
# shellcheck shell=bash

set -euo pipefail

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
PROGRAM=$(basename "$0")
# Prefix of the scripts' names for users: an installed copy has one command for all, "nao-remote start".
CALL=${NAO_REMOTE_CALL:-scripts/}

say() { printf '%s\n' "$*"; }
warn() { printf '%s: %s\n' "$PROGRAM" "$*" >&2; }

# die MESSAGE...: one sentence that says what is wrong and what to do, then exit status 1.
die() {
    warn "$@"
    exit 1
}

# die_usage MESSAGE...: the command line is wrong, exit status 2.
die_usage() {
    warn "$* (try: $CALL$PROGRAM --help)"
    exit 2
}

# Prints the comment at the head of the calling script: its documentation.
usage() {
    sed -n '2,/^[^#]/{ /^#/!q; s/^# \{0,1\}//; p; }' "$0"
}

# value OPTION ARGS...: the value that must follow an option.
value() {
    [ $# -ge 2 ] || die_usage "$1 needs a value"
    printf '%s' "$2"
}

# Runs a command as root: directly, or with sudo.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        return 126
    fi
}

# Number of parallel compilers: one per core, but 1.5 GB of memory for each.
build_jobs() {
    local cores memory_jobs
    cores=$(nproc)
    memory_jobs=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
    if [ "$memory_jobs" -lt 1 ]; then memory_jobs=1; fi
    printf '%s' "$((memory_jobs < cores ? memory_jobs : cores))"
}

# reconfigure_with_new_packages: until GoogleTest and OpenCV came, the dev preset was configured without tests and nao-vision.
reconfigure_with_new_packages() {
    if grep -qsE '^(GTest_DIR:PATH|OPENCV_INCLUDE_DIR:PATH|OPENCV_dnn_LIBRARY:FILEPATH)=.*-NOTFOUND' "$ROOT/build/dev/CMakeCache.txt"; then
        rm -f "$ROOT/build/dev/.configured"
    fi
}

# build_preset PRESET [TARGET...]: configures if necessary and builds; prints ninja's progress.
build_preset() {
    local preset=$1 targets=() target
    shift
    for target in "$@"; do targets+=(--target "$target"); done
    local build_dir=$ROOT/build/$preset stamp=$ROOT/build/$preset/.configured
    (
        cd "$ROOT"
        # Configuring takes longer than starting all programs. Ninja repeats it for files that it knows;
        # only new folders need it here.
        if [ ! -f "$stamp" ] || [ ! -f "$build_dir/build.ninja" ] ||
            [ -n "$(find . -path ./build -prune -o -name node_modules -prune -o \
                \( -name CMakeLists.txt -o -name '*.cmake' -o -name CMakePresets.json \) \
                -newer "$stamp" -print -quit)" ]; then
            cmake --preset "$preset" --log-level=WARNING
            touch "$stamp"
        fi
        cmake --build --preset "$preset" --parallel "$(build_jobs)" ${targets[@]+"${targets[@]}"}
    )
}
