"""What the robot says of itself, as plain immutable objects.

Units are metres, seconds and radians; `utime` is the robot's clock in microseconds. Fields have the names and meanings of
remote.proto.
"""

from __future__ import annotations

import enum
import os
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Mapping, TypeVar, Union, cast

from nao_remote import remote_pb2 as pb
from nao_remote.lights import from_rgb

T = TypeVar("T")


def plain(kind: type[T], message: Any, /, **others: Any) -> T:
    """@return an object of a dataclass whose fields have the names of the message's, lists as tuples; `others` are given."""
    values = {entry.name: getattr(message, entry.name) for entry in fields(cast(Any, kind)) if entry.name not in others}
    return kind(**{name: value if isinstance(value, (str, bytes, int, float)) else tuple(value)
                   for name, value in values.items()}, **others)


class Mode(enum.IntEnum):
    """What the robot does."""

    RELAXED = pb.MODE_RELAXED
    HOLDING = pb.MODE_HOLDING
    MOVING = pb.MODE_MOVING
    WALKING = pb.MODE_WALKING
    ACTING = pb.MODE_ACTING
    FALLING = pb.MODE_FALLING
    FALLEN = pb.MODE_FALLEN
    GETTING_UP = pb.MODE_GETTING_UP
    # The motion program or the robot does not answer; the state is the last known one.
    NO_ROBOT = pb.MODE_NO_ROBOT


class CommandKind(enum.IntEnum):
    """Types of motion commands."""

    NONE = pb.COMMAND_KIND_NONE
    WALK = pb.COMMAND_KIND_WALK
    MOVE_TO = pb.COMMAND_KIND_MOVE_TO
    POSTURE = pb.COMMAND_KIND_POSTURE
    JOINT_CHANGE = pb.COMMAND_KIND_JOINT_CHANGE
    ACTION = pb.COMMAND_KIND_ACTION
    STOP = pb.COMMAND_KIND_STOP


class CommandStatus(enum.IntEnum):
    """How far a motion command is."""

    ACCEPTED = pb.Notice.ACCEPTED
    REFUSED = pb.Notice.REFUSED
    DONE = pb.Notice.DONE
    INTERRUPTED = pb.Notice.INTERRUPTED
    FAILED = pb.Notice.FAILED


class Component(enum.IntEnum):
    """Programs whose availability the gateway reports."""

    MOTION = pb.Notice.MOTION
    ROBOT = pb.Notice.ROBOT
    CAMERA = pb.Notice.CAMERA


@dataclass(frozen=True)
class JointDescription:
    """A motor. Limits in rad (hands: opening 0 to 1), highest velocity in rad/s (hands: 1/s)."""

    name: str
    lower: float
    upper: float
    max_velocity: float


@dataclass(frozen=True)
class JointGroup:
    """Joints that a person sees as one. An axis without a joint is empty."""

    name: str
    yaw_joint: str
    pitch_joint: str
    roll_joint: str
    # Its pitch joint opens and closes (0 to 1), as a hand does.
    is_opening: bool

    def axis_of(self, joint: str) -> str | None:
        """@return "yaw", "pitch" or "roll"; None if the joint is not in this group."""
        axes = {self.yaw_joint: "yaw", self.pitch_joint: "pitch", self.roll_joint: "roll"}
        return axes.get(joint) if joint else None


@dataclass(frozen=True)
class Action:
    """An action. `kind`: "stand-up", "rest", "kick", "block", "dive", "gesture", "policy" or
    "own-gait"; `side`: "left", "right" or empty."""

    name: str
    kind: str
    side: str


@dataclass(frozen=True)
class RobotDescription:
    """What a program needs to command the robot."""

    name: str
    model: str
    # Path of the URDF on the gateway's HTTP port.
    urdf_path: str
    # By name, in the order of the robot.
    joints: Mapping[str, JointDescription]
    joint_groups: Mapping[str, JointGroup]
    postures: tuple[str, ...]
    actions: Mapping[str, Action]
    cameras: tuple[str, ...]
    # Limits of the walk: m/s forward and backward (negative), m/s and rad/s to either side.
    max_vx: float
    min_vx: float
    max_vy: float
    max_wz: float
    # Postures in which walks and actions begin; upright; without load on the motors. Empty: none.
    ready_posture: str
    stand_posture: str
    rest_posture: str
    # Group that turns the first camera; empty: none.
    camera_group: str
    # Words of people: (kind, name, language) to text; kind is "posture", "action", "group", "camera" or "light".
    labels: Mapping[tuple[str, str, str], str]
    # Languages that it speaks, as BCP 47 tags; names of its lights.
    languages: tuple[str, ...] = ()
    lights: tuple[str, ...] = ()

    @staticmethod
    def from_protocol(message: pb.RobotDescription) -> RobotDescription:
        roles = {role.name: role for role in message.action_roles}
        return plain(
            RobotDescription, message, joints={joint.name: plain(JointDescription, joint) for joint in message.joints},
            joint_groups={group.name: plain(JointGroup, group) for group in message.joint_groups},
            actions={name: Action(name, roles[name].kind if name in roles else "", roles[name].side if name in roles else "")
                     for name in message.actions},
            labels={(label.kind, label.name, label.language): label.text for label in message.labels},
            lights=tuple(light.name for light in message.lights))


@dataclass(frozen=True)
class Activity:
    """The motion that the robot executes."""

    kind: CommandKind
    # Its posture, action or joints.
    name: str
    # The robot has tried to get up without success.
    needs_help: bool


@dataclass(frozen=True)
class Body:
    """Condition of a real robot's body."""

    # Charge of the battery, 0 to 1; None: unknown.
    battery_charge: float | None
    is_charging: bool
    # Joint of the hottest motor; empty: unknown. Its temperature, degrees Celsius.
    hottest_joint: str
    hottest_temperature: float
    # "battery-low", "battery-hot", "joint-hot", "joint-dead", "sensor-dead".
    warnings: tuple[str, ...]
    # Joints whose motor is hot, limited or dead.
    faulty_joints: tuple[str, ...]

    @staticmethod
    def from_protocol(message: pb.Body) -> Body:
        return plain(Body, message,
                     battery_charge=message.battery_charge if message.HasField("battery_charge") else None)


@dataclass(frozen=True)
class State:
    """State of the robot."""

    utime: int
    # Age when the gateway sent it, ms.
    age_ms: float
    # Angles by joint, rad (hands: opening 0 to 1).
    joint_position: Mapping[str, float]
    # Torso in the odometry frame: unit quaternion (w, x, y, z); position, m, the third is the height above the ground.
    torso_orientation: tuple[float, ...]
    torso_position: tuple[float, ...]
    mode: Mode
    # Posture that the robot is in; empty between postures.
    posture: str
    activity: Activity | None
    # Fraction of the activity done; negative where the end is open.
    progress: float
    # Walk velocity being executed: m/s, m/s, rad/s.
    vx: float
    vy: float
    wz: float
    # Mean motor stiffness, 0 to 1.
    stiffness: float
    # What the lights show, by name: red, green, blue, each 0 to 1. Empty: unknown.
    light_rgb: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    # None: unknown, as of a simulated body.
    body: Body | None = None

    @staticmethod
    def from_protocol(message: pb.State, robot: RobotDescription) -> State:
        activity = None
        if message.HasField("activity"):
            activity = plain(Activity, message.activity, kind=_member(CommandKind, message.activity.kind, CommandKind.NONE))
        return plain(
            State, message, joint_position=dict(zip(robot.joints, message.joint_position)),
            mode=_member(Mode, message.mode, Mode.MOVING), activity=activity,
            light_rgb={name: from_rgb(rgb) for name, rgb in zip(robot.lights, message.light_rgb)},
            body=Body.from_protocol(message.body) if message.HasField("body") else None)


@dataclass(frozen=True)
class Image:
    """An image of a head camera."""

    # Robot time at mid exposure.
    utime: int
    age_ms: float
    camera: str
    # Pixels.
    width: int
    height: int
    # A whole JPEG file.
    jpeg: bytes

    @staticmethod
    def from_protocol(message: pb.Image) -> Image:
        return plain(Image, message)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the JPEG file, which appears whole or not at all."""
        part = Path(f"{os.fspath(path)}.part")
        try:
            part.write_bytes(self.jpeg)
            part.replace(Path(path))
        finally:
            part.unlink(missing_ok=True)

    def to_array(self) -> Any:
        """@return the pixels as OpenCV has them: a NumPy array of uint8, (height, width, 3), blue, green, red.

        @raise ImportError  without OpenCV (Debian: python3-opencv).
        """
        try:
            import cv2
            import numpy
        except ImportError as error:
            raise ImportError("Image.to_array() needs OpenCV and NumPy (Debian: python3-opencv)") from error
        return cv2.imdecode(numpy.frombuffer(self.jpeg, numpy.uint8), cv2.IMREAD_COLOR)


@dataclass(frozen=True)
class Pong:
    """Answer to ping()."""

    # Time from request to answer, s.
    round_trip: float
    # 0 while there is no robot.
    robot_utime: int
    num_clients: int


@dataclass(frozen=True)
class Control:
    """Who has control of the robot. `driver_id` 0: no client; 4294967295: the operator."""

    driver_id: int = 0
    driver_name: str = ""
    is_mine: bool = False
    # The operator lets this client watch only.
    is_muted: bool = False

    @staticmethod
    def from_protocol(message: pb.Control) -> Control:
        return plain(Control, message)


@dataclass(frozen=True)
class RobotEntry:
    """A robot of a gateway of several."""

    name: str
    model: str
    # Team, 0 or 1, and number on the shirt; None and 0: none.
    team: int | None
    number: int
    # Who drives it; 0: no client.
    driver_id: int
    driver_name: str
    # The robot answers.
    is_available: bool

    @staticmethod
    def from_protocol(message: pb.RobotList) -> tuple[RobotEntry, ...]:
        return tuple(plain(RobotEntry, robot, team=robot.team if robot.HasField("team") else None)
                     for robot in message.robots)


@dataclass(frozen=True)
class Client:
    """A client of the gateway, for the operator."""

    client_id: int
    name: str
    address: str
    # "websocket" or "tcp".
    transport: str
    is_driver: bool
    # Messages sent; states and images skipped because the client was slow.
    num_sent: int
    num_skipped: int
    # The robot that it watches, of several; it may only watch.
    robot: str = ""
    is_muted: bool = False

    @staticmethod
    def from_protocol(message: pb.Clients.Client) -> Client:
        return plain(Client, message)


@dataclass(frozen=True)
class Reason:
    """Why something happened: an English sentence, and the same as a code with its arguments for translation."""

    message: str
    reason_code: str = ""
    reason_arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class CommandResult(Reason):
    """A motion command of this client was accepted, refused or has ended."""

    request_id: int = 0
    status: CommandStatus = CommandStatus.ACCEPTED


@dataclass(frozen=True)
class ControlChanged(Reason):
    """Control has changed hands."""

    control: Control = Control()


@dataclass(frozen=True)
class RobotChanged(Reason):
    """This client watches another robot: `Robot.description` is that one's."""

    robot: str = ""


@dataclass(frozen=True)
class RobotsChanged(Reason):
    """The list of the gateway's robots has changed."""

    robots: tuple[RobotEntry, ...] = ()


@dataclass(frozen=True)
class ComponentChanged(Reason):
    """A program has become available or unavailable."""

    component: Component = Component.MOTION
    is_available: bool = False


@dataclass(frozen=True)
class Connected(Reason):
    """The client has connected again."""


@dataclass(frozen=True)
class Disconnected(Reason):
    """The connection was lost. `is_final`: the client does not connect again."""

    is_final: bool = False


Event = Union[CommandResult, ControlChanged, ComponentChanged, RobotChanged, RobotsChanged, Connected, Disconnected]


def event_from_protocol(notice: pb.Notice) -> Event | None:
    """@return None for a closing notice, which Disconnected repeats, and for kinds that this version does not know."""
    reason = (notice.message, notice.reason_code, tuple(notice.reason_arguments))
    if notice.kind == pb.Notice.COMMAND_RESULT:
        return CommandResult(*reason, notice.request_id, _member(CommandStatus, notice.status, CommandStatus.FAILED))
    if notice.kind == pb.Notice.CONTROL_CHANGED:
        return ControlChanged(*reason, Control.from_protocol(notice.control))
    if notice.kind == pb.Notice.ROBOT_CHANGED:
        return RobotChanged(*reason, notice.robot.name)
    if notice.kind == pb.Notice.ROBOTS_CHANGED:
        return RobotsChanged(*reason, RobotEntry.from_protocol(notice.robots))
    component = _member(Component, notice.component, None)
    if notice.kind == pb.Notice.COMPONENT_CHANGED and component is not None:
        return ComponentChanged(*reason, component, notice.is_available)
    return None


def _member(kind: Any, value: int, otherwise: Any) -> Any:
    """@return the enum's member, or `otherwise` for a value of a newer gateway."""
    try:
        return kind(value)
    except ValueError:
        return otherwise
