"""The robot's lights by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Mapping, Union

from nao_remote import remote_pb2 as pb

if TYPE_CHECKING:
    from nao_remote.aio import Robot
    from nao_remote.command import Command

# A color: "#ff8000", or red, green and blue, each 0 to 1.
Color = Union[str, "tuple[float, float, float]"]
# Default of timeouts for a light, s. Chosen: far above the 1.5 s after which the gateway reports that nothing answers.
LIGHT_TIMEOUT = 5.0


def to_rgb(color: Color) -> int:
    """@return a color as 0xRRGGBB. @raise ValueError  if it is none."""
    if isinstance(color, str):
        digits = color.removeprefix("#")
        if len(digits) != 6 or any(digit not in "0123456789abcdefABCDEF" for digit in digits):
            raise ValueError(f"{color!r} is not a color such as '#ff8000'")
        return int(digits, 16)
    parts = tuple(color)
    if len(parts) != 3 or any(not 0 <= part <= 1 for part in parts):
        raise ValueError(f"{color!r} is not red, green and blue, each 0 to 1")
    red, green, blue = (round(255 * part) for part in parts)
    return red << 16 | green << 8 | blue


def from_rgb(rgb: int) -> tuple[float, float, float]:
    """@return red, green and blue, each 0 to 1, of 0xRRGGBB."""
    return ((rgb >> 16 & 255) / 255, (rgb >> 8 & 255) / 255, (rgb & 255) / 255)


class Light:
    """One light of a connected robot."""

    def __init__(self, robot: Robot, name: str) -> None:
        self._robot = robot
        self.name = name

    async def color(self) -> tuple[float, float, float]:
        """@return red, green and blue that it shows, each 0 to 1."""
        return (await self._robot.state()).light_rgb[self.name]

    async def set(self, color: Color, duration: float = 0.0, *, timeout: float = LIGHT_TIMEOUT) -> Command:
        """Sets its color: "#ff8000", or red, green and blue, each 0 to 1.

        @param duration  s, after which it shows what it showed before; 0: until replaced.
        """
        return await self._robot.set_lights({self.name: color}, duration, timeout=timeout)


def make_request(colors: Mapping[str, Color], duration: float) -> pb.SetLights:
    """@raise ValueError  if a color is none."""
    return pb.SetLights(light_names=list(colors), light_rgb=[to_rgb(color) for color in colors.values()],
                        duration=duration)
