#!/usr/bin/python3
"""Trains a policy in simulation, by PPO, and writes it as ONNX beside its manifest.

    python3 tools/policy-train/train_policy.py data/robots/t1/policies/NAME --minutes 90 --seed 1

The folder holds policy.yaml (docs/policies.md): what the policy sees and moves. An optional training.yaml beside it changes the
defaults below. Method: J. Schulman et al., "Proximal Policy Optimization Algorithms", 2017, with an adaptive learning rate and
a critic that sees more than the actor, as in N. Rudin et al., "Learning to Walk in Minutes", CoRL 2021, and networks that are
symmetric as the robot is (F. Abdolhosseini et al., "On Learning Symmetric Locomotion", MIG 2019). Needs python3-torch.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
from pathlib import Path
from typing import Any

# Small matrices: more threads are not faster, and wait in a loop for the simulation.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import torch
import yaml
from torch import nn

sys.path.insert(0, str(Path(__file__).resolve().parent))

from batch import Batch  # noqa: E402
from onnx_writer import read_mlp, write_mlp  # noqa: E402

CHECKPOINT = "training.pt"
# Rollouts in which the normalization of a policy without a checkpoint is measured. Chosen: several episodes of all robots.
MEASURED_ROLLOUTS = 8
# Weights of the reward's terms (tools/policy-train/reward_terms.h), for a second. Chosen; steps (gait, clearance) weigh as much
# as the velocity: with a quarter for steps and twice for the velocity a T1 shuffled, and fell ten times a minute after 13
# million steps.
WEIGHTS = {
    "walk": {"velocity_tracking": 3.0, "mean_velocity": 1.5, "turn_tracking": 1.0, "alive": 0.5, "gait": 2.0,
             "clearance": 20.0, "tilt": -5.0, "height": -20.0, "vertical_speed": -0.5, "tilt_rate": -0.05, "torque": -0.3,
             "joint_speed": -0.2, "joint_acceleration": -0.5, "action_rate": -3.0, "range": -10.0, "lateral_posture": -2.5,
             "posture": -0.1, "rest_posture": -10.0, "slip": -0.3, "sole_angle": -0.5, "foot_distance": -20.0,
             "fallen": -50.0},
    "get-up": {"standing": 3.0, "tilt": -2.0, "height": -6.0, "torque": -0.1, "joint_acceleration": -0.1, "action_rate": -1.0,
               "range": -5.0, "posture": -0.5},
}
# What is printed of a training beside its reward.
PROGRESS = {
    "walk": "tracking of the velocity {velocity_tracking:.2f}, {falls_per_minute:.2f} falls a minute",
    "get-up": "standing {standing:.2f}, pulled up by {assist:.2f} of the weight",
}
DEFAULTS: dict[str, Any] = {
    "hidden": [128, 128], "size": 384, "horizon": 32, "epochs": 4, "minibatches": 4, "discount": 0.99, "trace": 0.95,
    "clip": 0.2, "entropy": 0.001, "divergence": 0.01, "rate": 1e-3, "deviation": 0.5, "push": 0.0,
    "rest": 0.0, "assist": 0.6, "episode": 20.0, "disturbances": "default", "critic_first": 0,
}


def mlp(sizes: list[int]) -> nn.Sequential:
    """Fully connected layers with ELU between them."""
    layers: list[nn.Module] = []
    for n, m in zip(sizes, sizes[1:]):
        layers += [nn.Linear(n, m), nn.ELU()]
    return nn.Sequential(*layers[:-1])


class Reflection:
    """Mirror image of rows of numbers."""

    def __init__(self, *reflections: dict[str, list[float]]) -> None:
        """@param reflections  Of parts of a row, one after the other."""
        index: list[float] = []
        for reflection in reflections:
            index += [len(index) + i for i in reflection["index"]]
        self.index = torch.tensor(index, dtype=torch.long)
        self.sign = torch.tensor([sign for reflection in reflections for sign in reflection["sign"]])

    def __call__(self, rows: torch.Tensor) -> torch.Tensor:
        return rows[..., self.index] * self.sign


class Normalization:
    """Running mean and variance of rows and their mirror images."""

    def __init__(self, reflection: Reflection) -> None:
        size = len(reflection.sign)
        self.reflection = reflection
        self.mean, self.variance, self.count = torch.zeros(size), torch.ones(size), 1e-4

    def update(self, rows: torch.Tensor) -> None:
        rows = torch.cat([rows, self.reflection(rows)])
        mean, variance = rows.mean(0), rows.var(0, unbiased=False)
        total = self.count + len(rows)
        change = mean - self.mean
        share = len(rows) / total
        self.variance = (1 - share) * self.variance + share * variance + change ** 2 * share * (1 - share)
        self.mean = self.mean + change * share
        self.count = min(total, 1e7)

    def scale(self) -> torch.Tensor:
        return 1 / (self.variance.sqrt() + 1e-2)

    def __call__(self, rows: torch.Tensor) -> torch.Tensor:
        n = rows.shape[-1]
        return (rows - self.mean[:n]) * self.scale()[:n]


class Symmetric(nn.Module):
    """A network whose output for a mirror image is the mirror image of its output: the mean of both."""

    def __init__(self, network: nn.Sequential, reflect_input: Reflection, reflect_output: Reflection) -> None:
        super().__init__()
        self.network, self.reflect_input, self.reflect_output = network, reflect_input, reflect_output

    def forward(self, rows: torch.Tensor) -> torch.Tensor:
        both = self.network(torch.stack([rows, self.reflect_input(rows)]))
        return (both[0] + self.reflect_output(both[1])) / 2

    def layers(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Weights and biases of the same function as one network: its halves side by side."""
        linear = [layer for layer in self.network if isinstance(layer, nn.Linear)]
        pairs = [(layer.weight.detach(), layer.bias.detach()) for layer in linear]
        first, last = pairs[0], pairs[-1]
        # The weights for a reflected input: sign[i] input[index[i]] goes to column i.
        mirrored = torch.zeros_like(first[0])
        mirrored.index_add_(1, self.reflect_input.index, first[0] * self.reflect_input.sign)
        reflect = self.reflect_output
        layers = [(torch.cat([first[0], mirrored]), torch.cat([first[1], first[1]]))]
        layers += [(torch.block_diag(weight, weight), torch.cat([bias, bias])) for weight, bias in pairs[1:-1]]
        reflected = last[0][reflect.index] * reflect.sign[:, None]
        layers.append((torch.cat([last[0], reflected], 1) / 2, (last[1] + reflect(last[1])) / 2))
        return [(weight.numpy(), bias.numpy()) for weight, bias in layers]


class Trainer:
    """One training: networks, optimizer, and the batch of robots."""

    def __init__(self, batch: Batch, settings: dict[str, Any], weights: np.ndarray, seed: int) -> None:
        """@param batch, weights  As open_batch() gives them."""
        torch.manual_seed(seed)
        self.settings, self.batch = settings, batch
        self.weights = weights * batch.period
        num_observations = self.batch.observations.shape[1]
        num_actions = self.batch.actions.shape[1]
        reflections = self.batch.reflections
        reflect_state = Reflection(reflections["observations"], reflections["privileged"])
        network = mlp([num_observations, *settings["hidden"], num_actions])
        with torch.no_grad():
            network[-1].weight *= 0.01
        self.actor = Symmetric(network, Reflection(reflections["observations"]), Reflection(reflections["actions"]))
        self.critic = Symmetric(mlp([len(reflect_state.sign), *settings["hidden"], 1]), reflect_state,
                                Reflection({"index": [0], "sign": [1.0]}))
        self.deviation = nn.Parameter(torch.full((num_actions,), math.log(settings["deviation"])))
        self.normalize = Normalization(reflect_state)
        self.rate = settings["rate"]
        self.optimizer = torch.optim.Adam([*self.actor.parameters(), *self.critic.parameters(), self.deviation], lr=self.rate)
        self.num_iterations = 0
        self.num_samples = 0
        self.batch.reset()
        self.observe()

    def observe(self) -> None:
        self.state = torch.cat([torch.from_numpy(self.batch.observations), torch.from_numpy(self.batch.privileged)], 1)

    def actor_of(self, observations: torch.Tensor) -> torch.Tensor:
        return self.actor(self.normalize(observations))

    @torch.no_grad()
    def collect(self) -> dict[str, torch.Tensor]:
        """Moves the robots for `horizon` steps."""
        horizon, size = self.settings["horizon"], self.settings["size"]
        num_observations = self.batch.observations.shape[1]
        states, actions, logs, values, rewards, ends = [], [], [], [], [], []
        self.term_sum = np.zeros(len(self.batch.term_names))
        self.num_falls = 0
        deviation = self.deviation.exp()
        for _ in range(horizon):
            mean = self.actor_of(self.state[:, :num_observations])
            action = mean + deviation * torch.randn_like(mean)
            value = self.critic(self.normalize(self.state))[:, 0]
            states.append(self.state)
            actions.append(action)
            logs.append(torch.distributions.Normal(mean, deviation).log_prob(action).sum(1))
            values.append(value)
            self.batch.actions[:] = action.numpy()
            self.batch.step()
            self.observe()
            terminated = torch.from_numpy(self.batch.terminated[:, 0] != 0)
            truncated = torch.from_numpy(self.batch.truncated[:, 0] != 0)
            reward = torch.from_numpy(self.batch.reward_terms @ self.weights)
            # An episode whose time is over goes on, for the return.
            rewards.append(reward + self.settings["discount"] * value * truncated)
            ends.append(terminated | truncated)
            self.term_sum += self.batch.reward_terms.mean(0)
            self.num_falls += int(terminated.sum())
        value = self.critic(self.normalize(self.state))[:, 0]
        advantages, advantage = [], torch.zeros(size)
        for k in reversed(range(horizon)):
            goes_on = (~ends[k]).float()
            change = rewards[k] + self.settings["discount"] * goes_on * value - values[k]
            advantage = change + self.settings["discount"] * self.settings["trace"] * goes_on * advantage
            value = values[k]
            advantages.insert(0, advantage)
        rows = {"state": torch.cat(states), "action": torch.cat(actions), "log": torch.cat(logs),
                "advantage": torch.cat(advantages)}
        rows["return"] = rows["advantage"] + torch.cat(values)
        rows["mean"] = self.actor_of(rows["state"][:, :num_observations])
        self.mean_reward = float(torch.stack(rewards).mean()) / self.batch.period
        return rows

    def update(self, rows: dict[str, torch.Tensor]) -> None:
        settings = self.settings
        num_observations = self.batch.observations.shape[1]
        old_deviation = self.deviation.detach().exp()
        advantage = (rows["advantage"] - rows["advantage"].mean()) / (rows["advantage"].std() + 1e-8)
        count = len(advantage)
        for _ in range(settings["epochs"]):
            for index in torch.randperm(count).chunk(settings["minibatches"]):
                state, action = rows["state"][index], rows["action"][index]
                observation = state[:, :num_observations]
                mean = self.actor_of(observation)
                deviation = self.deviation.exp()
                normal = torch.distributions.Normal(mean, deviation)
                ratio = (normal.log_prob(action).sum(1) - rows["log"][index]).exp()
                gain = advantage[index]
                surrogate = torch.min(ratio * gain, ratio.clamp(1 - settings["clip"], 1 + settings["clip"]) * gain).mean()
                value_loss = (self.critic(self.normalize(state))[:, 0] - rows["return"][index]).pow(2).mean()
                loss = value_loss
                if self.num_iterations >= settings["critic_first"]:
                    loss = loss - surrogate - settings["entropy"] * normal.entropy().sum(1).mean()
                self.optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_([*self.actor.parameters(), *self.critic.parameters(), self.deviation], 1.0)
                self.optimizer.step()
                if self.num_iterations < settings["critic_first"]:
                    continue
                with torch.no_grad():
                    divergence = (torch.log(deviation / old_deviation) + (old_deviation ** 2 + (rows["mean"][index] - mean) ** 2)
                                  / (2 * deviation ** 2) - 0.5).sum(1).mean()
                    if divergence > 2 * settings["divergence"]:
                        self.rate = max(1e-5, self.rate / 1.5)
                    elif divergence < settings["divergence"] / 2:
                        self.rate = min(1e-2, self.rate * 1.5)
                    for group in self.optimizer.param_groups:
                        group["lr"] = self.rate

    def iterate(self) -> dict[str, float]:
        """Collects and learns once. @return what the log says of it."""
        rows = self.collect()
        self.update(rows)
        self.normalize.update(rows["state"])
        self.num_iterations += 1
        self.num_samples += len(rows["state"])
        terms = dict(zip(self.batch.term_names, self.term_sum / self.settings["horizon"]))
        return {"iteration": self.num_iterations, "samples": self.num_samples, "reward": self.mean_reward,
                "deviation": float(self.deviation.exp().mean()), "rate": self.rate,
                "falls_per_minute": self.num_falls / (len(rows["state"]) * self.batch.period / 60), **terms}

    def layers(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Weights and biases of the actor, for observations that are not normalized."""
        layers = self.actor.layers()
        n = self.batch.observations.shape[1]
        weight = layers[0][0] * self.normalize.scale()[:n].numpy()
        layers[0] = (weight, layers[0][1] - weight @ self.normalize.mean[:n].numpy())
        return layers

    @torch.no_grad()
    def adopt(self, layers: list[tuple[np.ndarray, np.ndarray]]) -> None:
        """Goes on from a policy that layers() gave. Its normalization is measured while it moves the robots.
        It may lack the last observations, whose weights begin at 0.
        @throws ValueError  for a policy of other actions or hidden layers, or of more observations."""
        linear = [layer for layer in self.actor.network if isinstance(layer, nn.Linear)]
        expected = [weight.shape for weight, _ in self.actor.layers()]
        lacking = expected[0][1] - layers[0][0].shape[1]
        if lacking > 0:
            layers = [(np.pad(layers[0][0], ((0, 0), (0, lacking))), layers[0][1]), *layers[1:]]
        given = [weight.shape for weight, _ in layers]
        if given != expected:
            raise ValueError(f"its layers have (outputs, inputs) {given}; this training's have {expected}")
        for k, (layer, (weight, bias)) in enumerate(zip(linear, layers)):
            rows, columns = layer.weight.shape
            last = 2 if k == len(linear) - 1 else 1
            layer.weight.copy_(last * torch.from_numpy(weight[:rows, :columns]))
            layer.bias.copy_(torch.from_numpy(bias[:rows]))
        first, n = linear[0], self.batch.observations.shape[1]
        weight, bias = first.weight.clone(), first.bias.clone()
        for _ in range(MEASURED_ROLLOUTS):
            first.weight.copy_(weight / self.normalize.scale()[:n])
            first.bias.copy_(bias + weight @ self.normalize.mean[:n])
            self.normalize.update(self.collect()["state"])
        first.weight.copy_(weight / self.normalize.scale()[:n])
        first.bias.copy_(bias + weight @ self.normalize.mean[:n])

    def save(self, file: Path) -> None:
        state = {"actor": self.actor.state_dict(), "critic": self.critic.state_dict(), "deviation": self.deviation.data,
                 "optimizer": self.optimizer.state_dict(), "rate": self.rate,
                 "normalization": (self.normalize.mean, self.normalize.variance, self.normalize.count),
                 "iterations": self.num_iterations, "samples": self.num_samples, "random": torch.get_rng_state()}
        temporary = file.with_suffix(".new")
        torch.save(state, temporary)
        temporary.replace(file)

    def load(self, file: Path) -> None:
        state = torch.load(file)
        self.actor.load_state_dict(state["actor"])
        self.critic.load_state_dict(state["critic"])
        self.deviation.data = state["deviation"]
        self.optimizer.load_state_dict(state["optimizer"])
        self.normalize.mean, self.normalize.variance, self.normalize.count = state["normalization"]
        self.rate, self.num_iterations, self.num_samples = state["rate"], state["iterations"], state["samples"]
        torch.set_rng_state(state["random"])


def read_settings(folder: Path) -> tuple[dict[str, Any], dict[str, float]]:
    """@return Settings and weights of the policy in a folder. Ends the program if a file is missing or wrong."""
    manifest, file = folder / "policy.yaml", folder / "training.yaml"
    if not manifest.exists():
        sys.exit(f"{manifest} is missing: docs/policies.md says what it holds")
    kind = yaml.safe_load(manifest.read_text()).get("kind")
    if kind not in WEIGHTS:
        sys.exit(f"{manifest}: kind {kind!r} cannot be trained, only {' and '.join(WEIGHTS)}")
    changes = yaml.safe_load(file.read_text()) or {} if file.exists() else {}
    weights = {**WEIGHTS[kind], **changes.pop("weights", {})}
    unknown = set(changes) - set(DEFAULTS)
    if unknown:
        sys.exit(f"{file}: unknown settings {sorted(unknown)}; there are {', '.join(DEFAULTS)}, weights")
    return {**DEFAULTS, **changes, "kind": kind}, weights


def open_batch(folder: Path, model: str, settings: dict[str, Any], weights: dict[str, float], seed: int,
               threads: int) -> tuple[Batch, np.ndarray]:
    """Under mpirun it returns in the first process only; the others simulate until that one ends.
    @return the robots and the weights of their reward's terms, for a second.
    @throws RuntimeError, ValueError  as Batch and Batch.weights() do."""
    options = {name: settings[name] for name in ("size", "disturbances", "push", "rest", "assist", "episode")}
    options |= {"policy": folder / "policy.yaml", "model": model, "seed": 1000 * seed, "threads": threads}
    if int(os.environ.get("OMPI_COMM_WORLD_SIZE", "1")) == 1:
        batch = Batch(**options)
        return batch, batch.weights(weights)
    from distributed_batch import DistributedBatch

    distributed = DistributedBatch(**options)
    row = distributed.weights(weights)
    if not distributed.is_first:
        distributed.serve()
        sys.exit()
    return distributed, row


def train(trainer: Trainer, folder: Path, options: argparse.Namespace) -> None:
    """Iterates until the time is over, or Ctrl-C, and writes what the folder receives."""
    begin = last = time.monotonic()

    def write() -> None:
        trainer.save(folder / CHECKPOINT)
        write_mlp(folder / "policy.onnx", trainer.layers())

    try:
        with open(folder / "training.log", "a" if options.resume else "w") as log:
            while trainer.num_iterations < options.iterations and time.monotonic() - begin < 60 * options.minutes:
                figures = trainer.iterate()
                figures["seconds"] = time.monotonic() - begin
                log.write(json.dumps({name: round(float(value), 6) for name, value in figures.items()}) + "\n")
                log.flush()
                if time.monotonic() - last < 30 and trainer.num_iterations > 1:
                    continue
                last = time.monotonic()
                print(f"{figures['seconds'] / 60:.1f} min, {trainer.num_samples / 1e6:.2f} million steps: reward "
                      f"{figures['reward']:.2f}, " + PROGRESS[trainer.settings["kind"]].format(**figures), flush=True)
                write()
    except KeyboardInterrupt:
        print("ended; --resume goes on")
    write()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help=f"holds policy.yaml; receives policy.onnx, training.log and {CHECKPOINT}")
    parser.add_argument("--model", default="t1", help="the robot (default: t1)")
    parser.add_argument("--seed", type=int, default=1, help="of networks and robots (default: 1)")
    parser.add_argument("--minutes", type=float, default=90.0, help="of the training (default: 90)")
    parser.add_argument("--iterations", type=int, default=1_000_000, help="at the most")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="of the simulation (default: all cores)")
    parser.add_argument("--resume", action="store_true", help=f"go on from {CHECKPOINT}")
    parser.add_argument("--deviation", type=float, help="of the actions from now on, with --resume: less, for a calmer policy")
    parser.add_argument("--start", type=Path, help="go on from this policy.onnx, of the same hidden layers; it may lack the last observations")
    options = parser.parse_args()
    settings, weights = read_settings(options.folder)
    if options.resume and not (options.folder / CHECKPOINT).exists():
        sys.exit(f"{options.folder / CHECKPOINT} is missing: there is no training to go on with")
    torch.set_num_threads(1)
    try:
        batch, row = open_batch(options.folder, options.model, settings, weights, options.seed, options.threads)
    except (RuntimeError, ValueError) as error:
        sys.exit(str(error))
    with batch:
        trainer = Trainer(batch, settings, row, options.seed)
        if options.resume:
            trainer.load(options.folder / CHECKPOINT)
            if options.deviation:
                trainer.deviation.data.fill_(math.log(options.deviation))
        elif options.start:
            try:
                trainer.adopt(read_mlp(options.start))
            except (OSError, ValueError) as error:
                sys.exit(f"{options.start}: {error}")
        train(trainer, options.folder, options)


if __name__ == "__main__":
    main()
