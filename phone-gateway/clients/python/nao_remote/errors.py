"""Exceptions of this package.

Every exception has the robot's sentence as its text. Where the robot gave a reason code (PROTOCOL.md, section 8), it is
in `reason_code`, with the values of the sentence in `reason_arguments`.
"""

from __future__ import annotations

import re
from typing import Sequence

from nao_remote import remote_pb2 as pb


class NaoError(Exception):
    """Base of all exceptions of this package."""

    def __init__(self, message: str, reason_code: str = "", reason_arguments: Sequence[str] = ()) -> None:
        super().__init__(message)
        self.message = message
        self.reason_code = reason_code
        self.reason_arguments = tuple(reason_arguments)


class ConnectionLost(NaoError, ConnectionError):
    """The gateway cannot be reached, or the connection has ended. Raised by every request until the client has
    connected again."""


class Closed(ConnectionLost):
    """close() was called, or the client has given up connecting again."""


class Timeout(NaoError, TimeoutError):
    """No answer, state, image, event or result within the time that the caller allowed."""


class Refused(NaoError):
    """The gateway answered a request with an error. Each ErrorCode of the protocol has the subclass of its name: WRONG_TOKEN
    is WrongToken. `error_code` is the code."""

    error_code: int = pb.INVALID_REQUEST


class InvalidRequest(Refused):
    """The gateway does not know the request: it is older than this package."""


class NotConnected(Refused):
    """A request before Connect."""


class WrongVersion(Refused):
    """The gateway speaks another version of the protocol."""


class WrongToken(Refused):
    """The token is wrong or missing."""


class InvalidArgument(Refused):
    """A value is out of range or not finite, or names something that the robot does not have. Nothing moves."""


class NoControl(Refused):
    """No client has control: call take_control() first."""


class ControlTaken(Refused):
    """Another client or the operator has control; `driver_name` names it."""
    driver_name = ""


class TooManyRequests(Refused):
    """More requests in a second than the gateway accepts."""


class TooManyClients(Refused):
    """The gateway has as many clients as it accepts."""


class RobotUnavailable(Refused):
    """The motion program or the robot does not answer."""


class NotAllowed(Refused):
    """Only programs on the gateway's own host may do this."""


class Stopped(Refused):
    """A client sent Stop during this walk. The next walk() after 0.5 s is accepted."""


class NameInUse(Refused):
    """A motion of this name is saved, or an action of the robot's own has it."""

    error_code = pb.NAME_IN_USE


class TooLate(Refused):
    """The command was under way for too long, or the connection is too slow to drive. Nothing moves."""


class MotionNotSafe(InvalidArgument):
    """A taught motion would make the robot fall, touch itself or exceed a limit. Nothing is saved.

    `keyframe` is the one at which the fault shows, from 0; -1: none in particular. `repaired` is a changed motion without the
    fault, or None, and `repair` says what was changed: "slowed-down" or "clipped".
    """

    keyframe = -1
    repair = ""
    repaired: pb.Motion | None = None


class CommandFailed(NaoError):
    """A motion command failed after the gateway had passed it on."""


class CommandRefused(CommandFailed):
    """The robot refused the command; nothing moved."""


class CommandInterrupted(CommandFailed):
    """A newer command or the robot's own motion replaced this one."""


class SimulationError(NaoError):
    """The simulation's server refused a request, or has ended."""


def _code_of(kind: type[Refused]) -> int:
    return int(pb.ErrorCode.Value(re.sub("(?<=[a-z])(?=[A-Z])", "_", kind.__name__).upper()))


REFUSALS: dict[int, type[Refused]] = {_code_of(kind): kind for kind in Refused.__subclasses__()}


def refusal(response: pb.Response) -> Refused:
    """@return the exception for a response whose error is not OK."""
    kind = REFUSALS.get(response.error, Refused)
    if kind is InvalidArgument and response.HasField("motion_report"):
        kind = MotionNotSafe
    message = response.message or f"error {response.error}"
    error = kind(message, response.reason_code, response.reason_arguments)
    error.error_code = response.error
    if isinstance(error, ControlTaken):
        error.driver_name = response.control.driver_name
    if isinstance(error, MotionNotSafe):
        report = response.motion_report
        error.keyframe, error.repair = report.keyframe, report.repair
        error.repaired = report.repaired if report.HasField("repaired") else None
    return error
