"""Tests of tools/nao-trial/check_matches.py: what it finds in a ball's path."""

import sys
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools/nao-trial"))

import check_matches  # noqa: E402

SCENE = yaml.safe_load((ROOT / "data/scenes/soccer.yaml").read_text())


def roll(start, velocity, seconds, begin=0.0, phase="playing"):
    """@return path of a ball, 100 places a second."""
    return [(begin + 0.01 * i, phase, *(p + 0.01 * i * v for p, v in zip(start, velocity)))
            for i in range(int(100 * seconds))]


class Crossings(unittest.TestCase):
    def test_goal_when_the_whole_ball_is_over_the_line(self):
        # 4.5 m, half a line and the ball's radius: 4.575 m, after 0.575 s.
        (time, kind, team), = check_matches.crossings(roll((4, 0.2, 0.05), (1, 0, 0), 1), SCENE)
        self.assertAlmostEqual(time, 0.58, delta=0.011)
        self.assertEqual((kind, team), ("goal", 0))
        (_, kind, team), = check_matches.crossings(roll((-4, 0.2, 0.05), (-1, 0, 0), 1), SCENE)
        self.assertEqual((kind, team), ("goal", 1))

    def test_out_beside_and_above_the_goal_and_over_the_side_line(self):
        for start, velocity in (((4, 0.9, 0.05), (1, 0, 0)), ((4, 0, 0.9), (1, 0, 0)), ((1, 2.8, 0.05), (0, 1, 0))):
            (_, kind, team), = check_matches.crossings(roll(start, velocity, 1), SCENE)
            self.assertEqual((kind, team), ("ball-out", None))

    def test_place_at_the_crossing_decides_not_the_one_after_it(self):
        # Fast across the goal line inside the post, outside of it 10 ms later.
        path = roll((4.55, 0.70, 0.05), (6, 6, 0), 0.05)
        self.assertEqual([kind for _, kind, _ in check_matches.crossings(path, SCENE)], ["goal"])

    def test_counts_a_ball_once_until_it_is_put_back(self):
        path = roll((4, 0, 0.05), (1, 0, 0), 2) + roll((0, 0, 0.05), (0, 0, 0), 1, 2)
        path += roll((4, 0, 0.05), (1, 0, 0), 1, 3)
        self.assertEqual(len(check_matches.crossings(path, SCENE)), 2)

    def test_nothing_while_the_match_rests(self):
        self.assertEqual(check_matches.crossings(roll((4, 0, 0.05), (1, 0, 0), 1, phase="set"), SCENE), [])


class Compare(unittest.TestCase):
    def test_names_what_only_one_has(self):
        found = [(1.0, "goal", 0), (5.0, "ball-out", None)]
        self.assertEqual(check_matches.compare(found, [(1.05, "goal", 0), (5.03, "ball-out", None)]), [])
        self.assertEqual(len(check_matches.compare(found, [(1.05, "goal", 0)])), 1)
        self.assertEqual(len(check_matches.compare(found, [(1.05, "goal", 1), (5.03, "ball-out", None)])), 2)
        self.assertEqual(len(check_matches.compare(found, [(1.3, "goal", 0), (5.0, "ball-out", None)])), 2)
        self.assertEqual(len(check_matches.compare([], [(1.3, "goal", 0)])), 1)


if __name__ == "__main__":
    unittest.main()
