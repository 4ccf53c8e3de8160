"""A simulation with Gymnasium's interface, for learning. Needs NumPy (Debian: python3-numpy); Gymnasium is optional.

    env = Environment(actions="joints")
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from nao_remote.errors import SimulationError
from nao_remote.simulation.messages import SimulationState
from nao_remote.simulation.spaces import Box, Env
from nao_remote.simulation.world import simulate

# A robot whose torso is lower than this fraction of its height at the reset has fallen. Chosen: below every crouch that a
# robot walks in, above every posture in which it lies.
FALLEN_HEIGHT = 0.6

Reward = Callable[[SimulationState, SimulationState], float]


def forward_speed(before: SimulationState, after: SimulationState) -> float:
    """The default reward: true velocity of the torso along the world's x axis, m/s, which is ahead at the reset."""
    assert before.truth is not None and after.truth is not None
    return (after.truth.torso_position[0] - before.truth.torso_position[0]) / (after.time - before.time)


class Environment(Env):  # type: ignore[misc]
    """A robot that is to be controlled.

    Observation, float32: joint positions and velocities (in the order of `simulation.description.joints`), accelerometer (3),
    gyroscope (3), orientation of the torso (w, x, y, z), foot forces, velocity of the torso (3, estimated). An episode is
    terminated when the robot has fallen, and truncated after `max_steps`. `info["state"]` is the whole SimulationState, with
    the truth.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, actions: str = "joints", *, ticks_per_step: int = 2, max_steps: int = 1000,
                 reward: Reward = forward_speed, posture: str = "", **options: Any) -> None:
        """@param actions  "joints": targets of all joints, rad; "walk": velocity of the walk (vx, vy, wz).
        @param ticks_per_step  Control ticks (10 ms) of a step. @param reward  From the states before and after a step.
        @param posture  At the reset. @param options  Others of simulate().
        """
        if actions not in ("joints", "walk"):
            raise SimulationError(f"actions {actions!r} is none of joints and walk")
        self.simulation = simulate(posture=posture, **options)
        description = self.simulation.description
        if actions == "joints":
            low = [joint.lower for joint in description.joints.values()]
            high = [joint.upper for joint in description.joints.values()]
        else:
            low = [description.min_vx, -description.max_vy, -description.max_wz]
            high = [description.max_vx, description.max_vy, description.max_wz]
        self.action_space = Box(np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32)
        size = len(self._observe(self.simulation.state))
        self.observation_space = Box(np.full(size, -np.inf, np.float32), np.full(size, np.inf, np.float32), dtype=np.float32)
        self._actions = actions
        self._ticks_per_step = ticks_per_step
        self._max_steps = max_steps
        self._reward = reward
        self._posture = posture
        self._random = np.random.default_rng()
        self._height = 0.0
        self._num_steps = 0
        self._is_ended = True

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """A new world. @param seed  Of the world, and of the worlds of later resets without a seed.
        @param options  None is known. @return observation and info."""
        if options:
            raise SimulationError(f"unknown options: {', '.join(options)}")
        if seed is None:
            seed = int(self._random.integers(2 ** 32))
        else:
            self._random = np.random.default_rng(seed)
        state = self.simulation.reset(seed, self._posture)
        assert state.truth is not None
        self._height = state.truth.torso_position[2]
        self._num_steps = 0
        self._is_ended = False
        return self._observe(state), {"state": state}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """@param action  Clipped to the action space. @return observation, reward, terminated, truncated, info."""
        if self._is_ended:
            raise SimulationError("the episode has ended; call reset() first")
        vector = np.asarray(action, np.float32)
        if vector.shape != self.action_space.shape or not np.all(np.isfinite(vector)):
            raise SimulationError(f"an action has {self.action_space.shape[0]} finite numbers")
        values = [float(value) for value in np.clip(vector, self.action_space.low, self.action_space.high)]
        before = self.simulation.state
        if self._actions == "walk":
            self.simulation.walk(*values)
        state = self.simulation.step(self._ticks_per_step, values if self._actions == "joints" else None, truth=True)
        assert state.truth is not None
        self._num_steps += 1
        terminated = state.truth.torso_position[2] < FALLEN_HEIGHT * self._height
        truncated = self._num_steps >= self._max_steps
        self._is_ended = terminated or truncated
        return self._observe(state), float(self._reward(before, state)), terminated, truncated, {"state": state}

    def render(self) -> None:
        """Nothing is drawn."""

    def close(self) -> None:
        """Ends the simulation."""
        self.simulation.close()

    @staticmethod
    def _observe(state: SimulationState) -> Any:
        return np.array([*state.joint_position, *state.joint_velocity, *state.accelerometer, *state.gyroscope,
                         *state.orientation_torso_in_world, *state.foot_force, *state.velocity_torso_in_heading], np.float32)
