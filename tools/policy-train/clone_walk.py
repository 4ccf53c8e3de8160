#!/usr/bin/python3
"""Trains a small network to walk as the model-based walk does, and writes it as ONNX in the layout of unitree_rl_gym.

    python3 tools/policy-train/clone_walk.py data/robots/t1/policies/clone --seed 1

The network sees what such policies see: no velocity of the body, no contacts, one step of 20 ms. Method: DAgger (S. Ross,
G. Gordon, D. Bagnell, "A reduction of imitation learning and structured prediction to no-regret online learning", AISTATS
2011): the network moves the robot, the motion core says in each step what it would have done. Needs NumPy.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "build/dev/python"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import nao_remote  # noqa: E402
from onnx_writer import write_mlp  # noqa: E402
from output_file import replace_file  # noqa: E402

# Layout of unitree_rl_gym (deploy_real.py and configs/g1.yaml): scales of the observation, scale of the action.
ANGULAR_VELOCITY_SCALE = 0.25
COMMAND_SCALE = np.array([2.0, 2.0, 0.25])
VELOCITY_SCALE = 0.05
ACTION_SCALE = 0.25
# Duration of two steps of the model-based walk (gait.yaml), s; of a step of the network, s; ticks in it.
GAIT_PERIOD = 2 * 0.3888
STEP = 0.02
TICKS = 2
# Time after the walk command at which the network takes over, and of the first swing of the motion core, s; both measured.
START = 1.56
FIRST_SWING = 1.86
# Difference of the knees' targets that shows which leg swings, rad.
SWING = 0.1
# Greatest change of the command, m/s^2 and rad/s^2: as nao-motion ramps it.
RAMP = np.array([1.0, 1.0, 2.0])
# Commands that are trained: m/s, rad/s.
LOW = np.array([-0.15, -0.1, -0.4])
HIGH = np.array([0.55, 0.1, 0.4])
# Tilt at which an episode ends, and steps before it that are left out: nothing can be learned from them.
FALLEN = 0.4
NUM_LOST_STEPS = 15
BATCH = 256
LEG_JOINTS = [f"{side}_{joint}" for side in ("Left", "Right")
              for joint in ("Hip_Pitch", "Hip_Roll", "Hip_Yaw", "Knee_Pitch", "Ankle_Pitch", "Ankle_Roll")]


def gravity_of(orientation: tuple[float, ...]) -> np.ndarray:
    """Unit vector down in the torso's frame. @param orientation  Of the torso in the world, (w, x, y, z)."""
    w, x, y, z = orientation
    return np.array([2 * (w * y - x * z), -2 * (y * z + w * x), 2 * (x * x + y * y) - 1])


class Network:
    """Layers with ELU between them; inputs are standardised by the first layer."""

    def __init__(self, sizes: list[int], random: np.random.Generator) -> None:
        self.weights = [random.normal(0, np.sqrt(1 / n), (n, m)) for n, m in zip(sizes, sizes[1:])]
        self.biases = [np.zeros(m) for m in sizes[1:]]
        self.mean = np.zeros(sizes[0])
        self.deviation = np.ones(sizes[0])
        self._moments = [[np.zeros_like(p), np.zeros_like(p)] for p in self.weights + self.biases]
        self._num_updates = 0

    def run(self, observation: np.ndarray) -> np.ndarray:
        return self._forward(np.atleast_2d(observation))[-1]

    def _forward(self, observation: np.ndarray) -> list[np.ndarray]:
        values = [(observation - self.mean) / self.deviation]
        for k, (weight, bias) in enumerate(zip(self.weights, self.biases)):
            value = values[-1] @ weight + bias
            is_last = k == len(self.weights) - 1
            values.append(value if is_last else np.where(value > 0, value, np.expm1(np.minimum(value, 0))))
        return values

    def train(self, observation: np.ndarray, action: np.ndarray, rate: float) -> float:
        """One step of Adam on the mean squared error. @return the error."""
        values = self._forward(observation)
        error = values[-1] - action
        gradient = 2 * error / len(observation)
        gradients_w, gradients_b = [], []
        for k in reversed(range(len(self.weights))):
            gradients_w.insert(0, values[k].T @ gradient)
            gradients_b.insert(0, gradient.sum(0))
            if k > 0:
                gradient = (gradient @ self.weights[k].T) * np.where(values[k] > 0, 1, values[k] + 1)
        self._num_updates += 1
        for parameter, derivative, moment in zip(self.weights + self.biases, gradients_w + gradients_b, self._moments):
            moment[0] += 0.1 * (derivative - moment[0])
            moment[1] += 0.001 * (derivative ** 2 - moment[1])
            first = moment[0] / (1 - 0.9 ** self._num_updates)
            second = moment[1] / (1 - 0.999 ** self._num_updates)
            parameter -= rate * first / (np.sqrt(second) + 1e-8)
        return float((error ** 2).mean())

    def layers(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Weights (outputs x inputs) and biases, for inputs that are not standardised."""
        first = self.weights[0] / self.deviation[:, None]
        biases = [self.biases[0] - self.mean @ first, *self.biases[1:]]
        return [(weight.T, bias) for weight, bias in zip([first, *self.weights[1:]], biases)]


@dataclass
class Episode:
    """What one walk gave."""

    observations: list[np.ndarray] = field(default_factory=list)
    actions: list[np.ndarray] = field(default_factory=list)
    duration: float = 0.0
    has_fallen: bool = False
    way: np.ndarray = field(default_factory=lambda: np.zeros(2))


class Course:
    """One simulated robot that is driven by the motion core and by a network."""

    def __init__(self, model: str, disturbances: str) -> None:
        self.world = nao_remote.simulate(model=model, disturbances=disturbances)
        names = list(self.world.description.joints)
        self.legs = [names.index(name) for name in LEG_JOINTS]
        self.knees = [names.index("Left_Knee_Pitch"), names.index("Right_Knee_Pitch")]
        self.default = np.zeros(len(LEG_JOINTS))

    def find_default(self) -> None:
        """The default angles are those in which the motion core begins to step."""
        self.world.reset(1)
        self.world.walk(0.001)
        state = self.world.run(START)
        self.default = np.round(np.array(state.motion_target)[self.legs], 4)

    def observe(self, state: nao_remote.SimulationState, command: np.ndarray, action: np.ndarray, phase: float) -> np.ndarray:
        angle = np.array(state.joint_position)[self.legs] - self.default
        speed = np.array(state.joint_velocity)[self.legs]
        return np.concatenate([
            np.array(state.gyroscope) * ANGULAR_VELOCITY_SCALE, gravity_of(state.orientation_torso_in_world),
            command * COMMAND_SCALE, angle, speed * VELOCITY_SCALE, action,
            [np.sin(2 * np.pi * phase), np.cos(2 * np.pi * phase)]])

    def walk(self, seed: int, network: Network | None, duration: float, random: np.random.Generator, noise: float = 0.0,
             command: np.ndarray | None = None, has_free_clock: bool = False) -> Episode:
        """@param network  None: the motion core moves the robot. @param noise  Added to the targets, rad.
        @param command  None: a new one every 3 s. @param has_free_clock  The phase follows no step of the motion core."""
        episode = Episode()
        self.world.reset(seed)
        self.world.walk(0.001)
        self.world.run(START)
        present, goal = np.zeros(3), np.zeros(3)
        action = np.zeros(len(LEG_JOINTS))
        phase = 1 - (FIRST_SWING - START) / GAIT_PERIOD
        start_phase = phase
        swing, swing_time = 0, 0.0
        state = self.world.state
        begin = None
        for i in range(round(duration / STEP)):
            t = i * STEP
            if command is not None:
                goal = command
            elif i % 150 == 0:
                goal = np.where(random.random(3) < 0.3, 0, random.uniform(LOW, HIGH))
            change = np.clip(goal - present, -RAMP * STEP, RAMP * STEP)
            present = present + change
            sent = present if np.any(np.abs(present) > 1e-3) else np.array([1e-3, 0, 0])
            if i == 0 or np.any(change != 0):
                self.world.walk(*sent)
            # The leg that swings in the motion core's targets begins a half of the gait.
            target = np.array(state.motion_target)
            difference = target[self.knees[0]] - target[self.knees[1]]
            now = 1 if difference > SWING else -1 if difference < -SWING else swing
            if now != swing:
                swing, swing_time = now, t
            if has_free_clock or swing == 0:
                phase = (start_phase + t / GAIT_PERIOD) % 1
            else:
                phase = (0.5 if swing > 0 else 0.0) + 0.5 * min((t - swing_time) / (GAIT_PERIOD / 2), 0.999)
            observation = self.observe(state, present, action, phase)
            label = (target[self.legs] - self.default) / ACTION_SCALE
            episode.observations.append(observation)
            episode.actions.append(label)
            action = label if network is None else network.run(observation)[0]
            moved = target.copy()
            moved[self.legs] = self.default + ACTION_SCALE * action + random.normal(0, noise, len(self.legs))
            # The arms stay as they are when the walk begins.
            if begin is None:
                held = target.copy()
            others = [k for k in range(len(target)) if k not in self.legs]
            moved[others] = held[others]
            state = self.world.step(TICKS, [float(x) for x in moved], truth=True)
            begin = np.array(state.truth.torso_position[:2]) if begin is None else begin
            episode.way = np.array(state.truth.torso_position[:2]) - begin
            episode.duration = t + STEP
            if np.arccos(np.clip(-gravity_of(state.truth.torso_orientation)[2], -1, 1)) > FALLEN:
                episode.has_fallen = True
            if episode.has_fallen or state.mode != nao_remote.Mode.WALKING:
                episode.has_fallen = True
                del episode.observations[-NUM_LOST_STEPS:], episode.actions[-NUM_LOST_STEPS:]
                break
        return episode


def write_manifest(file: Path, default: np.ndarray, command: str) -> None:
    """Describes the network in nao-motion's words (docs/policies.md)."""
    joints = "\n".join(f"  - {{name: {name}, default: {angle:g}}}" for name, angle in zip(LEG_JOINTS, default))
    limits = ", ".join(f"{name}: [{low:g}, {high:g}]" for name, low, high in zip(("vx", "vy", "wz"), LOW, HIGH))
    replace_file(file, f"""# Imitates the model-based walk, in the layout of unitree_rl_gym. Made by
#   {command}
kind: walk
network: policy.onnx
source: trained by tools/policy-train
rate: {1 / STEP:g}
observations:
  - {{quantity: angular_velocity, scale: {ANGULAR_VELOCITY_SCALE:g}}}
  - {{quantity: projected_gravity}}
  - {{quantity: velocity_command, scale: {COMMAND_SCALE.tolist()}}}
  - {{quantity: joint_position}}
  - {{quantity: joint_velocity, scale: {VELOCITY_SCALE:g}}}
  - {{quantity: last_action}}
  - {{quantity: phase_sine}}
  - {{quantity: phase_cosine}}
phase: {{frequency: {1 / GAIT_PERIOD:.5g}, start: {1 - (FIRST_SWING - START) / GAIT_PERIOD:.3g}}}
action: {{scale: {ACTION_SCALE:g}}}
joints:
{joints}
command: {{{limits}}}
""")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="receives policy.onnx; the default angles are printed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--model", default="t1")
    parser.add_argument("--disturbances", default="default")
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--episodes", type=int, default=8, help="in a round")
    parser.add_argument("--duration", type=float, default=12.0, help="of an episode, s")
    parser.add_argument("--updates", type=int, default=3000, help="of the network in a round")
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    course = Course(options.model, options.disturbances)
    course.find_default()
    print("default angles:", dict(zip(LEG_JOINTS, course.default.tolist())), flush=True)
    network = Network([3 + 3 + 3 + 3 * len(LEG_JOINTS) + 2, 128, 128, len(LEG_JOINTS)], random)
    options.folder.mkdir(parents=True, exist_ok=True)
    write_manifest(options.folder / "policy.yaml", course.default,
                   f"tools/policy-train/clone_walk.py {options.folder} --seed {options.seed} --rounds {options.rounds} "
                   f"--episodes {options.episodes} --duration {options.duration:g} --updates {options.updates}")
    observations, actions = np.zeros((0, network.weights[0].shape[0])), np.zeros((0, len(LEG_JOINTS)))
    for i in range(options.rounds):
        begin = time.monotonic()
        episodes = [course.walk(1000 * options.seed + i * options.episodes + k, None if i == 0 else network, options.duration,
                                random, noise=0.03 if i == 0 else 0.005 * (k % 3)) for k in range(options.episodes)]
        observations = np.concatenate([observations, *[np.array(e.observations) for e in episodes if e.observations]])
        actions = np.concatenate([actions, *[np.array(e.actions) for e in episodes if e.actions]])
        if i == 0:
            network.mean, network.deviation = observations.mean(0), observations.std(0) + 0.02
        errors = []
        for k in range(options.updates):
            rate = 1e-3 * (0.1 if k > 0.7 * options.updates else 1) * (0.5 if i > 0.6 * options.rounds else 1)
            batch = random.integers(0, len(observations), BATCH)
            errors.append(network.train(observations[batch], actions[batch], rate))
        write_mlp(options.folder / "policy.onnx", network.layers())
        print(f"round {i}: {len(observations)} steps, {sum(e.has_fallen for e in episodes)} of {len(episodes)} fell, mean "
              f"{np.mean([e.duration for e in episodes]):.1f} s, error {np.mean(errors[-200:]):.4f}, "
              f"{time.monotonic() - begin:.0f} s", flush=True)
    # Seeds that were not trained on.
    for velocity in ((0.001, 0, 0), (0.3, 0, 0), (0.5, 0, 0), (0, 0, 0.3)):
        ends = [course.walk(900000 + k, network, 10.0, random, command=np.array(velocity), has_free_clock=True) for k in range(5)]
        print(f"command {velocity}: {sum(e.has_fallen for e in ends)} of {len(ends)} fell, way "
              f"{np.mean([np.linalg.norm(e.way) for e in ends]):.2f} m in {np.mean([e.duration for e in ends]):.1f} s", flush=True)


if __name__ == "__main__":
    main()
