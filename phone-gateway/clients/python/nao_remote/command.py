"""A motion command between its request and its result."""

from __future__ import annotations

import asyncio

from nao_remote.errors import CommandFailed, CommandInterrupted, CommandRefused, NaoError
from nao_remote.messages import CommandResult, CommandStatus
from nao_remote.waiting import within

_FAILURES: dict[CommandStatus, type[CommandFailed]] = {
    CommandStatus.REFUSED: CommandRefused,
    CommandStatus.INTERRUPTED: CommandInterrupted,
    CommandStatus.FAILED: CommandFailed,
}


class Command:
    """A motion command that was passed on to the robot."""

    def __init__(self, request_id: int) -> None:
        self.request_id = request_id
        self._end: asyncio.Future[CommandResult] = asyncio.get_running_loop().create_future()
        # An end that nobody waits for is not an error of the program.
        self._end.add_done_callback(lambda end: end.cancelled() or end.exception())

    @property
    def is_done(self) -> bool:
        """True when the command has ended, well or not."""
        return self._end.done()

    async def wait(self, timeout: float = 60.0) -> CommandResult:
        """Waits until the robot has done it.

        @param timeout  s.
        @raise CommandRefused, CommandInterrupted, CommandFailed  if it ended otherwise, with the robot's reason.
        @raise ConnectionLost  if the connection was lost meanwhile: the result is unknown then.
        @raise Timeout
        """
        return await within(timeout, asyncio.shield(self._end), "the command has not ended within {timeout}")

    def handle(self, result: CommandResult) -> None:
        if self._end.done() or result.status == CommandStatus.ACCEPTED:
            return
        if result.status == CommandStatus.DONE:
            self._end.set_result(result)
        else:
            self.fail(_FAILURES[result.status](result.message, result.reason_code, result.reason_arguments))

    def fail(self, error: NaoError) -> None:
        if not self._end.done():
            self._end.set_exception(error)
