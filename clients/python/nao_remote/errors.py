"""Exceptions of this package.

Every exception has the robot's sentence as its text. Where the robot gave a reason code (PROTOCOL.md, section 7), it is
in `reason_code`, with the values of the sentence in `reason_arguments`.
"""

from __future__ import annotations

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
    """The gateway answered a request with an error. There is one subclass for each ErrorCode of the protocol."""

    error_code: int = pb.INVALID_REQUEST


class InvalidRequest(Refused):
    """The gateway does not know the request: it is older than this package."""

    error_code = pb.INVALID_REQUEST


class NotConnected(Refused):
    """A request before Connect."""

    error_code = pb.NOT_CONNECTED


class WrongVersion(Refused):
    """The gateway speaks another version of the protocol."""

    error_code = pb.WRONG_VERSION


class WrongToken(Refused):
    """The token is wrong or missing."""

    error_code = pb.WRONG_TOKEN


class InvalidArgument(Refused):
    """A value is out of range or not finite, or names something that the robot does not have. Nothing moves."""

    error_code = pb.INVALID_ARGUMENT


class NoControl(Refused):
    """No client has control: call take_control() first."""

    error_code = pb.NO_CONTROL


class ControlTaken(Refused):
    """Another client or the operator has control; `driver_name` names it."""

    error_code = pb.CONTROL_TAKEN
    driver_name = ""


class TooManyRequests(Refused):
    """More requests in a second than the gateway accepts."""

    error_code = pb.TOO_MANY_REQUESTS


class TooManyClients(Refused):
    """The gateway has as many clients as it accepts."""

    error_code = pb.TOO_MANY_CLIENTS


class RobotUnavailable(Refused):
    """The motion program or the robot does not answer."""

    error_code = pb.ROBOT_UNAVAILABLE


class NotAllowed(Refused):
    """Only programs on the gateway's own host may do this."""

    error_code = pb.NOT_ALLOWED


class Stopped(Refused):
    """A client sent Stop during this walk. The next walk() after 0.5 s is accepted."""

    error_code = pb.STOPPED


class CommandFailed(NaoError):
    """A motion command failed after the gateway had passed it on."""


class CommandRefused(CommandFailed):
    """The robot refused the command; nothing moved."""


class CommandInterrupted(CommandFailed):
    """A newer command or the robot's own motion replaced this one."""


class SimulationError(NaoError):
    """The simulation's server refused a request, or has ended."""


REFUSALS: dict[int, type[Refused]] = {kind.error_code: kind for kind in Refused.__subclasses__()}


def refusal(response: pb.Response) -> Refused:
    """@return the exception for a response whose error is not OK."""
    kind = REFUSALS.get(response.error, Refused)
    message = response.message or f"error {response.error}"
    error = kind(message, response.reason_code, response.reason_arguments)
    error.error_code = response.error
    if isinstance(error, ControlTaken):
        error.driver_name = response.control.driver_name
    return error
