"""The one subscription of a client, made from the streams that are open."""

from __future__ import annotations

import asyncio
from typing import Any

from nao_remote import remote_pb2 as pb
from nao_remote.connection import Connection
from nao_remote.errors import ConnectionLost, InvalidArgument, NaoError, Refused
from nao_remote.messages import Image, State
from nao_remote.streams import Stream

# Width of images where the request names none, pixels (remote.proto, ImageRequest).
DEFAULT_WIDTH = 320


class Subscription:
    """Keeps the gateway's subscription at what the open streams need, also after connecting again."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._states: dict[Stream[State], float] = {}
        self._images: dict[Stream[Image], float] = {}
        self._image = pb.ImageRequest()
        self._sent = pb.Subscribe()
        self._sending: asyncio.Task[None] | None = None
        # Streams that were opened after the last subscription that the gateway accepted.
        self._unconfirmed: set[Stream[Any]] = set()

    def add_states(self, stream: Stream[State], rate: float) -> None:
        self._states[stream] = rate
        self._add(stream)

    def add_images(self, stream: Stream[Image], rate: float, image: pb.ImageRequest) -> None:
        """@raise InvalidArgument  if a stream with another camera or size is open."""
        if self._images and image != self._image:
            raise InvalidArgument(f"a stream of {_describe(self._image)} is open; close it before one of {_describe(image)}")
        self._images[stream] = rate
        self._image = image
        self._add(stream)

    def remove(self, stream: Stream[Any]) -> None:
        self._states.pop(stream, None)
        self._images.pop(stream, None)
        self._unconfirmed.discard(stream)
        self._update()

    def handle_connected(self) -> None:
        """The gateway knows of no subscription any more."""
        self._sent = pb.Subscribe()
        self._update()

    def put_state(self, state: State) -> None:
        for stream in self._states:
            stream.put(state)

    def put_image(self, image: Image) -> None:
        # For a moment the gateway may still send what the subscription before this one wanted.
        is_wanted = image.width == (self._image.width or DEFAULT_WIDTH) and self._image.camera in ("", image.camera)
        for stream in self._images if is_wanted else ():
            stream.put(image)

    def fail(self, error: NaoError) -> None:
        streams: list[Stream[Any]] = [*self._states, *self._images]
        for stream in streams:
            stream.fail(error)

    def _add(self, stream: Stream[Any]) -> None:
        self._unconfirmed.add(stream)
        if self._connection.end is not None:
            stream.fail(self._connection.end)
        self._update()

    def _wanted(self) -> pb.Subscribe:
        wanted = pb.Subscribe(state_rate=max(self._states.values(), default=0),
                              image_rate=max(self._images.values(), default=0))
        if self._images:
            wanted.image.CopyFrom(self._image)
        return wanted

    def _update(self) -> None:
        if self._connection.is_connected and (self._sending is None or self._sending.done()):
            self._sending = asyncio.ensure_future(self._send())

    async def _send(self) -> None:
        while (wanted := self._wanted()) != self._sent:
            opened = set(self._unconfirmed)
            try:
                await self._connection.request(subscribe=wanted)
            except ConnectionLost:
                # The next connection subscribes anew.
                return
            except NaoError as error:
                if not isinstance(error, Refused) or not opened:
                    return
                for stream in opened:
                    self._states.pop(stream, None)
                    self._images.pop(stream, None)
                    stream.fail(error)
                self._unconfirmed -= opened
                continue
            self._unconfirmed -= opened
            self._sent = wanted
        self._unconfirmed.clear()


def _describe(image: pb.ImageRequest) -> str:
    return f"camera {image.camera or 'default'}, {image.width or DEFAULT_WIDTH} pixels, quality {image.quality or 'default'}"
