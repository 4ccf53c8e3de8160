#!/usr/bin/python3
"""scripts/deploy puts the software on a robot, runs it there and removes it. The robot is a bare Debian system with an
ssh server; the software is a stand-in that shows that it runs. NAO_TEST_ROBOT names a folder with such a system
(debootstrap --variant=minbase --include=openssh-server,rsync RELEASE DIR); without it, one is made in the build folder."""

import os
import platform
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from stack import BIN_DIR, DEADLINE, ROOT, free_port, run

ROBOT_FOLDER = "/home/nao/nao-remote"

# Programs of the stand-in's system, from this machine.
TOOLS = ("sh", "env", "sleep", "mkdir", "cat", "rm", "kill")
# The package's command: "start" leaves a process that runs until "stop".
STAND_IN = """#!/bin/sh
set -e
cd "$NAO_REMOTE_RUN_DIR"
case $1 in
    start)
        [ -e /proc/self ] && [ -e /dev/null ] || exit 1
        [ ! -f pid ] || { echo "running already"; exit 0; }
        mkdir -p logs
        echo "started with $*" >logs/nao-motion.log
        sleep 100000 </dev/null >/dev/null 2>&1 &
        echo $! >pid
        echo "the stand-in runs" ;;
    status) kill -0 "$(cat pid)" && echo "nao-motion ready" ;;
    stop) [ ! -f pid ] || { kill "$(cat pid)"; rm pid; echo "Stopped."; } ;;
esac
"""


def make_payload(folder):
    """A system of few programs with the stand-in."""
    for tool in TOOLS:
        program = Path(shutil.which(tool)).resolve()
        files = [program] + [Path(word) for word in run(["ldd", program]).stdout.split() if word.startswith("/")]
        for file in files:
            target = folder / ("usr/bin/" + tool if file == program else str(file).lstrip("/"))
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, target)
    (folder / "bin").symlink_to("usr/bin")
    command = folder / "usr/bin/nao-remote"
    command.write_text(STAND_IN)
    command.chmod(0o755)
    for name in ("dev", "proc", "sys", "tmp", "var/lib", "many"):
        (folder / name).mkdir(parents=True)
    for index in range(100):
        (folder / f"many/{index}").write_text(str(index) * 1000)
    os.link(folder / "many/0", folder / "many/link")


class Robot:
    """A Debian system with its own mounts and processes, and an ssh server on the loopback interface. All of it ends with
    the server's process."""

    def __init__(self, root, folder):
        self.root = root
        self.port = free_port()
        self.key = folder / "key"
        for name in ("key", "host_key"):
            result = run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", folder / name])
            assert result.returncode == 0, result.stderr
        (root / "home/nao").mkdir(exist_ok=True)
        keys = root / "etc/ssh/test"
        shutil.rmtree(keys, ignore_errors=True)
        keys.mkdir(parents=True)
        shutil.copy(folder / "host_key", keys)
        shutil.copy(folder / "key.pub", keys)
        self.log = open(folder / "sshd.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            ["unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c",
             'mount -t proc proc "$1/proc" && mkdir -p "$1/run/sshd" && exec chroot "$1" /usr/sbin/sshd -D -e -p "$2" '
             "-h /etc/ssh/test/host_key -o AuthorizedKeysFile=/etc/ssh/test/key.pub -o ListenAddress=127.0.0.1 "
             "-o UsePAM=no -o StrictModes=no -o PidFile=none -o LogLevel=ERROR", "robot", root, str(self.port)],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log)
        deadline = time.monotonic() + DEADLINE
        while not self.listens():
            assert self.process.poll() is None and time.monotonic() < deadline, self.said()
            time.sleep(0.05)
        self.ssh = (f"ssh -F none -p {self.port} -i {self.key} -o IdentitiesOnly=yes -o StrictHostKeyChecking=no "
                    f"-o UserKnownHostsFile={folder / 'known_hosts'} -o LogLevel=ERROR")

    def listens(self):
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.port)) == 0

    def said(self):
        self.log.seek(0)
        return self.log.read()

    def stop(self):
        self.process.send_signal(signal.SIGKILL)  # unshare takes its child, and that its processes, along
        self.process.wait()
        self.log.close()
        shutil.rmtree(self.root / "etc/ssh/test")

    def deploy(self, *words):
        return run([ROOT / "scripts/deploy", "root@127.0.0.1", "--ssh", self.ssh, *words])

    def files(self):
        """All its files, but for what any login changes."""
        found = set()
        for folder, folders, files in os.walk(self.root):
            relative = os.path.relpath(folder, self.root)
            if relative == ".":
                folders[:] = [name for name in folders if name not in ("proc", "sys", "dev", "run")]
            found.update(os.path.join(relative, name) for name in [*folders, *files])
        return found

    def processes(self):
        """Command lines of what runs in it."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if str(self.root) in os.readlink(process / "root"):  # a root of this test's own may stand before it
                    found.append((process / "cmdline").read_bytes().replace(b"\0", b" ").decode())
            except OSError:
                continue
        return found


def robot_root():
    """@return a bare system. @throws unittest.SkipTest  if there is none."""
    if os.geteuid() != 0:
        raise unittest.SkipTest("needs root: mounts, and a robot's system with its own root")
    for tool in ("unshare", "ssh", "ssh-keygen"):
        if not shutil.which(tool):
            raise unittest.SkipTest(f"no {tool}: scripts/setup --with test")
    if run(["unshare", "--mount", "--pid", "--fork", "true"]).returncode != 0:
        raise unittest.SkipTest("this system permits no mounts of a process's own")
    given = os.environ.get("NAO_TEST_ROBOT")
    root = Path(given) if given else BIN_DIR.parent / "test/robot"
    made = root / "usr/sbin/sshd"
    if not made.exists():
        if given or not shutil.which("debootstrap"):
            raise unittest.SkipTest(f"no ssh server in {root}" if given else "no debootstrap: scripts/setup --with test")
        shutil.rmtree(root, ignore_errors=True)
        root.parent.mkdir(parents=True, exist_ok=True)
        result = subprocess.run(["debootstrap", "--variant=minbase", "--include=openssh-server,rsync",
                                 platform.freedesktop_os_release()["VERSION_CODENAME"], root],
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if result.returncode != 0:
            shutil.rmtree(root, ignore_errors=True)
            raise unittest.SkipTest(f"debootstrap makes no system here: {result.stdout[-300:]}{result.stderr[-300:]}")
    return root


class Deployment(unittest.TestCase):
    def setUp(self):
        root = robot_root()
        folder = tempfile.TemporaryDirectory(prefix="nao-")
        self.addCleanup(folder.cleanup)
        self.payload = Path(folder.name) / "payload"
        self.payload.mkdir()
        make_payload(self.payload)
        self.robot = Robot(root, Path(folder.name))
        self.addCleanup(self.robot.stop)
        self.addCleanup(lambda: self.robot.deploy("remove"))
        self.installed = root / ROBOT_FOLDER.lstrip("/")
        self.before = self.robot.files()

    def succeed(self, *words):
        result = self.robot.deploy(*words)
        self.assertEqual(result.returncode, 0, f"{words}\n{result.stdout}{result.stderr}\n{self.robot.said()}")
        return result.stdout

    def fail_with(self, said, *words):
        result = self.robot.deploy(*words)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(said, result.stderr)

    def install(self, *options):
        return self.succeed("install", "--root", self.payload, *options)

    def check_copy(self):
        for file in sorted(self.payload.rglob("*")):
            copy = self.installed / "root" / file.relative_to(self.payload)
            if file.is_symlink():
                self.assertEqual(os.readlink(copy), os.readlink(file))
            elif file.is_file():
                self.assertEqual(copy.read_bytes(), file.read_bytes(), copy)
                self.assertEqual(copy.stat().st_mode, file.stat().st_mode, copy)
                self.assertEqual((copy.stat().st_uid, copy.stat().st_gid), (0, 0), copy)
        copied = {path.relative_to(self.installed / "root") for path in (self.installed / "root").rglob("*")}
        copied.discard(Path("var/lib/nao-remote"))  # where its settings are mounted
        self.assertEqual(copied, {path.relative_to(self.payload) for path in self.payload.rglob("*")})

    def test_from_nothing_to_nothing(self):
        self.fail_with("nothing is installed", "status")
        self.install()
        self.check_copy()
        self.fail_with("nothing is running", "status")
        self.assertIn("the stand-in runs", self.succeed("start", "--", "--tls"))
        self.assertIn("nao-motion ready", self.succeed("status"))
        self.assertIn("started with start --backend robot --model nao_v6 --tls", self.succeed("logs", "nao-motion"))
        self.fail_with("there is no log", "logs", "nao-robot")
        self.assertIn("running already", self.succeed("start"))
        self.assertTrue(any("sleep 100000" in line for line in self.robot.processes()))

        # Again, over what runs: that ends first, and settings are kept.
        (self.payload / "usr/bin/new").write_text("new")
        shutil.rmtree(self.payload / "many")
        self.assertIn("Stopped.", self.install())
        self.check_copy()
        self.assertTrue((self.installed / "state/logs/nao-motion.log").exists())
        self.assertFalse(any("sleep 100000" in line for line in self.robot.processes()))

        self.succeed("start")
        self.assertIn("Stopped.", self.succeed("stop"))
        self.assertIn("Nothing was running", self.succeed("stop"))
        self.succeed("start")
        self.succeed("remove")
        self.assertEqual(self.robot.files() - self.before, set())
        self.assertEqual(self.before - self.robot.files(), set())
        self.assertFalse(any("sleep 100000" in line for line in self.robot.processes()))
        self.fail_with("nothing is installed", "remove")

    def test_an_interrupted_copy_continues(self):
        for options in ((), ("--tar",)):
            with self.subTest(options=options):
                self.install(*options)
                self.check_copy()
                copy = self.installed / "root/many"
                (self.installed / "complete").unlink()
                self.fail_with("is not complete", "start")
                for index in range(50):
                    (copy / str(index)).unlink()
                with open(copy / "60", "w", encoding="utf-8") as file:
                    file.write("cut off")
                (copy / "70").unlink()
                (copy / "70").mkdir()
                (copy / "70/left_over").write_text("")
                untouched = (copy / "80").stat()
                self.install(*options)
                self.check_copy()
                self.assertEqual((copy / "80").stat().st_ctime_ns, untouched.st_ctime_ns)
                self.succeed("remove")

    def test_nobody_answers(self):
        port = free_port()
        result = run([ROOT / "scripts/deploy", "root@127.0.0.1", "status", "--ssh", f"ssh -F none -p {port}"])
        self.assertEqual(result.returncode, 1)
        self.assertIn("no connection to root@127.0.0.1", result.stderr)


if __name__ == "__main__":
    unittest.main()
