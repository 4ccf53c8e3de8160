"""Reads LCM logs, as lcm-logger writes them."""

import struct
from collections import namedtuple

SYNC = 0xEDA1DA01
HEADER = struct.Struct(">IqqII")

# time: time of reception, microseconds since 1970; data: the encoded message.
Event = namedtuple("Event", "number time channel data")


def read_log(path):
    """Every whole event of a log, in order. A truncated last event is skipped."""
    return list(read_events(path))


def read_events(path):
    """The events of read_log() one by one, for logs that are large."""
    with open(path, "rb") as file:
        while len(header := file.read(HEADER.size)) == HEADER.size:
            sync, number, time, channel_size, data_size = HEADER.unpack(header)
            if sync != SYNC:
                raise ValueError(f"{path}: no event at byte {file.tell() - HEADER.size}")
            channel = file.read(channel_size)
            data = file.read(data_size)
            if len(data) < data_size:
                return
            yield Event(number, time, channel.decode(), data)


def write_log(path, events):
    """Writes events as a log."""
    with open(path, "wb") as file:
        for event in events:
            channel = event.channel.encode()
            file.write(HEADER.pack(SYNC, event.number, event.time, len(channel), len(event.data)) + channel + event.data)
