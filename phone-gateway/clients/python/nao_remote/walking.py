"""A walk as one command: the protocol wants its velocity repeated for as long as the robot is to walk."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import Any, Awaitable, Callable, Coroutine

from nao_remote import remote_pb2 as pb
from nao_remote.command import Command
from nao_remote.errors import CommandInterrupted, NaoError, Timeout, TooLate

# Interval of WalkTurn, s. PROTOCOL.md wants 0.2 s or less; half of it leaves one request that may be late.
PERIOD = 0.1


class Walk:
    """A walk that is being executed. Its command has the number of the first WalkTurn."""

    def __init__(self, command: Command, request: Callable[..., Awaitable[Any]]) -> None:
        """@param request  Sends a request: Connection.request."""
        self.command = command
        self._request = request
        self._velocity = pb.WalkTurn()
        self._repeating: asyncio.Task[None] | None = None
        # Besides cancelling the task: until Python 3.12 wait_for() may swallow a cancellation.
        self._is_abandoned = False

    async def start(self, velocity: pb.WalkTurn) -> None:
        """Sends the velocity, and repeats it from then on. @raise NaoError  if the first one is refused."""
        self._velocity = velocity
        await self._request(self.command.request_id, walk_turn=velocity)
        self._repeating = asyncio.ensure_future(self._repeat())

    @property
    def is_running(self) -> bool:
        return not (self._repeating is None or self._repeating.done() or self._is_abandoned or self.command.is_done)

    async def change(self, velocity: pb.WalkTurn) -> None:
        """Goes on with another velocity."""
        self._velocity = velocity
        await self._request(walk_turn=velocity)

    async def end(self) -> None:
        """Ends the walk with velocity zero."""
        self.abandon()
        await self._request(walk_turn=pb.WalkTurn())

    async def end_on_failure(self) -> None:
        """Ends it where its caller is cancelled or has failed, whose error is the one to be raised."""
        if not self.command.is_done:
            await despite_failure(self.end())

    def abandon(self) -> None:
        """Sends no more velocities: another command has replaced the walk."""
        self._is_abandoned = True
        if self._repeating is not None:
            self._repeating.cancel()

    async def end_after(self, duration: float) -> None:
        """Ends it after a time, s, and returns when the robot stands. @raise CommandFailed  if it ends earlier."""
        try:
            await self.command.wait(duration)
        except Timeout:
            pass
        else:
            # The robot has heard nothing for a second.
            if not self._is_abandoned:
                raise CommandInterrupted("the walk ended before its time: this program was held up")
        if self.is_running:
            await self.end()
        await self.command.wait()

    async def _repeat(self) -> None:
        while True:
            await asyncio.sleep(PERIOD)
            # A walk that the robot has ended (a fall, a stop) must not begin again by itself.
            if self.command.is_done or self._is_abandoned:
                return
            try:
                await self._request(walk_turn=self._velocity)
            except TooLate:
                # The next one may be in time; else the gateway ends the walk.
                continue
            except NaoError as error:
                self.command.fail(error)
                return


async def despite_failure(ending: Coroutine[Any, Any, Any]) -> None:
    """Executes what ends a motion for a caller that is cancelled or has failed, also if it is cancelled again."""
    with suppress(NaoError):
        await asyncio.shield(asyncio.ensure_future(ending))
