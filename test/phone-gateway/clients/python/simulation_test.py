#!/usr/bin/python3
"""The simulation of the package nao_remote, with the real server."""

import os
import random
import struct
import subprocess
import time
import unittest

from built_package import BIN_DIR

os.environ["NAO_REMOTE_BIN"] = str(BIN_DIR)

import nao_remote  # noqa: E402
from nao_remote import simulation_pb2 as pb  # noqa: E402
from nao_remote.simulation.pipe import PROGRAM, ServerPipe, find_program  # noqa: E402


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


class Worlds(unittest.TestCase):
    def simulate(self, **options):
        return self.enterContext(nao_remote.simulate(**options))

    def test_the_robot_walks(self):
        world = self.simulate(seed=1)
        world.walk(0.1, 0, 0)
        state = world.run(5, truth=True)
        self.assertIs(state.mode, nao_remote.Mode.WALKING)
        self.assertGreater(state.truth.torso_position[0], 0.2)
        self.assertLess(distance(state.torso_position, state.truth.torso_position), 0.1)
        self.assertEqual([result.status.name for result in state.results], ["ACCEPTED"])
        world.walk()
        self.assertEqual([result.status.name for result in world.run(3).results][-1], "DONE")

    def test_commands_do_what_they_do_on_a_robot(self):
        world = self.simulate()
        world.posture("Crouch")
        self.assertEqual(world.run_until_done().posture, "Crouch")
        world.change_joints({"HeadYaw": 0.4})
        names = list(world.description.joints)
        self.assertAlmostEqual(world.run_until_done().joint_position[names.index("HeadYaw")], 0.4, delta=0.05)
        world.posture("StandInit")
        world.run_until_done()
        world.action("wave")
        world.run_until_done()
        world.move_to(0.3, 0, 0)
        world.run_until_done()
        world.posture("Handstand")
        with self.assertRaises(nao_remote.CommandFailed) as failed:
            world.run_until_done()
        self.assertEqual(failed.exception.reason_code, "posture-unknown")
        world.stop()
        world.step()

    def trajectory(self, seed, **options):
        with nao_remote.simulate(seed=seed, **options) as world:
            world.walk(0.1, 0, 0.2)
            return [world.step(50, truth=True) for _ in range(6)]

    def test_the_same_seed_gives_the_same_trajectory(self):
        self.assertEqual(self.trajectory(3), self.trajectory(3))
        self.assertNotEqual(self.trajectory(3), self.trajectory(4))

    def test_a_reset_is_as_a_new_simulation(self):
        world = self.simulate(seed=9)
        world.walk(0.1)
        world.run(2)
        world.reset(3)
        world.walk(0.1, 0, 0.2)
        self.assertEqual([world.step(50, truth=True) for _ in range(6)], self.trajectory(3))

    def test_joint_targets_replace_the_motion_core_until_they_end(self):
        world = self.simulate(disturbances="none")
        world.step(50, joint_targets={"HeadYaw": 0.5})
        yaw = list(world.description.joints).index("HeadYaw")
        self.assertAlmostEqual(world.state.joint_position[yaw], 0.5, delta=0.05)
        world.step(50, joint_targets=[0.0] * len(world.description.joints))
        self.assertAlmostEqual(world.state.joint_position[yaw], 0, delta=0.05)
        # Limp, the robot collapses; the motion core then gets it up.
        state = world.step(100, joint_targets=world.state.joint_target, stiffness=[0.0] * len(world.description.joints), truth=True)
        self.assertLess(state.truth.torso_position[2], 0.3)

    def test_joint_targets_may_have_gains_of_their_own(self):
        world = self.simulate(disturbances="none")
        count = len(world.description.joints)
        yaw = list(world.description.joints).index("HeadYaw")
        # Without stiffness the servo does not turn the head; meanwhile the motion core says where it would hold it.
        state = world.step(50, joint_targets={"HeadYaw": 0.5}, gains=([0.0 if k == yaw else 100.0 for k in range(count)], [1.0] * count))
        self.assertAlmostEqual(state.joint_position[yaw], 0, delta=0.05)
        self.assertAlmostEqual(state.joint_target[yaw], 0.5)
        self.assertAlmostEqual(state.motion_target[yaw], 0, delta=0.01)
        with self.assertRaises(nao_remote.SimulationError):
            world.step(1, joint_targets={"HeadYaw": 0.5}, gains=([-1.0] * count, [1.0] * count))

    def test_what_is_refused_is_said_and_changes_nothing(self):
        world = self.simulate()
        before = world.state
        for call in (lambda: world.step(0), lambda: world.step(6001), lambda: world.step(1, [0.0]), lambda: world.step(-1),
                     lambda: world.step(1, {"Tail": 1.0}), lambda: world.step(1, [float("nan")] * 25), lambda: world.reset(-1),
                     lambda: world.reset(1, "Handstand"), world.end_step, world.run_until_done):
            with self.assertRaises(nao_remote.SimulationError) as refused:
                call()
            self.assertTrue(str(refused.exception))
        self.assertIs(world.state, before)
        self.assertAlmostEqual(world.step().time, before.time + before.period)

    def test_wrong_options_are_said(self):
        for options in ({"engine": "paper"}, {"disturbances": "chaos"}, {"model": "nobody"}, {"scene": "moon"},
                        {"posture": "Handstand"}, {"program": "/nowhere/server"}):
            with self.assertRaises(nao_remote.SimulationError) as refused:
                nao_remote.simulate(**options)
            self.assertTrue(str(refused.exception), options)

    def test_a_killed_server_is_an_error_and_no_hang(self):
        world = self.simulate()
        world._pipe._process.kill()
        with self.assertRaisesRegex(nao_remote.SimulationError, "ended"):
            for _ in range(10):
                world.step()

    def test_a_silent_server_is_a_timeout(self):
        pipe = ServerPipe(["sleep", "60"], 0.1)
        self.addCleanup(pipe.close)
        self.addCleanup(pipe._process.kill)
        with self.assertRaises(nao_remote.Timeout):
            pipe.receive()

    def test_worlds_step_at_the_same_time(self):
        worlds = [self.simulate(seed=seed) for seed in (1, 2, 1)]
        for world in worlds:
            world.walk(0.1)
        states = nao_remote.step_together(worlds, 100, truth=True)
        self.assertEqual(states[0], states[2])
        self.assertNotEqual(states[0], states[1])
        with self.assertRaises(nao_remote.SimulationError):
            worlds[0].begin_step()
            worlds[0].begin_step()
        worlds[0].end_step()

    def test_real_time_takes_at_least_its_time(self):
        world = self.simulate(realtime=True)
        start = time.monotonic()
        world.run(0.5)
        self.assertGreaterEqual(time.monotonic() - start, 0.5)

    def test_other_robots_and_scenes_are_simulated(self):
        world = self.simulate(scene="soccer")
        self.assertEqual(len(world.step(truth=True).truth.ball_position), 3)


class Server(unittest.TestCase):
    def talk(self, sent):
        """@return exit status, stdout and stderr of a server with this input."""
        result = subprocess.run([find_program()], input=sent, capture_output=True, timeout=60, check=False)
        return result.returncode, result.stdout, result.stderr.decode()

    def test_a_request_that_is_too_long_ends_it_with_a_reason(self):
        status, answered, said = self.talk(struct.pack(">I", 1 << 31) + b"x" * 100)
        self.assertEqual(status, 1)
        self.assertIn("65536", pb.Response.FromString(answered[4:]).error)
        self.assertIn("65536", said)

    def test_an_incomplete_request_is_none(self):
        self.assertEqual(self.talk(b"")[:2], (0, b""))
        self.assertEqual(self.talk(b"\0\0\0\5ab")[:2], (0, b""))

    def test_any_messages_are_answered_one_by_one(self):
        numbers = random.Random(1)
        messages = [bytes(numbers.randrange(256) for _ in range(numbers.randrange(40))) for _ in range(300)]
        status, answered, _ = self.talk(b"".join(struct.pack(">I", len(message)) + message for message in messages))
        self.assertEqual(status, 0)
        num_responses = 0
        while answered:
            length, = struct.unpack_from(">I", answered)
            self.assertTrue(pb.Response.FromString(answered[4:4 + length]).WhichOneof("response"))
            answered = answered[4 + length:]
            num_responses += 1
        self.assertEqual(num_responses, len(messages))

    def test_it_is_found_or_its_absence_is_said(self):
        self.assertEqual(find_program(), str(BIN_DIR / PROGRAM))
        self.assertEqual(find_program("mine"), "mine")


try:
    import numpy as np
    from nao_remote.simulation import environment
except ImportError:
    np = None


@unittest.skipIf(np is None, "NumPy is missing (Debian: python3-numpy)")
class Environments(unittest.TestCase):
    """The contract of Gymnasium's Env, checked without Gymnasium."""

    def make(self, *arguments, **options):
        env = environment.Environment(*arguments, **options)
        self.addCleanup(env.close)
        return env

    def test_shapes_and_types_are_those_of_the_spaces(self):
        for actions in ("joints", "walk"):
            env = self.make(actions, max_steps=3)
            observation, info = env.reset(seed=1)
            for _ in range(3):
                self.assertEqual((observation.shape, observation.dtype), (env.observation_space.shape, np.dtype("float32")))
                self.assertTrue(env.observation_space.contains(observation))
                action = env.action_space.sample()
                self.assertTrue(env.action_space.contains(action))
                observation, reward, terminated, truncated, info = env.step(action)
                self.assertEqual((type(reward), type(terminated), type(truncated), type(info)), (float, bool, bool, dict))

    def test_an_episode_is_truncated_after_its_steps_and_then_refuses(self):
        env = self.make("walk", max_steps=5)
        env.reset(seed=1)
        ends = [env.step(np.zeros(3, np.float32))[2:4] for _ in range(5)]
        self.assertEqual(ends, [(False, False)] * 4 + [(False, True)])
        with self.assertRaises(nao_remote.SimulationError):
            env.step(np.zeros(3, np.float32))
        env.reset()
        env.step(np.zeros(3, np.float32))

    def test_a_fall_terminates_it(self):
        env = self.make("joints", ticks_per_step=10, disturbances="none")
        env.reset(seed=1)
        # Straight legs and a stretched hip: the robot tips over.
        names = list(env.simulation.description.joints)
        action = np.zeros(len(names), np.float32)
        for joint in ("LHipPitch", "RHipPitch"):
            action[names.index(joint)] = 0.48
        for _ in range(100):
            _, _, terminated, _, info = env.step(action)
            if terminated:
                break
        self.assertTrue(terminated)

    def test_seeds_determine_everything(self):
        def episode(env, seed):
            env.action_space.seed(seed)
            first, _ = env.reset(seed=seed)
            steps = [env.step(env.action_space.sample()) for _ in range(20)]
            second, _ = env.reset()
            return np.concatenate([first, *[step[0] for step in steps], second]), [step[1] for step in steps]
        one, other = self.make(), self.make()
        for seed in (1, 2):
            a, b = episode(one, seed), episode(other, seed)
            np.testing.assert_array_equal(a[0], b[0])
            self.assertEqual(a[1], b[1])
        self.assertFalse(np.array_equal(episode(one, 1)[0], episode(one, 2)[0]))

    def test_walking_ahead_is_rewarded(self):
        env = self.make("walk", ticks_per_step=50)
        env.reset(seed=1)
        rewards = [env.step(np.array([0.1, 0, 0], np.float32))[1] for _ in range(10)]
        self.assertGreater(sum(rewards[4:]) / 6, 0.05)

    def test_actions_are_clipped_and_checked(self):
        env = self.make("walk")
        env.reset(seed=1)
        env.step(np.full(3, 1e9, np.float32))
        for bad in (np.zeros(4), np.full(3, np.nan), "walk"):
            with self.assertRaises((nao_remote.SimulationError, ValueError)):
                env.step(bad)
        with self.assertRaises(nao_remote.SimulationError):
            env.reset(options={"colour": 1})
        with self.assertRaises(nao_remote.SimulationError):
            environment.Environment("teleport")

    def test_a_box_samples_within_its_bounds(self):
        from nao_remote.simulation.spaces import Box
        box = Box(np.array([-1, -np.inf]), np.array([2, np.inf]), dtype=np.float32)
        box.seed(1)
        samples = [box.sample() for _ in range(100)]
        self.assertTrue(all(box.contains(sample) for sample in samples))
        box.seed(1)
        np.testing.assert_array_equal(box.sample(), samples[0])
        self.assertFalse(box.contains(np.zeros(3, np.float32)))
        self.assertFalse(box.contains(np.array([3, 0], np.float32)))
        self.assertFalse(box.contains([0, 0]))

    def test_gymnasiums_own_checker_is_content(self):
        try:
            from gymnasium.utils.env_checker import check_env
        except ImportError:
            self.skipTest("Gymnasium is missing; Debian has no package")
        check_env(self.make("walk"), skip_render_check=True)


if __name__ == "__main__":
    unittest.main()
