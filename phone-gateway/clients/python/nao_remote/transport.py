"""The two transports of the protocol: messages as bytes over a WebSocket or over TCP (PROTOCOL.md, section 1)."""

from __future__ import annotations

import asyncio
import os
import socket
import ssl
import struct
from typing import Any, Protocol

from nao_remote.address import Address
from nao_remote.errors import ConnectionLost

# Bytes of a message from the gateway: PROTOCOL.md promises less than 100 kB; ten times as much is an error of the sender.
MAX_MESSAGE = 1_000_000
# Time for an orderly end of a WebSocket, s. Chosen: a gateway that does not answer must not delay the caller.
CLOSE_TIMEOUT = 0.5


class Transport(Protocol):
    """A connection that carries whole messages. Both methods raise ConnectionLost when it has ended."""

    async def send(self, message: bytes) -> None: ...

    async def receive(self) -> bytes: ...

    async def close(self) -> None: ...


class TcpTransport:
    """Messages over TCP, each after its length (4 bytes, big-endian)."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader = reader
        self._writer = writer

    async def send(self, message: bytes) -> None:
        try:
            self._writer.write(struct.pack(">I", len(message)) + message)
            await self._writer.drain()
        except OSError as error:
            raise ConnectionLost(f"the connection was lost: {error}") from error

    async def receive(self) -> bytes:
        try:
            (length,) = struct.unpack(">I", await self._reader.readexactly(4))
            if length > MAX_MESSAGE:
                raise ConnectionLost(f"a message of {length} bytes is longer than {MAX_MESSAGE}; is this port the gateway's?")
            return await self._reader.readexactly(length)
        except ConnectionLost:
            raise
        except asyncio.IncompleteReadError as error:
            raise ConnectionLost("the gateway closed the connection") from error
        except OSError as error:
            raise ConnectionLost(f"the connection was lost: {error}") from error

    async def close(self) -> None:
        self._writer.close()
        try:
            await asyncio.wait_for(self._writer.wait_closed(), CLOSE_TIMEOUT)
        except (OSError, asyncio.TimeoutError):
            pass


class WebSocketTransport:
    """Messages as binary messages of a WebSocket, by the package websockets."""

    def __init__(self, connection: Any) -> None:
        self._connection = connection

    async def send(self, message: bytes) -> None:
        from websockets.exceptions import WebSocketException

        try:
            await self._connection.send(message)
        except (OSError, WebSocketException) as error:
            raise ConnectionLost(f"the connection was lost: {error}") from error

    async def receive(self) -> bytes:
        from websockets.exceptions import WebSocketException

        try:
            message = await self._connection.recv()
        except (OSError, WebSocketException) as error:
            raise ConnectionLost(f"the gateway closed the connection: {error}") from error
        if not isinstance(message, bytes):
            raise ConnectionLost("the other end sent a text message; is this address the gateway's?")
        return message

    async def close(self) -> None:
        await self._connection.close()


def tls_context(certificate: str | os.PathLike[str] | None) -> ssl.SSLContext:
    """@param certificate  PEM file: the gateway's own certificate (gateway-certificate.pem) or that of its authority, the
    only one that is trusted then; None: the system's authorities. The host's name is always compared."""
    return ssl.create_default_context(cafile=certificate)


async def open_transport(address: Address, certificate: str | os.PathLike[str] | None, timeout: float) -> Transport:
    """Opens a connection. @raise ConnectionLost  within `timeout` s if there is no gateway."""
    try:
        return await asyncio.wait_for(_open(address, certificate), timeout)
    except ConnectionLost:
        raise
    except asyncio.TimeoutError as error:
        raise ConnectionLost(f"no answer from {address} within {timeout:g} s") from error
    except ssl.SSLCertVerificationError as error:
        raise ConnectionLost(f"{address}: {error.verify_message}; name the gateway's certificate file "
                             "(certificate=\"gateway-certificate.pem\")") from error
    except OSError as error:
        raise ConnectionLost(f"no gateway at {address}: {error}; is it running?") from error


async def _open(address: Address, certificate: str | os.PathLike[str] | None) -> Transport:
    if address.transport == "tcp":
        reader, writer = await asyncio.open_connection(address.host, address.port)
        writer.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return TcpTransport(reader, writer)
    from websockets import connect
    from websockets.exceptions import WebSocketException
    from websockets.version import version

    # From version 15 on the package would ask the web's proxy, which knows no robot.
    options: dict[str, Any] = {"proxy": None} if int(version.split(".")[0]) >= 15 else {}
    context = tls_context(certificate) if address.transport == "wss" else None
    try:
        # The protocol has pings of its own, and images are compressed already.
        connection = await connect(
            address.websocket_url, ssl=context, max_size=MAX_MESSAGE, max_queue=8, ping_interval=None, compression=None,
            open_timeout=None, close_timeout=CLOSE_TIMEOUT, **options)
    except WebSocketException as error:
        raise ConnectionLost(f"no gateway at {address}: {error}") from error
    return WebSocketTransport(connection)
