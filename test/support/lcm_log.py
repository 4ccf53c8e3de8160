"""Reads LCM logs, as lcm-logger writes them."""

import struct
from collections import namedtuple

SYNC = 0xEDA1DA01
HEADER = struct.Struct(">IqqII")

# time: when it was received, microseconds since 1970; data: the encoded message.
Event = namedtuple("Event", "number time channel data")


def read_log(path):
    """Every whole event of a log, in order. One that was cut off at the end is left out."""
    content = path.read_bytes()
    events = []
    position = 0
    while position + HEADER.size <= len(content):
        sync, number, time, channel_size, data_size = HEADER.unpack_from(content, position)
        if sync != SYNC:
            raise ValueError(f"{path}: no event at byte {position}")
        start = position + HEADER.size
        middle = start + channel_size
        position = middle + data_size
        if position <= len(content):
            events.append(Event(number, time, content[start:middle].decode(), content[middle:position]))
    return events
