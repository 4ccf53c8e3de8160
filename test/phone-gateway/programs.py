"""Programs started by a test, on a bus and on ports of its own.

NAO_BIN_DIR (set by CTest) is the folder of the programs.
"""

import json
import os
import re
import subprocess
import sys
import threading
import time
from collections import deque
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN_DIR = Path(os.environ.get("NAO_BIN_DIR", ROOT / "build/dev/bin"))
# The package nao_remote, with the protocol's classes.
sys.path[:0] = [str(BIN_DIR.parent / "python"), str(ROOT / "test/support")]

from stack import private_lcm_url  # noqa: E402

# s. Long, since the machine may be busy; nothing here measures time.
DEADLINE = 60


def wait_until(condition, what, timeout=DEADLINE):
    """Calls condition() until its result is true. @return the result."""
    deadline = time.monotonic() + timeout
    while time.monotonic() < deadline:
        answer = condition()
        if answer:
            return answer
        time.sleep(0.05)
    raise AssertionError(f"not within {timeout} s: {what}")


class Program:
    """A running program. The last lines of its log are in .log."""

    def __init__(self, name, *options):
        self.name = name
        # The last lines: in a test of an hour they must not be the memory that grows.
        self.log = deque(maxlen=1000)
        self.process = subprocess.Popen(
            [str(BIN_DIR / name), *[str(option) for option in options]],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.log.append(line.rstrip())

    def wait_for_log(self, pattern):
        """@return the match of a line that it logs."""
        def find():
            if self.process.poll() is not None:
                self._reader.join()
                self.process.stderr.close()
                raise AssertionError(f"{self.name} ended: {self.log}")
            return next((found for line in list(self.log) if (found := re.search(pattern, line))), None)
        return wait_until(find, f"{self.name} logs {pattern}")

    def kill(self):
        """Kills it with SIGKILL."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self._reader.join()
        self.process.stderr.close()

    def end(self):
        """Terminates it with SIGTERM. @return its exit status."""
        if self.process.poll() is None:
            self.process.terminate()
        status = self.process.wait(DEADLINE)
        self._reader.join()
        self.process.stderr.close()
        return status


class Gateway(Program):
    """A gateway on free ports of 127.0.0.1. Without lcm_url it has a bus of its own."""

    def __init__(self, *options, lcm_url="memq://", bind="127.0.0.1", http_port=0, tcp_port=0):
        super().__init__("nao-phone-gateway", "--bind", bind, "--http-port", http_port, "--tcp-port", tcp_port,
                         "--token", "test-token", "--lcm-url", lcm_url, *options)
        ports = self.wait_for_log(r"HTTP and WebSocket on [^ ]*:(\d+), TCP on [^ ]*:(\d+)")
        self.http_port = int(ports.group(1))
        self.tcp_port = int(ports.group(2))


class Robot:
    """Simulator, motion, camera and gateway. Use it in a with statement, which kills them at its end."""

    def __init__(self, scene="soccer", bind="127.0.0.1"):
        self.scene = scene
        self.bind = bind
        self.lcm_url = private_lcm_url()
        self.programs = {}

    def __enter__(self):
        self.start("nao-sim", "--scene", self.scene)
        self.start("nao-motion")
        self.start("nao-head-camera")
        self.start_gateway()
        self.nao("status", "--wait", "nao-sim,nao-motion,nao-head-camera,nao-phone-gateway", "--timeout", DEADLINE)
        return self

    def __exit__(self, *_):
        for program in self.programs.values():
            program.kill()

    def start(self, name, *options):
        self.programs[name] = Program(name, "--lcm-url", self.lcm_url, *options)

    def start_gateway(self):
        before = self.programs.get("nao-phone-gateway")
        ports = {"http_port": before.http_port, "tcp_port": before.tcp_port} if before else {}
        self.programs["nao-phone-gateway"] = Gateway(lcm_url=self.lcm_url, bind=self.bind, **ports)

    def start_speaker(self):
        """Starts the speech program without sound."""
        self.start("nao-speaker", "--output", "none")
        self.nao("status", "--wait", "nao-speaker", "--timeout", DEADLINE)

    @property
    def gateway(self):
        return self.programs["nao-phone-gateway"]

    def nao(self, *arguments):
        """Runs the command-line client of the bus. @return its output."""
        result = subprocess.run([str(BIN_DIR / "nao"), "--lcm-url", self.lcm_url, *[str(a) for a in arguments]],
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=2 * DEADLINE, check=False)
        if result.returncode != 0:
            raise AssertionError(f"nao {arguments}: {result.returncode}\n{result.stdout}{result.stderr}")
        return result.stdout

    def nao_phone(self, *arguments):
        """Runs nao-phone. @return its exit status and output."""
        return subprocess.run([str(BIN_DIR / "nao-phone"), "--port", str(self.gateway.tcp_port),
                               *[str(a) for a in arguments]],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=2 * DEADLINE, check=False)

    def stand(self):
        """Stands the robot up; retries while programs that the test before has killed are unavailable."""
        wait_until(lambda: self.nao_phone("posture", "StandInit").returncode == 0, "the robot stands")

    def truth(self):
        """@return the robot's part of world_truth_t as a dictionary."""
        return json.loads(self.nao("world", "show", "--json"))["robots"][0]

    def torso_height(self):
        return self.truth()["position_torso_in_world"][2]
