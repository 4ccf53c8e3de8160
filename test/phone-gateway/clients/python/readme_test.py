#!/usr/bin/python3
"""What the package's README says leads from an empty virtual environment to a walking robot: its commands install the package,
its first script drives the robot."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from built_package import ROOT
from programs import DEADLINE, Robot

README = (ROOT / "phone-gateway/clients/python/README.md").read_text()


def first_block(language, after=""):
    """The first block of code in a language after a text."""
    return re.search(rf"^```{language}\n(.*?)^```", README[README.index(after):], re.MULTILINE | re.DOTALL)[1]


class Readme(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        # Builds write into the sources' folder.
        shutil.copytree(ROOT / "phone-gateway/clients/python", self.folder / "repository/phone-gateway/clients/python",
                        ignore=shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__"))
        for proto in ("phone-gateway/protocol/remote.proto", "tools/simulation-server/simulation.proto"):
            (self.folder / "repository" / proto).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / proto, self.folder / "repository" / proto)

    def run_command(self, command, url):
        """Runs a line of a shell as a user would: without this build's package."""
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "NAO_"))}
        # Debian's own Python, whatever else is installed.
        environment["PATH"] = "/usr/bin:" + environment["PATH"]
        result = subprocess.run(
            ["bash", "-c", command], cwd=self.folder / "repository", stdin=subprocess.DEVNULL, capture_output=True, text=True,
            timeout=4 * DEADLINE, check=False, env={**environment, "HOME": str(self.folder), "NAO_REMOTE_URL": url})
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}{result.stderr}")
        return result.stdout

    def test_its_commands_and_its_first_script_lead_to_a_walking_robot(self):
        commands = [line for line in first_block("sh", "## Installation").splitlines() if not line.startswith("apt-get")]
        self.assertEqual(len(commands), 3, "virtual environment, package, example")
        with Robot() as robot:
            robot.start_speaker()
            url = f"http://127.0.0.1:{robot.gateway.http_port}"
            for command in commands:
                self.run_command(command, url)
            # The address of this robot; one state instead of all.
            script = first_block("python").replace('"nao.local", token="k7"', "")
            self.assertIn("nao_remote.connect()", script)
            self.assertTrue(script.endswith("print(state.mode.name, state.torso_position)\n"), script)
            self.assertLessEqual(len(script.strip().splitlines()), 10)
            (self.folder / "script.py").write_text(script + "        break\n")
            before = robot.truth()["position_torso_in_world"]
            said = self.run_command("~/nao/bin/python ~/script.py", url)
            after = robot.truth()["position_torso_in_world"]
        self.assertRegex(said, r"^[A-Z_]+ \(")
        distance = ((after[0] - before[0]) ** 2 + (after[1] - before[1]) ** 2) ** 0.5
        self.assertGreater(distance, 0.15, "3 s at 0.1 m/s")
        self.assertTrue((self.folder / "repository/view.jpg").read_bytes().startswith(b"\xff\xd8"))


if __name__ == "__main__":
    unittest.main()
