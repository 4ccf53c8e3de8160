"""What a robot has, by name."""

from __future__ import annotations

from typing import Callable, Collection, Iterator, Mapping, TypeVar

T = TypeVar("T")


class ByName(Mapping[str, T]):
    """The joints or lights of the robot that is watched: `robot.joints["HeadYaw"]`."""

    def __init__(self, noun: str, names: Callable[[], Collection[str]], make: Callable[[str], T]) -> None:
        """@param noun  For errors: "joint". @param names  All names now. @param make  Makes the one of a name."""
        self._noun = noun
        self._names = names
        self._make = make

    def __getitem__(self, name: str) -> T:
        if name not in self._names():
            raise KeyError(f"the robot has no {self._noun} {name!r}; it has {', '.join(self._names())}")
        return self._make(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())
