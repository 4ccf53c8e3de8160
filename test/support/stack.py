"""A private stack for a test: scripts/start with its own bus, ports and run directory.

NAO_BIN_DIR (set by CTest) is the folder of the programs to start.
"""

import contextlib
import json
import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BIN_DIR = Path(os.environ.get("NAO_BIN_DIR", ROOT / "build/dev/bin"))

# Timeout, s, for a machine with other load; it measures nothing.
DEADLINE = 120


# Sockets that keep other tests from taking the same ports, until this test ends.
_holders = []


def private_lcm_url():
    """URL of a bus that no other test uses. A TCP socket on the bus's port holds it, for any number of programs may share a UDP
    port."""
    while True:
        port = 20000 + secrets.randbelow(10000)
        holder = socket.socket()
        with contextlib.suppress(OSError):
            holder.bind(("127.0.0.1", port))
            _holders.append(holder)
            return f"udpm://239.255.76.67:{port}?ttl=0"


def free_port():
    """A TCP port that no other test gets. With SO_REUSEADDR, as all servers set it, a program can listen on it."""
    holder = socket.socket()
    holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    holder.bind(("127.0.0.1", 0))
    _holders.append(holder)
    return holder.getsockname()[1]


def run(command, **options):
    """Runs a command to its end. @return .returncode, .stdout, .stderr."""
    return subprocess.run(
        [str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
        timeout=DEADLINE, check=False, **options)


class Stack:
    """One stack. Use it in a with statement: its end stops all programs and removes all files."""

    def __init__(self):
        self.run_dir = Path(tempfile.mkdtemp(prefix="nao-"))
        self.lcm_url = private_lcm_url()
        self.http_port = free_port()
        self.tcp_port = free_port()
        self.token = "test-token"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
        shutil.rmtree(self.run_dir, ignore_errors=True)

    def start(self, *options, ports=True):
        """Calls scripts/start and returns its result unchecked."""
        command = [ROOT / "scripts/start", "--bin", BIN_DIR, "--run-dir", self.run_dir, "--lcm-url", self.lcm_url,
                   "--bind", "127.0.0.1", "--token", self.token]
        if ports:
            command += ["--http-port", self.http_port, "--tcp-port", self.tcp_port]
        return run([*command, *options])

    def start_or_fail(self, *options):
        """Starts the stack; a failure includes all logs."""
        result = self.start(*options)
        if result.returncode != 0:
            raise AssertionError(f"scripts/start: {result.returncode}\n{result.stdout}{result.stderr}{self.logs()}")
        return result

    def stop(self):
        return self.script("stop")

    def script(self, name, *arguments):
        """Calls another of the scripts on this stack."""
        return run([ROOT / "scripts" / name, "--run-dir", self.run_dir, *arguments])

    def nao(self, *arguments):
        """Calls the command-line client on this stack's bus."""
        return run([BIN_DIR / "nao", "--lcm-url", self.lcm_url, *arguments])

    def state(self):
        """State of nao-motion: a dictionary with robot_state and motion_state."""
        return json.loads(self.nao("state", "--json").stdout)

    def truth(self):
        """True state of the world: world_truth_t as a dictionary."""
        return json.loads(self.nao("world", "show", "--json").stdout)

    def torso_height(self):
        return self.truth()["robots"][0]["position_torso_in_world"][2]

    def pids(self):
        """Program name to process id, of every process with this stack's environment variable."""
        mark = f"NAO_REMOTE_STACK={self.run_dir}".encode()
        found = {}
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                if mark in (folder / "environ").read_bytes().split(b"\0"):
                    program = (folder / "cmdline").read_bytes().split(b"\0")[0].decode()
                    found[Path(program).name] = int(folder.name)
            except OSError:
                continue  # it has ended, or belongs to another user
        return found

    def wait_ready(self, *programs):
        return self.nao("status", "--wait", ",".join(programs), "--timeout", DEADLINE - 10)

    def logs(self):
        """The end of every log, for the message of a failed test."""
        texts = []
        for log in sorted((self.run_dir / "logs").glob("*.log")):
            texts.append(f"--- {log.name}\n" + "\n".join(log.read_text(errors="replace").splitlines()[-15:]))
        return "\n".join(texts)


class Program:
    """One program without supervisor."""

    def __init__(self, name, lcm_url, *options, environment=None):
        self.process = subprocess.Popen(
            [str(BIN_DIR / name), "--lcm-url", lcm_url, *[str(option) for option in options]],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            env={**os.environ, **(environment or {})})

    def end(self, with_signal=signal.SIGTERM):
        """Sends SIGTERM. @return (exit status, duration in s, output)."""
        start = time.monotonic()
        self.process.send_signal(with_signal)
        _, said = self.process.communicate(timeout=DEADLINE)
        return self.process.returncode, time.monotonic() - start, said

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
