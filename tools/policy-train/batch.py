"""Many simulated robots that are stepped together, for the training of a policy: nao-batch-simulation, whose arrays are NumPy's.

    with Batch(model="t1", policy="policy.yaml", size=256) as batch:
        batch.reset()
        batch.actions[:] = 0
        batch.step()
        print(batch.observations, batch.reward_terms @ batch.weights({"velocity_tracking": 1.0}), batch.terminated)
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Mapping

import numpy as np

PROGRAM = Path(os.environ.get("NAO_BIN_DIR") or Path(__file__).resolve().parents[2] / "build/dev/bin") / "nao-batch-simulation"


class Batch:
    """The arrays are shared with the program: a step changes them, they are not copied.

    actions (size, num_actions), observations (size, num_observations), privileged (size, 9), reward_terms (size, num_terms):
    float32; terminated and truncated (size, 1): uint8. Where an episode has ended, the observation is the next one's first.
    """

    actions: Any
    observations: Any
    privileged: Any
    reward_terms: Any
    terminated: Any
    truncated: Any

    def __init__(self, *, policy: str | Path, size: int, **options: Any) -> None:
        """@param policy  A policy.yaml. @param options  Others of the program: model="nao", seed=1, command=(0.3, 0, 0).
        @throws RuntimeError  if the program ends; it says why on stderr."""
        self._file = tempfile.NamedTemporaryFile(prefix="nao-batch-", dir="/dev/shm" if os.path.isdir("/dev/shm") else None)
        command = [str(PROGRAM), "--policy", str(policy), "--memory", self._file.name, "--size", str(size)]
        for name, value in options.items():
            values = value if isinstance(value, (tuple, list)) else (value,)
            command += ["--" + name.replace("_", "-"), *(str(v) for v in values)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        try:
            description = json.loads(self._read())
        except RuntimeError:
            self.close()
            raise
        memory = np.memmap(self._file.name, mode="r+", dtype=np.uint8)
        for name, array in description["arrays"].items():
            setattr(self, name, np.ndarray(array["shape"], array["type"], memory, array["offset"]))
        self.size = size
        self.period: float = description["period"]
        self.term_names: list[str] = description["reward_terms"]
        self.reflections: dict[str, dict[str, list[float]]] = description["reflections"]

    def _read(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"nao-batch-simulation ended with exit status {self._process.wait()}")
        return line

    def _request(self, request: str) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(request + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # The next line says so.
        self._read()

    def reset(self) -> None:
        """Begins an episode of every robot."""
        self._request("reset")

    def step(self) -> None:
        """Moves every robot by its row of `actions` for one period of the policy."""
        self._request("step")

    def weights(self, weights: Mapping[str, float]) -> Any:
        """@return a vector of weights, (num_terms). @throws ValueError  for an unknown term."""
        unknown = set(weights) - set(self.term_names)
        if unknown:
            raise ValueError(f"unknown reward terms {sorted(unknown)}; there are {', '.join(self.term_names)}")
        return np.array([weights.get(name, 0.0) for name in self.term_names], np.float32)

    def close(self) -> None:
        """Ends the program."""
        with contextlib.suppress(BrokenPipeError):
            self._process.communicate()
        self._file.close()

    def __enter__(self) -> Batch:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()
