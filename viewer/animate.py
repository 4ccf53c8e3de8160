#!/usr/bin/env python3
"""Joins PNG images of one size into an animated one (APNG), which browsers show.

Usage: viewer/animate.py OUTPUT DELAY_MS IMAGE...
"""

import pathlib
import struct
import sys
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))
from output_file import replace_file  # noqa: E402

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_chunks(file):
    """Yields (type, content) of the chunks of a PNG file."""
    data = file.read_bytes()
    if not data.startswith(SIGNATURE):
        sys.exit(f"{file} is not a PNG file")
    at = len(SIGNATURE)
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + length]
        at += 12 + length


def chunk(kind, data):
    """An encoded chunk: length, type, content, CRC."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def animate(images, delay_ms):
    """The bytes of an APNG file that repeats the images for ever, each shown for `delay_ms`.

    Source of the format: W3C, "PNG specification (third edition)", 2025, section 11.3.6.
    """
    header = None
    palette = []
    body = []
    sequence = 0
    for index, image in enumerate(images):
        chunks = list(read_chunks(image))
        if header is None:
            header = chunks[0][1]
            palette = [chunk(kind, data) for kind, data in chunks if kind in (b"PLTE", b"tRNS")]
        elif chunks[0][1] != header:
            sys.exit(f"{image} differs from {images[0]} in size or color type")
        width, height = struct.unpack(">II", header[:8])
        body.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", sequence, width, height, 0, 0, delay_ms,
                                               1000, 0, 0)))
        sequence += 1
        pixels = b"".join(data for kind, data in chunks if kind == b"IDAT")
        if index == 0:
            body.append(chunk(b"IDAT", pixels))
        else:
            body.append(chunk(b"fdAT", struct.pack(">I", sequence) + pixels))
            sequence += 1
    control = chunk(b"acTL", struct.pack(">II", len(images), 0))
    return SIGNATURE + b"".join([chunk(b"IHDR", header), control, *palette, *body, chunk(b"IEND", b"")])


def main():
    if len(sys.argv) < 4 or not sys.argv[2].isdigit():
        sys.exit(__doc__.strip())
    images = [pathlib.Path(name) for name in sys.argv[3:]]
    replace_file(sys.argv[1], animate(images, int(sys.argv[2])))


if __name__ == "__main__":
    main()
