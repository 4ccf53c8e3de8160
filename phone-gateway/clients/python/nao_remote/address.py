"""Where the gateway is, and the token for it."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

# Ports of nao-phone-gateway.
HTTP_PORT = 8080
TCP_PORT = 7668

# Environment variables.
URL_VARIABLE = "NAO_REMOTE_URL"
TOKEN_VARIABLE = "NAO_REMOTE_TOKEN"

_TRANSPORTS = {"": "ws", "ws": "ws", "http": "ws", "wss": "wss", "https": "wss", "tcp": "tcp"}


@dataclass(frozen=True)
class Address:
    """Address of a gateway."""

    host: str
    port: int
    # "ws", "wss" (with TLS) or "tcp" (PROTOCOL.md, section 1).
    transport: str
    token: str = ""

    @staticmethod
    def parse(text: str) -> Address:
        """Reads an address.

        @param text  A host (`nao.local`), with a port if it is not the usual one (`nao.local:8081`), or a URL: the one
                     that the gateway prints (`http://HOST:8080/#token=TOKEN`), `ws://`, `wss://`, `https://` or
                     `tcp://HOST:7668`. IPv6 addresses stand in brackets.
        @raise ValueError  if it is none of these.
        """
        stripped = text.strip()
        parts = urlsplit(stripped if "://" in stripped else f"//{stripped}")
        try:
            port = parts.port
        except ValueError as error:
            raise ValueError(f"address {text!r}: {error}") from error
        if parts.scheme not in _TRANSPORTS:
            raise ValueError(f"address {text!r}: {parts.scheme!r} is none of http, https, ws, wss and tcp")
        if not parts.hostname:
            raise ValueError(f"address {text!r} has no host; write nao.local, or http://HOST:{HTTP_PORT}")
        transport = _TRANSPORTS[parts.scheme]
        token = parse_qs(parts.fragment).get("token", [""])[0]
        return Address(parts.hostname, port or (TCP_PORT if transport == "tcp" else HTTP_PORT), transport, token)

    @property
    def authority(self) -> str:
        """HOST:PORT, with an IPv6 address in brackets."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

    @property
    def websocket_url(self) -> str:
        return f"{self.transport}://{self.authority}/ws"

    def __str__(self) -> str:
        """Without the token: it is for logs and error messages."""
        return f"{self.transport}://{self.authority}"


def resolve(address: str, token: str | None = None, token_file: str | os.PathLike[str] | None = None) -> Address:
    """@return the address with its token: the argument, else the file's first line, else the address's own, else the
    environment variable NAO_REMOTE_TOKEN, else none, which is enough on the gateway's own host.

    @raise ValueError  if the address cannot be read. @raise OSError  if the file cannot be read.
    """
    parsed = Address.parse(address)
    if token is None and token_file is not None:
        lines = Path(token_file).read_text(encoding="utf-8").splitlines()
        token = lines[0].strip() if lines else ""
    if token is None:
        token = parsed.token or os.environ.get(TOKEN_VARIABLE, "")
    return replace(parsed, token=token)
