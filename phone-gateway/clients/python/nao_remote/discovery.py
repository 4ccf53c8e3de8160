"""Finding gateways without knowing their address.

A finder is a function that takes a time limit, s, and returns addresses as connect() accepts them. This is the place
for ways to search a network: add a function here to FINDERS, or register one from outside.
"""

from __future__ import annotations

import importlib
import os
import time
from typing import Any, Callable, Sequence

from nao_remote.address import URL_VARIABLE

Finder = Callable[[float], Sequence[str]]

# Used when nothing is found: the own host, where no token is needed.
DEFAULT_ADDRESS = "localhost"
# What gateways announce themselves as (DNS-SD, RFC 6763).
SERVICE_TYPE = "_nao-remote._tcp.local."
# Between two looks at what was found, s.
POLL_PERIOD = 0.05


def from_environment(_timeout: float) -> Sequence[str]:
    """The address in the environment variable NAO_REMOTE_URL."""
    url = os.environ.get(URL_VARIABLE, "")
    return [url] if url else []


def from_network(timeout: float) -> Sequence[str]:
    """Gateways that announce themselves in the local network, as tcp://HOST:PORT. Needs the package zeroconf (Debian:
    python3-zeroconf); without it, and without a network, none are found."""
    try:
        # By name, so that type checkers do not ask for it.
        zeroconf: Any = importlib.import_module("zeroconf")
    except ImportError:
        return []
    try:
        network = zeroconf.Zeroconf(ip_version=zeroconf.IPVersion.V4Only)
    except OSError:
        return []
    names: list[str] = []

    def changed(name: str, state_change: Any, **_others: Any) -> None:
        if state_change.name == "Added" and name not in names:
            names.append(name)

    found: dict[str, None] = {}
    try:
        browser = zeroconf.ServiceBrowser(network, SERVICE_TYPE, handlers=[changed])
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            time.sleep(min(POLL_PERIOD, timeout))
        browser.cancel()
        for name in names:
            info = network.get_service_info(SERVICE_TYPE, name, timeout=1000)
            port = (info.properties.get(b"tcp") or b"") if info else b""
            if info is not None and port.isdigit():
                found.update({f"tcp://{address}:{int(port)}": None for address in info.parsed_addresses(zeroconf.IPVersion.V4Only)})
    finally:
        network.close()
    return list(found)


# Asked by discover(), in this order.
FINDERS: list[Finder] = [from_environment, from_network]


def discover(timeout: float = 2.0) -> list[str]:
    """@return the addresses that all finders know, without duplicates. @param timeout  s, for each finder."""
    found: dict[str, None] = {}
    for finder in FINDERS:
        found.update(dict.fromkeys(finder(timeout)))
    return list(found)


def first_address(timeout: float = 2.0) -> str:
    """Where connect() without an address goes: to the environment's address, else to "localhost". Never to a robot that
    merely happens to be in the same network."""
    return next(iter(from_environment(timeout)), DEFAULT_ADDRESS)
