"""The one space that environments here need: Gymnasium's Box, or a small one with the same interface without Gymnasium."""

from __future__ import annotations

from typing import Any

import numpy as np

try:
    from gymnasium import Env as Env
    from gymnasium.spaces import Box as Box
except ImportError:

    class Env:  # type: ignore[no-redef]
        """Stands for gymnasium.Env."""

        metadata: dict[str, Any] = {}
        render_mode: str | None = None
        spec: Any = None

        @property
        def unwrapped(self) -> Any:
            return self

    class Box:  # type: ignore[no-redef]
        """Vectors within bounds: what users of gymnasium.spaces.Box call most."""

        def __init__(self, low: Any, high: Any, dtype: Any = np.float32, seed: int | None = None) -> None:
            self.dtype = np.dtype(dtype)
            self.low = np.asarray(low, self.dtype)
            self.high = np.asarray(high, self.dtype)
            self.shape = self.low.shape
            self.seed(seed)

        def seed(self, seed: int | None = None) -> None:
            """Makes the sequence of samples anew."""
            self._random = np.random.default_rng(seed)

        def sample(self) -> Any:
            """@return a vector within the bounds, uniform; normal where a bound is infinite."""
            normal = self._random.normal(size=self.shape)
            is_bounded = np.isfinite(self.low) & np.isfinite(self.high)
            low, high = np.where(is_bounded, self.low, 0), np.where(is_bounded, self.high, 1)
            values = np.where(is_bounded, self._random.uniform(low, high), np.clip(normal, self.low, self.high))
            return values.astype(self.dtype)

        def contains(self, value: Any) -> bool:
            return (isinstance(value, np.ndarray) and value.shape == self.shape and np.can_cast(value.dtype, self.dtype)
                    and bool(np.all(value >= self.low)) and bool(np.all(value <= self.high)))

        def __contains__(self, value: Any) -> bool:
            return self.contains(value)

        def __repr__(self) -> str:
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"
