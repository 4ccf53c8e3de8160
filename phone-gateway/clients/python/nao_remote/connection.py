"""A connection that is made again after it was lost."""

from __future__ import annotations

import asyncio
import itertools
import os
from typing import Any, Callable

from nao_remote import remote_pb2 as pb
from nao_remote.address import Address
from nao_remote.errors import Closed, ConnectionLost, NaoError, TooManyClients, WrongToken, WrongVersion
from nao_remote.session import PROTOCOL_VERSION, Session
from nao_remote.transport import open_transport

# Pause before the first attempt to connect again, s, doubled after each failure up to the longest: those of the phone
# app, for a gateway that restarts is back within seconds.
FIRST_DELAY = 0.5
LONGEST_DELAY = 5.0

SOFTWARE = "nao_remote for Python"


def retry_delay(num_failures: int) -> float:
    """@return the pause after this number of failures in a row (1, 2, ...), s."""
    return float(min(FIRST_DELAY * 2 ** min(num_failures - 1, 30), LONGEST_DELAY))


class Connection:
    """Connects, and connects again with growing pauses after the connection was lost.

    Refusals that do not change by themselves (wrong token, wrong version, too many clients) end it.
    """

    def __init__(self, address: Address, client_name: str, certificate: str | os.PathLike[str] | None, timeout: float,
                 reconnects: bool, robot: str = "") -> None:
        """@param robot  Which of several robots; empty: the gateway chooses."""
        self.address = address
        self.robot = robot
        self.timeout = timeout
        # Called after each successful Connect, after each loss (with whether it was the last one), and with every
        # message that is not a response.
        self.on_connected: Callable[[pb.Connected], None] = lambda connected: None
        self.on_lost: Callable[[ConnectionLost, bool], None] = lambda error, is_final: None
        self.on_message: Callable[[pb.ServerMessage], None] = lambda message: None
        self._client_name = client_name
        self._certificate = certificate
        self._reconnects = reconnects
        self._request_ids = itertools.count(1)
        self._session: Session | None = None
        self._running: asyncio.Task[ConnectionLost] | None = None
        self._supervisor: asyncio.Task[None] | None = None
        self._error: ConnectionLost = ConnectionLost("not connected yet")

    @property
    def is_connected(self) -> bool:
        return self._session is not None

    @property
    def is_interrupted(self) -> bool:
        """True while nothing is heard of the gateway, also before that counts as a lost connection."""
        return self._session is None or self._session.is_silent

    @property
    def end(self) -> Closed | None:
        """Why it ended for good; None before."""
        return self._error if isinstance(self._error, Closed) else None

    @property
    def session(self) -> Session:
        """@raise ConnectionLost  while there is no connection."""
        if self._session is None:
            # A new object: a traceback must not grow with every raise.
            raise type(self._error)(self._error.message, self._error.reason_code, self._error.reason_arguments)
        return self._session

    async def open(self) -> None:
        """Connects for the first time. @raise NaoError  if that fails; it is not tried again."""
        await self._connect()
        self._supervisor = asyncio.ensure_future(self._supervise())

    async def close(self) -> None:
        self._error = Closed("the client was closed")
        session, self._session = self._session, None
        for task in (self._supervisor, self._running):
            if task is not None:
                task.cancel()
                await asyncio.gather(task, return_exceptions=True)
        if session is not None:
            await session.close()
            self.on_lost(self._error, True)

    async def request(self, request_id: int | None = None, **use_case: Any) -> pb.Response:
        """As Session.request(), with the connection's timeout."""
        return await self.session.request(self.timeout, request_id, **use_case)

    async def request_within(self, timeout: float, **use_case: Any) -> pb.Response:
        """As Session.request(), for what the gateway answers late."""
        return await self.session.request(timeout, None, **use_case)

    async def _connect(self) -> None:
        transport = await open_transport(self.address, self._certificate, self.timeout)
        session = Session(transport, self._request_ids, self.on_message)
        running = asyncio.ensure_future(session.run())
        try:
            response = await session.request(self.timeout, connect=pb.Connect(
                protocol_version=PROTOCOL_VERSION, token=self.address.token, client_name=self._client_name,
                client_software=SOFTWARE, robot=self.robot))
        except BaseException:
            running.cancel()
            await asyncio.gather(running, return_exceptions=True)
            raise
        self._session, self._running = session, running
        self.on_connected(response.connected)

    async def _supervise(self) -> None:
        while True:
            assert self._running is not None
            reason = await self._running
            self._session = None
            self._error = reason if self._reconnects else Closed(
                reason.message, reason.reason_code, reason.reason_arguments)
            self.on_lost(self._error, not self._reconnects)
            if not self._reconnects or not await self._reconnect():
                return

    async def _reconnect(self) -> bool:
        """@return whether there is a connection again."""
        for num_failures in itertools.count(1):
            await asyncio.sleep(retry_delay(num_failures))
            try:
                await self._connect()
                return True
            except (WrongToken, WrongVersion, TooManyClients) as error:
                self._error = Closed(error.message, error.reason_code, error.reason_arguments)
                self.on_lost(self._error, True)
                return False
            except NaoError as error:
                self._error = ConnectionLost(error.message, error.reason_code, error.reason_arguments)
        return False
