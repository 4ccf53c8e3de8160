"""Streams with bounded memory: the newest value only, or the last events."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import AsyncIterator, Callable, Deque, Generic, TypeVar

from nao_remote.errors import Timeout
from nao_remote.waiting import within

T = TypeVar("T")


class Stream(AsyncIterator[T], Generic[T]):
    """Values as they arrive. If they arrive faster than they are read, only the newest `capacity` are kept.

    A stream goes on after the client has connected again. Close it when it is no longer needed, so that the gateway stops
    sending: `with robot.states() as states:`.
    """

    def __init__(self, what: str, capacity: int, timeout: float | None, on_close: Callable[[Stream[T]], None],
                 is_interrupted: Callable[[], bool]) -> None:
        """@param what  What it waits for, for the error message. @param timeout  s; None: without end.
        @param is_interrupted  True during an outage of the connection, which iterating outlasts."""
        self._what = what
        self._values: Deque[T] = deque(maxlen=capacity)
        self._timeout = timeout
        self._on_close = on_close
        self._is_interrupted = is_interrupted
        self._changed = asyncio.Event()
        self._error: Exception | None = None
        # Values that were replaced before they were read.
        self.num_skipped = 0

    def __aiter__(self) -> Stream[T]:
        return self

    async def __anext__(self) -> T:
        """@raise Timeout  if no value arrives in time although there is a connection.
        @raise Closed  if the client has given up connecting.
        @raise StopAsyncIteration  after close()."""
        return await self.read()

    async def read(self) -> T:
        """As iterating."""
        while True:
            # The time counts from the reconnection on.
            was_interrupted = self._is_interrupted()
            try:
                return await self.next(self._timeout)
            except Timeout:
                if not was_interrupted and not self._is_interrupted():
                    raise

    async def next(self, timeout: float | None) -> T:
        """As __anext__, with another timeout, which holds during an outage, too."""
        if not self._values and self._error is None:
            self._changed.clear()
            await within(timeout, self._changed.wait(), f"no {self._what} within {{timeout}}")
        if self._values:
            return self._values.popleft()
        assert self._error is not None
        raise self._error

    def __enter__(self) -> Stream[T]:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the stream."""
        if not isinstance(self._error, StopAsyncIteration):
            self._error = StopAsyncIteration()
            self._values.clear()
            self._changed.set()
            self._on_close(self)

    def put(self, value: T) -> None:
        if isinstance(self._error, StopAsyncIteration):
            return
        if len(self._values) == self._values.maxlen:
            self.num_skipped += 1
        self._values.append(value)
        self._changed.set()

    def fail(self, error: Exception) -> None:
        """The values that are left are still read; then the error is raised."""
        if self._error is None:
            self._error = error
            self._changed.set()
