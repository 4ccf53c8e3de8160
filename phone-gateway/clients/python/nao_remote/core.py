"""What the asyncio face is made of: connection, control, commands on their way, events."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager, contextmanager
from typing import Any, AsyncIterator, Iterator

from nao_remote import remote_pb2 as pb
from nao_remote.command import Command
from nao_remote.connection import Connection
from nao_remote.errors import ConnectionLost, Timeout
from nao_remote.messages import (CommandResult, CommandStatus, Connected, Control, ControlChanged, Disconnected, Event, Image,
                                 Pong, RobotDescription, RobotEntry, RobotsChanged, State, event_from_protocol)
from nao_remote.streams import Stream
from nao_remote.subscription import Subscription
from nao_remote.walking import Walk, despite_failure

# Events that are kept for a reader that is late. Chosen: a minute of busy driving.
EVENT_CAPACITY = 256
# Use cases during which a walk goes on.
BESIDE_A_WALK = {"change_joints", "say", "set_lights"}
# Those that walk by themselves: they end when the one who waits for them gives up.
WALKS = {"move_to", "play"}


class RobotCore:
    """Base of aio.Robot."""

    def __init__(self, connection: Connection, auto_control: bool) -> None:
        self._connection = connection
        self._auto_control = auto_control
        self._description: RobotDescription | None = None
        self._control = Control()
        # Another client or the operator has taken control from this one: it is not taken back by itself.
        self._is_displaced = False
        self._client_id = 0
        self._robots: tuple[RobotEntry, ...] = ()
        self._commands: dict[int, Command] = {}
        self._walk: Walk | None = None
        self._events: set[Stream[Event]] = set()
        self._subscription = Subscription(connection)
        connection.on_connected = self._handle_connected
        connection.on_lost = self._handle_lost
        connection.on_message = self._handle_message

    # ---- Connection ----

    async def _open(self) -> None:
        await self._connection.open()

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the connection. A walk of this client ends, too."""
        if self._walk is not None:
            self._walk.abandon()
        await self._connection.close()

    @property
    def is_connected(self) -> bool:
        """False from the loss of a connection until the client has connected again."""
        return self._connection.is_connected

    @property
    def client_id(self) -> int:
        """Number of this client at the gateway; a new one for each connection."""
        return self._client_id

    @property
    def description(self) -> RobotDescription:
        """The robot's joints, postures, actions, cameras and limits."""
        assert self._description is not None
        return self._description

    @property
    def robots(self) -> tuple[RobotEntry, ...]:
        """The robots of a gateway of several; empty where there is only one."""
        return self._robots

    async def watch(self, robot: str) -> RobotDescription:
        """Watches another robot of the gateway: control of the one before is released, and its walk ends.

        @return its description. @raise InvalidArgument  if there is none of that name.
        """
        with self.events(self._connection.timeout) as events:
            await self._connection.request(watch_robot=pb.WatchRobot(robot=robot))
            while self.description.name != robot:
                await events.next(self._connection.timeout)
        return self.description

    async def wait_until_connected(self, timeout: float = 30.0) -> None:
        """Waits until the client has connected again. @raise Timeout. @raise Closed  if it has given up."""
        with self.events(timeout=None) as events:
            deadline = asyncio.get_running_loop().time() + timeout
            while not self.is_connected:
                await events.next(max(0.0, deadline - asyncio.get_running_loop().time()))

    async def request(self, /, **use_case: Any) -> pb.Response:
        """Sends any request of the protocol, for those that have no method: `request(ping=pb.Ping())`.

        @return the response. @raise Refused  if it is an error.
        """
        return await self._connection.request(**use_case)

    async def ping(self) -> Pong:
        """Measures the time to the gateway and back; relates the clocks."""
        now = asyncio.get_running_loop().time
        start = now()
        pong = (await self._connection.request(ping=pb.Ping(client_utime=int(start * 1e6)))).pong
        return Pong(now() - start, pong.robot_utime, pong.num_clients)

    # ---- Control ----

    @property
    def control(self) -> Control:
        """Who drives, as far as this client knows."""
        return self._control

    async def take_control(self, robot: str = "") -> Control:
        """Asks for control. @param robot  Another one of several robots, which is watched from then on.

        @raise ControlTaken  if another client drives.
        """
        with self.events(self._connection.timeout) as events:
            response = await self._connection.request(take_control=pb.TakeControl(robot=robot))
            while robot and self.description.name != robot:
                await events.next(self._connection.timeout)
        self._control = Control.from_protocol(response.control)
        self._is_displaced = False
        return self._control

    async def release_control(self) -> Control:
        """Lets other clients drive."""
        response = await self._connection.request(release_control=pb.ReleaseControl())
        self._control = Control.from_protocol(response.control)
        return self._control

    @asynccontextmanager
    async def driving(self) -> AsyncIterator[Control]:
        """Control for a block: `async with robot.driving():`"""
        control = await self.take_control()
        try:
            yield control
        finally:
            if self.is_connected:
                await self.release_control()

    # ---- Events ----

    def events(self, timeout: float | None = None) -> Stream[Event]:
        """A stream of what happens from now on; the last 256 are kept. @param timeout  s, for reading; None: no end."""
        stream = Stream[Event]("event", EVENT_CAPACITY, timeout, self._events.discard,
                               lambda: self._connection.is_interrupted)
        self._events.add(stream)
        if self._connection.end is not None:
            stream.fail(self._connection.end)
        return stream

    # ---- Inside ----

    async def _ensure_control(self) -> None:
        if self._auto_control and not self._control.is_mine and not self._is_displaced:
            await self.take_control()

    @contextmanager
    def _new_command(self) -> Iterator[Command]:
        """A command whose results are awaited, unless the block that requests it fails."""
        command = Command(self._connection.session.next_request_id())
        self._commands[command.request_id] = command
        try:
            yield command
        except BaseException:
            self._commands.pop(command.request_id, None)
            raise

    async def _command(self, wait: bool, timeout: float, **use_case: Any) -> Command:
        await self._ensure_control()
        if self._walk is not None and not use_case.keys() & BESIDE_A_WALK:
            walk, self._walk = self._walk, None
            walk.abandon()
        try:
            with self._new_command() as command:
                await self._connection.request(command.request_id, **use_case)
            if wait:
                await command.wait(timeout)
        except (asyncio.CancelledError, Timeout):
            # Also before the answer: the robot may have begun.
            if use_case.keys() & WALKS:
                await despite_failure(self._connection.request(stop=pb.Stop()))
            raise
        return command

    def _handle_connected(self, connected: pb.Connected) -> None:
        is_first = self._description is None
        self._description = RobotDescription.from_protocol(connected.robot)
        self._client_id = connected.client_id
        self._control = Control.from_protocol(connected.control)
        self._is_displaced = False
        self._robots = RobotEntry.from_protocol(connected.robots)
        if self._robots:
            # After a lost connection the same one.
            self._connection.robot = connected.robot.name
        self._subscription.handle_connected()
        if not is_first:
            self._publish(Connected(f"connected to {self._connection.address} again"))

    def _handle_lost(self, error: ConnectionLost, is_final: bool) -> None:
        self._control = Control()
        if self._walk is not None:
            self._walk.abandon()
            self._walk = None
        commands, self._commands = self._commands, {}
        for command in commands.values():
            command.fail(error)
        self._publish(Disconnected(error.message, error.reason_code, error.reason_arguments, is_final))
        if is_final:
            self._subscription.fail(error)
            for stream in self._events:
                stream.fail(error)

    def _handle_message(self, message: pb.ServerMessage) -> None:
        kind = message.WhichOneof("message")
        if kind == "state" and self._description is not None:
            self._subscription.put_state(State.from_protocol(message.state, self._description))
        elif kind == "image":
            self._subscription.put_image(Image.from_protocol(message.image))
        elif kind == "notice":
            if message.notice.kind == pb.Notice.ROBOT_CHANGED:
                self._handle_robot_changed(message.notice)
            event = event_from_protocol(message.notice)
            if event is not None:
                self._handle_event(event)

    def _handle_robot_changed(self, notice: pb.Notice) -> None:
        self._description = RobotDescription.from_protocol(notice.robot)
        self._connection.robot = notice.robot.name
        self._control = Control.from_protocol(notice.control)
        self._is_displaced = False
        if self._walk is not None:
            self._walk.abandon()
            self._walk = None
        # The gateway reports nothing more of the robot before.
        commands, self._commands = self._commands, {}
        for command in commands.values():
            command.handle(CommandResult(notice.message, notice.reason_code, tuple(notice.reason_arguments),
                                         command.request_id, CommandStatus.INTERRUPTED))

    def _handle_event(self, event: Event) -> None:
        if isinstance(event, RobotsChanged):
            self._robots = event.robots
        if isinstance(event, ControlChanged):
            if self._control.is_mine and not event.control.is_mine and event.control.driver_id != 0:
                self._is_displaced = True
            self._control = event.control
        if isinstance(event, CommandResult):
            command = self._commands.get(event.request_id)
            if command is not None:
                command.handle(event)
                if command.is_done:
                    del self._commands[event.request_id]
        self._publish(event)

    def _publish(self, event: Event) -> None:
        for stream in self._events:
            stream.put(event)
