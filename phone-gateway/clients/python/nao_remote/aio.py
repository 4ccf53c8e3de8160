"""The asyncio face: `async with await nao_remote.aio.connect("nao.local") as robot: await robot.posture("Sit")`."""

from __future__ import annotations

import asyncio
import os
from typing import Callable, Mapping

from nao_remote import remote_pb2 as pb
from nao_remote.address import resolve
from nao_remote.by_name import ByName
from nao_remote.command import Command
from nao_remote.connection import Connection
from nao_remote.core import RobotCore
from nao_remote.discovery import first_address
from nao_remote.errors import ConnectionLost, Timeout
from nao_remote.joints import Joint
from nao_remote.lights import LIGHT_TIMEOUT, Color, Light, make_request
from nao_remote.messages import CommandResult, CommandStatus, Image, State
from nao_remote.operator import Operator
from nao_remote.streams import Stream
from nao_remote.walking import Walk, despite_failure

# Period of asking for an image while the camera begins to render, s. PROTOCOL.md: ten times a second is usual.
IMAGE_POLL_PERIOD = 0.1
# Default of timeouts for a motion, s. Chosen: getting up from the belly and sitting down takes half of it.
MOTION_TIMEOUT = 60.0
# For a behavior, s: longer than the search for a ball, and than any way to a goal.
PLAY_TIMEOUT = 600.0
# Default of timeouts for checking a taught motion, s. PROTOCOL.md: up to half a minute, and as long for one before it.
CHECK_TIMEOUT = 120.0


async def connect(address: str | None = None, *, token: str | None = None,
                  token_file: str | os.PathLike[str] | None = None, name: str = "Python",
                  certificate: str | os.PathLike[str] | None = None, timeout: float = 5.0, reconnect: bool = True,
                  auto_control: bool = True, robot: str = "") -> Robot:
    """Connects to a robot's gateway. The parameters are those of nao_remote.connect()."""
    resolved = resolve(first_address() if address is None else address, token, token_file)
    connected = Robot(Connection(resolved, name, certificate, timeout, reconnect, robot), auto_control)
    await connected._open()
    return connected


class Robot(RobotCore):
    """A connected robot. Made by connect(); all methods must be called in the event loop that called it.

    Requests raise the exceptions of nao_remote.errors. A method that moves the robot takes control first if no client
    drives (unless connected with `auto_control=False`).
    """

    def __init__(self, connection: Connection, auto_control: bool) -> None:
        super().__init__(connection, auto_control)
        # The joints and lights by name; the operator's console.
        self.joints = ByName("joint", lambda: self.description.joints, lambda name: Joint(self, self.description.joints[name]))
        self.lights = ByName("light", lambda: self.description.lights, lambda name: Light(self, name))
        self.operator = Operator(connection)

    async def __aenter__(self) -> Robot:
        return self

    # ---- Motion ----

    async def walk(self, vx: float = 0.0, vy: float = 0.0, wz: float = 0.0, duration: float | None = None) -> Command:
        """Walks at a velocity, clipped to the limits in `description`.

        @param vx, vy, wz  Forward, m/s; to the left, m/s; turning to the left, rad/s. All zero ends a walk.
        @param duration  s: returns when the robot stands again. None: returns at once, and the walk goes on until the next
                         walk(), stop(), another motion or the end of the connection. A walk() that is cancelled or fails
                         ends the walk.
        """
        velocity = pb.WalkTurn(vx=vx, vy=vy, wz=wz)
        walk = self._walk if self._walk is not None and self._walk.is_running else None
        if vx == 0 and vy == 0 and wz == 0:
            return await self._end_walk(walk)
        try:
            if walk is not None:
                await walk.change(velocity)
            else:
                await self._ensure_control()
                with self._new_command() as command:
                    walk = Walk(command, self._connection.request)
                    await walk.start(velocity)
                self._walk = walk
            if duration is not None:
                await walk.end_after(duration)
        except BaseException:
            if walk is not None:
                await walk.end_on_failure()
            raise
        return walk.command

    async def move_to(self, x: float = 0.0, y: float = 0.0, theta: float = 0.0, *, wait: bool = True,
                      timeout: float = MOTION_TIMEOUT) -> Command:
        """Walks to a pose relative to the present one: m forward, m to the left, rad to the left.

        @param wait  False: returns when the robot has accepted it. The same holds for all motions below.
        """
        return await self._command(wait, timeout, move_to=pb.MoveTo(x=x, y=y, theta=theta))

    async def posture(self, posture: str, speed: float = 0.0, *, wait: bool = True,
                      timeout: float = MOTION_TIMEOUT) -> Command:
        """Goes to a posture of `description.postures`.

        @param speed  Fraction of the maximum, above 0 up to 1; 0: the gateway's default.
        """
        return await self._command(wait, timeout, go_to_posture=pb.GoToPosture(posture=posture, speed=speed))

    async def change_joints(self, group: str, *, yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0,
                            speed: float = 0.0, allow_tipping: bool = False, both_sides: bool = False,
                            wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Turns the joints of a group of `description.joint_groups` relative to their present targets.

        @param yaw, pitch, roll  rad (hands: opening, in `pitch`). @param allow_tipping  Also if the robot tips over.
        @param both_sides  The other side's group makes the mirrored change in the same motion.
        """
        return await self._command(wait, timeout, change_joints=pb.ChangeJoints(
            group=group, yaw=yaw, pitch=pitch, roll=roll, speed=speed, allow_tipping=allow_tipping, both_sides=both_sides))

    async def action(self, action: str, *, ball: tuple[float, float] | None = None, strength: float | None = None,
                     wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Performs an action of `description.actions`.

        @param ball  For kicks: its position on the ground, m forward and to the left. @param strength  For kicks: 0 to 1.
        """
        request = pb.DoAction(action=action)
        if ball is not None:
            request.ball_x, request.ball_y = ball
        if strength is not None:
            request.strength = strength
        return await self._command(wait, timeout, do_action=request)

    async def play(self, behavior: str, *, target: tuple[float, float] | None = None, wait: bool = True,
                   timeout: float = PLAY_TIMEOUT) -> Command:
        """Lets the robot act by what it sees; needs nao-play and nao-vision on its host.

        @param behavior  "go-to-ball", "kick", "dribble", "score", "keep-goal" (which goes on until it is ended) or "none", which
        ends what runs. @param target  Where the ball shall go, m, in the odometry frame; None: the opponent's goal.
        """
        request = pb.Play(behavior=pb.Play.Behavior.Value(behavior.upper().replace("-", "_")))
        if target is not None:
            request.target_x, request.target_y = target
        return await self._command(wait and behavior != "none", timeout, play=request)

    # ---- Speech and lights ----

    async def say(self, text: str, *, language: str = "", volume: float = 1.0, rate: float = 1.0, after: bool = False,
                  wait: bool = True, timeout: float = MOTION_TIMEOUT) -> Command:
        """Speaks a text of at most 1000 bytes; the robot may move meanwhile.

        @param language  One of `description.languages`, with or without a region ("de-AT"); empty: the speaker's default.
        @param volume  0 to 1. @param rate  Speed relative to normal, 0.5 to 2.
        @param after  Speak it after what is being said, instead of replacing that.
        """
        operation = pb.Say.SAY_AFTER if after else pb.Say.SAY
        return await self._command(wait, timeout, say=pb.Say(operation=operation, text=text, language=language,
                                                             volume=volume, rate=rate))

    async def stop_speaking(self, *, timeout: float = MOTION_TIMEOUT) -> Command:
        """Ends what is being said, and what waits."""
        return await self._command(True, timeout, say=pb.Say(operation=pb.Say.STOP))

    async def set_lights(self, colors: Mapping[str, Color], duration: float = 0.0, *,
                         timeout: float = LIGHT_TIMEOUT) -> Command:
        """Sets several lights of `description.lights` at once; `robot.lights[NAME].set(color)` sets one.

        @param colors  By name: "#ff8000", or red, green and blue, each 0 to 1.
        @param duration  s, after which they show what they showed before; 0: until replaced.
        """
        return await self._command(True, timeout, set_lights=make_request(colors, duration))

    # ---- Taught motions ----

    async def motions(self) -> list[str]:
        """@return the names of the motions that are saved on the robot's host; each is an action, too."""
        response = await self._connection.request(list_motions=pb.ListMotions())
        return list(response.motions.names)

    async def motion(self, name: str) -> str:
        """@return the text of a saved motion, YAML. @raise InvalidArgument  if there is none of that name."""
        response = await self._connection.request(get_motion=pb.GetMotion(name=name))
        return response.motion_file.yaml

    async def check_motion(self, motion: str | pb.Motion, timeout: float = CHECK_TIMEOUT) -> None:
        """Checks a motion in a simulation, which takes seconds, without saving it.

        @param motion  A text as motion() returns it, or a Motion of the protocol. @raise MotionNotSafe
        """
        file = _motion_file(motion)
        await self._connection.request_within(timeout, check_motion=pb.CheckMotion(motion=file))

    async def save_motion(self, motion: str | pb.Motion, *, replace: bool = False, timeout: float = CHECK_TIMEOUT) -> None:
        """Checks a motion and saves it: action() plays it by its name.

        @param replace  Replace a saved motion of the same name. @raise MotionNotSafe. @raise NameInUse
        """
        await self._ensure_control()
        file = _motion_file(motion)
        await self._connection.request_within(timeout, save_motion=pb.SaveMotion(motion=file, replace=replace))

    async def delete_motion(self, name: str) -> None:
        """Deletes a saved motion. @raise InvalidArgument  if there is none of that name."""
        await self._ensure_control()
        await self._connection.request(delete_motion=pb.DeleteMotion(name=name))

    async def stop(self) -> None:
        """Ends any motion, also another client's; needs no control."""
        walk, self._walk = self._walk, None
        if walk is not None:
            walk.abandon()
        await self._connection.request(stop=pb.Stop())

    def _end_walk_soon(self) -> None:
        """Begins to end a walk, without waiting."""
        if self._walk is not None and self._walk.is_running:
            asyncio.ensure_future(despite_failure(self._walk.end()))

    async def _end_walk(self, walk: Walk | None) -> Command:
        self._walk = None
        if walk is not None:
            await walk.end()
            return walk.command
        # The robot does not walk: nothing will be reported.
        command = Command(self._connection.session.next_request_id())
        await self._connection.request(command.request_id, walk_turn=pb.WalkTurn())
        command.handle(CommandResult("", request_id=command.request_id, status=CommandStatus.DONE))
        return command

    # ---- States, images, events ----

    async def state(self) -> State:
        """@return the newest state. @raise RobotUnavailable  before the first one."""
        response = await self._connection.request(get_state=pb.GetState())
        return State.from_protocol(response.state_and_image.state, self.description)

    async def wait_until(self, condition: Callable[[State], bool], timeout: float = MOTION_TIMEOUT,
                         rate: float = 20.0) -> State:
        """@return the first state for which the condition holds. @raise Timeout"""
        try:
            return await asyncio.wait_for(self._first_state(condition, rate), timeout)
        except asyncio.TimeoutError as error:
            raise Timeout(f"no state met the condition within {timeout:g} s") from error

    async def image(self, camera: str = "", width: int = 0, quality: int = 0, timeout: float = 5.0) -> Image:
        """@return an image of a head camera that this client has not received yet.

        @param camera  One of `description.cameras`; empty: the first. @param width  640, 320 or 160 pixels; 0: 320.
        @param quality  JPEG quality, 1 to 95; 0: the camera's default. @raise Timeout  if the camera sends none.
        """
        wanted = pb.ImageRequest(camera=camera, width=width, quality=quality)
        deadline = asyncio.get_running_loop().time() + timeout
        while True:
            response = await self._connection.request(get_state=pb.GetState(with_image=True, image=wanted))
            if response.state_and_image.HasField("image"):
                return Image.from_protocol(response.state_and_image.image)
            if asyncio.get_running_loop().time() > deadline:
                raise Timeout(f"no image of camera {camera or self.description.cameras[0]!r} within {timeout:g} s")
            await asyncio.sleep(IMAGE_POLL_PERIOD)

    def states(self, rate: float = 20.0, timeout: float | None = 5.0) -> Stream[State]:
        """A stream of the newest states, to be iterated over: `with robot.states() as states: ...`

        @param rate  A second, up to 60; streams share the highest rate.
        @param timeout  Longest time between states while there is a connection, for iterating, s; None: without end.
        """
        stream = Stream[State]("state", 1, timeout, self._subscription.remove, lambda: self._connection.is_interrupted)
        self._subscription.add_states(stream, rate)
        return stream

    def images(self, rate: float = 15.0, camera: str = "", width: int = 0, quality: int = 0,
               timeout: float | None = 5.0) -> Stream[Image]:
        """A stream of the newest images. @param rate  A second, up to 30; others as for image() and states().

        @raise InvalidArgument  if a stream with another camera or size is open: a client has one at a time.
        """
        stream = Stream[Image]("image", 1, timeout, self._subscription.remove, lambda: self._connection.is_interrupted)
        wanted = pb.ImageRequest(camera=camera, width=width, quality=quality)
        self._subscription.add_images(stream, rate, wanted)
        return stream

    async def _first_state(self, condition: Callable[[State], bool], rate: float) -> State:
        with self.states(rate, None) as states:
            async for state in states:
                if condition(state):
                    return state
        raise ConnectionLost("the stream of states ended")


def _motion_file(motion: str | pb.Motion) -> pb.MotionFile:
    return pb.MotionFile(yaml=motion) if isinstance(motion, str) else pb.MotionFile(motion=motion)
