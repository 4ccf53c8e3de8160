"""A client for tests: one connection to nao-phone-gateway over raw TCP.

It sends what a test tells it, and pings only inside its waiting methods: it falls silent when a test stops calling them, and never
connects again by itself. Programs use the package nao_remote (phone-gateway/clients/python) instead.
"""

import socket
import struct
import time

from nao_remote import remote_pb2 as pb

PROTOCOL_VERSION = 1
PING_PERIOD = 1.0  # s, see PROTOCOL.md


class ConnectionLost(Exception):
    """The gateway cannot be reached, or has closed the connection."""


class Refused(Exception):
    """The gateway answered with an error; .code is its ErrorCode, .response the whole answer."""

    def __init__(self, response):
        super().__init__(f"{pb.ErrorCode.Name(response.error)}: {response.message}")
        self.code = response.error
        self.response = response


class Phone:
    """Connects at once. Use it in a with statement, and call a waiting method at least every 4 s."""

    def __init__(self, host="127.0.0.1", port=7668, token="", name="python", timeout=5.0, robot=""):
        self.timeout = timeout
        self.state = None  # newest State
        self.image = None  # newest Image
        self.notices = []  # every Notice, oldest first
        self._last_request_id = 0
        self._last_sent = 0.0
        self._responses = {}
        self._own_pings = set()  # sent to keep the connection open; their answers are dropped
        self._bytes = b""
        try:
            self._socket = socket.create_connection((host, port), timeout)
        except OSError as error:
            raise ConnectionLost(f"no gateway at {host} port {port}: {error}") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        hello = pb.Connect(protocol_version=PROTOCOL_VERSION, token=token, client_name=name,
                           client_software="nao-remote test", robot=robot)
        try:
            self.connected = self.ask(connect=hello).connected
        except (ConnectionLost, Refused):
            self._socket.close()
            raise
        self.robot = self.connected.robot

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._socket.close()

    def ask(self, **use_case):
        """Sends a request, such as ask(go_to_posture=pb.GoToPosture(posture="Sit")), waits for its
        answer and returns it. @raise Refused if the answer is an error."""
        request_id = self._send(**use_case)
        if not self.wait_until(lambda: request_id in self._responses, self.timeout):
            raise ConnectionLost("the gateway does not answer")
        response = self._responses.pop(request_id)
        if response.error != pb.OK:
            raise Refused(response)
        return response

    def wait_until(self, is_done, timeout):
        """Handles messages until is_done() or the timeout, s. @return is_done()."""
        deadline = time.monotonic() + timeout
        while not is_done():
            left = deadline - time.monotonic()
            if left <= 0:
                return False
            if time.monotonic() - self._last_sent > PING_PERIOD:
                self._own_pings.add(self._send(ping=pb.Ping()))
            self._handle(self._receive(min(left, PING_PERIOD)))
        return True

    def wait_for_result(self, request_id, timeout):
        """Waits for the final result of a command. @return its Notice, None after the timeout, s."""
        def find():
            return next((notice for notice in self.notices
                         if notice.kind == pb.Notice.COMMAND_RESULT and notice.request_id == request_id
                         and notice.status != pb.Notice.ACCEPTED), None)
        self.wait_until(find, timeout)
        return find()

    def joint_positions(self):
        """@return the angles of the newest state by joint name, rad."""
        return {joint.name: angle for joint, angle in zip(self.robot.joints, self.state.joint_position)}

    def _send(self, **use_case):
        self._last_request_id += 1
        message = pb.Request(request_id=self._last_request_id, **use_case).SerializeToString()
        self._last_sent = time.monotonic()
        try:
            self._socket.sendall(struct.pack(">I", len(message)) + message)
        except OSError as error:
            raise ConnectionLost(str(error)) from error
        return self._last_request_id

    def _receive(self, timeout):
        """@return the next message's bytes, None after the timeout, s."""
        deadline = time.monotonic() + timeout
        while True:
            if len(self._bytes) >= 4:
                length, = struct.unpack_from(">I", self._bytes)
                if len(self._bytes) >= 4 + length:
                    message, self._bytes = self._bytes[4:4 + length], self._bytes[4 + length:]
                    return message
            left = deadline - time.monotonic()
            if left <= 0:
                return None
            self._socket.settimeout(left)
            try:
                received = self._socket.recv(65536)
            except TimeoutError:
                return None
            except OSError as error:
                raise ConnectionLost(str(error)) from error
            if not received:
                raise ConnectionLost("the gateway closed the connection")
            self._bytes += received

    def _handle(self, received):
        if received is None:
            return
        message = pb.ServerMessage.FromString(received)
        kind = message.WhichOneof("message")
        if kind == "response":
            if message.response.request_id not in self._own_pings:
                self._responses[message.response.request_id] = message.response
            self._own_pings.discard(message.response.request_id)
        elif kind == "state":
            self.state = message.state
        elif kind == "image":
            self.image = message.image
        elif kind == "notice":
            self.notices.append(message.notice)
