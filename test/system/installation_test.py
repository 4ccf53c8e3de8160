#!/usr/bin/python3
"""An installed copy does not depend on the build tree."""

import os
import shlex
import shutil
import tempfile
import unittest
import urllib.request
from pathlib import Path

from stack import BIN_DIR, Stack, run

PROGRAMS = ["nao-sim", "nao-motion", "nao-motion-files", "nao-head-camera", "nao-speaker", "nao-phone-gateway"]


class Installation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="nao-")
        self.addCleanup(folder.cleanup)
        installed = Path(folder.name) / "installed"
        result = run(["cmake", "--install", BIN_DIR.parent, "--prefix", installed])
        self.assertEqual(result.returncode, 0, result.stderr)
        # Moved: no program may depend on its installation path.
        self.prefix = Path(folder.name) / "moved"
        installed.rename(self.prefix)

    def test_every_program_is_installed(self):
        for name in [*PROGRAMS, "nao-foxglove", "nao"]:
            result = run([self.prefix / "bin" / name, "--version"])
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_one_command_speaks_of_itself(self):
        command = self.prefix / "bin/nao-remote"
        for words, said in ((["status"], "start it: nao-remote start"),
                            (["status", "--no-such"], "(try: nao-remote status --help)"),
                            (["start", "--no-such"], "(try: nao-remote start --help)")):
            with self.subTest(words=words):
                result = run([command, *words], env={**os.environ, "NAO_REMOTE_RUN_DIR": str(self.prefix / "run")})
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(said, result.stderr)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "no systemd here")
    def test_the_systemd_units_are_sound(self):
        units = self.prefix / "lib/systemd/user"
        service = units / "nao-remote@.service"
        # The units name programs where the Debian package puts them.
        service.write_text(service.read_text().replace("/usr/bin", str(self.prefix / "bin")))
        for name in ("sim", "motion", "motion-files", "head-camera", "phone-gateway"):
            (units / f"nao-remote@{name}.service").symlink_to(service)
        result = run(["systemd-analyze", "--user", "--man=no", "verify", units / "nao-remote.target",
                      *units.glob("nao-remote@?*.service")],
                     env={**os.environ, "XDG_RUNTIME_DIR": str(self.prefix)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")

    def test_the_units_say_when_they_end_at_log_out(self):
        unit = (self.prefix / "lib/systemd/user/nao-remote@.service").read_text()
        command, = (line.removeprefix("ExecStartPre=-") for line in unit.splitlines() if line.startswith("ExecStartPre="))
        folder = self.prefix / "linger"
        folder.mkdir()
        (folder / "stays").touch()
        command = command.replace("/var/lib/systemd/linger", str(folder))
        for user, said in (("stays", ""), ("leaves", "ends when you log out; as root, run loginctl enable-linger leaves\n")):
            with self.subTest(user=user):
                result = run(shlex.split(command.replace("%u", user)))
                self.assertEqual((result.returncode, result.stdout), (0, said))

    def test_the_robot_moves_and_the_app_is_served(self):
        with Stack() as stack:
            stack.start_or_fail("--bin", self.prefix / "bin")
            result = run([self.prefix / "bin/nao", "--lcm-url", stack.lcm_url, "posture", "Crouch"])
            self.assertEqual(result.returncode, 0, result.stderr + stack.logs())
            self.assertAlmostEqual(stack.torso_height(), 0.229, delta=0.01)

            data = self.prefix / "share/nao-remote"
            for path, file in (("", "web/index.html"),
                               ("robots/nao/nao.urdf", "robots/nao/nao.urdf"),
                               ("robots/nao/meshes/Head.glb", "robots/nao/meshes/Head.glb")):
                url = f"http://127.0.0.1:{stack.http_port}/{path}"
                with urllib.request.urlopen(url, timeout=30) as answer:
                    self.assertEqual(answer.read(), (data / file).read_bytes(), path)


if __name__ == "__main__":
    unittest.main()
