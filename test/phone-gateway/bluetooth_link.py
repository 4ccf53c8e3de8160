"""Phones by Bluetooth, without a radio: a private D-Bus with test/support/bluez.py, and a TCP port at which a client is one."""

import contextlib
import json
import os
import queue
import socket
import struct
import subprocess
import sys
import threading
import time

from programs import DEADLINE, ROOT, wait_until

LAST = 0x80
NUM_NUMBERS = 128
ACKNOWLEDGED_BYTES = 500
END = b"\xff"


class Bus:
    """A private system bus, for this process and those that it starts."""

    def __init__(self, folder):
        path = folder / "bus"
        self.process = subprocess.Popen(["dbus-daemon", "--nofork", f"--config-file={ROOT / 'test/support/system_bus.conf'}",
                                         f"--address=unix:path={path}"])
        wait_until(path.exists, "the bus listens")
        os.environ["DBUS_SYSTEM_BUS_ADDRESS"] = f"unix:path={path}"

    def end(self):
        self.process.terminate()
        self.process.wait()


class Bluez:
    """bluetoothd, and what phones do with it."""

    def __init__(self, *options):
        self.process = subprocess.Popen([sys.executable, str(ROOT / "test/support/bluez.py"), *options],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        self.events = queue.Queue()
        self.on_value = lambda value: None
        self._answers = {}
        self._last_id = 0
        self._lock = threading.Lock()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.wait_for("ready")

    def _read(self):
        for line in self.process.stdout:
            what = json.loads(line)
            if "id" in what:
                self._answers[what["id"]].put(what)
            elif what["event"] == "value":
                self.on_value(bytes.fromhex(what["value"]))
            else:
                self.events.put(what)

    def wait_for(self, event):
        while (what := self.events.get(timeout=DEADLINE))["event"] != event:
            pass
        return what

    def act(self, do, **more):
        """@return its answer: {"value"} or {"error"}."""
        answer = queue.Queue()
        with self._lock:
            self._last_id += 1
            self._answers[self._last_id] = answer
            self.process.stdin.write(json.dumps({"id": self._last_id, "do": do, **more}) + "\n")
        return answer.get(timeout=DEADLINE)

    def end(self):
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait()
        self._reader.join()
        self.process.stdout.close()


class BluetoothLink:
    """A phone: serves one client at .port, and passes its messages on. Use it in a with statement."""

    def __init__(self, bluez, phone="AA", mtu=185, rate=100_000 / 8):
        """@param rate  Bytes a second that it takes."""
        self.bluez, self.phone, self.mtu, self.rate = bluez, phone, mtu, rate
        self.num_bytes = 0
        self.is_over = False
        self._values = queue.Queue()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._threads = [threading.Thread(target=self._send, daemon=True), threading.Thread(target=self._receive, daemon=True)]
        self._client = None

    def __enter__(self):
        self.bluez.act("start")
        size = self.bluez.act("read", phone=self.phone, mtu=self.mtu)
        assert "error" not in size, size
        # What came before belongs to another connection.
        self.bluez.on_value = self._values.put
        self.value_bytes = int.from_bytes(bytes.fromhex(size["value"]), "little")
        for thread in self._threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.is_over = True
        self._values.put(END)
        self._listener.close()
        if self._client:
            # Its thread may wait for a request.
            with contextlib.suppress(OSError):
                self._client.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join(DEADLINE)
        if self._client:
            self._client.close()
        self.bluez.act("leave", phone=self.phone)

    def write(self, value):
        return self.bluez.act("write", phone=self.phone, mtu=self.mtu, value=value.hex())

    def _send(self):
        try:
            self._client, _ = self._listener.accept()
            stream, number = self._client.makefile("rb"), 0
            while head := stream.read(4):
                message = stream.read(struct.unpack(">I", head)[0])
                for begin in range(0, len(message), self.value_bytes - 1):
                    part = message[begin:begin + self.value_bytes - 1]
                    is_last = begin + len(part) == len(message)
                    if "error" in self.write(bytes([number | (LAST if is_last else 0)]) + part):
                        return
                    number = (number + 1) % NUM_NUMBERS
        except OSError:
            pass

    def _receive(self):
        message, number, num_new = b"", 0, 0
        while (value := self._values.get()) != END and not self.is_over:
            # The radio takes its time.
            time.sleep(len(value) / self.rate)
            self.num_bytes += len(value)
            assert value[0] & ~LAST == number, "a fragment is lost"
            number = (number + 1) % NUM_NUMBERS
            message += value[1:]
            num_new += len(value)
            is_last = bool(value[0] & LAST)
            if is_last:
                wait_until(lambda: self._client, "the client connects")
                try:
                    self._client.sendall(struct.pack(">I", len(message)) + message)
                except OSError:
                    return
                message = b""
            if is_last or num_new >= ACKNOWLEDGED_BYTES:
                num_new = 0
                self.write(bytes([number]))
        if self._client and not self.is_over:
            with contextlib.suppress(OSError):
                self._client.shutdown(socket.SHUT_RDWR)
