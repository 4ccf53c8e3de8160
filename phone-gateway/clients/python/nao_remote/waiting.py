"""Waiting for a limited time."""

from __future__ import annotations

import asyncio
from typing import Awaitable, TypeVar

from nao_remote.errors import Timeout

T = TypeVar("T")


async def within(timeout: float | None, awaitable: Awaitable[T], message: str) -> T:
    """As asyncio.wait_for(), which until Python 3.12 may swallow a cancellation: a walk would go on then.

    @param timeout  s; None: without end. @param message  Of Timeout, with "{timeout}" in it. @raise Timeout
    """
    task = asyncio.ensure_future(awaitable)
    try:
        await asyncio.wait([task], timeout=timeout)
        if not task.done():
            raise Timeout(message.format(timeout=f"{timeout:g} s"))
        return task.result()
    finally:
        task.cancel()
