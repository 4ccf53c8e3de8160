"""What start, stop and status share: their command lines, and one stack of running programs with its run directory."""

import argparse
import os
import signal
import sys
import time
from pathlib import Path

from output_file import replace_file

ROOT = Path(__file__).resolve().parent.parent

# Prefix of the scripts' names for users: an installed copy has one command for all, "nao-remote start".
CALL = os.environ.get("NAO_REMOTE_CALL", "scripts/")

SIM = "nao-sim"
# All programs of a stack.
PROGRAMS = (SIM, "nao-motion", "nao-motion-files", "nao-head-camera", "nao-speaker", "nao-phone-gateway")
# Those of them without which the robot can be driven.
OPTIONAL = ("nao-speaker",)
# With --backend lola one more: the bridge of a real robot, which its watchdog starts.
ROBOT = "nao-robot"
ROBOT_WATCHDOG = "nao-robot-watchdog"
# Without these a phone cannot drive.
TO_DRIVE = (SIM, ROBOT, "nao-motion", "nao-phone-gateway")
# Replaces programs that hang: "nao watchdog".
WATCHDOG = "nao-watchdog"
# On a real robot, and where LoLA listens there.
ROBOT_PROGRAMS = (ROBOT, "nao-motion", "nao-motion-files", "nao-head-camera", "nao-phone-gateway")
LOLA_SOCKET = "/tmp/robocup"
CAMERA = "nao-head-camera"
# With --foxglove one more: the bus for Foxglove and Lichtblick.
FOXGLOVE = "nao-foxglove"
# With --match one more: the referee.
REFEREE = "nao-referee"
# With --vision two more: perception in the head camera's images, and behaviors that use it.
VISION = "nao-vision"
PLAY = "nao-play"
# One process for each robot; all other programs serve every robot of the stack.
PER_ROBOT = ("nao-motion", "nao-motion-files", CAMERA, "nao-speaker", VISION, PLAY)

# Targets that scripts/start builds beside them.
COMPANIONS = ("nao", "nao_robot_files", "scenes", "exhibition", "nao_phone_app")

# Columns of help texts, as in the comments that the shell scripts print as theirs.
HELP_WIDTH = 106

# Time for supervisor to end its programs, s: stopwaitsecs of its configuration, and as much for itself.
SUPERVISOR_STOP_TIME = 10
# Time for processes to end after a signal, s. Chosen: more than twice the 2 s in which a program must stop.
STOP_TIME = 5
# Period, s, of looking for processes that have not ended. Chosen: not noticed by a user, 1 % of one core.
POLL_PERIOD = 0.05


class Failure(Exception):
    """Ends a script with exit status 1. Its text is one sentence: what is wrong and what to do."""


def script_name():
    return Path(sys.argv[0]).stem


def warn(text):
    print(f"{script_name()}: {text}", file=sys.stderr, flush=True)


def run_script(main):
    """Calls main() and ends the script: with the status that it returns, or 1 after a Failure or where a file cannot be
    read or written, as on a full disk."""
    # What started it may have closed them; a file that is opened must not become one of them.
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    try:
        status = main()
        if sys.stdout:
            sys.stdout.flush()
        sys.exit(status)
    except BrokenPipeError:
        # The reader, such as head, has ended. Python's own flush at the exit must not fail again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(128 + signal.SIGPIPE)
    except Failure as failure:
        warn(failure)
        sys.exit(1)
    except OSError as error:
        warn(f"{error.filename}: {error.strerror}" if error.filename else error)
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Options begin in the same column in all scripts, and "Usage" with a capital letter."""

    def __init__(self, prog):
        super().__init__(prog, max_help_position=22, width=HELP_WIDTH)

    def add_usage(self, usage, actions, groups, prefix=None):
        super().add_usage(usage, actions, groups, "Usage: ")


class CommandLine(argparse.ArgumentParser):
    """Command line of a script: no abbreviations; a wrong one ends with exit status 2 and names --help."""

    def __init__(self, arguments, description):
        super().__init__(usage=f"{CALL}{script_name()} {arguments}", description=description, add_help=False,
                         allow_abbrev=False, formatter_class=HelpFormatter)
        self.options = self.add_argument_group()

    def option(self, name, **keywords):
        self.options.add_argument(name, **keywords)

    def run_dir_option(self, purpose):
        self.option("--run-dir", metavar="DIR", type=lambda text: Path(text).resolve(),
                    default=Path(os.environ.get("NAO_REMOTE_RUN_DIR", ROOT / "run")).resolve(),
                    help=f"{purpose} (default: run)")

    def parse(self, arguments=None):
        """Adds --help and reads the command line, or other arguments."""
        self.option("--help", action="help", help="this text")
        values, unknown = self.parse_known_intermixed_args(arguments)
        if unknown:
            self.error(f"unknown option {unknown[0]}")
        return values

    def error(self, message):
        warn(f"{message} (try: {CALL}{script_name()} --help)")
        sys.exit(2)


class Stack:
    """One stack of programs. Its run directory has supervisor's configuration, socket and process id, the settings of
    scripts/start, the pairing token, and the logs."""

    def __init__(self, run_dir):
        self.run_dir = run_dir
        self.logs = run_dir / "logs"
        self.configuration = run_dir / "supervisord.conf"
        self.socket = run_dir / "supervisor.sock"
        self.pid_file = run_dir / "supervisord.pid"
        self.token_file = run_dir / "token"
        self.motions = run_dir / "motions"
        self.lola_socket = run_dir / "lola.sock"

    def write_settings(self, settings):
        replace_file(self.run_dir / "settings", "".join(f"{key}={value}\n" for key, value in settings.items()))

    def read_settings(self):
        """Settings of the running stack, or of the last one: a dictionary, empty if none was started here."""
        try:
            lines = (self.run_dir / "settings").read_text().splitlines()
        except FileNotFoundError:
            return {}
        return dict(line.split("=", 1) for line in lines)

    def supervisor_pid(self):
        """Process id of supervisor; None if it does not run. A stale file may name a process that has ended or that is
        unrelated to this stack."""
        try:
            pid = int(self.pid_file.read_text())
            words = Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
        except (OSError, ValueError):
            return None
        return pid if os.fsencode(self.configuration) in words else None

    def pids(self):
        """Processes of all programs of this stack, identified by an environment variable; this includes orphans of a
        killed supervisor."""
        mark = b"NAO_REMOTE_STACK=" + os.fsencode(self.run_dir)
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if mark in (process / "environ").read_bytes().split(b"\0"):
                    found.append(int(process.name))
            except OSError:
                continue  # it has ended, or belongs to another user
        return found

    def stop(self):
        """Ends every process: SIGTERM to supervisor, which ends its programs; SIGTERM to the remaining processes; then
        SIGKILL."""
        supervisor = self.supervisor_pid()
        if supervisor is not None:
            os.kill(supervisor, signal.SIGTERM)
            self._wait_for_no_pids(SUPERVISOR_STOP_TIME)
        for number in (signal.SIGTERM, signal.SIGKILL):
            self._signal_all(number)
            if self._wait_for_no_pids(STOP_TIME):
                break
        else:
            raise Failure(f"these processes do not end: {' '.join(map(str, self.pids()))}")
        self.pid_file.unlink(missing_ok=True)
        self.socket.unlink(missing_ok=True)

    def _signal_all(self, number):
        for pid in self.pids():
            try:
                os.kill(pid, number)
            except ProcessLookupError:
                pass

    def _wait_for_no_pids(self, seconds):
        """@return False after this time."""
        deadline = time.monotonic() + seconds
        while self.pids():
            if time.monotonic() >= deadline:
                return False
            time.sleep(POLL_PERIOD)
        return True
