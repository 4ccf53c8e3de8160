"""The blocking face: the same methods as nao_remote.aio, for scripts without asyncio.

An event loop runs in a background thread; each method is executed there and waited for. Methods may be called from
several threads.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import functools
import os
import threading
from contextlib import contextmanager
from typing import Any, Callable, Concatenate, Coroutine, Generic, Iterator, ParamSpec, TypeVar

from nao_remote import aio, command, joints, lights, operator, streams
from nao_remote.by_name import ByName
from nao_remote.errors import Closed
from nao_remote.messages import Control, JointDescription, RobotDescription, RobotEntry

T = TypeVar("T")
A = TypeVar("A")
P = ParamSpec("P")

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


class _Face(Generic[A]):
    """Face of an object that lives in the loop."""

    def __init__(self, inner: A, loop: LoopThread) -> None:
        self._inner = inner
        self._loop = loop


def _waiting(method: Callable[Concatenate[Any, P], Coroutine[Any, Any, T]]) -> Callable[Concatenate[_Face[Any], P], T]:
    """@return the method of a face that executes one in the loop and waits for it."""

    @functools.wraps(method)
    def wait(self: _Face[Any], /, *arguments: P.args, **keywords: P.kwargs) -> T:
        return self._loop.call(method(self._inner, *arguments, **keywords))

    return wait


def _commanding(method: Callable[Concatenate[Any, P], Coroutine[Any, Any, command.Command]]
                ) -> Callable[Concatenate[_Face[Any], P], Command]:
    """As _waiting(), for one that gives a command."""

    @functools.wraps(method)
    def wait(self: _Face[Any], /, *arguments: P.args, **keywords: P.kwargs) -> Command:
        return Command(self._loop.call(method(self._inner, *arguments, **keywords)), self._loop)

    return wait


def _streaming(method: Callable[Concatenate[Any, P], streams.Stream[T]]) -> Callable[Concatenate[_Face[Any], P], Stream[T]]:
    """As _waiting(), for one that opens a stream."""

    @functools.wraps(method)
    def wait(self: _Face[Any], /, *arguments: P.args, **keywords: P.kwargs) -> Stream[T]:
        return Stream(self._loop.run(method, self._inner, *arguments, **keywords), self._loop)

    return wait


class Stream(_Face[streams.Stream[T]], Generic[T]):
    """Values as they arrive: `for state in robot.states(): ...`. See nao_remote.streams.Stream."""

    def __iter__(self) -> Stream[T]:
        return self

    def __next__(self) -> T:
        try:
            return self._loop.call(self._inner.read())
        except StopAsyncIteration as end:
            raise StopIteration from end

    def next(self, timeout: float | None) -> T:
        """As iterating, with another timeout, s. @raise Timeout. @raise StopIteration  after close()."""
        return self._loop.call(self._inner.next(timeout))

    def __enter__(self) -> Stream[T]:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def num_skipped(self) -> int:
        """Values that were replaced before they were read."""
        return self._inner.num_skipped

    def close(self) -> None:
        """Ends the stream. One that is no longer referenced is closed by itself."""
        self._loop.post(self._inner.close)

    __del__ = close


class Command(_Face[command.Command]):
    """A motion command that was passed on to the robot."""

    @property
    def request_id(self) -> int:
        """Number of its request, which its CommandResult events have, too."""
        return self._inner.request_id

    @property
    def is_done(self) -> bool:
        """True when the command has ended, well or not."""
        return self._inner.is_done

    wait = _waiting(command.Command.wait)


class Joint(_Face[joints.Joint]):
    """One joint of a connected robot."""

    @property
    def name(self) -> str:
        return self._inner.name

    @property
    def description(self) -> JointDescription:
        return self._inner.description

    position = _waiting(joints.Joint.position)
    move_by = _commanding(joints.Joint.move_by)
    move_to = _commanding(joints.Joint.move_to)


class Light(_Face[lights.Light]):
    """One light of a connected robot."""

    @property
    def name(self) -> str:
        return self._inner.name

    color = _waiting(lights.Light.color)
    set = _commanding(lights.Light.set)


class Operator(_Face[operator.Operator]):
    """The operator's console; its methods raise NotAllowed on another host."""

    clients = _waiting(operator.Operator.clients)
    take_control = _waiting(operator.Operator.take_control)
    release_control = _waiting(operator.Operator.release_control)
    mute = _waiting(operator.Operator.mute)
    unmute = _waiting(operator.Operator.unmute)
    assign = _waiting(operator.Operator.assign)
    kick = _waiting(operator.Operator.kick)


class Robot(_Face[aio.Robot]):
    """A connected robot. Each method is that of nao_remote.aio.Robot.

    It has more than 25 methods: it is the whole interface of scripts.
    """

    def __init__(self, robot: aio.Robot, loop: LoopThread) -> None:
        super().__init__(robot, loop)
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
        self._loop.post(self._inner._end_walk_soon)

    def close(self) -> None:
        """Ends the connection. A walk of this client ends, too."""
        try:
            self._loop.call(self._inner.close())
        except Closed:
            return
        self._loop.close()

    @property
    def is_connected(self) -> bool:
        """False from the loss of a connection until the client has connected again."""
        return self._inner.is_connected

    @property
    def client_id(self) -> int:
        """Number of this client at the gateway; a new one for each connection."""
        return self._inner.client_id

    @property
    def description(self) -> RobotDescription:
        """The robot's joints, postures, actions, cameras and limits."""
        return self._inner.description

    @property
    def control(self) -> Control:
        """Who drives, as far as this client knows."""
        return self._inner.control

    @property
    def robots(self) -> tuple[RobotEntry, ...]:
        """The robots of a gateway of several; empty where there is only one."""
        return self._inner.robots

    watch = _waiting(aio.Robot.watch)
    wait_until_connected = _waiting(aio.Robot.wait_until_connected)
    request = _waiting(aio.Robot.request)
    ping = _waiting(aio.Robot.ping)
    take_control = _waiting(aio.Robot.take_control)
    release_control = _waiting(aio.Robot.release_control)

    @contextmanager
    def driving(self) -> Iterator[Control]:
        """Control for a block: `with robot.driving():`"""
        control = self.take_control()
        try:
            yield control
        finally:
            if self.is_connected:
                self.release_control()

    walk = _commanding(aio.Robot.walk)
    move_to = _commanding(aio.Robot.move_to)
    posture = _commanding(aio.Robot.posture)
    change_joints = _commanding(aio.Robot.change_joints)
    action = _commanding(aio.Robot.action)
    play = _commanding(aio.Robot.play)
    say = _commanding(aio.Robot.say)
    stop_speaking = _commanding(aio.Robot.stop_speaking)
    set_lights = _commanding(aio.Robot.set_lights)
    motions = _waiting(aio.Robot.motions)
    motion = _waiting(aio.Robot.motion)
    check_motion = _waiting(aio.Robot.check_motion)
    save_motion = _waiting(aio.Robot.save_motion)
    delete_motion = _waiting(aio.Robot.delete_motion)
    stop = _waiting(aio.Robot.stop)
    state = _waiting(aio.Robot.state)
    wait_until = _waiting(aio.Robot.wait_until)
    image = _waiting(aio.Robot.image)
    states = _streaming(aio.Robot.states)
    images = _streaming(aio.Robot.images)
    events = _streaming(aio.Robot.events)
