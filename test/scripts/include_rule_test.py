#!/usr/bin/python3
"""Includes point from right to left: lcmtypes <- libs <- programs <- tools <- test; docs/architecture.md explains it."""

import re
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LIBS = {folder.name for folder in (ROOT / "libs").iterdir() if folder.is_dir()}
GENERATED = {"naolcm": "lcmtypes", "remote.pb.h": "phone-gateway", "simulation.pb.h": "tools"}
FOLDERS = {"lcmtypes", "libs", "sim", "daemons", "phone-gateway", "viewer", "tools", "test"}

# Programs exchange messages, and include no header of each other. Exceptions: (who includes, whose headers) -> why.
EXCEPTIONS = {
    ("sim/closed_loop", "sim"): "it steps the simulator in its own process",
    ("sim/closed_loop", "daemons/motion"): "it steps the motion core in the same process, for trials, tuners and tests",
    ("daemons/motion-files", "daemons/motion"): "it reads motions and joint limits as nao-motion does, so that both agree on what is safe",
    ("daemons/motion-files", "sim/closed_loop"): "it simulates a motion before it saves it",
}


def component(path):
    """The library group, program or folder that a path, or an include from one of the two include roots, belongs to."""
    first, *others = path.split("/")
    if first in GENERATED:
        return GENERATED[first]
    if first in LIBS:
        return "libs"
    if first == "daemons" or (first == "sim" and others[0] == "closed_loop"):
        return f"{first}/{others[0]}"
    return first if others else None  # a header beside its includer, of the system or of a Debian package


def layer(name):
    return {"lcmtypes": 0, "libs": 1, "tools": 3, "test": 4}.get(name, 2)


def is_allowed(includer, included):
    if includer == included or (includer, included) in EXCEPTIONS:
        return True
    return layer(included) < layer(includer)


def includes():
    """All includes of the project's own headers: (file, include, component of each)."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard", "*.h", "*.cpp"],
                            capture_output=True, text=True, check=True).stdout.splitlines()
    for name in listed:
        if not (ROOT / name).exists() or name.startswith("cmake/"):  # cmake/ has the precompiled headers
            continue
        for include in re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', (ROOT / name).read_text(), re.MULTILINE):
            owner = component(include)
            if owner is not None and owner.split("/")[0] in FOLDERS:
                yield name, include, component(name), owner


class IncludeRule(unittest.TestCase):
    def test_includes_point_to_the_left(self):
        wrong = [f"{name} includes {include}: {includer} may not include {included}"
                 for name, include, includer, included in includes() if not is_allowed(includer, included)]
        self.assertEqual(wrong, [])

    def test_every_exception_is_in_use(self):
        used = {(includer, included) for _, _, includer, included in includes()}
        self.assertEqual(sorted(set(EXCEPTIONS) - used), [])

    def test_no_include_leaves_its_folder_by_a_relative_path(self):
        self.assertEqual([f"{name}: {include}" for name, include, _, _ in includes() if ".." in include.split("/")], [])

    def test_the_rule_tells_right_from_wrong(self):
        for includer, include, right in (("libs/messages/command.cpp", "common/bus.h", True),
                                         ("libs/common/bus.cpp", "sim/world.h", False),
                                         ("daemons/play/main.cpp", "naolcm/play_state_t.hpp", True),
                                         ("daemons/play/play_core.h", "daemons/vision/localizer.h", False),
                                         ("viewer/main.cpp", "sim/world.h", False),
                                         ("sim/world.cpp", "tools/tuning/workers.h", False),
                                         ("tools/nao/main.cpp", "daemons/motion/motion_core.h", True),
                                         ("tools/nao/main.cpp", "test/support/nao_model.h", False),
                                         ("daemons/motion-files/rollout.h", "sim/closed_loop/closed_loop.h", True),
                                         ("sim/sim_core.h", "sim/closed_loop/closed_loop.h", False)):
            with self.subTest(includer=includer, include=include):
                self.assertEqual(is_allowed(component(includer), component(include)), right)


if __name__ == "__main__":
    unittest.main()
