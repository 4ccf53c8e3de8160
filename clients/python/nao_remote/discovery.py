"""Finding gateways without knowing their address.

A finder is a function that takes a time limit, s, and returns addresses as connect() accepts them. This is the place
for ways to search a network: add a function here to FINDERS, or register one from outside.
"""

from __future__ import annotations

import os
from typing import Callable, Sequence

from nao_remote.address import URL_VARIABLE

Finder = Callable[[float], Sequence[str]]

# Used when nothing is found: the own host, where no token is needed.
DEFAULT_ADDRESS = "localhost"


def from_environment(_timeout: float) -> Sequence[str]:
    """The address in the environment variable NAO_REMOTE_URL."""
    url = os.environ.get(URL_VARIABLE, "")
    return [url] if url else []


# Asked in this order.
FINDERS: list[Finder] = [from_environment]


def discover(timeout: float = 2.0) -> list[str]:
    """@return the addresses that all finders know, without duplicates. @param timeout  s, for each finder."""
    found: dict[str, None] = {}
    for finder in FINDERS:
        found.update(dict.fromkeys(finder(timeout)))
    return list(found)


def first_address(timeout: float = 2.0) -> str:
    """@return the first address found, else "localhost"."""
    return next((address for finder in FINDERS for address in finder(timeout)), DEFAULT_ADDRESS)
