"""A gateway for unit tests: it answers every request with OK, reports every motion as done, and notes what it received.

It is its own implementation of PROTOCOL.md, in a thread of its own, so that client and gateway can be wrong only in different
ways.
"""

import asyncio
import struct
import threading

import websockets

from nao_remote import remote_pb2 as pb
from programs import DEADLINE

MOTIONS = ("move_to", "go_to_posture", "change_joints", "do_action", "play", "say", "set_lights")


def description():
    robot = pb.RobotDescription(name="NAO", model="nao", postures=["Sit", "Stand"], actions=["wave", "kick-left"],
                                cameras=["top", "bottom"], max_vx=0.3, min_vx=-0.2, max_vy=0.1, max_wz=1.0)
    robot.joints.add(name="HeadYaw", lower=-2, upper=2, max_velocity=8)
    robot.joints.add(name="HeadPitch", lower=-0.6, upper=0.5, max_velocity=7)
    robot.joints.add(name="Tail", lower=-1, upper=1, max_velocity=1)
    robot.joint_groups.add(name="head", yaw_joint="HeadYaw", pitch_joint="HeadPitch")
    robot.action_roles.add(name="kick-left", kind="kick", side="left")
    robot.labels.add(kind="posture", name="Sit", language="de", text="Sitzen")
    robot.languages.extend(["en", "de"])
    for name in ("left-eye", "chest"):
        robot.lights.add(name=name)
    return robot


class FakeGateway:
    """Use it in a with statement. `answers` replaces the answer to a use case: a function that takes the request and returns
    the messages to send (none: silence)."""

    def __init__(self, token="k7"):
        self.token = token
        self.requests = []
        self.answers = {}
        self.port = self.tcp_port = 0
        self.num_connections = 0
        self._walk_id = 0
        self._sends = {}
        self._servers = []
        self._tasks = set()

    def __enter__(self):
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever)
        self._thread.start()
        self.start()
        return self

    def __exit__(self, *_):
        self.stop()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}/#token={self.token}"

    @property
    def tcp_address(self):
        return f"tcp://127.0.0.1:{self.tcp_port}/#token={self.token}"

    def start(self):
        self._call(self._start())

    def stop(self):
        """Closes all connections and listens no more."""
        self._call(self._stop())

    def drop(self):
        """Closes all connections."""
        self._call(self._drop())

    def send(self, **message):
        """Sends a message to all clients: send(state=pb.State())."""
        self._call(self._send_to_all(pb.ServerMessage(**message)))

    def received(self, use_case):
        """@return the requests of a kind, oldest first."""
        return [getattr(request, use_case) for request in list(self.requests) if request.WhichOneof("use_case") == use_case]

    def _call(self, coroutine):
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop).result(DEADLINE)

    async def _start(self):
        server = await websockets.serve(self._serve_websocket, "127.0.0.1", self.port, ping_interval=None)
        self.port = server.sockets[0].getsockname()[1]
        tcp_server = await asyncio.start_server(self._serve_tcp, "127.0.0.1", self.tcp_port)
        self.tcp_port = tcp_server.sockets[0].getsockname()[1]
        self._servers = [server, tcp_server]

    async def _stop(self):
        for server in self._servers:
            server.close()
        await self._drop()
        for server in self._servers:
            await server.wait_closed()

    async def _drop(self):
        tasks = list(self._tasks)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _serve_websocket(self, connection):
        await self._serve(connection.send, connection.__aiter__().__anext__)

    async def _serve_tcp(self, reader, writer):
        async def send(message):
            writer.write(struct.pack(">I", len(message)) + message)
            await writer.drain()

        async def receive():
            length, = struct.unpack(">I", await reader.readexactly(4))
            return await reader.readexactly(length)
        try:
            await self._serve(send, receive)
        finally:
            writer.close()

    async def _serve(self, send, receive):
        self.num_connections += 1
        task = asyncio.current_task()
        self._tasks.add(task)
        self._sends[task] = send
        try:
            while True:
                request = pb.Request.FromString(await receive())
                self.requests.append(request)
                for message in self._answer(request):
                    await send(message if isinstance(message, bytes) else message.SerializeToString())
        except (asyncio.CancelledError, asyncio.IncompleteReadError, StopAsyncIteration, OSError,
                websockets.ConnectionClosed):
            pass
        finally:
            self._tasks.discard(task)
            del self._sends[task]

    async def _send_to_all(self, message):
        for send in list(self._sends.values()):
            await send(message.SerializeToString())

    def _answer(self, request):
        use_case = request.WhichOneof("use_case")
        if use_case in self.answers:
            return self.answers[use_case](request)
        response = pb.Response(request_id=request.request_id)
        if use_case == "connect":
            if request.connect.token != self.token:
                return [refuse(request, pb.WRONG_TOKEN, "The token is wrong.", "token-wrong")]
            response.connected.CopyFrom(pb.Connected(protocol_version=1, server_version="fake", client_id=3,
                                                     client_name=request.connect.client_name, robot=description()))
        elif use_case == "get_state":
            response.state_and_image.state.CopyFrom(state())
            if request.get_state.with_image:
                response.state_and_image.image.CopyFrom(image(request.get_state.image))
        elif use_case == "ping":
            response.pong.CopyFrom(pb.Pong(client_utime=request.ping.client_utime, robot_utime=5, num_clients=1))
        elif use_case in ("take_control", "release_control"):
            is_mine = use_case == "take_control"
            response.control.CopyFrom(pb.Control(driver_id=3 if is_mine else 0, is_mine=is_mine))
        elif use_case == "operate":
            response.clients.clients.add(client_id=3, name="Python", is_driver=True)
        return [pb.ServerMessage(response=response), *self._results(request, use_case)]

    def _results(self, request, use_case):
        if use_case in MOTIONS:
            return [result(request.request_id, pb.Notice.ACCEPTED), result(request.request_id, pb.Notice.DONE)]
        if use_case == "walk_turn":
            turn = request.walk_turn
            if (turn.vx, turn.vy, turn.wz) != (0, 0, 0):
                if not self._walk_id:
                    self._walk_id = request.request_id
                    return [result(self._walk_id, pb.Notice.ACCEPTED)]
            elif self._walk_id:
                walk_id, self._walk_id = self._walk_id, 0
                return [result(walk_id, pb.Notice.DONE)]
        return []


def state(**fields):
    return pb.State(utime=1000, age_ms=1, joint_position=[0.5, -0.25, 0], torso_orientation=[1, 0, 0, 0],
                    torso_position=[0, 0, 0.3], mode=pb.MODE_HOLDING, posture="Stand",
                    light_rgb=[0xff0033, 0],
                    body=pb.Body(battery_charge=0.5, hottest_joint="HeadYaw", hottest_temperature=40,
                                 warnings=["battery-low"]), **fields)


def image(wanted):
    width = wanted.width or 320
    return pb.Image(utime=1000, camera=wanted.camera or "top", width=width, height=width * 3 // 4, jpeg=b"JPEG")


def result(request_id, status, message="", reason_code=""):
    return pb.ServerMessage(notice=pb.Notice(kind=pb.Notice.COMMAND_RESULT, request_id=request_id, status=status,
                                             message=message, reason_code=reason_code))


def refuse(request, error, message, reason_code, arguments=(), **fields):
    return pb.ServerMessage(response=pb.Response(request_id=request.request_id, error=error, message=message,
                                                 reason_code=reason_code, reason_arguments=arguments, **fields))
