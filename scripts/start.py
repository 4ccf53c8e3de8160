"""Installs and builds what is missing, starts the programs, waits until a phone can drive, and prints the
address to open on it. scripts/stop ends the programs, scripts/status shows their state."""

import fcntl
import itertools
import os
import re
import select
import subprocess
import sys
from argparse import ArgumentTypeError
from pathlib import Path

from stack import (CALL, COMPANIONS, PROGRAMS, ROBOT, ROBOT_WATCHDOG, ROOT, CommandLine, Failure, Stack, run_as_root,
                   run_script, warn)

# Ports that are tried first. 8080: registered for HTTP alternatives (IANA); 7668: next to LCM's 7667.
HTTP_PORT = 8080
TCP_PORT = 7668
GATEWAY = "nao-phone-gateway"

# Time for all programs to become ready, s. Chosen: ten times the usual 2 to 4 s, and more for a loaded machine.
READY_TIMEOUT = 60
# The same with --only, s: a program may wait for programs on other hosts.
ONLY_READY_TIMEOUT = 5
# Period, s, of looking for crashed programs meanwhile. Chosen: not noticed by a user.
POLL_PERIOD = 0.05
# A program that ended so often before all programs were ready has failed.
MAX_START_FAILURES = 3
# Length of a run directory's path: a socket's path has at most 107 bytes (unix(7)), supervisor appends to it.
MAX_RUN_DIR_LENGTH = 80

# A program that ends within 5 s of its start is restarted after 1 s, 2 s, 3 s ...; after ten consecutive failures
# (about a minute) it is not restarted. A program that ran longer is restarted immediately.
SUPERVISOR_SECTION = """\
[unix_http_server]
file={socket}
chmod=0700

[supervisord]
logfile={logs}/supervisord.log
logfile_maxbytes=5MB
logfile_backups=3
pidfile={pid_file}
{user}

[rpcinterface:supervisor]
supervisor.rpcinterface_factory = supervisor.rpcinterface:make_main_rpcinterface

[supervisorctl]
serverurl=unix://{socket}
"""
# Time to end after SIGTERM, s; the bridge of a robot first lets it sit down.
STOP_WAIT_TIME = 5
ROBOT_STOP_WAIT_TIME = 10
PROGRAM_SECTION = """
[program:{program}]
command={command}
autorestart={restart}
startsecs=5
startretries=10
stopsignal=TERM
stopwaitsecs={stop_time}
redirect_stderr=true
stdout_logfile={logs}/{program}.log
stdout_logfile_maxbytes=5MB
stdout_logfile_backups=3
"""


def say(text):
    print(text, flush=True)


def port(text):
    """Value of a port's option."""
    if not re.fullmatch("[0-9]{1,5}", text) or not 1 <= int(text) <= 65535:
        raise ArgumentTypeError(f"'{text}' is not a port from 1 to 65535")
    return int(text)


def parse_options():
    line = CommandLine("[OPTION]...", __doc__)
    line.option("--scene", metavar="NAME", default="soccer", help="empty or soccer (default: soccer)")
    line.option("--robot", metavar="NAME", default="NAO",
                help="name of the robot: prefix of its channels (default: NAO)")
    line.option("--only", metavar="LIST",
                help="only these programs; the others run on other hosts: sim,motion,head-camera,phone-gateway")
    line.option("--no-camera", action="store_true", help="without the head camera")
    line.option("--lcm-url", metavar="URL",
                default=os.environ.get("LCM_DEFAULT_URL") or "udpm://239.255.76.67:7667?ttl=0",
                help="message bus (default: LCM_DEFAULT_URL, or limited to this host: udpm://239.255.76.67:7667?ttl=0; "
                     "several hosts: ...?ttl=1)")
    line.option("--backend", choices=("sim", "lola"), default="sim",
                help="sim: the robot is simulated; lola: the simulated robot has the interface of a NAO V6, and nao-robot "
                     "connects it as it would a real one (default: sim)")
    line.option("--lock-step", action="store_true", help="simulate as fast as possible and deterministically")
    line.option("--http-port", metavar="PORT", type=port,
                help=f"for the app (default: {HTTP_PORT}, or the next free one)")
    line.option("--tcp-port", metavar="PORT", type=port,
                help=f"for clients in other languages (default: {TCP_PORT}, or the next free one)")
    line.option("--bind", metavar="ADDRESS", default="0.0.0.0",
                help="address to listen on: 127.0.0.1 for this host only (default: 0.0.0.0)")
    line.option("--tls", action="store_true",
                help="also https on the same port, with a self-signed certificate: phones give their tilt sensors only to "
                     "secure pages, after the user has accepted a warning")
    line.option("--token", metavar="TOKEN", help="access token for phones (default: a new random one)")
    line.option("--bin", metavar="DIR", default=os.environ.get("NAO_REMOTE_BIN") or None,
                help="folder of built programs (default: NAO_REMOTE_BIN, or build them)")
    line.run_dir_option("for logs and settings; one for each stack")
    options = line.parse()
    options.programs = choose_programs(line, options)
    return options


def choose_programs(line, options):
    """The programs that --only and --no-camera leave."""
    programs = list(PROGRAMS)
    if options.backend == "lola":
        programs.insert(1, ROBOT)
    known_programs = list(programs)
    if options.only:
        names = re.split("[, ]+", options.only.strip(", "))
        programs = ["nao-" + name.removeprefix("nao-") for name in names]
        for name, program in zip(names, programs):
            if program not in known_programs:
                known = " ".join(known.removeprefix("nao-") for known in known_programs)
                line.error(f"no program '{name}'; there are: {known}")
    if options.no_camera:
        programs = [program for program in programs if program != "nao-head-camera"]
    if not programs:
        line.error("no program is left to start")
    return programs


def install_and_build(options):
    """Installs and builds what is missing. @return the folder of the programs."""
    setup = [ROOT / "scripts/setup"]
    # What is installed and built can be read by other users, unlike what a stack writes.
    if options.bin:
        folder = Path(options.bin).resolve()
        succeed([*setup, "--run-only"], umask=0o022)
    else:
        folder = ROOT / "build/dev/bin"
        succeed(setup, umask=0o022)
        if not (folder / "nao-sim").exists():
            say("Building; the first time this takes some minutes.")
        # Only the programs started here; all others (nao-viewer, nao-trial): cmake --build --preset dev --target programs
        build = f". '{ROOT}/scripts/lib.sh'; build_preset dev \"$@\""
        watchdog = [ROBOT_WATCHDOG] if ROBOT in options.programs else []
        succeed(["bash", "-c", build, "start", *options.programs, *watchdog, *COMPANIONS], umask=0o022)
    for program in [*options.programs, "nao"]:
        if not os.access(folder / program, os.X_OK):
            raise Failure(f"there is no {folder / program}; build it, or choose other programs: --only")
    return folder


def succeed(command, **keywords):
    """Runs a command that prints its own errors. Ends this script with the command's exit status if it fails."""
    status = subprocess.run(command, check=False, **keywords).returncode
    if status != 0:
        sys.exit(status)


def listeners(number):
    """What ss prints of the sockets that listen on a port."""
    return subprocess.run(["ss", "-Hltnp", f"sport = :{number}"], check=True, stdout=subprocess.PIPE, text=True).stdout


def owner_of(sockets):
    """The listening program, if visible to this user."""
    owner = re.search(r'users:\(\("([^"]*)",pid=(\d+)', sockets)
    return f"{owner[1]} (process {owner[2]})" if owner else "another program"


def choose_port(given, option, default):
    """A given port, which must be free; otherwise the first free one from the default on."""
    if given:
        if used := listeners(given):
            raise Failure(f"port {given} is in use by {owner_of(used)}. End that, or take another: {option} PORT")
        return given
    used = listeners(default)
    chosen = default if not used else next(number for number in itertools.count(default + 1) if not listeners(number))
    if used:
        say(f"Port {default} is in use by {owner_of(used)}; taking {chosen} instead ({option} chooses another).")
    return chosen


def check_bus(bin_dir, lcm_url):
    """Checks that messages arrive. The bus needs a route for its multicast group. Without a network there is none: adds
    one by the loopback interface."""
    def fault():
        result = subprocess.run([bin_dir / "nao", "bus", "--quick", "--lcm-url", lcm_url], check=False,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return result.stdout.strip() if result.returncode != 0 else None

    report = fault()
    if report is None:
        return
    group = re.match(r"udpm://([0-9.]+)", lcm_url)
    if "no route" not in report or not group:
        raise Failure(f"the message bus does not work: {report}")
    network = group[1].rpartition(".")[0] + ".0/24"
    say(f"The message bus has no route on this machine; adding one: {network} by the loopback interface.")
    if not (run_as_root("ip", "link", "set", "lo", "up", "multicast", "on") and
            run_as_root("ip", "route", "replace", network, "dev", "lo")):
        raise Failure("that needs root. As root, run: ip link set lo up multicast on; "
                      f"ip route add {network} dev lo")
    report = fault()
    if report is not None:
        raise Failure(f"the message bus does not work: {report}")


def escaped(text):
    """A text in supervisor's configuration."""
    return str(text).replace("%", "%%")


def gateway_options(stack, settings):
    """Options of the gateway that decide which addresses phones open."""
    options = ["--http-port", settings["http_port"], "--bind", settings["bind"], "--token-file", stack.token_file]
    return [*options, "--tls"] if settings["scheme"] == "https" else options


def command_of(program, stack, settings, options):
    """Command line of a program, quoted for supervisor."""
    bus = ["--lcm-url", settings["lcm_url"]]
    if program == "nao-watchdog":
        words = ["nao", "watchdog", *bus]
    else:
        words = [program, *bus, "--robot", settings["robot"]]
    if program == "nao-sim":
        words += ["--scene", settings["scene"], *(["--lola", stack.lola_socket] if options.backend == "lola" else [])]
    elif program == ROBOT:
        # Nobody presses a simulated robot's button.
        words = [ROBOT_WATCHDOG, *words[1:], "--lola", stack.lola_socket, "--autostart"]
    elif program == GATEWAY:
        words += [*gateway_options(stack, settings), "--tcp-port", settings["tcp_port"],
                  "--audit-log", stack.logs / "phones.jsonl"]
    if options.lock_step and program in ("nao-sim", ROBOT):
        words.append("--lock-step")
    words[0] = f"{settings['bin_dir']}/{words[0]}"
    return " ".join('"' + escaped(word).replace('"', '\\"') + '"' for word in words)


def write_configuration(stack, settings, options):
    paths = {"socket": escaped(stack.socket), "logs": escaped(stack.logs), "pid_file": escaped(stack.pid_file)}
    text = SUPERVISOR_SECTION.format(**paths, user="user=root" if os.geteuid() == 0 else "")
    for program in [*options.programs, "nao-watchdog"]:
        is_robot = program == ROBOT
        # The bridge ends with status 0 when it was ended by the robot's button.
        text += PROGRAM_SECTION.format(**paths, program=program,
                                       command=command_of(program, stack, settings, options),
                                       restart="unexpected" if is_robot else "true",
                                       stop_time=ROBOT_STOP_WAIT_TIME if is_robot else STOP_WAIT_TIME)
    stack.configuration.write_text(text)


def failed_program(stack, programs):
    """A program that ended several times; None if there is none."""
    log = (stack.logs / "supervisord.log").read_text(errors="replace")
    return next((program for program in programs if log.count(f"exited: {program} ") >= MAX_START_FAILURES), None)


def wait_until_ready(stack, settings, options):
    """Waits until every program is ready. With --only, a program may wait for programs on other hosts: then a shorter
    timeout applies and is not an error."""
    timeout = ONLY_READY_TIMEOUT if options.only else READY_TIMEOUT
    report = stack.logs / "start.log"
    with open(report, "w", encoding="utf-8") as output:
        waiter = subprocess.Popen([f"{settings['bin_dir']}/nao", "status", "--wait", ",".join(options.programs),
                                   "--timeout", str(timeout), "--lcm-url", settings["lcm_url"]], stderr=output)
    ended = os.pidfd_open(waiter.pid)  # readable when the process has ended
    while not select.select([ended], [], [], POLL_PERIOD)[0]:
        failed = failed_program(stack, options.programs)
        if failed:
            waiter.kill()
            waiter.wait()
            log = stack.logs / f"{failed}.log"
            warn(f"{failed} does not start. Its last words ({log}):")
            print("\n".join(log.read_text(errors="replace").splitlines()[-5:]), file=sys.stderr)
            stack.stop()
            raise Failure(f"everything is stopped again. More: {CALL}start --help, docs/troubleshooting.md")
    if waiter.wait() == 0:
        return
    sys.stderr.write(re.sub("^nao: ", "", report.read_text(), flags=re.MULTILINE))
    if options.only:
        warn(f"the programs run and wait for the others; {CALL}status shows when they are there")
        return
    stack.stop()
    raise Failure(f"not everything became ready within {timeout} s, so everything is stopped again; logs: {stack.logs}")


def print_addresses(stack):
    """Prints the addresses to open, which the gateway knows, the first one also as a QR code."""
    settings = stack.read_settings()
    told = subprocess.run([f"{settings['bin_dir']}/{GATEWAY}", "--print-addresses", "--print-qr",
                           *gateway_options(stack, settings)], check=True, stdout=subprocess.PIPE, text=True).stdout
    urls, _, qr_code = told.partition("\n\n")
    urls = urls.splitlines()
    is_local = "//127." in urls[0]
    if is_local and not settings["bind"].startswith("127."):
        say(f"This machine is in no network, so no phone can reach it; once it is, run {CALL}start again.")
    say("Open this on this machine:" if is_local else "Open this on the phone, in the same Wi-Fi:")
    for url in urls:
        say(f"  {url}")
    if not is_local:
        say(f"or on this machine: http://127.0.0.1:{settings['http_port']}/")
        # Colors, black and white, only for a terminal.
        say(qr_code if sys.stdout.isatty() else re.sub(r"\x1b\[[0-9;]*m", "", qr_code))
    say(f"Clients in other languages: TCP port {settings['tcp_port']}. Watch: {CALL}status. End: {CALL}stop")


def choose_settings(options, bin_dir):
    """What scripts/start has chosen, for the other scripts."""
    has_gateway = GATEWAY in options.programs
    return {
        "bin_dir": bin_dir,
        "lcm_url": options.lcm_url,
        "robot": options.robot,
        "scene": options.scene,
        "programs": " ".join(options.programs),
        "http_port": choose_port(options.http_port, "--http-port", HTTP_PORT) if has_gateway else "",
        "tcp_port": choose_port(options.tcp_port, "--tcp-port", TCP_PORT) if has_gateway else "",
        "bind": options.bind,
        "scheme": "https" if options.tls else "http",
    }


def main():
    options = parse_options()
    os.umask(0o077)
    stack = Stack(options.run_dir)
    if len(str(stack.run_dir)) > MAX_RUN_DIR_LENGTH:
        raise Failure(f"the path {stack.run_dir} is too long for a socket; choose a shorter: --run-dir DIR")
    stack.logs.mkdir(parents=True, exist_ok=True)
    lock = open(stack.run_dir / "lock", "w", encoding="utf-8")  # held until the script ends
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise Failure(f"another {CALL}start is at work in {stack.run_dir}; wait for it") from None

    if stack.supervisor_pid() is not None:
        say(f"The robot is running already (other options need {CALL}stop first).")
        if GATEWAY in stack.read_settings()["programs"]:
            print_addresses(stack)
        return
    stack.stop()  # orphans of a killed supervisor

    bin_dir = install_and_build(options)
    settings = choose_settings(options, bin_dir)
    check_bus(bin_dir, options.lcm_url)
    stack.token_file.unlink(missing_ok=True)  # the gateway creates a new one
    if options.token:
        stack.token_file.write_text(options.token + "\n")
    write_configuration(stack, settings, options)
    stack.write_settings(settings)
    (stack.logs / "supervisord.log").write_text("")
    succeed([sys.executable, "-m", "supervisor.supervisord", "--configuration", stack.configuration],
            env={**os.environ, "NAO_REMOTE_STACK": str(stack.run_dir)})
    wait_until_ready(stack, settings, options)
    if GATEWAY in options.programs:
        print_addresses(stack)
    else:
        say(f"Running: {settings['programs']}. Watch: {CALL}status. End: {CALL}stop")


if __name__ == "__main__":
    run_script(main)
