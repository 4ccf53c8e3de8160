"""The blocking face: the same methods as nao_remote.aio, for scripts without asyncio.

An event loop runs in a background thread; each method is executed there and waited for. Methods may be called from
several threads.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import os
import threading
from contextlib import contextmanager
from typing import Any, Callable, Coroutine, Generic, Iterator, Mapping, TypeVar

from nao_remote import aio
from nao_remote import remote_pb2 as pb
from nao_remote.aio import CHECK_TIMEOUT, MOTION_TIMEOUT, PLAY_TIMEOUT
from nao_remote.by_name import ByName
from nao_remote.command import Command as AsyncCommand
from nao_remote.errors import Closed
from nao_remote.joints import Joint as AsyncJoint
from nao_remote.lights import LIGHT_TIMEOUT, Color
from nao_remote.lights import Light as AsyncLight
from nao_remote.messages import (Client, CommandResult, Control, Event, Image, JointDescription, Pong, RobotDescription,
                                 RobotEntry, State)
from nao_remote.operator import Operator as AsyncOperator
from nao_remote.streams import Stream as AsyncStream

T = TypeVar("T")

# Longest time that close() waits for what is still being done, s. Chosen: a cancelled task needs milliseconds.
CLOSE_TIMEOUT = 2.0


def connect(address: str | None = None, *, token: str | None = None, token_file: str | os.PathLike[str] | None = None,
            name: str = "Python", certificate: str | os.PathLike[str] | None = None, timeout: float = 5.0,
            reconnect: bool = True, auto_control: bool = True, robot: str = "") -> Robot:
    """Connects to a robot's gateway: `with nao_remote.connect("nao.local", token="k7") as robot: robot.walk(0.1, duration=2)`.

    @param address  A host (`nao.local`, `192.168.1.20:8080`) or a URL: the one that the gateway prints
                    (`http://HOST:8080/#token=TOKEN`), `wss://HOST:8080` with TLS, `tcp://HOST:7668`. None: the environment
                    variable NAO_REMOTE_URL, else this host.
    @param token  The gateway's token; otherwise the first line of `token_file`, else that of the URL, else the environment
                  variable NAO_REMOTE_TOKEN. None is needed on the gateway's own host.
    @param name  Name that other clients see.
    @param certificate  For TLS: PEM file of the gateway's certificate, the only one that is trusted then. None: the
                        system's authorities.
    @param timeout  Time for the connection and for the answer to each request, s.
    @param reconnect  Connect again after the connection was lost. Until then requests raise ConnectionLost.
    @param auto_control  Take control with the first motion, if no client drives.
    @param robot  Which robot of a gateway of several; empty: the first one that nobody drives, else the first.
    @raise InvalidArgument  if the gateway has no robot of that name.
    @raise ConnectionLost  if there is no gateway. @raise WrongToken, WrongVersion, TooManyClients
    @raise ValueError  if the address cannot be read. @raise OSError  if a file cannot be read.
    """
    loop = LoopThread()
    try:
        connected = loop.call(aio.connect(address, token=token, token_file=token_file, name=name, certificate=certificate,
                                      timeout=timeout, reconnect=reconnect, auto_control=auto_control, robot=robot))
    except BaseException:
        loop.close()
        raise
    return Robot(connected, loop)


class LoopThread:
    """An event loop in a thread of its own, which does not keep the program from ending."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._is_closed = False
        # A forked process has no copy of the thread.
        self._process = os.getpid()
        # Of _is_closed: nothing is given to a loop that will not execute it. Reentrant, for __del__ may interrupt its holder.
        self._lock = threading.RLock()
        self._thread = threading.Thread(target=self._loop.run_forever, name="nao_remote", daemon=True)
        self._thread.start()

    def call(self, coroutine: Coroutine[Any, Any, T]) -> T:
        """Executes a coroutine in the loop. @return its result. An interruption (Ctrl+C) cancels it."""
        if self._is_forked:
            coroutine.close()
            raise Closed("this robot was connected before a fork, by another process; call connect() in this one")
        with self._lock:
            if self._is_closed or threading.current_thread() is self._thread:
                coroutine.close()
                if self._is_closed:
                    raise Closed("the client was closed")
                raise RuntimeError("the blocking face cannot be used inside its own event loop; use nao_remote.aio")
            future = asyncio.run_coroutine_threadsafe(coroutine, self._loop)
        try:
            return future.result()
        except concurrent.futures.CancelledError as error:
            raise Closed("the client was closed") from error
        except BaseException:
            future.cancel()
            raise

    def run(self, function: Callable[..., T], *arguments: Any, **keywords: Any) -> T:
        """Executes a function in the loop. @return its result."""

        async def execute() -> T:
            return function(*arguments, **keywords)

        return self.call(execute())

    def post(self, function: Callable[[], None]) -> None:
        """Executes a function in the loop, without waiting; nothing if it is closed."""
        if self._is_forked:
            return
        with self._lock:
            if not self._is_closed:
                self._loop.call_soon_threadsafe(function)

    @property
    def _is_forked(self) -> bool:
        return os.getpid() != self._process

    def close(self) -> None:
        """Ends the loop; calls of other threads that still wait raise Closed."""
        with self._lock:
            if self._is_closed:
                return
            self._is_closed = True
            # After everything that calls have given to the loop.
            ending = asyncio.run_coroutine_threadsafe(_cancel_other_tasks(), self._loop)
        ending.result()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()


async def _cancel_other_tasks() -> None:
    tasks = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
    for task in tasks:
        task.cancel()
    if tasks:
        await asyncio.wait(tasks, timeout=CLOSE_TIMEOUT)


class Stream(Generic[T]):
    """Values as they arrive: `for state in robot.states(): ...`. See nao_remote.streams.Stream."""

    def __init__(self, stream: AsyncStream[T], loop: LoopThread) -> None:
        self._stream = stream
        self._loop = loop

    def __iter__(self) -> Stream[T]:
        return self

    def __next__(self) -> T:
        try:
            return self._loop.call(self._stream.read())
        except StopAsyncIteration as end:
            raise StopIteration from end

    def next(self, timeout: float | None) -> T:
        """As iterating, with another timeout, s. @raise Timeout. @raise StopIteration  after close()."""
        return self._loop.call(self._stream.next(timeout))

    def __enter__(self) -> Stream[T]:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def num_skipped(self) -> int:
        """Values that were replaced before they were read."""
        return self._stream.num_skipped

    def close(self) -> None:
        """Ends the stream. One that is no longer referenced is closed by itself."""
        self._loop.post(self._stream.close)

    __del__ = close


class Command:
    """A motion command that was passed on to the robot."""

    def __init__(self, command: AsyncCommand, loop: LoopThread) -> None:
        self._command = command
        self._loop = loop

    @property
    def request_id(self) -> int:
        """Number of its request, which its CommandResult events have, too."""
        return self._command.request_id

    @property
    def is_done(self) -> bool:
        """True when the command has ended, well or not."""
        return self._command.is_done

    def wait(self, timeout: float = MOTION_TIMEOUT) -> CommandResult:
        """Waits until the robot has done it; see nao_remote.command.Command.wait()."""
        return self._loop.call(self._command.wait(timeout))


class Joint:
    """One joint; see nao_remote.joints.Joint."""

    def __init__(self, joint: AsyncJoint, loop: LoopThread) -> None:
        self._joint = joint
        self._loop = loop

    @property
    def name(self) -> str:
        return self._joint.name

    @property
    def description(self) -> JointDescription:
        return self._joint.description

    def position(self) -> float:
        """@return the measured angle, rad (hands: opening 0 to 1)."""
        return self._loop.call(self._joint.position())

    def move_by(self, change: float, speed: float = 0.0, *, allow_tipping: bool = False, wait: bool = True,
                timeout: float = MOTION_TIMEOUT) -> Command:
        """Turns it by an angle, rad, from its present target."""
        return Command(self._loop.call(self._joint.move_by(
            change, speed, allow_tipping=allow_tipping, wait=wait, timeout=timeout)), self._loop)

    def move_to(self, angle: float, speed: float = 0.0, *, allow_tipping: bool = False, wait: bool = True,
                timeout: float = MOTION_TIMEOUT) -> Command:
        """Turns it to an angle, rad, clipped to its limits."""
        return Command(self._loop.call(self._joint.move_to(
            angle, speed, allow_tipping=allow_tipping, wait=wait, timeout=timeout)), self._loop)


class Light:
    """One light; see nao_remote.lights.Light."""

    def __init__(self, light: AsyncLight, loop: LoopThread) -> None:
        self._light = light
        self._loop = loop

    @property
    def name(self) -> str:
        return self._light.name

    def color(self) -> tuple[float, float, float]:
        """@return red, green and blue that it shows, each 0 to 1."""
        return self._loop.call(self._light.color())

    def set(self, color: Color, duration: float = 0.0, *, timeout: float = LIGHT_TIMEOUT) -> Command:
        """Sets its color: "#ff8000", or red, green and blue, each 0 to 1."""
        return Command(self._loop.call(self._light.set(color, duration, timeout=timeout)), self._loop)


class Operator:
    """The operator's console; see nao_remote.operator.Operator."""

    def __init__(self, operator: AsyncOperator, loop: LoopThread) -> None:
        self._operator = operator
        self._loop = loop

    def clients(self) -> list[Client]:
        """@return the gateway's clients."""
        return self._loop.call(self._operator.clients())

    def take_control(self, robot: str = "") -> None:
        """Takes control from every client until release_control()."""
        self._loop.call(self._operator.take_control(robot))

    def release_control(self, robot: str = "") -> None:
        """Lets clients drive again."""
        self._loop.call(self._operator.release_control(robot))

    def mute(self, client_id: int) -> None:
        """Lets a client watch only."""
        self._loop.call(self._operator.mute(client_id))

    def unmute(self, client_id: int) -> None:
        """Lets a client drive again."""
        self._loop.call(self._operator.unmute(client_id))

    def assign(self, client_id: int, robot: str = "") -> None:
        """Lets a client drive a robot."""
        self._loop.call(self._operator.assign(client_id, robot))

    def kick(self, client_id: int) -> None:
        """Closes a client's connection."""
        self._loop.call(self._operator.kick(client_id))


class Robot:
    """A connected robot. Each method is that of nao_remote.aio.Robot, where its parameters are explained.

    It has more than 25 methods: it is the whole interface of scripts.
    """

    def __init__(self, robot: aio.Robot, loop: LoopThread) -> None:
        self._robot = robot
        self._loop = loop
        # The joints and lights by name; the operator's console.
        self.joints = ByName("joint", lambda: robot.joints, lambda name: Joint(robot.joints[name], loop))
        self.lights = ByName("light", lambda: robot.lights, lambda name: Light(robot.lights[name], loop))
        self.operator = Operator(robot.operator, loop)

    def __enter__(self) -> Robot:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        # Nobody could end its walk any more. The connection stays, for streams.
        self._loop.post(self._robot._end_walk_soon)

    def close(self) -> None:
        """Ends the connection. A walk of this client ends, too."""
        try:
            self._loop.call(self._robot.close())
        except Closed:
            return
        self._loop.close()

    @property
    def is_connected(self) -> bool:
        """False from the loss of a connection until the client has connected again."""
        return self._robot.is_connected

    @property
    def client_id(self) -> int:
        """Number of this client at the gateway; a new one for each connection."""
        return self._robot.client_id

    @property
    def description(self) -> RobotDescription:
        """The robot's joints, postures, actions, cameras and limits."""
        return self._robot.description

    @property
    def control(self) -> Control:
        """Who drives, as far as this client knows."""
        return self._robot.control

    @property
    def robots(self) -> tuple[RobotEntry, ...]:
        """The robots of a gateway of several; empty where there is only one."""
        return self._robot.robots

    def watch(self, robot: str) -> RobotDescription:
        """Watches another robot of the gateway."""
        return self._loop.call(self._robot.watch(robot))

    def wait_until_connected(self, timeout: float = 30.0) -> None:
        """Waits until the client has connected again."""
        self._loop.call(self._robot.wait_until_connected(timeout))

    def request(self, **use_case: Any) -> pb.Response:
        """Sends any request of the protocol."""
        return self._loop.call(self._robot.request(**use_case))

    def ping(self) -> Pong:
        """Measures the time to the gateway and back; relates the clocks."""
        return self._loop.call(self._robot.ping())

    def take_control(self, robot: str = "") -> Control:
        """Asks for control, of another one of several robots if it is named."""
        return self._loop.call(self._robot.take_control(robot))

    def release_control(self) -> Control:
        """Lets other clients drive."""
        return self._loop.call(self._robot.release_control())

    @contextmanager
    def driving(self) -> Iterator[Control]:
        """Control for a block: `with robot.driving():`"""
        control = self.take_control()
        try:
            yield control
        finally:
            if self.is_connected:
                self.release_control()

    def walk(self, vx: float = 0.0, vy: float = 0.0, wz: float = 0.0, duration: float | None = None) -> Command:
        """Walks at a velocity: m/s forward, m/s and rad/s to the left; for `duration` s, or until the next motion."""
        return self._command(self._robot.walk(vx, vy, wz, duration))

    def move_to(self, x: float = 0.0, y: float = 0.0, theta: float = 0.0, *, wait: bool = True,
                timeout: float = MOTION_TIMEOUT) -> Command:
        """Walks to a pose relative to the present one: m forward, m to the left, rad to the left."""
        return self._command(self._robot.move_to(x, y, theta, wait=wait, timeout=timeout))

    def posture(self, posture: str, speed: float = 0.0, *, wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Goes to a posture of `description.postures`."""
        return self._command(self._robot.posture(posture, speed, wait=wait, timeout=timeout))

    def change_joints(self, group: str, *, yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0, speed: float = 0.0,
                      allow_tipping: bool = False, both_sides: bool = False, wait: bool = True,
                      timeout: float = MOTION_TIMEOUT) -> Command:
        """Turns the joints of a group of `description.joint_groups` relative to their present targets, rad."""
        return self._command(self._robot.change_joints(
            group, yaw=yaw, pitch=pitch, roll=roll, speed=speed, allow_tipping=allow_tipping, both_sides=both_sides,
            wait=wait, timeout=timeout))

    def action(self, action: str, *, ball: tuple[float, float] | None = None, strength: float | None = None,
               wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Performs an action of `description.actions`."""
        return self._command(self._robot.action(action, ball=ball, strength=strength, wait=wait, timeout=timeout))

    def play(self, behavior: str, *, target: tuple[float, float] | None = None, wait: bool = True,
             timeout: float = PLAY_TIMEOUT) -> Command:
        """See aio.Robot.play()."""
        return self._command(self._robot.play(behavior, target=target, wait=wait, timeout=timeout))

    def say(self, text: str, *, language: str = "", volume: float = 1.0, rate: float = 1.0, after: bool = False,
            wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Speaks a text of at most 1000 bytes; the robot may move meanwhile."""
        return self._command(self._robot.say(text, language=language, volume=volume, rate=rate, after=after, wait=wait,
                                             timeout=timeout))

    def stop_speaking(self, *, timeout: float = MOTION_TIMEOUT) -> Command:
        """Ends what is being said, and what waits."""
        return self._command(self._robot.stop_speaking(timeout=timeout))

    def set_lights(self, colors: Mapping[str, Color], duration: float = 0.0, *,
                   timeout: float = LIGHT_TIMEOUT) -> Command:
        """Sets several lights of `description.lights` at once."""
        return self._command(self._robot.set_lights(colors, duration, timeout=timeout))

    def motions(self) -> list[str]:
        """@return the names of the motions that are saved on the robot's host; each is an action, too."""
        return self._loop.call(self._robot.motions())

    def motion(self, name: str) -> str:
        """@return the text of a saved motion, YAML."""
        return self._loop.call(self._robot.motion(name))

    def check_motion(self, motion: str | pb.Motion, timeout: float = CHECK_TIMEOUT) -> None:
        """Checks a motion in a simulation, which takes seconds, without saving it."""
        self._loop.call(self._robot.check_motion(motion, timeout))

    def save_motion(self, motion: str | pb.Motion, *, replace: bool = False, timeout: float = CHECK_TIMEOUT) -> None:
        """Checks a motion and saves it: action() plays it by its name."""
        self._loop.call(self._robot.save_motion(motion, replace=replace, timeout=timeout))

    def delete_motion(self, name: str) -> None:
        """Deletes a saved motion."""
        self._loop.call(self._robot.delete_motion(name))

    def stop(self) -> None:
        """Ends any motion, also another client's; needs no control."""
        self._loop.call(self._robot.stop())

    def state(self) -> State:
        """@return the newest state."""
        return self._loop.call(self._robot.state())

    def wait_until(self, condition: Callable[[State], bool], timeout: float = MOTION_TIMEOUT, rate: float = 20.0) -> State:
        """@return the first state for which the condition holds."""
        return self._loop.call(self._robot.wait_until(condition, timeout, rate))

    def image(self, camera: str = "", width: int = 0, quality: int = 0, timeout: float = 5.0) -> Image:
        """@return an image of a head camera that this client has not received yet."""
        return self._loop.call(self._robot.image(camera, width, quality, timeout))

    def states(self, rate: float = 20.0, timeout: float | None = 5.0) -> Stream[State]:
        """A stream of the newest states: `for state in robot.states(): ...`"""
        return Stream(self._loop.run(self._robot.states, rate, timeout), self._loop)

    def images(self, rate: float = 15.0, camera: str = "", width: int = 0, quality: int = 0,
               timeout: float | None = 5.0) -> Stream[Image]:
        """A stream of the newest images."""
        return Stream(self._loop.run(self._robot.images, rate, camera, width, quality, timeout), self._loop)

    def events(self, timeout: float | None = None) -> Stream[Event]:
        """A stream of what happens from now on."""
        return Stream(self._loop.run(self._robot.events, timeout), self._loop)

    def _command(self, request: Coroutine[Any, Any, AsyncCommand]) -> Command:
        return Command(self._loop.call(request), self._loop)
