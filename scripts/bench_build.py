"""Processor time of the builds: everything that compiles, links or generates, in a copy of the sources, without a cache."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from stack import COMPANIONS, PROGRAMS

# Included by most sources of the programs.
TOUCHED_HEADER = "libs/robot_model/robot_model.h"


def copy_sources(root, folder):
    """Copies the sources as they are now, without anything that is built."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            check=True, stdout=subprocess.PIPE).stdout
    for name in filter(None, listed.decode().split("\0")):
        if (root / name).is_file():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(root / name, target)


def processor_time(folder, command):
    """User and system time of a command of scripts/lib.sh and of all its children, s."""
    script = f'. "$1"; {command}'
    before = os.times()
    subprocess.run(["bash", "-c", script, "bench", folder / "scripts/lib.sh"], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "CCACHE_DISABLE": "1"})
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def measure(root):
    """@return {name of a figure: s}"""
    with tempfile.TemporaryDirectory(prefix="nao-bench-build-") as name:
        folder = Path(name)
        copy_sources(root, folder)
        start_command = " ".join(["build_preset", "dev", *PROGRAMS, *COMPANIONS])
        start = processor_time(folder, start_command)
        with open(folder / TOUCHED_HEADER, "a", encoding="utf-8") as header:
            header.write("// One more line.\n")
        touch = processor_time(folder, start_command)
        test = processor_time(folder, "build_preset dev")
        # The other build of .ci/run.
        sanitize = processor_time(folder, "build_preset asan unit_and_bus_tests fuzzers")
    return {"build.start_cpu_s": start, "build.touch_cpu_s": touch, "build.test_cpu_s": test,
            "build.ci_cpu_s": start + test + sanitize}
