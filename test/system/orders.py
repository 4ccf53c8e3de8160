#!/usr/bin/python3
"""Usage: test/system/orders.py [--orders N] [--seed S] [--time-scale FACTOR]

Starts the five programs of a stack in every order (120 orders, or N random ones) without supervisor; all programs
must become ready and the robot must execute a command. Then ends them with SIGINT in another order; each must end
within 2 s with exit status 0. Prints the longest times; exit status 1 if an order failed. A few orders are part of
the test run.
"""

import argparse
import itertools
import random
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from stack import DEADLINE, Program, Stack, free_port  # noqa: E402

PROGRAMS = ["nao-sim", "nao-motion", "nao-head-camera", "nao-phone-gateway", "nao watchdog"]
REPORTING = ",".join(PROGRAMS[:4])
MAX_END = 2  # s


class Run:
    """One order of starts and ends of the programs."""

    def __init__(self, stack):
        self.stack = stack
        self.programs = {}
        self.ready_seconds = self.end_seconds = 0.0

    def start(self, name):
        words = name.split()
        options = words[1:]
        if name == "nao-phone-gateway":
            options = ["--bind", "127.0.0.1", "--token", "x", "--http-port", free_port(), "--tcp-port", free_port()]
        self.programs[name] = Program(words[0], self.stack.lcm_url, *options)

    def carry_out(self, order):
        """@return The failure; empty on success."""
        begin = time.monotonic()
        for name in order:
            self.start(name)
            time.sleep(random.uniform(0, 0.3))
        ready = self.stack.nao("status", "--wait", REPORTING, "--timeout", DEADLINE - 10)
        self.ready_seconds = time.monotonic() - begin
        if ready.returncode != 0:
            return ready.stderr
        obeyed = self.stack.nao("joint", "HeadYaw", "=0.2")
        if obeyed.returncode != 0:
            return obeyed.stderr
        for name in random.sample(order, len(order)):
            status, seconds, said = self.programs.pop(name).end(signal.SIGINT)
            self.end_seconds = max(self.end_seconds, seconds)
            if status != 0:
                return f"{name} ends with status {status}: {said}"
        return ""

    def kill(self):
        for program in self.programs.values():
            program.kill()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--orders", type=int)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time-scale", type=float, default=1, help="factor of the time bounds, on a machine with other load")
    arguments = parser.parse_args()
    random.seed(arguments.seed)
    orders = list(itertools.permutations(PROGRAMS))
    if arguments.orders:
        orders = random.sample(orders, arguments.orders)
    failures, worst_ready, worst_end = 0, 0.0, 0.0
    with Stack() as stack:
        for order in orders:
            run = Run(stack)
            try:
                fault = run.carry_out(order)
            finally:
                run.kill()
            worst_ready, worst_end = max(worst_ready, run.ready_seconds), max(worst_end, run.end_seconds)
            if fault:
                failures += 1
                print(f"{' '.join(order)}: {fault}", flush=True)
    print(f"{len(orders)} orders, {failures} failed; ready after {worst_ready:.1f} s at the worst, "
          f"ended by Ctrl-C within {worst_end:.2f} s")
    return 1 if failures or worst_end > arguments.time_scale * MAX_END else 0


if __name__ == "__main__":
    sys.exit(main())
