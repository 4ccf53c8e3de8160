#!/usr/bin/python3
"""The project works below a folder of any name: apostrophe, quotes, '&', '%', backslash and blanks."""

import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import start  # noqa: E402
from stack import Failure, Stack  # noqa: E402


class Paths(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, stack):
        options = start.parse_options([])
        robots = [SimpleNamespace(name="NAO", model="nao", team=None, words=lambda: "NAO")]
        settings = {"bin_dir": stack.run_dir / "bin", "lcm_url": "memq://", "scene": "soccer"}
        process = SimpleNamespace(program=start.SIM, name=start.SIM, robot=robots[0])
        start.write_configuration(stack, settings, options, [process], robots)

    def test_supervisor_reads_back_every_path(self):
        from supervisor.options import ServerOptions

        stack = Stack(self.folder / "a'b & 50% \"c\"\\d %(here)s %%")
        stack.logs.mkdir(parents=True)
        self.write(stack)
        options = ServerOptions()
        options.realize(["-c", str(stack.configuration)])
        self.assertEqual(options.logfile, str(stack.logs / "supervisord.log"))
        self.assertEqual(options.pidfile, str(stack.pid_file))
        self.assertEqual(options.server_configs[0]["file"], str(stack.socket))
        program = next(config for group in options.process_group_configs for config in group.process_configs
                       if config.name == start.SIM)
        self.assertEqual(program.stdout_logfile, str(stack.logs / "nao-sim.log"))
        self.assertEqual(shlex.split(program.command)[0], str(stack.run_dir / "bin/nao-sim"))

    def test_a_path_that_supervisor_cannot_read_is_refused(self):
        stack = Stack(self.folder / "a #b")
        stack.run_dir.mkdir()
        with self.assertRaisesRegex(Failure, "comment"):
            self.write(stack)

    def test_lcm_gen_and_others_get_the_path_as_it_is(self):
        files = subprocess.run(["git", "-C", ROOT, "ls-files", "*CMakeLists.txt", "*.cmake"], check=True,
                               stdout=subprocess.PIPE, text=True).stdout.splitlines()
        for file in files:
            for command in (ROOT / file).read_text().split("add_custom_command(")[1:]:
                self.assertIn("VERBATIM", command.partition(")\n")[0], file)


if __name__ == "__main__":
    unittest.main()
