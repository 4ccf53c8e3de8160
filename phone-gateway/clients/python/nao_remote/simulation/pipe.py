"""A process of nao-simulation-server: messages over its stdin and stdout, each after its length."""

from __future__ import annotations

import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Sequence

from nao_remote.errors import SimulationError, Timeout

PROGRAM = "nao-simulation-server"
# Folder of the programs, an environment variable, as for scripts/start.
BIN_VARIABLE = "NAO_REMOTE_BIN"
# Bytes of a response: a state has less than 4 kB; a longer one is an error of the server.
MAX_RESPONSE = 1_000_000
# Time for the process to end after its stdin was closed, s. Chosen: more than a step that it still does.
END_TIMEOUT = 5.0


def find_program(program: str | os.PathLike[str] | None = None) -> str:
    """@return the server's file: the argument, else in the folder NAO_REMOTE_BIN, else on the PATH, else in the build folder
    of the repository in which this file is. @raise SimulationError  if there is none."""
    if program is not None:
        return os.fspath(program)
    folders = [os.environ.get(BIN_VARIABLE, ""), os.environ.get("PATH", os.defpath)]
    found = next(filter(None, (shutil.which(PROGRAM, path=path) for path in folders if path)), None)
    parents = Path(__file__).resolve().parents
    built = parents[5] / "build/dev/bin" / PROGRAM if len(parents) > 5 else Path(PROGRAM)
    if found is None and built.is_file():
        found = str(built)
    if found is None:
        raise SimulationError(f"there is no program {PROGRAM}: build it (cmake --build --preset dev --target {PROGRAM}), or set "
                              f"{BIN_VARIABLE} to its folder")
    return found


class ServerPipe:
    """One running server."""

    def __init__(self, command: Sequence[str], timeout: float) -> None:
        """@param timeout  Longest time for a response, s."""
        self._timeout = timeout
        self._log = tempfile.TemporaryFile()
        try:
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log, bufsize=0)
        except OSError as error:
            self._log.close()
            raise SimulationError(f"{command[0]} cannot be started: {error}") from error
        assert self._process.stdin is not None and self._process.stdout is not None
        self._input = self._process.stdin.fileno()
        self._output = self._process.stdout.fileno()
        os.set_blocking(self._input, False)
        os.set_blocking(self._output, False)
        self._received = bytearray()

    def send(self, message: bytes) -> None:
        """@raise SimulationError  if the server has ended. @raise Timeout  if it reads nothing."""
        rest = memoryview(struct.pack(">I", len(message)) + message)
        deadline = time.monotonic() + self._timeout
        while rest:
            try:
                rest = rest[os.write(self._input, rest):]
            except BlockingIOError:
                self._wait(self._input, select.POLLOUT, deadline)
            except OSError as error:
                raise self._ended() from error

    def receive(self) -> bytes:
        """@return the next response. @raise SimulationError, Timeout"""
        deadline = time.monotonic() + self._timeout
        while True:
            message = self._take()
            if message is not None:
                return message
            self._wait(self._output, select.POLLIN, deadline)
            part = os.read(self._output, 65536)
            if not part:
                raise self._ended()
            self._received += part

    def close(self) -> None:
        """Ends the server."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.close()
        try:
            self._process.wait(END_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()
        self._log.close()

    def _take(self) -> bytes | None:
        if len(self._received) < 4:
            return None
        (length,) = struct.unpack_from(">I", self._received)
        if length > MAX_RESPONSE:
            raise SimulationError(f"the server sent a message of {length} bytes; is it {PROGRAM}?")
        if len(self._received) < 4 + length:
            return None
        message = bytes(self._received[4:4 + length])
        del self._received[:4 + length]
        return message

    def _wait(self, descriptor: int, event: int, deadline: float) -> None:
        poll = select.poll()
        poll.register(descriptor, event)
        if not poll.poll(max(0.0, deadline - time.monotonic()) * 1e3):
            raise Timeout(f"the simulation has not answered within {self._timeout:g} s")

    def _ended(self) -> SimulationError:
        try:
            status: object = self._process.wait(END_TIMEOUT)
        except subprocess.TimeoutExpired:
            status = "none"
        self._log.seek(0)
        lines = self._log.read()[-2000:].decode(errors="replace").strip()
        return SimulationError(f"{PROGRAM} has ended with status {status}: {lines or 'without a message'}")
