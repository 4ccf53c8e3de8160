"""Many simulated robots that are stepped together, for the training of a policy: nao-batch-simulation, whose arrays are NumPy's.

VectorEnvironment is the same by the interface of https://gymnasium.farama.org.

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

try:
    from gymnasium.spaces import Box
    from gymnasium.vector import AutoresetMode, VectorEnv

    SAME_STEP = AutoresetMode.SAME_STEP
except ImportError:
    VectorEnv, SAME_STEP = object, "SameStep"

    class Box:  # type: ignore[no-redef]
        """Arrays of one shape and type with bounds: what is needed here of gymnasium.spaces.Box."""

        def __init__(self, low: float, high: float, shape: tuple[int, ...], dtype: Any) -> None:
            self.low, self.high = np.full(shape, low, dtype), np.full(shape, high, dtype)
            self.shape, self.dtype = shape, np.dtype(dtype)
            self.seed(None)

        def seed(self, seed: int | None) -> None:
            self._random = np.random.default_rng(seed)

        def sample(self) -> Any:
            """@return uniform numbers; normal ones without bounds."""
            if np.isfinite(self.high).all():
                return self._random.uniform(self.low, self.high).astype(self.dtype)
            return self._random.standard_normal(self.shape).astype(self.dtype)

        def contains(self, value: Any) -> bool:
            """@return whether an array has the shape, a type that fits, and is within the bounds."""
            fits = isinstance(value, np.ndarray) and value.shape == self.shape and np.can_cast(value.dtype, self.dtype)
            return fits and bool(((self.low <= value) & (value <= self.high)).all())

PROGRAM = Path(os.environ.get("NAO_BIN_DIR") or Path(__file__).resolve().parents[2] / "build/dev/bin") / "nao-batch-simulation"


class Batch:
    """The arrays are shared with the program: a step changes them, they are not copied.

    actions (size, num_actions), observations (size, num_observations), privileged (size, 9), reward_terms (size, num_terms):
    float32; terminated and truncated (size, 1): uint8. Where an episode has ended, the observation is the next one's first, and
    that of the end is in final_observations (size, num_observations).
    """

    actions: Any
    observations: Any
    final_observations: Any
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
        # Greatest output; without one infinity.
        self.action_clip: float = description["action_clip"] or np.inf
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

    def reset(self, seed: int | None = None) -> None:
        """Begins an episode of every robot. @param seed  Other robots: those of a batch made with this seed."""
        self._request("reset" if seed is None else f"reset {seed}")

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


class VectorEnvironment(VectorEnv):  # type: ignore[misc]
    """The robots of a Batch as a gymnasium.vector.VectorEnv, with or without Gymnasium.

        envs = VectorEnvironment({"velocity_tracking": 1.0}, model="t1", policy="policy.yaml", size=256)
        observations, infos = envs.reset(seed=1)
        observations, rewards, terminations, truncations, infos = envs.step(envs.action_space.sample())

    What reset and step return is shared with the program: the next step changes it. An episode that ends is followed by the next
    one in the same step; infos has `final_obs`, the observations of the end, and `_final_obs`, where one ended.
    """

    metadata = {"autoreset_mode": SAME_STEP, "render_modes": []}
    render_mode = None
    spec = None
    closed = False

    def __init__(self, weights: Mapping[str, float], **options: Any) -> None:
        """@param weights  Of the reward's terms, for a second. @param options  Of Batch.
        @throws RuntimeError, ValueError  as Batch and Batch.weights() do."""
        self.batch = Batch(**options)
        try:
            self._weights = self.batch.weights(weights) * self.batch.period
        except ValueError:
            self.batch.close()
            raise
        self.num_envs, num_observations = self.batch.observations.shape
        num_actions = self.batch.actions.shape[1]
        clip = self.batch.action_clip
        self.single_observation_space = Box(-np.inf, np.inf, (num_observations,), np.float32)
        self.observation_space = Box(-np.inf, np.inf, (self.num_envs, num_observations), np.float32)
        self.single_action_space = Box(-clip, clip, (num_actions,), np.float32)
        self.action_space = Box(-clip, clip, (self.num_envs, num_actions), np.float32)
        self._terminations = self.batch.terminated[:, 0].view(np.bool_)
        self._truncations = self.batch.truncated[:, 0].view(np.bool_)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins an episode of every robot. @param seed  Draws other robots; robot i has seed + i. @param options  None or empty.
        @throws ValueError  for any option."""
        if options:
            raise ValueError(f"unknown options {sorted(options)}: there are none")
        self.batch.reset(seed)
        return self.batch.observations, {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """@param actions  (num_envs, num_actions); batch.actions itself is not copied."""
        if actions is not self.batch.actions:
            self.batch.actions[:] = actions
        self.batch.step()
        rewards = self.batch.reward_terms @ self._weights
        ended = self._terminations | self._truncations
        infos = {"final_obs": self.batch.final_observations, "_final_obs": ended} if ended.any() else {}
        return self.batch.observations, rewards, self._terminations, self._truncations, infos

    def close(self, **_: Any) -> None:
        """Ends the program."""
        if not self.closed:
            self.closed = True
            self.batch.close()
