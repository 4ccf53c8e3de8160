"""Single joints by name, in terms of the groups that the protocol moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nao_remote.errors import InvalidArgument
from nao_remote.messages import JointDescription, RobotDescription

if TYPE_CHECKING:
    from nao_remote.aio import Robot
    from nao_remote.command import Command

# The gateway refuses a change of nothing; this one moves no motor by a step of its encoder, rad.
LEAST_CHANGE = 1e-6


def group_and_axis(robot: RobotDescription, joint: str) -> tuple[str, str]:
    """@return the group that moves a joint, and the joint's axis in it.

    @raise InvalidArgument  if the robot has no such joint, or no group has it.
    """
    if joint not in robot.joints:
        raise InvalidArgument(f"the robot has no joint {joint!r}; it has {', '.join(robot.joints)}")
    for group in robot.joint_groups.values():
        axis = group.axis_of(joint)
        if axis is not None:
            return group.name, axis
    raise InvalidArgument(f"no joint group of the robot has the joint {joint}")


class Joint:
    """One joint of a connected robot."""

    def __init__(self, robot: Robot, description: JointDescription) -> None:
        self._robot = robot
        self.description = description

    @property
    def name(self) -> str:
        return self.description.name

    async def position(self) -> float:
        """@return the measured angle, rad (hands: opening 0 to 1)."""
        return (await self._robot.state()).joint_position[self.name]

    async def move_by(self, change: float, speed: float = 0.0, *, allow_tipping: bool = False, wait: bool = True,
                      timeout: float = 60.0) -> Command:
        """Turns it by an angle, rad, from its present target.

        @param speed  Fraction of the maximum, above 0 up to 1; 0: the gateway's default.
        @param allow_tipping  Also if the robot tips over. @param wait  False: returns when the robot has accepted it.
        """
        group, axis = group_and_axis(self._robot.description, self.name)
        yaw, pitch, roll = (change if axis == candidate else 0.0 for candidate in ("yaw", "pitch", "roll"))
        return await self._robot.change_joints(group, yaw=yaw, pitch=pitch, roll=roll, speed=speed,
                                               allow_tipping=allow_tipping, wait=wait, timeout=timeout)

    async def move_to(self, angle: float, speed: float = 0.0, *, allow_tipping: bool = False, wait: bool = True,
                      timeout: float = 60.0) -> Command:
        """Turns it to an angle, rad, clipped to its limits.

        The protocol moves joints relative to their targets, which a state does not have: the change is computed from the
        measured angle. The result is therefore as exact as the motor holds its target, and less exact under load.
        """
        limits = self.description
        change = min(max(angle, limits.lower), limits.upper) - await self.position()
        return await self.move_by(change or LEAST_CHANGE, speed, allow_tipping=allow_tipping, wait=wait, timeout=timeout)
