"""What a simulation says, as plain immutable objects. Fields have the names and meanings of simulation.proto."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping

from nao_remote import simulation_pb2 as pb
from nao_remote.messages import CommandStatus, JointDescription, Mode, plain


@dataclass(frozen=True)
class SimulationDescription:
    """The robot and the world."""

    # Folder of robots/, physics engine, disturbances.
    model: str
    engine: str
    disturbances: str
    # By name, in the order of all lists of joints.
    joints: Mapping[str, JointDescription]
    postures: tuple[str, ...]
    actions: tuple[str, ...]
    # In the order of SimulationState.foot_force.
    foot_sensors: tuple[str, ...]
    # Limits of the walk: m/s forward and backward (negative), m/s and rad/s to either side.
    max_vx: float
    min_vx: float
    max_vy: float
    max_wz: float

    @staticmethod
    def from_protocol(message: pb.Description) -> SimulationDescription:
        joints = {joint.name: plain(JointDescription, joint) for joint in message.joints}
        return plain(SimulationDescription, message, joints=joints)


@dataclass(frozen=True)
class SimulationResult:
    """The result of a command."""

    command_id: int
    status: CommandStatus
    reason_code: str
    reason: str


@dataclass(frozen=True)
class Truth:
    """What no robot knows, in the world frame: for rewards and measurements, never for control."""

    # Torso, m, and unit quaternion (w, x, y, z).
    torso_position: tuple[float, ...]
    torso_orientation: tuple[float, ...]
    joint_position: tuple[float, ...]
    # Empty without a ball.
    ball_position: tuple[float, ...]


@dataclass(frozen=True)
class SimulationState:
    """What the robot knows: sensor readings and the estimate of its motion core."""

    # Simulated time since the reset, and length of a control tick, s.
    time: float
    period: float
    # Encoders, rad and rad/s; motors' torques, N m; targets of the servos, rad. Hands: opening.
    joint_position: tuple[float, ...]
    joint_velocity: tuple[float, ...]
    joint_torque: tuple[float, ...]
    joint_target: tuple[float, ...]
    # Targets of the motion core, rad, also while other targets take their place.
    motion_target: tuple[float, ...]
    # Specific force, m/s^2, and angular velocity, rad/s, in the torso frame.
    accelerometer: tuple[float, ...]
    gyroscope: tuple[float, ...]
    # Torso in the world as the inertial unit estimates it: unit quaternion (w, x, y, z).
    orientation_torso_in_world: tuple[float, ...]
    # N.
    foot_force: tuple[float, ...]
    # Estimate: torso in the odometry frame, m and (w, x, y, z); its velocity in its heading frame, m/s.
    torso_position: tuple[float, ...]
    torso_orientation: tuple[float, ...]
    velocity_torso_in_heading: tuple[float, ...]
    left_foot_carries: bool
    right_foot_carries: bool
    mode: Mode
    # Posture that the robot is in; empty between postures.
    posture: str
    # Numbers of the commands of this step; results of all commands since the last one.
    command_ids: tuple[int, ...]
    results: tuple[SimulationResult, ...]
    # None unless it was asked for.
    truth: Truth | None

    @staticmethod
    def from_protocol(message: pb.State) -> SimulationState:
        truth = plain(Truth, message.truth) if message.HasField("truth") else None
        results = tuple(plain(SimulationResult, result, status=CommandStatus(result.status)) for result in message.results)
        return plain(SimulationState, message, mode=Mode(message.mode), results=results, truth=truth)
