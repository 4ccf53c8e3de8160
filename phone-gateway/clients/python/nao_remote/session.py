"""One connection: requests and their responses, pings, and the detection of a lost connection."""

from __future__ import annotations

import asyncio
from typing import Any, Awaitable, Callable, Iterator

from google.protobuf.message import DecodeError

from nao_remote import remote_pb2 as pb
from nao_remote.errors import ConnectionLost, refusal
from nao_remote.transport import Transport
from nao_remote.waiting import within

PROTOCOL_VERSION = 1

# PROTOCOL.md, section 6, s: a request at least once a second; lost after 5 s without a message.
PING_PERIOD = 1.0
SILENCE_TIMEOUT = 5.0
# How often both are looked at, s. Chosen: far below them.
CHECK_PERIOD = 0.25


class Session:
    """A connection from its opening to its end."""

    def __init__(self, transport: Transport, request_ids: Iterator[int], handle: Callable[[pb.ServerMessage], None]) -> None:
        """@param request_ids  Numbers of requests, the same for all connections of a client.
        @param handle  Called with every message that is not a response."""
        self._transport = transport
        self._request_ids = request_ids
        self._handle = handle
        self._responses: dict[int, asyncio.Future[pb.Response]] = {}
        self._loop = asyncio.get_running_loop()
        self._now = self._loop.time
        self._last_sent = self._last_received = self._now()
        self._closing: ConnectionLost | None = None
        # Besides cancelling tasks: until Python 3.12 wait_for() may swallow a cancellation.
        self._is_closed = False

    async def run(self) -> ConnectionLost:
        """Handles messages until the connection ends, and fails the requests that have no response then.

        @return why it ended.
        """
        tasks = [asyncio.ensure_future(self._receive()), asyncio.ensure_future(self._keep_open())]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            error = next(iter(done)).exception()
            if not isinstance(error, ConnectionLost):
                raise error or AssertionError("the session ended without an error")
            # What the gateway said of it explains more than the end of the connection.
            reason = self._closing or error
        finally:
            self._is_closed = True
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await self.close()
        self._fail(reason)
        return reason

    async def close(self) -> None:
        self._fail(ConnectionLost("the connection was closed"))
        await self._transport.close()

    @property
    def is_silent(self) -> bool:
        """True if the answer to a ping is late."""
        return self._now() - self._last_received > 2 * PING_PERIOD

    def next_request_id(self) -> int:
        return next(self._request_ids)

    async def request(self, timeout: float, request_id: int | None = None, **use_case: Any) -> pb.Response:
        """Sends a request and waits for its response.

        @param use_case  One field of Request's `use_case`: `stop=pb.Stop()`.
        @raise Refused  if the response is an error. @raise ConnectionLost. @raise Timeout
        """
        if asyncio.get_running_loop() is not self._loop:
            raise RuntimeError("this robot was connected in another event loop or, before a fork, in another process; "
                               "call connect() in this one")
        number = self.next_request_id() if request_id is None else request_id
        message = pb.Request(request_id=number, sent_at=self._now(), **use_case).SerializeToString()
        response: asyncio.Future[pb.Response] = self._loop.create_future()
        self._responses[number] = response
        try:
            answer = await within(timeout, self._exchange(message, response), "no answer within {timeout}")
        finally:
            self._responses.pop(number, None)
            response.cancel()
        if answer.error != pb.OK:
            raise refusal(answer)
        return answer

    async def _exchange(self, message: bytes, response: Awaitable[pb.Response]) -> pb.Response:
        self._last_sent = self._now()
        await self._transport.send(message)
        return await response

    async def _receive(self) -> None:
        while True:
            received = await self._transport.receive()
            self._last_received = self._now()
            message = _parse(received)
            if message.HasField("response"):
                response = self._responses.get(message.response.request_id)
                if response is not None and not response.done():
                    response.set_result(message.response)
                continue
            if message.HasField("notice") and message.notice.kind == pb.Notice.CLOSING:
                self._closing = ConnectionLost(message.notice.message, message.notice.reason_code,
                                               message.notice.reason_arguments)
            self._handle(message)

    async def _keep_open(self) -> None:
        while not self._is_closed:
            await asyncio.sleep(CHECK_PERIOD)
            if self._now() - self._last_received > SILENCE_TIMEOUT:
                raise ConnectionLost(f"the gateway has sent nothing for {SILENCE_TIMEOUT:g} s")
            if self._now() - self._last_sent > PING_PERIOD:
                self._last_sent = self._now()
                # Its response finds nobody who waits; it only shows that the gateway lives.
                ping = pb.Request(request_id=self.next_request_id(), ping=pb.Ping())
                try:
                    await asyncio.wait_for(self._transport.send(ping.SerializeToString()), SILENCE_TIMEOUT)
                except asyncio.TimeoutError as error:
                    raise ConnectionLost(f"the gateway has read nothing for {SILENCE_TIMEOUT:g} s") from error

    def _fail(self, error: ConnectionLost) -> None:
        for response in self._responses.values():
            if not response.done():
                response.set_exception(error)


def _parse(received: bytes) -> pb.ServerMessage:
    message = pb.ServerMessage()
    try:
        is_whole = message.ParseFromString(received) == len(received)
    except DecodeError:
        is_whole = False
    if not is_whole:
        raise ConnectionLost("the other end sent bytes that are not a message; is this port the gateway's?")
    return message
