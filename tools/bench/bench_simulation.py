#!/usr/bin/python3
"""Measures how fast nao_remote.simulate() steps: control ticks a second of several worlds in parallel, one request for each tick.

A tick of 10 ms has five physics steps, the sensors, the motion core and the exchange with Python. "of a core" divides by the CPU
time of servers and Python together, which other programs on the machine do not change much; "real" by the time that passed.
"""

import argparse
import os
import resource
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "build/dev/python"))

import nao_remote  # noqa: E402


def cpu_time():
    """@return CPU time of this process and of its children that have ended, s."""
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def measure(engine, num_worlds, num_ticks, mode):
    """@return ticks of all worlds for each s of CPU time, and for each s that passed."""
    worlds = [nao_remote.simulate(seed=seed, engine=engine) for seed in range(1, num_worlds + 1)]
    # The start is left out of the elapsed time; its CPU time is measured with no ticks and subtracted.
    if mode == "walk":
        for world in worlds:
            world.walk(0.1)
    nao_remote.step_together(worlds, 1)
    start = time.monotonic()
    for _ in range(num_ticks):
        targets = [world.state.joint_target for world in worlds] if mode == "joints" else None
        nao_remote.step_together(worlds, 1, targets)
    real = time.monotonic() - start
    for world in worlds:
        world.close()
    return real


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engines", default="fast,mujoco", help="physics engines, with commas (default: fast,mujoco)")
    parser.add_argument("--worlds", default="1,2,8", help="numbers of worlds, with commas (default: 1,2,8)")
    parser.add_argument("--ticks", type=int, default=2000, help="control ticks of each world (default: 2000)")
    options = parser.parse_args()
    print(f"{os.cpu_count()} cores, {options.ticks} ticks of each world")
    print("mode    engine   worlds  ticks/s of a core  ticks/s real")
    for mode in ("walk", "joints"):
        for engine in options.engines.split(","):
            for num_worlds in map(int, options.worlds.split(",")):
                begin = cpu_time()
                measure(engine, num_worlds, 0, mode)
                start_up = cpu_time() - begin
                begin = cpu_time()
                real = measure(engine, num_worlds, options.ticks, mode)
                used = cpu_time() - begin - start_up
                total = num_worlds * options.ticks
                print(f"{mode:7} {engine:8} {num_worlds:6} {total / used:18.0f} {total / real:13.0f}", flush=True)


if __name__ == "__main__":
    main()
