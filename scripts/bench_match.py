"""Cost of several robots that all walk, without cameras; used by scripts/bench."""

import contextlib
import json
import subprocess
import time

# Numbers of robots of the table.
COUNTS = (1, 2, 4, 8, 10)
# Time to begin walking, and measured time, s.
SETTLE_TIME = 4
DURATION = 15
# In circles of 0.2 m: the robots stay apart. m/s, m/s, rad/s.
WALK = ("0.08", "0", "0.4")


@contextlib.contextmanager
def walking(stack, names, velocity=WALK):
    """All robots walk until the end."""
    drivers = [subprocess.Popen([str(stack.bin_dir / "nao"), "--lcm-url", stack.lcm_url, "--robot", name, "walk", *velocity],
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
               for name in names]
    try:
        yield
        if any(driver.poll() is not None for driver in drivers):
            raise RuntimeError("a robot has stopped walking")
    finally:
        for driver in drivers:
            driver.terminate()
            driver.wait()


def measure_robots(stack, count, figure):
    """@return Figures for this number of robots."""
    names = [f"NAO{i}" for i in range(1, count + 1)] if count > 1 else ["NAO"]
    truth = lambda: json.loads(stack.nao("world", "show", "--json"))
    with walking(stack, names):
        time.sleep(SETTLE_TIME)
        before, begin, first = stack.usage_by_program(), time.monotonic(), truth()
        time.sleep(DURATION)
        after, end, last = stack.usage_by_program(), time.monotonic(), truth()
    percent = {program: 100 * (cpu - before.get(program, 0)) / (end - begin) for program, cpu in after.items()}
    standing = sum(robot["position_torso_in_world"][2] > 0.25 for robot in last["robots"])
    ticks = last["tick"] - first["tick"]
    prefix = f"match.robots{count}"
    return [figure(f"{prefix}_core_percent", sum(percent.values()), "% of a core"),
            *(figure(f"{prefix}.{program}_percent", value, "% of a core") for program, value in sorted(percent.items())),
            figure(f"{prefix}.real_time_factor", 1e-6 * (last["utime"] - first["utime"]) / (end - begin), "x"),
            figure(f"{prefix}.late_ticks_percent", 100 * (last["num_late_ticks"] - first["num_late_ticks"]) / ticks, "%"),
            figure(f"{prefix}.late_commands_percent",
                   100 * (last["num_late_commands"] - first["num_late_commands"]) / ticks / count, "%"),
            figure(f"{prefix}.standing_robots", standing, "")]


def measure(bin_dir, stack_class, figure, programs=None):
    """@param programs  Only these, as --only of scripts/start names them; None: all but the cameras."""
    figures = []
    for count in COUNTS:
        with stack_class(bin_dir) as stack:
            stack.start("--robots", str(count), *(["--only", programs] if programs else ["--no-camera"]))
            figures += measure_robots(stack, count, figure)
    return figures
