#!/usr/bin/python3
"""Usage: test/phone-gateway/clients/python/soak.py [--minutes M]

A client of the package nao_remote with the real gateway, motion, simulator and camera: it reads states and images at full rate, pings and
turns its head; every two minutes the gateway is killed and started again. Prints the client's memory, and its growth from the warm-up on.
Not part of the test run, because of its duration (default: 60 minutes). Exit status 1 if objects, memory, threads or file descriptors grow,
or a call lasts longer than its timeout.
"""

import argparse
import gc
import os
import sys
import threading
import time
from pathlib import Path

import built_package  # noqa: F401
import nao_remote
from programs import DEADLINE, Robot

KILL_PERIOD = 120  # s
# Part of the duration after which memory counts: until every buffer has its largest size.
WARM_UP = 0.3
MAX_GROWTH = 3  # MiB: caches of the interpreter; 100 bytes leaked for each of the 300000 messages of an hour would be 30 MiB
# Objects that Python's garbage collector knows: a leak of one for each message would be hundreds of thousands. The rest are those of the
# requests that happen to be on their way.
MAX_MORE_OBJECTS = 1000
# s that a call may last above its timeout on a busy machine.
GRACE = 10


def memory_mib():
    resident_pages = int(Path("/proc/self/statm").read_text().split()[1])
    return resident_pages * os.sysconf("SC_PAGESIZE") / 2 ** 20


def resources():
    """@return memory, MiB; objects; threads; file descriptors."""
    gc.collect()
    return memory_mib(), len(gc.get_objects()), threading.active_count(), len(list(Path("/proc/self/fd").iterdir()))


class Reader(threading.Thread):
    """Reads a stream to its end."""

    def __init__(self, stream):
        super().__init__()
        self.stream = stream
        self.num_values = 0
        self.start()

    def run(self):
        for _ in self.stream:
            self.num_values += 1


def act(robot, direction):
    """One round of requests. @return whether the robot did them; the longest call is checked."""
    is_done = True
    for call in (robot.ping, robot.state, lambda: robot.joints["HeadYaw"].move_by(0.2 * direction, timeout=DEADLINE)):
        start = time.monotonic()
        try:
            call()
        except nao_remote.NaoError:
            is_done = False
        if time.monotonic() - start > DEADLINE + GRACE:
            sys.exit(f"a call lasted {time.monotonic() - start:.0f} s")
    return is_done


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    duration = 60 * parser.parse_args().minutes
    with Robot(scene="soccer") as stack:
        stack.stand()
        with nao_remote.connect(f"127.0.0.1:{stack.gateway.http_port}", timeout=5) as robot:
            readers = [Reader(robot.states(60, timeout=None)), Reader(robot.images(30, timeout=None)), Reader(robot.events())]
            start = time.monotonic()
            last_kill, before, num_rounds, num_failed, direction = start, None, 0, 0, 1
            while time.monotonic() < start + duration:
                num_rounds += 1
                is_done = act(robot, direction)
                num_failed += not is_done
                direction = -direction
                if time.monotonic() > last_kill + KILL_PERIOD:
                    stack.gateway.kill()
                    act(robot, direction)
                    stack.start_gateway()
                    robot.wait_until_connected(DEADLINE)
                    last_kill = time.monotonic()
                    print(f"{last_kill - start:5.0f} s  {memory_mib():6.2f} MiB, {readers[0].num_values} states, "
                          f"{readers[1].num_values} images", flush=True)
                if before is None and time.monotonic() > start + WARM_UP * duration:
                    before = resources()
            after = resources()
            for reader in readers:
                reader.stream.close()
                reader.join()
    print(f"{num_rounds} rounds, {num_failed} failed; memory, objects, threads, descriptors: {before} to {after}")
    allowed = (MAX_GROWTH, MAX_MORE_OBJECTS, 0, 1)
    if any(later - earlier > most for later, earlier, most in zip(after, before, allowed)):
        sys.exit("it grows")


if __name__ == "__main__":
    main()
