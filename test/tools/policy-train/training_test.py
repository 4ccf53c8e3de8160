"""The batch of robots in Python, and a short training, which needs python3-torch."""

from __future__ import annotations

import contextlib
import enum
import importlib
import importlib.util
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/policy-train"))
sys.path.insert(0, str(ROOT / "test/support"))

import batch  # noqa: E402
from open_mpi import MPI_ENVIRONMENT  # noqa: E402

POLICY = ROOT / "data/robots/t1/policies/trained-walk/policy.yaml"

try:
    import torch
except ImportError:
    torch = None  # type: ignore[assignment]


class BatchTest(unittest.TestCase):
    def test_arrays_are_shared(self) -> None:
        with batch.Batch(policy=POLICY, size=3, model="t1", seed=5, command=(0.2, 0, 0)) as robots:
            robots.reset()
            before = robots.observations.copy()
            np.testing.assert_allclose(before[:, 6:9], [[0.2, 0, 0]] * 3, rtol=1e-6)
            robots.actions[1] = 0.5
            for _ in range(10):
                robots.step()
            self.assertFalse(np.array_equal(before, robots.observations))
            weights = robots.weights({"alive": 2.0})
            np.testing.assert_array_equal(robots.reward_terms @ weights, [2.0] * 3)
            with self.assertRaisesRegex(ValueError, "unknown reward terms.*speed.*alive"):
                robots.weights({"speed": 1.0})

    def test_a_wrong_policy_is_an_error(self) -> None:
        with self.assertRaisesRegex(RuntimeError, "exit status 1"):
            batch.Batch(policy="/nonexistent/policy.yaml", size=1)

    def test_an_unknown_request_ends_the_program(self) -> None:
        with tempfile.NamedTemporaryFile() as memory:
            run = subprocess.run([batch.PROGRAM, "--policy", POLICY, "--memory", memory.name, "--size", "1"], input="jump\n",
                                 capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn('unknown request "jump"', run.stderr)


def stand_in_gymnasium() -> dict[str, types.ModuleType]:
    """@return Modules with the names of Gymnasium 1.1 that batch.py imports."""

    class VectorEnv:
        def step(self, actions: Any) -> Any:
            raise NotImplementedError

    modes = enum.Enum("AutoresetMode", {"NEXT_STEP": "NextStep", "SAME_STEP": "SameStep", "DISABLED": "Disabled"})
    modules = {name: types.ModuleType(name) for name in ("gymnasium", "gymnasium.spaces", "gymnasium.vector")}
    modules["gymnasium.spaces"].Box = batch.Box  # type: ignore[attr-defined]
    modules["gymnasium.vector"].VectorEnv = VectorEnv  # type: ignore[attr-defined]
    modules["gymnasium.vector"].AutoresetMode = modes  # type: ignore[attr-defined]
    return modules


class VectorEnvironmentTest(unittest.TestCase):
    OPTIONS: dict[str, Any] = {"policy": POLICY, "size": 3, "model": "t1", "seed": 5, "threads": 1, "episode": 1.0}

    def check(self, envs: Any, observations: Any, ended: bool | None = None) -> None:
        """What https://gymnasium.farama.org/api/vector/ says of observations and of a step."""
        self.assertTrue(envs.observation_space.contains(observations))
        self.assertEqual(envs.observation_space.shape, (envs.num_envs, *envs.single_observation_space.shape))
        self.assertEqual(envs.action_space.shape, (envs.num_envs, *envs.single_action_space.shape))
        if ended is None:
            return
        actions = envs.action_space.sample()
        self.assertTrue(envs.action_space.contains(actions))
        observations, rewards, terminations, truncations, infos = envs.step(0.1 * actions)  # No robot falls.
        self.check(envs, observations)
        np.testing.assert_allclose(rewards, [2 * envs.batch.period] * 3)
        for array in (rewards, terminations, truncations):
            self.assertEqual(array.shape, (3,))
        self.assertEqual((terminations.dtype, truncations.dtype), (np.bool_, np.bool_))
        self.assertEqual((terminations | truncations).tolist(), [ended] * 3)
        self.assertEqual("final_obs" in infos, ended)

    def test_robots_step_as_gymnasium_says(self) -> None:
        envs = batch.VectorEnvironment({"alive": 2.0}, **self.OPTIONS)
        self.addCleanup(envs.close)
        self.assertEqual(envs.metadata["autoreset_mode"], batch.SAME_STEP)
        first, infos = envs.reset(seed=7)
        self.assertEqual(infos, {})
        start = first.copy()
        for _ in range(49):
            self.check(envs, first, ended=False)
        before = first.copy()
        observations, _, _, truncations, infos = envs.step(envs.action_space.sample() * 0)
        self.assertTrue(truncations.all() and infos["_final_obs"].all())
        # The end of one episode is near the step before; the next one begins at the default angles, without a last action.
        np.testing.assert_allclose(infos["final_obs"][:, :3], before[:, :3], atol=0.1)
        self.assertFalse(observations[:, -14:-2].any())
        np.testing.assert_array_equal(envs.reset(seed=7)[0], start)
        self.assertFalse(np.array_equal(envs.reset(seed=8)[0], start))
        with self.assertRaisesRegex(ValueError, "unknown options.*speed"):
            envs.reset(options={"speed": 1})
        envs.close()
        envs.close()

    def test_arrays_are_not_copied(self) -> None:
        with contextlib.closing(batch.VectorEnvironment({}, **self.OPTIONS)) as envs:
            observations, _ = envs.reset()
            self.assertIs(observations, envs.batch.observations)
            self.assertIs(envs.step(envs.batch.actions)[0], observations)
            self.assertTrue(np.shares_memory(envs.step(envs.batch.actions)[2], envs.batch.terminated))

    def test_it_is_a_vector_env_where_gymnasium_is(self) -> None:
        with unittest.mock.patch.dict(sys.modules, stand_in_gymnasium()):
            with_gymnasium = importlib.reload(batch)
            self.addCleanup(importlib.reload, batch)
            self.assertTrue(issubclass(batch.VectorEnvironment, sys.modules["gymnasium.vector"].VectorEnv))
            self.assertEqual(batch.VectorEnvironment.metadata["autoreset_mode"].name, "SAME_STEP")
            with contextlib.closing(with_gymnasium.VectorEnvironment({"alive": 2.0}, **self.OPTIONS)) as envs:
                self.check(envs, envs.reset()[0], ended=False)

    def test_an_unknown_term_is_an_error(self) -> None:
        with self.assertRaisesRegex(ValueError, "unknown reward terms"):
            batch.VectorEnvironment({"speed": 1.0}, **self.OPTIONS)


@unittest.skipIf(torch is None, "python3-torch is not installed")
class TrainingTest(unittest.TestCase):
    def train(self, folder: Path, *arguments: str, manifest: str = POLICY.read_text(), hidden: int = 16) -> list[dict[str, float]]:
        """@return The lines of its log."""
        import train_policy

        (folder / "policy.yaml").write_text(manifest)
        (folder / "training.yaml").write_text(f"{{size: 16, horizon: 8, hidden: [{hidden}], weights: {{alive: 1.0}}}}\n")
        sys.argv = ["train_policy.py", str(folder), "--threads", "1", *arguments]
        with contextlib.redirect_stdout(io.StringIO()):
            train_policy.main()
        return [json.loads(line) for line in (folder / "training.log").read_text().splitlines()]

    def test_the_same_seed_gives_the_same_network(self) -> None:
        networks = []
        for seed in ("1", "1", "2"):
            with tempfile.TemporaryDirectory() as folder:
                self.train(Path(folder), "--iterations", "3", "--seed", seed)
                networks.append((Path(folder) / "policy.onnx").read_bytes())
        self.assertEqual(networks[0], networks[1])
        self.assertNotEqual(networks[0], networks[2])

    @unittest.skipUnless(shutil.which("mpirun") and importlib.util.find_spec("mpi4py"), "openmpi-bin or python3-mpi4py is missing")
    def test_processes_of_mpirun_train_the_same_network(self) -> None:
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            self.train(Path(one), "--iterations", "3")
            for name in ("policy.yaml", "training.yaml"):
                shutil.copy(Path(one) / name, two)
            command = ["mpirun", "-n", "2", sys.executable, ROOT / "tools/policy-train/train_policy.py", two]
            subprocess.run([*command, "--iterations", "3", "--threads", "1"], env={**os.environ, **MPI_ENVIRONMENT}, check=True,
                           capture_output=True)
            self.assertEqual((Path(one) / "policy.onnx").read_bytes(), (Path(two) / "policy.onnx").read_bytes())

    def test_goes_on_where_it_was_ended(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            self.train(Path(folder), "--iterations", "2")
            lines = self.train(Path(folder), "--iterations", "4", "--resume")
        self.assertEqual([line["iteration"] for line in lines], [1, 2, 3, 4])
        self.assertEqual(lines[-1]["samples"], 4 * 16 * 8)

    def test_goes_on_from_a_policy_without_a_checkpoint(self) -> None:
        """With a critic that learns first, the function stays that of the policy."""
        import cv2
        import train_policy

        with tempfile.TemporaryDirectory() as name, unittest.mock.patch.dict(train_policy.DEFAULTS, {"critic_first": 9}):
            folder = Path(name)
            self.train(folder, "--iterations", "3", "--seed", "5")
            start = folder / "start.onnx"
            (folder / "policy.onnx").rename(start)
            self.train(folder, "--iterations", "0", "--start", str(start))
            row = np.random.default_rng(1).standard_normal((1, 50)).astype(np.float32)

            def run(file: Path, size: int) -> np.ndarray:
                network = cv2.dnn.readNetFromONNX(str(file))
                network.setInput(row[:, :size])
                return np.asarray(network.forward())

            self.assertGreater(np.abs(run(start, 47)).max(), 1e-3)
            np.testing.assert_allclose(run(folder / "policy.onnx", 47), run(start, 47), atol=1e-4)
            # Observations that the policy lacks do not change it.
            manifest = POLICY.read_text().replace("phase:", "  - {quantity: linear_velocity}\nphase:")
            self.train(folder, "--iterations", "0", "--start", str(start), manifest=manifest)
            np.testing.assert_allclose(run(folder / "policy.onnx", 50), run(start, 47), atol=1e-4)
            with self.assertRaisesRegex(SystemExit, r"start.onnx: its layers have .*\(64, 47\)"):
                self.train(folder, "--start", str(start), hidden=32)
            policy = start.read_bytes()
            random = np.random.default_rng(2)
            for content in (b"", policy[:3000], *(random.bytes(size) for size in range(1, 40))):
                start.write_bytes(content)
                with self.assertRaisesRegex(SystemExit, r"start\.onnx: it(s layers| is damaged)"):
                    self.train(folder, "--start", str(start))
            start.unlink()
            with self.assertRaisesRegex(SystemExit, r"start\.onnx: .*No such file"):
                self.train(folder, "--start", str(start))

    def test_the_network_is_the_trained_one(self) -> None:
        """What is written takes observations that are not normalized, and gives the actor's mean."""
        import cv2
        import train_policy

        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.train(folder, "--iterations", "3")
            settings = {**train_policy.DEFAULTS, "size": 16, "horizon": 8, "hidden": [16]}
            robots, weights = train_policy.open_batch(folder, "t1", settings, {}, seed=1, threads=1)
            trainer = train_policy.Trainer(robots, settings, weights, seed=1)
            trainer.load(folder / "training.pt")
            observations = torch.from_numpy(trainer.batch.observations)
            expected = trainer.actor_of(observations).detach().numpy()
            network = cv2.dnn.readNetFromONNX(str(folder / "policy.onnx"))
            network.setInput(observations[:1].numpy())
            np.testing.assert_allclose(network.forward(), expected[:1], atol=1e-4)
            robots.close()


if __name__ == "__main__":
    unittest.main()
