"""Cost of several robots that all walk, without cameras, and a match with two people; used by scripts/bench."""

import contextlib
import json
import os
import statistics
import subprocess
import tempfile
import time

# Numbers of robots of the table.
COUNTS = (1, 2, 4, 8, 10)
# Each number this many times, in turn: a shared machine's speed changes within minutes.
ROUNDS = 3
# Time to begin walking, and measured time, s.
SETTLE_TIME = 4
DURATION = 15
# In circles of 0.2 m: the robots stay apart. m/s, m/s, rad/s.
WALK = ("0.08", "0", "0.4")
# Robots of a match of two against two that people drive; the others play by themselves.
PEOPLE, AUTONOMOUS = ("NAO1", "NAO3"), ("NAO2", "NAO4")
# Measured time of the match, s.
MATCH_DURATION = 60
# What the app asks for: states and images a second.
PHONE = ("--rate", "60", "--images", "15")


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


def linear_fit(counts, costs):
    """Least squares of costs = shared + each * count. @return shared, each, and the greatest deviation in % of the cost."""
    each, shared = statistics.linear_regression(counts, costs)
    return shared, each, max(abs(cost / (shared + each * count) - 1) for count, cost in zip(counts, costs)) * 100


@contextlib.contextmanager
def phones(stack, velocity, names=("",)):
    """Phones drive their robots and see states and images until the end. @param names  Robots; empty: the only one.
    @return lambda: the lines that each phone has printed."""
    # Lines at once: they are counted.
    phone = ["stdbuf", "-oL", str(stack.bin_dir / "nao-phone"), "--port", stack.setting("tcp_port"), "--robot"]
    quiet = {"stdin": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    logs, processes = [], []
    try:
        for name in names:
            logs.append(tempfile.TemporaryFile())
            for words, output in (["watch", *PHONE], logs[-1]), (["walk", *velocity], subprocess.DEVNULL):
                command = [*phone, name, *words, "--duration", "600"]
                processes.append(subprocess.Popen(command, stdout=output, **quiet))
        yield lambda: [os.pread(log.fileno(), 1 << 26, 0).decode().splitlines() for log in logs]
        if any(process.poll() is not None for process in processes):
            raise RuntimeError("a phone has ended")
    finally:
        for process in processes:
            process.terminate()
            process.wait()
        for log in logs:
            log.close()


def measure_match(bin_dir, stack_class, figure):
    """Two against two, of which two are driven by people and two play by what they see, in real time."""
    truth = lambda: json.loads(stack.nao("world", "show", "--json"))
    with stack_class(bin_dir) as stack:
        stack.start("--match", "2v2", "--vision", "--autonomous", ",".join(AUTONOMOUS))
        with phones(stack, WALK, PEOPLE) as lines:
            count_images = lambda: [sum(line.startswith("image") for line in seen) for seen in lines()]
            stack.nao("match", "start")
            time.sleep(SETTLE_TIME)
            before, first, images, begin = stack.usage()[0], truth(), count_images(), time.monotonic()
            log = f"{stack.folder.name}/vision.log"
            stack.nao("record", "--channels", ".*_VISION_STATE", "--for", str(MATCH_DURATION), log)
            seconds = time.monotonic() - begin
            images, last = [b - a for a, b in zip(images, count_images())], truth()
            percent = 100 * (stack.usage()[0] - before) / seconds
        seen = {one["channel"]: one["messages"] / MATCH_DURATION
                for one in json.loads(stack.nao("log", "info", "--json", log))["channels"]}
    ticks = last["tick"] - first["tick"]
    return [figure("match.people_core_percent", percent, "% of a core"),
            figure("match.people_late_ticks_percent", 100 * (last["num_late_ticks"] - first["num_late_ticks"]) / ticks, "%"),
            figure("match.people_late_commands_percent",
                   100 * (last["num_late_commands"] - first["num_late_commands"]) / ticks / len(last["robots"]), "%"),
            figure("match.people_real_time_factor", 1e-6 * (last["utime"] - first["utime"]) / seconds, "x"),
            figure("match.people_images_per_s", min(images) / seconds, "1/s"),
            figure("match.people_seen_images_per_s", min(seen[f"{name}_VISION_STATE"] for name in AUTONOMOUS), "1/s")]


def measure_crowd(bin_dir, stack_class, figure):
    """Robots that walk, of each number in COUNTS: medians."""
    rounds = []
    for _ in range(ROUNDS):
        rounds.append([])
        for count in COUNTS:
            with stack_class(bin_dir) as stack:
                stack.start("--robots", str(count), "--no-camera")
                rounds[-1] += measure_robots(stack, count, figure)
    figures = [{**same[0], "value": statistics.median(one["value"] for one in same)} for same in zip(*rounds)]
    costs = [one["value"] for one in figures if one["name"].endswith("_core_percent")]
    shared, each, deviation = linear_fit(COUNTS, costs)
    return [*figures, figure("match.shared_core_percent", shared, "% of a core"),
            figure("match.each_robot_core_percent", each, "% of a core"),
            figure("match.linear_deviation_percent", deviation, "%")]


def measure(bin_dir, stack_class, figure):
    return measure_crowd(bin_dir, stack_class, figure) + measure_match(bin_dir, stack_class, figure)
