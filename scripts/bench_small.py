"""The whole system on half a core and 512 MB, at rest and with one phone that drives; used by scripts/bench."""

import contextlib
import json
import os
import re
import sys
import time
from pathlib import Path

import bench_match

# Half a core, as us of processor time in each period of us, and bytes.
QUOTA, PERIOD = 50_000, 100_000
MEMORY = 512 << 20
# From the start until programs rest, s: more than the time after which the simulator does.
SETTLE_TIME = 8
# Measured time of each part, and the period in which memory is read meanwhile, s.
DURATION = 20
SAMPLE_PERIOD = 1
# In circles of 0.25 m. m/s, m/s, rad/s.
WALK = ("0.15", "0", "0.6")
CGROUPS = Path("/sys/fs/cgroup")


@contextlib.contextmanager
def limits():
    """@return The command that runs another one with the limits, and what enforces them."""
    folders = [CGROUPS / controller / f"nao-bench-{os.getpid()}" for controller in ("cpu", "memory")]
    if Path("/run/systemd/system").is_dir() and os.geteuid() == 0:
        yield ["systemd-run", "--quiet", "--scope", "-p", f"CPUQuota={100 * QUOTA // PERIOD}%", "-p", f"MemoryMax={MEMORY}",
               "--"], "systemd-run"
        return
    if not all(os.access(folder.parent / "tasks", os.W_OK) for folder in folders):
        yield [], "nothing: neither systemd nor control groups of version 1 are to be had"
        return
    for folder in folders:
        folder.mkdir()
    try:
        (folders[0] / "cpu.cfs_period_us").write_text(str(PERIOD))
        (folders[0] / "cpu.cfs_quota_us").write_text(str(QUOTA))
        (folders[1] / "memory.limit_in_bytes").write_text(str(MEMORY))
        enter = "".join(f"echo $$ > {folder}/cgroup.procs; " for folder in folders)
        yield ["sh", "-ec", f'{enter} exec "$@"', "sh"], "control groups, without real-time scheduling"
    finally:
        for folder in folders:
            folder.rmdir()


def read_usage(stack):
    """Program to its processor time, s, the times that it went to sleep, and its private bytes."""
    usage = {}
    for program, process in stack.folders():
        with contextlib.suppress(OSError):
            time_used = wakeups = 0
            for task in (process / "task").iterdir():
                time_used += int((task / "schedstat").read_text().split()[0]) * 1e-9
                wakeups += int(re.search(r"^voluntary_ctxt_switches:\s+(\d+)", (task / "status").read_text(), re.MULTILINE)[1])
            private = re.findall(r"^Private_\w+:\s+(\d+) kB", (process / "smaps_rollup").read_text(), re.MULTILINE)
            before = usage.get(program, (0, 0, 0))
            usage[program] = (before[0] + time_used, before[1] + wakeups, before[2] + 1024 * sum(map(int, private)))
    return usage


def measure_usage(stack, prefix, figure):
    """@return Figures by program and of all: % of a core, wake-ups a second, private memory, and its peak."""
    before, begin, peak = read_usage(stack), time.monotonic(), 0
    while time.monotonic() < begin + DURATION:
        time.sleep(SAMPLE_PERIOD)
        after = read_usage(stack)
        peak = max(peak, sum(usage[2] for usage in after.values()))
    seconds = time.monotonic() - begin
    rows = {program: (100 * (after[program][0] - before[program][0]) / seconds,
                      (after[program][1] - before[program][1]) / seconds, after[program][2] / 1e6)
            for program in sorted(after) if program in before}
    rows["all"] = tuple(map(sum, zip(*rows.values())))
    units = (("core_percent", "% of a core"), ("wakeups_per_s", "1/s"), ("private_mb", "MB"))
    return [*(figure(f"{prefix}.{program}.{name}", value, unit)
              for program, values in rows.items() for (name, unit), value in zip(units, values)),
            figure(f"{prefix}.peak_private_mb", peak / 1e6, "MB")]


def percentile(values, fraction):
    return sorted(values)[min(len(values) - 1, int(fraction * len(values)))] if values else None


def measure_driving(stack, figure):
    """One phone drives and watches."""
    truth = lambda: json.loads(stack.nao("world", "show", "--json"))
    with bench_match.phones(stack, WALK) as phones:
        time.sleep(SETTLE_TIME)
        first, num_lines, begin = truth(), len(phones()[0]), time.monotonic()
        figures = measure_usage(stack, "small.driving", figure)
        last, seen, seconds = truth(), phones()[0][num_lines:], time.monotonic() - begin
    ages = {is_image: [float(line.split()[-2]) for line in seen if line.endswith(" ms") and line.startswith("image") == is_image]
            for is_image in (False, True)}
    late = last["num_late_ticks"] - first["num_late_ticks"]
    return [*figures,
            figure("small.driving.late_ticks_percent", 100 * late / (last["tick"] - first["tick"]), "%"),
            figure("small.driving.real_time_factor", 1e-6 * (last["utime"] - first["utime"]) / seconds, "x"),
            figure("small.driving.states_per_s", len(ages[False]) / seconds, "1/s"),
            figure("small.driving.state_age_p99_ms", percentile(ages[False], 0.99), "ms"),
            figure("small.driving.images_per_s", len(ages[True]) / seconds, "1/s"),
            figure("small.driving.image_age_p95_ms", percentile(ages[True], 0.95), "ms")]


def measure(bin_dir, stack_class, figure):
    with limits() as (prefix, enforced_by), stack_class(bin_dir, prefix) as stack:
        print(f"half a core and {MEMORY >> 20} MB, enforced by {enforced_by}", file=sys.stderr)
        figures = [figure("small.start_s", stack.start(), "s")]
        time.sleep(SETTLE_TIME)
        figures += measure_usage(stack, "small.rest", figure)
        figures += measure_driving(stack, figure)
        # Fails where the robot does. The ball lies before its left foot: a kick that moves none fails.
        for words in (("posture", "Stand"), ("world", "place-robot", "0", "0"), ("world", "place-ball", "0.18", "0.05"),
                      ("action", "kick-left"), ("posture", "LyingBelly"), ("action", "get-up"), ("stop",)):
            stack.nao(*words)
        return figures
