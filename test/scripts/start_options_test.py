#!/usr/bin/python3
"""Which options scripts/start gives to the programs."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import start  # noqa: E402


class Options(unittest.TestCase):
    def test_host_names_reach_the_gateway_and_foxglove(self):
        options = start.parse_options(["--foxglove", "--host-name", "nao.example", "--host-name", "robot.example"])
        stack = SimpleNamespace(token_file="token", logs=Path("logs"), motions=Path("motions"))
        robots = [SimpleNamespace(name="NAO", model="nao", team=None)]
        settings = {"bin_dir": "bin", "lcm_url": "memq://", "http_port": "1", "tcp_port": "2", "foxglove_port": "3",
                    "bind": "0.0.0.0", "scheme": "http", "scene": "soccer", "host_names": " ".join(options.host_name)}
        for program in (start.GATEWAY, start.FOXGLOVE):
            with self.subTest(program):
                process = SimpleNamespace(program=program, name=program, robot=robots[0])
                command = start.command_of(process, [process], stack, settings, options, robots)
                self.assertIn('"--host-name" "nao.example" "--host-name" "robot.example"', command)

    def test_what_a_stack_will_publish_must_be_silent(self):
        robots = [SimpleNamespace(name=name) for name in ("NAO1", "NAO2")]
        processes = [SimpleNamespace(program=start.SIM, robot=robots[0]), SimpleNamespace(program=start.GATEWAY, robot=robots[0]),
                     *(SimpleNamespace(program="nao-motion", robot=robot) for robot in robots)]
        self.assertEqual(start.own_channels(processes),
                         ["NAO1_SENSOR_STATE", "NAO1_MOTION_STATE", "NAO2_MOTION_STATE", "WORLD_TRUTH"])
        self.assertEqual(start.own_channels(processes[1:2]), [])


if __name__ == "__main__":
    unittest.main()
