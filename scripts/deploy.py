"""Puts this software on a real robot and runs it there. On the robot it is one folder: a small Debian system with the
package in it, which leaves the robot's own system as it is. Commands: install (the default) copies what differs and
ends what runs; start and stop; status; logs [PROGRAM]; remove deletes everything. Options after -- go to the robot's
start: scripts/deploy nao@ROBOT start -- --tls"""

import hashlib
import os
import platform
import re
import shlex
import shutil
import stat
import subprocess
import sys
from pathlib import Path

from output_file import replace_file
from stack import ROOT, CommandLine, Failure, run_script

COMMANDS = ("install", "start", "stop", "status", "logs", "remove")
# On the data partition, which has 25 of the 29 GB of a V6.
ROBOT_FOLDER = "/home/nao/nao-remote"
MODEL = "nao_v6"
CONTROL = ROOT / "packaging/robot-control"

# Debian that the package is built for: this machine's.
SUITE = platform.freedesktop_os_release().get("VERSION_CODENAME", "")
# Free space needed beyond the copy, for logs and settings, bytes. Chosen: ten times what the logs' rotation allows.
SPARE_SPACE = 500e6
# Exit status of ssh if it could not connect (ssh(1)), and here of a robot without an installation.
SSH_FAILED = 255
NOT_INSTALLED = 97

# What a minimal Debian system would otherwise start while it is made (policy-rc.d(8)).
NO_SERVICES = "#!/bin/sh\nexit 101\n"
# Folders that are filled on the robot.
SHARED = ("dev", "proc", "sys", "tmp", "var/lib/nao-remote")


def say(text):
    print(text, flush=True)


def quoted(words):
    return " ".join(shlex.quote(str(word)) for word in words)


class Steps:
    """Does steps, or with --dry-run only prints them."""

    def __init__(self, dry_run):
        self.dry_run = dry_run

    def tell(self, text, command):
        """@param text  Empty: the step belongs to the one before."""
        if text:
            say(text)
        if self.dry_run:
            say(f"    {command}")

    def do(self, text, words, fault, **keywords):
        """Runs a command on this machine. @throws Failure  with this text, if it fails."""
        self.tell(text, quoted(words))
        if self.dry_run:
            return
        try:
            status = subprocess.run([str(word) for word in words], check=False, **keywords).returncode
        except FileNotFoundError as error:
            raise Failure(f"{error.filename} is missing here; install it: scripts/setup --with deploy") from None
        if status != 0:
            raise Failure(fault)


class Robot:
    """The robot at the other end of ssh."""

    def __init__(self, steps, options):
        self.steps = steps
        self.target = options.target
        self.folder = options.dir
        self.ssh = [*shlex.split(options.ssh), "-o", "BatchMode=yes", "-o", "ConnectTimeout=10"]
        # Replaced by what the robot says.
        self.sudo = [] if options.target.startswith("root@") else ["sudo", "-n"]

    def words(self, command):
        return [*self.ssh, self.target, command]

    def ask(self, command):
        """@return what a command on the robot prints. @throws Failure  if it fails."""
        try:
            result = subprocess.run(self.words(command), check=False, stdin=subprocess.DEVNULL, capture_output=True,
                                    text=True)
        except FileNotFoundError as error:
            raise Failure(f"{error.filename} is missing here; install it: scripts/setup --with deploy") from None
        self.check(result.returncode, result.stderr)
        return result.stdout

    def check(self, status, said=""):
        if status == SSH_FAILED:
            raise Failure(f"no connection to {self.target} ({said.strip() or 'see above'}); is it switched on, in this "
                          f"network, and does it have your key (ssh-copy-id {self.target})?")
        if status == NOT_INSTALLED:
            raise Failure(f"nothing is installed in {self.folder} of {self.target}; "
                          f"scripts/deploy {self.target} install")
        if status != 0:
            raise Failure(f"{self.target} ended that with status {status}{': ' if said else ''}{said.strip()}")

    def do(self, text, words, **keywords):
        """Runs a command as root on the robot, which prints its own errors."""
        command = quoted([*self.sudo, *words])
        self.steps.tell(text, quoted(self.words(command)))
        if not self.steps.dry_run:
            self.check(subprocess.run(self.words(command), check=False, **keywords).returncode)

    def control(self, text, *words):
        """Runs the control script on the robot as root."""
        control = f"{self.folder}/control"
        call = quoted([*self.sudo, control, *words])
        command = f"if [ -x {control} ]; then exec {call}; else exit {NOT_INSTALLED}; fi"
        self.steps.tell(text, quoted(self.words(command)))
        if not self.steps.dry_run:
            self.check(subprocess.run(self.words(command), check=False, stdin=subprocess.DEVNULL).returncode)

    def become_root(self):
        """Finds out how commands become root's."""
        if self.steps.dry_run:
            return
        if self.ask("id -u").strip() == "0":
            self.sudo = []
        elif self.ask("sudo -n true && echo yes || echo no").strip() == "yes":
            self.sudo = ["sudo", "-n"]
        else:
            raise Failure(f"{self.target} must become root without a password, to mount and for real-time threads; "
                          f"log in as root, or permit it there: visudo, NAME ALL=(ALL) NOPASSWD: ALL")


def parse_facts(text):
    """Lines "key=value" as a dictionary."""
    return dict(line.split("=", 1) for line in text.splitlines() if "=" in line)


def check_facts(facts, needed, folder):
    """@throws Failure  if a robot cannot hold and run the programs. @param facts  What FACTS prints there.
    @param needed  Bytes to copy at most."""
    if facts.get("machine") != "x86_64":
        raise Failure(f"the robot's processor is {facts.get('machine') or 'unknown'}, the programs are for x86_64: a "
                      "NAO V6. Is that the right host?")
    if facts.get("sse") != "yes":
        raise Failure("the robot's processor has no SSE4.2, which every NAO V6 has; is that the right host?")
    free = int(facts.get("free_kb") or 0) * 1024
    # What an earlier or interrupted copy has already is replaced.
    free += int(facts.get("used_kb") or 0) * 1024
    if free < needed + SPARE_SPACE:
        raise Failure(f"{folder} is on {facts.get('partition', 'a partition')} with {free / 1e9:.1f} GB free, "
                      f"{(needed + SPARE_SPACE) / 1e9:.1f} GB are needed; delete something there, or take another folder: "
                      "--dir DIR")
    if facts.get("tar") != "yes":
        raise Failure("the robot's system has no tar; install it there")


def facts_command(folder):
    """Shell commands that print what check_facts() needs."""
    root = shlex.quote(f"{folder}/root")
    return f"folder={shlex.quote(folder)}; root={root}" + r"""
while [ ! -d "$folder" ]; do folder=$(dirname "$folder"); done
echo "machine=$(uname -m)"
if grep -qw sse4_2 /proc/cpuinfo; then echo sse=yes; fi
df -Pk "$folder" | awk 'NR == 2 { print "free_kb=" $4; print "partition=" $6 }'
for tool in rsync tar; do if command -v $tool >/dev/null; then echo $tool=yes; fi; done
if [ -d "$root" ]; then du -sk "$root" 2>/dev/null | awk '{ print "used_kb=" $1 }'; fi
true"""


def local_files(root):
    """@return path below root -> (type, size, modification time in whole seconds) as list_command() has them. What is
    filled on the robot is left out; of folders only the type counts."""
    found = {}
    for folder, folders, files in os.walk(root):
        relative = os.path.relpath(folder, root)
        prefix = "" if relative == "." else relative + "/"
        names = [*folders, *files]
        folders[:] = [name for name in folders if prefix + name not in SHARED]
        for name in names:
            status = os.lstat(os.path.join(folder, name))
            kind = "d" if stat.S_ISDIR(status.st_mode) else "l" if stat.S_ISLNK(status.st_mode) else "f"
            found[prefix + name] = (kind, 0, 0) if kind == "d" else (kind, status.st_size, int(status.st_mtime))
    return found


def parse_list(data):
    """What list_command() printed, as local_files() returns it."""
    found = {}
    for entry in data.split("\0"):
        if not entry:
            continue
        kind, size, changed, path = entry.split(" ", 3)
        if any(path.startswith(shared + "/") for shared in SHARED):
            continue
        found[path] = (kind, 0, 0) if kind == "d" else (kind, int(size), int(float(changed)))
    return found


def list_command(folder):
    return ["find", f"{folder}/root", "-mindepth", "1", "-printf", r"%y %s %T@ %P\0"]


def plan_copy(local, remote):
    """@return the paths to send, folders before what is in them, and those to remove, the other way round."""
    send = sorted(path for path, what in local.items() if remote.get(path) != what)
    remove = sorted((path for path, what in remote.items()
                     if path not in SHARED and (path not in local or local[path][0] != what[0])), reverse=True)
    return send, remove


def copy_by_rsync(steps, robot, root):
    excludes = [f"--exclude=/{name}/*" for name in SHARED]
    steps.do("Copying what differs (rsync; an interrupted copy continues when this is called again).",
             ["rsync", "--archive", "--hard-links", "--compress", "--delete", "--partial", "--chown=root:root", *excludes,
              f"--rsync-path={quoted([*robot.sudo, 'rsync'])}", f"--rsh={quoted(robot.ssh)}",
              f"{root}/", f"{robot.target}:{robot.folder}/root/"],
             f"the copy to {robot.target} was interrupted; call this again to continue it")


def copy_by_tar(steps, robot, root):
    """Sends with tar what the robot does not have yet; so an interrupted copy continues."""
    receive = quoted([*robot.sudo, "tar", "--directory", f"{robot.folder}/root", "--extract", "--gzip",
                      "--preserve-permissions"])
    send = ["tar", "--directory", str(root), "--create", "--gzip", "--no-recursion", "--owner=0", "--group=0", "--null",
            "--files-from=-"]
    steps.tell("Copying what differs (tar; an interrupted copy continues when this is called again).",
               f"{quoted(send)} | {quoted(robot.words(receive))}")
    if steps.dry_run:
        return
    listed = subprocess.run(robot.words(quoted([*robot.sudo, *list_command(robot.folder)]) + " 2>/dev/null || true"),
                            check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
    robot.check(listed.returncode)
    local = local_files(root)
    paths, removed = plan_copy(local, parse_list(os.fsdecode(listed.stdout)))
    if removed:
        names = "".join(f"{robot.folder}/root/{path}\0" for path in removed)
        robot.do(f"Removing {len(removed)} files of an earlier copy.", ["xargs", "-0", "rm", "-rf", "--one-file-system", "--"],
                 input=os.fsencode(names))
    if not paths:
        return
    sender = subprocess.Popen(send, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    receiver = subprocess.Popen(robot.words(receive), stdin=sender.stdout)
    sender.stdout.close()
    try:
        sender.stdin.write(os.fsencode("".join(path + "\0" for path in paths)))
        sender.stdin.close()
    except BrokenPipeError:
        pass
    if receiver.wait() != 0 or sender.wait() != 0:
        sender.wait()
        raise Failure(f"the copy to {robot.target} was interrupted; call this again to continue it")


def size_of(root):
    """Bytes of all files below a folder."""
    return sum(size for _, size, _ in local_files(root).values())


def run_packages():
    """What the scripts call, of scripts/packages."""
    lines = (ROOT / "scripts/packages").read_text().splitlines()
    return [line.split()[1] for line in lines if line.startswith("run ")]


def build_package(steps):
    """Builds the Debian package. @return its file."""
    build = f". {shlex.quote(str(ROOT / 'scripts/lib.sh'))}; build_preset release package"
    steps.do("Building the Debian package (build/release).", ["bash", "-c", build, "deploy"],
             "the package was not built, see above; or name one: --package FILE", env={**os.environ, "PROGRAM": "deploy"})
    found = sorted((ROOT / "build/release").glob("nao-remote_*_amd64.deb"))
    if not found and not steps.dry_run:
        raise Failure(f"there is no package in {ROOT / 'build/release'}; name one: --package FILE")
    return found[-1] if found else ROOT / "build/release/nao-remote_VERSION_amd64.deb"


def make_root(steps, package, root):
    """Makes the robot's Debian system with the package, unless it is there. It is the user's own: nothing in it needs
    another owner, since on the robot everything in it belongs to root."""
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    stamp = root.parent / "made"
    wanted = f"{SUITE} {hashlib.sha256(package.read_bytes()).hexdigest()}\n" if package.exists() else ""
    if wanted and stamp.exists() and stamp.read_text() == wanted:
        say(f"The robot's system is in {root} already.")
        return
    fault = "the robot's system was not made, see above; is there a network?"
    stamp.unlink(missing_ok=True)
    steps.do("Making a Debian system for the robot.", [*as_root, "rm", "-rf", "--one-file-system", root], fault)
    if not steps.dry_run:
        root.parent.mkdir(parents=True, exist_ok=True)
    steps.do("", [*as_root, "debootstrap", "--variant=minbase", SUITE, root], fault)
    inside = [*as_root, "chroot", root, "/usr/bin/env", "DEBIAN_FRONTEND=noninteractive",
              "PATH=/usr/sbin:/usr/bin:/sbin:/bin"]
    steps.do("", [*as_root, "sh", "-c", 'printf "$1" >"$2/usr/sbin/policy-rc.d"; chmod 755 "$2/usr/sbin/policy-rc.d"',
                  "policy", NO_SERVICES.replace("\n", r"\n"), root], fault)
    steps.do("Installing the package in it.", [*as_root, "cp", package, root / "tmp/nao-remote.deb"], fault)
    steps.do("", [*inside, "apt-get", "update", "--quiet"], fault)
    steps.do("", [*inside, "apt-get", "install", "--yes", "--quiet", "--no-install-recommends",
                  "--option", "DPkg::Options::=--force-unsafe-io", "/tmp/nao-remote.deb", *run_packages()], fault)
    steps.do("", [*inside, "sh", "-c",
                  "rm -rf /tmp/* /var/cache/apt/* /var/lib/apt/lists/* /usr/share/doc/* /usr/share/man/*"], fault)
    owner = f"{os.getuid()}:{os.getgid()}"
    steps.do("", [*as_root, "sh", "-c", f"chown -R {owner} \"$1\" && chmod -R u+rX \"$1\"", "own", root], fault)
    if not steps.dry_run:
        replace_file(stamp, wanted)


def install(steps, robot, options):
    if options.root:
        root = options.root
        if not (root / "usr/bin/nao-remote").exists():
            raise Failure(f"there is no {root / 'usr/bin/nao-remote'}; "
                          "--root names a Debian system with the package in it")
    else:
        root = ROOT / "build/robot/root"
        make_root(steps, options.package or build_package(steps), root)

    command = facts_command(robot.folder)
    steps.tell("Checking the robot: processor, space, tools.", quoted(robot.words(command)))
    facts = {}
    if not steps.dry_run:
        facts = parse_facts(robot.ask(command))
        check_facts(facts, size_of(root), robot.folder)

    stop = f"{robot.folder}/control"
    robot.do("Ending what runs there; a robot that stands sits down.",
             ["sh", "-c", f"mkdir -p {robot.folder}/root && cd {robot.folder} && rm -f complete && "
                          f"if [ -x {stop} ]; then {stop} stop; fi"], stdin=subprocess.DEVNULL)
    has_rsync = steps.dry_run or (facts.get("rsync") == "yes" and shutil.which("rsync"))
    if has_rsync and not options.tar:
        copy_by_rsync(steps, robot, root)
    else:
        copy_by_tar(steps, robot, root)
    control = shlex.quote(f"{robot.folder}/control")
    robot.do("Installing its control script; the copy is complete.",
             ["sh", "-c", f"cat >{control}.new && chmod 755 {control}.new && mv {control}.new {control} && "
                          f"touch {robot.folder}/complete"],
             **({} if steps.dry_run else {"input": CONTROL.read_bytes()}))
    if options.boot:
        robot.control("Starting the programs with the robot from now on.", "boot", *start_options(options))
    else:
        robot.control("Not starting the programs with the robot.", "no-boot")
    if not steps.dry_run:
        say(f"Installed. Seat the robot, then: scripts/deploy {robot.target} start")


def start_options(options):
    return ["--model", options.model, *options.forwarded]


def parse_options():
    words = sys.argv[1:]
    forwarded = []
    if "--" in words:
        forwarded = words[words.index("--") + 1:]
        sys.argv[1:] = words[:words.index("--")]
    line = CommandLine("USER@HOST [COMMAND] [OPTION]... [-- OPTION...]", __doc__)
    line.add_argument("target", metavar="USER@HOST", help="the robot, as for ssh, with a key")
    line.add_argument("command", nargs="?", metavar="COMMAND", default="install", help=", ".join(COMMANDS))
    line.add_argument("program", nargs="?", metavar="PROGRAM", default="", help="of logs; all by default")
    line.option("--dry-run", action="store_true", help="print every step without doing it; contacts no robot")
    line.option("--dir", metavar="DIR", default=ROBOT_FOLDER, help=f"folder on the robot (default: {ROBOT_FOLDER})")
    line.option("--model", metavar="NAME", default=MODEL, help=f"of the robot, for start (default: {MODEL})")
    line.option("--boot", action="store_true", help="with install: start the programs with the robot, by systemd")
    line.option("--package", metavar="FILE", type=lambda text: Path(text).resolve(),
                help="Debian package to install (default: build it)")
    line.option("--root", metavar="DIR", type=lambda text: Path(text).resolve(),
                help="Debian system with the package in it (default: make it in build/robot/root)")
    line.option("--tar", action="store_true", help="copy with tar, also if there is rsync")
    line.option("--ssh", metavar="COMMAND", default="ssh",
                help='with its options, such as "ssh -p 2222 -i KEY" (default: ssh)')
    options = line.parse()
    options.forwarded = forwarded
    if options.target.startswith("-") or not re.fullmatch(r"([\w.-]+@)?[\w.:-]+", options.target):
        line.error(f"'{options.target}' is not USER@HOST")
    if options.target in COMMANDS:
        line.error(f"USER@HOST is missing before {options.target}")
    if options.command not in COMMANDS:
        line.error(f"no command '{options.command}'; there are: {' '.join(COMMANDS)}")
    if options.program and (options.command != "logs" or not re.fullmatch(r"[\w-]+", options.program)):
        line.error(f"'{options.program}' does not belong to {options.command}")
    # It is deleted by remove, and stands in shell commands and mount tables.
    if not re.fullmatch(r"(/[\w.-]+){2,}", options.dir) or ".." in options.dir.split("/"):
        line.error(f"--dir {options.dir}: takes an absolute path, two folders deep at least, of letters, digits, '.', '_' "
                   "and '-'")
    if options.package and not options.package.is_file():
        line.error(f"there is no {options.package}")
    return options


def main():
    options = parse_options()
    steps = Steps(options.dry_run)
    robot = Robot(steps, options)
    robot.become_root()
    if options.command == "install":
        install(steps, robot, options)
    elif options.command == "start":
        robot.control("Starting the programs; the robot must be seated.", "start", *start_options(options))
    elif options.command == "stop":
        robot.control("Ending the programs; a robot that stands sits down.", "stop")
    elif options.command == "remove":
        robot.control("Ending the programs and deleting everything.", "remove")
    else:
        robot.control(f"Asking {robot.target}.", options.command, *([options.program] if options.program else []))


if __name__ == "__main__":
    run_script(main)
