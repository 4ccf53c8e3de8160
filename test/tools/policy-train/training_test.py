"""The batch of robots in Python, and a short training, which needs python3-torch."""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/policy-train"))

import batch  # noqa: E402

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


@unittest.skipIf(torch is None, "python3-torch is not installed")
class TrainingTest(unittest.TestCase):
    def train(self, folder: Path, *arguments: str) -> list[dict[str, float]]:
        """@return The lines of its log."""
        import train_policy

        (folder / "policy.yaml").write_text(POLICY.read_text())
        (folder / "training.yaml").write_text("{size: 16, horizon: 8, hidden: [16], weights: {alive: 1.0}}\n")
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

    def test_goes_on_where_it_was_ended(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            self.train(Path(folder), "--iterations", "2")
            lines = self.train(Path(folder), "--iterations", "4", "--resume")
        self.assertEqual([line["iteration"] for line in lines], [1, 2, 3, 4])
        self.assertEqual(lines[-1]["samples"], 4 * 16 * 8)

    def test_the_network_is_the_trained_one(self) -> None:
        """What is written takes observations that are not normalized, and gives the actor's mean."""
        import cv2
        import train_policy

        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.train(folder, "--iterations", "3")
            settings = {**train_policy.DEFAULTS, "size": 16, "horizon": 8, "hidden": [16]}
            trainer = train_policy.Trainer(folder, "t1", settings, {}, 1, 1)
            trainer.load(folder / "training.pt")
            observations = torch.from_numpy(trainer.batch.observations)
            expected = trainer.actor_of(observations).detach().numpy()
            network = cv2.dnn.readNetFromONNX(str(folder / "policy.onnx"))
            network.setInput(observations[:1].numpy())
            np.testing.assert_allclose(network.forward(), expected[:1], atol=1e-4)
            trainer.batch.close()


if __name__ == "__main__":
    unittest.main()
