"""A batch whose robots are simulated by the processes of mpirun, on one or more machines. Needs python3-mpi4py.

The first process has all arrays and trains; the others simulate. The numbers are those of a Batch, with any number of processes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from batch import Batch
from mpi4py import MPI

RESULTS = ("observations", "final_observations", "privileged", "reward_terms", "terminated", "truncated")


class DistributedBatch(Batch):
    """A Batch with an equal share of the robots in each process. In the first one, arrays of all robots."""

    def __init__(self, *, size: int, seed: int, **options: Any) -> None:
        """@param size  Of all processes together. @throws ValueError  if it is no multiple of their number.
        @throws RuntimeError  as Batch does."""
        self._world = MPI.COMM_WORLD
        if size % self._world.size:
            raise ValueError(f"{size} robots cannot be shared equally by {self._world.size} processes: change `size` in "
                             "training.yaml")
        share = size // self._world.size
        super().__init__(size=share, seed=seed + share * self._world.rank, **options)
        self._share = {name: getattr(self, name) for name in ("actions", *RESULTS)}
        self.is_first = self._world.rank == 0
        if self.is_first:
            self.size = size
            for name, array in self._share.items():
                setattr(self, name, np.zeros((size, array.shape[1]), array.dtype))

    def _request(self, request: str) -> None:
        """In the first process: all processes answer, and their arrays are collected."""
        self._exchange(self._world.bcast(request))

    def _exchange(self, request: str) -> None:
        self._world.Scatter(self.actions if self.is_first else None, self._share["actions"])
        super()._request(request)
        for name in RESULTS:
            self._world.Gather(self._share[name], getattr(self, name) if self.is_first else None)

    def serve(self) -> None:
        """In the other processes: does what the first one asks for, until it closes the batch."""
        while request := self._world.bcast(""):
            self._exchange(request)
        super().close()

    def close(self) -> None:
        if self.is_first:
            self._world.bcast("")
        super().close()
