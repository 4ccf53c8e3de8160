"""Runs one stack on several hosts: a deployment file says which programs run where, and for which robots. Every host has
this project, built, and runs its part under supervisor by scripts/start; the others are reached by ssh. Commands: start
(the default), stop, status. docs/several-hosts.md explains the file."""

import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import start
from stack import CAMERA, PER_ROBOT, ROOT, CommandLine, Failure, run_script

COMMANDS = ("start", "stop", "status")
DEFAULT_LCM_URL = "udpm://239.255.76.67:7667?ttl=1"
# Exit status of ssh if it could not connect (ssh(1)).
SSH_FAILED = 255
FILE_KEYS = {"lcm_url", "start", "hosts"}
HOST_KEYS = {"name", "ssh", "folder", "run_dir", "programs", "robots", "options"}


class Host(NamedTuple):
    """A host, and its part of the stack."""
    name: str
    # USER@ADDRESS; empty: this machine.
    ssh: str
    # Folder of the project on that host.
    folder: str
    # Run directory of scripts/start there; empty: its default.
    run_dir: str
    # Full names, "nao-motion".
    programs: list
    # Robots whose own programs run on this host.
    robots: list
    # Options of scripts/start on this host only.
    options: list

    def script(self, name, *words):
        """Command line of a script on this host."""
        return [f"scripts/{name}", *words, *(["--run-dir", self.run_dir] if self.run_dir else [])]


def fail(file, text):
    raise Failure(f"{file}: {text}")


def words_of(file, value, name):
    """A list of words, given as such or as one text."""
    if isinstance(value, str):
        return shlex.split(value)
    if isinstance(value, list) and all(isinstance(word, (str, int, float)) for word in value):
        return [str(word) for word in value]
    return fail(file, f"{name} is neither a text nor a list of words")


def text_of(file, value, name):
    if not isinstance(value, str) or not value:
        fail(file, f"{name} is not text")
    return value


def check_keys(file, entry, known, name):
    if not isinstance(entry, dict):
        fail(file, f"{name} has no keys; it needs some of: {' '.join(sorted(known))}")
    for key in entry:
        if key not in known:
            fail(file, f"{name} has the unknown key '{key}'; known are: {' '.join(sorted(known))}")


def read_host(file, entry, number, robots):
    check_keys(file, entry, HOST_KEYS, f"host {number}")
    name = text_of(file, entry.get("name"), f"name of host {number}")
    programs = ["nao-" + word.removeprefix("nao-")
                for word in words_of(file, entry.get("programs", []), f"programs of {name}")]
    own_robots = words_of(file, entry.get("robots", robots), f"robots of {name}")
    for robot in own_robots:
        if robot not in robots:
            fail(file, f"{name} has the unknown robot '{robot}'; there are: {' '.join(robots)}")
    return Host(name, entry.get("ssh") or "", text_of(file, entry.get("folder", str(ROOT)), f"folder of {name}"),
                entry.get("run_dir") or "", programs, own_robots, words_of(file, entry.get("options", []), f"options of {name}"))


def check_parts(file, hosts, programs, robots):
    """Every program must run on exactly one host, or for each robot on exactly one."""
    for host in hosts:
        for program in host.programs:
            if program not in programs:
                fail(file, f"{host.name} has the unknown program '{program}'; with these options of start there are: "
                     f"{' '.join(name.removeprefix('nao-') for name in programs)}")
    for program in programs:
        for robot in robots if program in PER_ROBOT else [""]:
            runners = [host.name for host in hosts if program in host.programs and (not robot or robot in host.robots)]
            what = program + (f" of {robot}" if robot and len(robots) > 1 else "")
            if len(runners) > 1:
                fail(file, f"{what} runs on {' and '.join(runners)}; it must run on one host")
            if not runners and program != CAMERA:
                fail(file, f"{what} runs on no host")


class Deployment:
    """The deployment file."""

    def __init__(self, file):
        import yaml  # a package that scripts/setup installs
        try:
            content = yaml.safe_load(Path(file).read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
            raise Failure(f"{file} cannot be read: {error}") from None
        check_keys(file, content, FILE_KEYS, "the file")
        self.lcm_url = text_of(file, content.get("lcm_url", DEFAULT_LCM_URL), "lcm_url")
        self.start = words_of(file, content.get("start", ""), "start")
        options = start.parse_options(self.start)
        for option, is_given in (("--only", options.only), ("--only-robots", options.only_robots)):
            if is_given:
                fail(file, f"start has {option}; the hosts' programs and robots say that")
        robots = [words.partition(":")[0] for words in options.robot_words]
        entries = content.get("hosts")
        if not isinstance(entries, list) or not entries:
            fail(file, "hosts is not a list of hosts")
        self.hosts = [read_host(file, entry, number, robots) for number, entry in enumerate(entries, 1)]
        names = [host.name for host in self.hosts]
        for name in names:
            if names.count(name) > 1:
                fail(file, f"two hosts are called {name}")
        check_parts(file, self.hosts, options.programs, robots)
        self.programs = options.programs
        self.has_several_robots = len(robots) > 1

    def start_command(self, host):
        only = ",".join(program.removeprefix("nao-") for program in host.programs)
        words = [*self.start, *host.options, "--lcm-url", self.lcm_url, "--only", only]
        if self.has_several_robots:
            words += ["--only-robots", ",".join(host.robots)]
        return host.script("start", *words)


class Runner:
    """Runs commands on the hosts."""

    def __init__(self, ssh):
        self.ssh = [*shlex.split(ssh), "-o", "BatchMode=yes", "-o", "ConnectTimeout=10"]

    def run(self, host, words):
        """Runs a command in the project's folder on a host, which prints its own words. @return whether it succeeded."""
        command = f"cd {shlex.quote(host.folder)} && {shlex.join(words)}"
        call = [*self.ssh, host.ssh, command] if host.ssh else ["sh", "-c", command]
        print(f"== {host.name}", flush=True)
        try:
            status = subprocess.run(call, check=False, stdin=subprocess.DEVNULL).returncode
        except FileNotFoundError as error:
            raise Failure(f"{error.filename} is missing here; install it: scripts/setup --with deploy") from None
        if host.ssh and status == SSH_FAILED:
            print(f"hosts: no connection to {host.ssh}; is it switched on, and does it have your key "
                  f"(ssh-copy-id {host.ssh})?", file=sys.stderr)
        return status == 0


def start_all(deployment, runner):
    for number, host in enumerate(deployment.hosts):
        if runner.run(host, deployment.start_command(host)):
            continue
        # No robot without its gateway, no gateway without its robot.
        for started in reversed(deployment.hosts[:number]):
            runner.run(started, started.script("stop"))
        raise Failure(f"{host.name} does not start; what ran is stopped again")


def main():
    line = CommandLine("FILE [start|stop|status] [OPTION]...", __doc__)
    line.add_argument("file", metavar="FILE", help="deployment file, YAML")
    line.add_argument("command", metavar="COMMAND", nargs="?", choices=COMMANDS, default="start", help="start, stop or status")
    line.option("--ssh", metavar="COMMAND", default="ssh", help="how to reach other hosts (default: ssh)")
    options = line.parse()
    deployment = Deployment(options.file)
    runner = Runner(options.ssh)
    if options.command == "start":
        start_all(deployment, runner)
        return
    # One that fails must not leave the others running.
    hosts = reversed(deployment.hosts) if options.command == "stop" else deployment.hosts
    failed = [host.name for host in hosts if not runner.run(host, host.script(options.command))]
    if failed:
        raise Failure(f"{options.command} has failed on {' '.join(failed)}")


if __name__ == "__main__":
    run_script(main)
