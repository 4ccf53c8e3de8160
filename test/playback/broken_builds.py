#!/usr/bin/python3
"""Usage: test/playback/broken_builds.py [--keep]

Shows that the playback tests catch a broken daemon: flips one sign in each, builds that, and prints which tests
failed. Works on a copy of the tree in build/broken, with a build of its own: half an hour on two cores.
Exit status 1 if a break was not caught, or a test fails on the tree as it is.

  --keep  leave the copy, so that the next run builds little
  --help  this text
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COPY = ROOT / "build/broken"
TARGETS = ["playback_test", "image_playback_test", "nao-head-camera", "nao-phone-gateway", "nao-phone", "nao",
           "nao_python_client"]

# Daemon, file, original text, replacement.
FLIPS = [
    ("nao-sim", "sim/sensors.cpp",
     "readings_.gyroscope = truth.angular_velocity", "readings_.gyroscope = -truth.angular_velocity"),
    ("nao-motion", "daemons/motion/message_conversion.cpp",
     "WalkCommand{message.vx, message.vy, message.wz}", "WalkCommand{message.vx, message.vy, -message.wz}"),
    ("nao-head-camera", "libs/rendering/pinhole_camera.cpp",
     "matrix(1, 1) = 2 * camera.fy", "matrix(1, 1) = -2 * camera.fy"),
    ("nao-phone-gateway", "phone-gateway/server/core/robot_mirror.cpp",
     "add_joint_position(static_cast<float>(position))", "add_joint_position(-static_cast<float>(position))"),
]


def run(*command):
    return subprocess.run(command, cwd=COPY, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def copy_tree():
    """Copies every file of the project; unchanged files keep their time stamps, so that little is rebuilt."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True, text=True).stdout
    for name in listed.splitlines():
        source, target = ROOT / name, COPY / name
        if not source.is_file() or (target.exists() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)


def failed_tests():
    """Builds the copy and replays the logs. @return The names of the failing tests."""
    build = run("cmake", "--build", "--preset", "dev", "--target", *TARGETS)
    if build.returncode != 0:
        sys.exit(f"broken_builds.py: it does not build:\n{build.stdout[-4000:]}{build.stderr}")
    tests = run("ctest", "--preset", "dev", "-L", "playback")
    if "tests passed" not in tests.stdout:
        sys.exit(f"broken_builds.py: the tests do not run:\n{tests.stdout[-4000:]}{tests.stderr}")
    return re.findall(r"^\s*\d+ - (\S+).*\(\w+\)$", tests.stdout, re.MULTILINE)


def break_and_test(file, original, broken):
    path = COPY / file
    text = path.read_text()
    if text.count(original) != 1:
        sys.exit(f"broken_builds.py: {file} does not hold once: {original}")
    path.write_text(text.replace(original, broken))
    try:
        return failed_tests()
    finally:
        path.write_text(text)


def main():
    if set(sys.argv[1:]) - {"--keep"}:
        print(__doc__.strip())
        sys.exit(0 if "--help" in sys.argv else 2)
    copy_tree()
    configured = run("cmake", "--preset", "dev", "--log-level=WARNING")
    if configured.returncode != 0:
        sys.exit(f"broken_builds.py: cannot configure:\n{configured.stderr}")

    failed = failed_tests()
    print(f"as it is: {', '.join(failed) or 'all pass'}", flush=True)
    num_faults = len(failed)
    for daemon, file, original, broken in FLIPS:
        failed = break_and_test(file, original, broken)
        print(f"{daemon}: {file}: {broken}\n  caught by {', '.join(failed) or 'NOTHING'}", flush=True)
        num_faults += not failed
    if "--keep" not in sys.argv:
        shutil.rmtree(COPY)
    sys.exit(1 if num_faults else 0)


main()
