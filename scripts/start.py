"""Installs and builds what is missing, starts the programs, waits until a phone can drive, and prints the
address to open on it. scripts/stop ends the programs, scripts/status shows their state."""

import fcntl
import itertools
import os
import re
import select
import shutil
import socket
import subprocess
import sys
import time
from argparse import ArgumentTypeError
from pathlib import Path

from imported_model import data_folder, import_model
from output_file import replace_file
from robots import (MAX_ROBOTS, Process, choose_autonomous, choose_processes, choose_robots, choose_served_robots,
                    number_of_robots, place_robots, team_sizes)
from seat import check_seated
from stack import (CALL, CAMERA, COMPANIONS, FOXGLOVE, LOLA_SOCKET, OPTIONAL, PLAY, PROGRAMS, ROBOT, ROBOT_PROGRAMS,
                   REFEREE, ROBOT_WATCHDOG, ROOT, SIM, TO_DRIVE, VISION, WATCHDOG, CommandLine, Failure, Stack, run_script,
                   warn)

# Ports that are tried first. 8080: registered for HTTP alternatives (IANA); 7668: next to LCM's 7667; 8765: what
# Foxglove proposes.
HTTP_PORT = 8080
TCP_PORT = 7668
FOXGLOVE_PORT = 8765
GATEWAY = "nao-phone-gateway"

# Time for all programs to become ready, s. Chosen: ten times the usual 2 to 4 s, and more for a loaded machine.
READY_TIMEOUT = 60
# The same for programs that driving does not need, once it is possible, s. Chosen: they need less than a second more.
OTHERS_READY_TIMEOUT = 10
# The same as READY_TIMEOUT with --only, s: a program may wait for programs on other hosts; and the time in which
# nao-robot makes a simulated robot sit down and get up, twice the usual 5 s.
ONLY_READY_TIMEOUT = 5
ROBOT_READY_TIME = 10
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
[program:{name}]
command={command}
priority={priority}
autorestart={restart}
startsecs=5
startretries=10
stopsignal=TERM
stopwaitsecs={stop_time}
redirect_stderr=true
stdout_logfile={logs}/{name}.log
stdout_logfile_maxbytes=5MB
stdout_logfile_backups=3
"""


# Where the simulator places the robot.
DEFAULT_START_POSE = "0,0,0"


def say(text):
    print(text, flush=True)


def port(text):
    """Value of a port's option."""
    if not re.fullmatch("[0-9]{1,5}", text) or not 1 <= int(text) <= 65535:
        raise ArgumentTypeError(f"'{text}' is not a port from 1 to 65535")
    return int(text)


def start_pose(text):
    """Value of --start-pose; nao-vision checks its range."""
    if not re.fullmatch(r"[-+0-9.e]+,[-+0-9.e]+,[-+0-9.e]+", text):
        raise ArgumentTypeError(f"'{text}' is not a pose X,Y,HEADING such as 0,0,0 or -3,0,90")
    return text


def parse_options(arguments=None):
    """@param arguments  Instead of the command line."""
    line = CommandLine("[OPTION]...", __doc__)
    line.option("--exhibition", metavar="FILE", type=lambda text: Path(text).resolve(),
                help="visitors drive one after the other, by the settings in this file, of which data/exhibition/example.yaml is "
                     "an example; prints the addresses of a big display and of the operator's page: docs/exhibition.md")
    line.option("--scene", metavar="NAME", default="soccer", help="empty, soccer, or a field of the league of 2026: hsl_small, hsl_middle, hsl_large "
                     "(default: soccer)")
    line.option("--robot", metavar="NAME[:MODEL]", action="append",
                help="name of the robot, which is the prefix of its channels, and its model (default: NAO, and that of "
                     "--model); repeat it for several robots in one world")
    line.option("--robots", metavar="NUMBER", type=number_of_robots,
                help=f"this many robots, up to {MAX_ROBOTS}: NAO1, NAO2 ...; an even number is two teams (default: 1)")
    line.option("--match", metavar="TEAMS", type=team_sizes,
                help="two teams that face each other, such as 2v2 (1 to 5 robots each): NAO1, NAO2 ... of team 0, which plays "
                     "along x, then those of team 1")
    line.option("--game-controller", action="store_true",
                help="the RoboCup GameController in the network decides the match instead of nao-referee's own rules")
    line.option("--autonomous", metavar="LIST",
                help="with --match: robots that play by themselves by what they see, such as NAO2,NAO4, or all; anybody may "
                     "take them over")
    line.option("--model", metavar="NAME", default="nao",
                help="folder of robots/ that describes robots without a model: nao, a V5, nao_v6, t1, g1, k1 (default: nao); or a URDF, "
                     "which is imported: docs/your-robot.md")
    line.option("--only", metavar="LIST",
                help="only these programs; the others run on other hosts: "
                     "sim,motion,motion-files,head-camera,speaker,phone-gateway, and what other options add: robot,referee,vision,play")
    line.option("--only-robots", metavar="LIST",
                help="with --only: of the programs that there are for each robot only those of these, such as NAO1,NAO2")
    line.option("--no-camera", action="store_true", help="without the head camera")
    line.option("--vision", action="store_true",
                help="also find ball, lines, goals and robots in the head camera's images, and the robot's pose on the field, and "
                     "let the robot act by it (the app's \"Score\" and \"Keep goal\"): docs/vision.md")
    line.option("--start-pose", metavar="X,Y,HEADING", type=start_pose, default=DEFAULT_START_POSE,
                help="with --vision: pose of the robot on the field at the start, m and degrees; x towards the opponents' "
                     "goal, y left (default: 0,0,0, where the simulator places it)")
    line.option("--foxglove", action="store_true",
                help=f"also serve every channel to Foxglove and Lichtblick, read-only, on port {FOXGLOVE_PORT} or the next "
                     "free one of this host: docs/inspection.md")
    line.option("--lcm-url", metavar="URL",
                default=os.environ.get("LCM_DEFAULT_URL") or "udpm://239.255.76.67:7667?ttl=0",
                help="message bus (default: LCM_DEFAULT_URL, or limited to this host: udpm://239.255.76.67:7667?ttl=0; "
                     "several hosts: ...?ttl=1)")
    line.option("--backend", choices=("sim", "lola", "robot"), default="sim",
                help="sim: the robot is simulated; lola: the simulated robot has the interface of a NAO V6, and nao-robot "
                     "connects it as it would a real one; robot: this runs on a real NAO V6 (default: sim)")
    line.option("--any-posture", action="store_true", help="with --backend robot: also if the robot is not seated")
    line.option("--lock-step", action="store_true", help="simulate as fast as possible and deterministically")
    line.option("--disturbances", metavar="NAMES", default="",
                help="how the simulated robot and floor differ from their models: none, default, moderate, real, or entries of "
                     "real such as backlash,floor_slope (default: sensor noise only)")
    line.option("--seed", metavar="NUMBER", type=int, default=1, help="of the simulation's noise and disturbances (default: 1)")
    line.option("--http-port", metavar="PORT", type=port,
                help=f"for the app (default: {HTTP_PORT}, or the next free one)")
    line.option("--tcp-port", metavar="PORT", type=port,
                help=f"for clients in other languages (default: {TCP_PORT}, or the next free one)")
    line.option("--bind", metavar="ADDRESS", default="0.0.0.0",
                help="address to listen on: 127.0.0.1 for this host only (default: 0.0.0.0)")
    line.option("--host-name", metavar="NAME", action="append", default=[],
                help="another name of this host that browsers may use; its own name, also in the network's domain, needs none "
                     "(repeatable)")
    line.option("--tls", action="store_true",
                help="also https on the same port, with a self-signed certificate: phones give their tilt sensors only to "
                     "secure pages, after the user has accepted a warning")
    line.option("--relay", metavar="HOST[:PORT]",
                help="a public server with nao-relay, over which phones that nao invite lets in drive or watch from anywhere: "
                     "docs/anywhere.md")
    line.option("--bluetooth", action="store_true", help="also serve one phone at a time by Bluetooth, with BlueZ: docs/app.md")
    line.option("--token", metavar="TOKEN", help="access token for phones (default: a new random one)")
    line.option("--bin", metavar="DIR", default=os.environ.get("NAO_REMOTE_BIN") or None,
                help="folder of built programs (default: NAO_REMOTE_BIN, or build them)")
    line.run_dir_option("for logs and settings; one for each stack")
    options = line.parse(arguments)
    options.robot_words = choose_robots(line, options)
    options.autonomous_names = choose_autonomous(line, options)
    options.programs = choose_programs(line, options)
    options.served_robots = choose_served_robots(line, options)
    if len(options.robot_words) > 1 and options.start_pose != DEFAULT_START_POSE:
        line.error("--start-pose is for one robot; several start where the simulator places them")
    if options.exhibition and (len(options.robot_words) > 1 or not options.exhibition.is_file()):
        line.error("--exhibition is for one robot" if options.exhibition.is_file() else f"there is no file {options.exhibition}")
    return options


def choose_programs(line, options):
    """The programs that --only and --no-camera leave."""
    programs = list(ROBOT_PROGRAMS if options.backend == "robot" else PROGRAMS)
    if options.backend == "lola":
        programs.insert(1, ROBOT)
    if options.match:
        programs.append(REFEREE)
    if options.vision:
        # Behaviors need a field.
        programs += [VISION] if options.scene == "empty" else [VISION, PLAY]
    elif options.start_pose != DEFAULT_START_POSE:
        line.error("--start-pose needs --vision")
    known_programs = list(programs)
    if options.only:
        names = re.split("[, ]+", options.only.strip(", "))
        programs = ["nao-" + name.removeprefix("nao-") for name in names]
        for name, program in zip(names, programs):
            if program not in known_programs:
                known = " ".join(known.removeprefix("nao-") for known in known_programs)
                line.error(f"no program '{name}'; there are: {known}")
    if options.no_camera:
        programs = [program for program in programs if program != CAMERA]
    if options.foxglove:
        programs.append(FOXGLOVE)
    if not programs:
        line.error("no program is left to start")
    return programs


def install_and_build(options):
    """Installs and builds what is missing. @return the folder of the programs."""
    setup = [ROOT / "scripts/setup", *(["--with", "vision"] if options.vision else [])]
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
        build = '. "$1"; shift; reconfigure_with_new_packages; build_preset dev "$@"'
        watchdog = [ROBOT_WATCHDOG] if ROBOT in options.programs else []
        needed = {*options.programs, *watchdog, *COMPANIONS, *needed_programs(options)}
        succeed(["bash", "-c", build, "start", ROOT / "scripts/lib.sh", *sorted(needed)], umask=0o022)
    if options.bin and not options.only:
        # A folder of an earlier build may lack programs that a robot can do without.
        options.programs = [program for program in options.programs
                            if program not in OPTIONAL or (folder / program).exists()]
    for program in [*options.programs, *needed_programs(options)]:
        if not os.access(folder / program, os.X_OK):
            raise Failure(f"there is no {folder / program}; build it, or choose other programs: --only")
    return folder


def needed_programs(options):
    """Programs that this script calls: with several robots it asks the simulator for their places; one imports a URDF."""
    return ["nao", *([SIM] if len(options.robot_words) > 1 else []), *(["nao-tools"] if is_urdf(options.model) else [])]


def is_urdf(model):
    return model.lower().endswith(".urdf")


def camera_devices(model):
    """Device files of a robot's head cameras; none if its folder names none."""
    try:
        text = (model / "head_cameras.yaml").read_text()
    except FileNotFoundError:
        return []
    return re.findall(r"^ +device: (\S+)$", text, re.MULTILINE)


def check_models(options, robots, bin_dir):
    """Checks that the files of all robots are there, and that a real robot is seated."""
    folder = data_folder(bin_dir) / "robots"
    for robot in robots:
        model = folder / robot.model
        if not (model / "robot.yaml").exists():
            known = " ".join(sorted(file.parent.name for file in folder.glob("*/robot.yaml")))
            raise Failure(f"there is no {model / 'robot.yaml'}; choose another robot: --model NAME, of these: {known}")
    if options.backend == "robot" and CAMERA in options.programs:
        devices = camera_devices(model)
        if not any(Path(device).exists() for device in devices):
            say(f"No head camera: none of its devices is there ({', '.join(devices) or 'the robot names none'}).")
            options.programs.remove(CAMERA)
    if options.backend == "robot" and ROBOT in options.programs and not options.any_posture:
        check_seated(model, LOLA_SOCKET)


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
    """A given port, which must be free; otherwise the first free one from the default on. `option`, if any, gives one."""
    if given:
        if used := listeners(given):
            raise Failure(f"port {given} is in use by {owner_of(used)}. End that, or take another: {option} PORT")
        return given
    used = listeners(default)
    chosen = default if not used else next(number for number in itertools.count(default + 1) if not listeners(number))
    if used:
        say(f"Port {default} is in use by {owner_of(used)}; taking {chosen} instead"
            f"{f' ({option} chooses another)' if option else ''}.")
    return chosen


def own_channels(processes):
    """Channels on which these processes publish all the time, and nobody else may."""
    states = {SIM: "SENSOR_STATE", ROBOT: "SENSOR_STATE", "nao-motion": "MOTION_STATE", PLAY: "PLAY_STATE"}
    channels = [f"{process.robot.name}_{states[process.program]}" for process in processes if process.program in states]
    programs = {process.program for process in processes}
    return [*channels, *(["WORLD_TRUTH"] if SIM in programs else []), *(["MATCH_STATE"] if REFEREE in programs else [])]


def begin_bus_check(bin_dir, lcm_url, channels):
    """Begins to check that messages arrive on the bus, and that no other system publishes on these channels."""
    own = [word for channel in channels for word in ("--own", channel)]
    return subprocess.Popen([bin_dir / "nao", "bus", "--quick", *own, "--lcm-url", lcm_url], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)


def end_bus_check(check):
    report = check.communicate()[0].strip()
    if "another system" in report:
        raise Failure(f"two systems would share the message bus, and a robot obey both:\n{report}")
    if check.returncode != 0:
        raise Failure(f"the message bus does not work: {report}")


def escaped(text):
    """A text in supervisor's configuration."""
    return str(text).replace("%", "%%")


def gateway_options(stack, settings):
    """Options of the gateway that decide which addresses phones open."""
    options = ["--http-port", settings["http_port"], "--bind", settings["bind"], "--token-file", stack.token_file]
    options += host_name_options(settings)
    return [*options, "--tls"] if settings["scheme"] == "https" else options


def exhibition_options(stack, file):
    """Options of the gateway. Queue and best time of a day go on after scripts/stop."""
    day = time.strftime("%Y-%m-%d")
    return ["--exhibition", file, "--exhibition-state", stack.run_dir / f"exhibition-{day}.json",
            "--exhibition-report", stack.logs / f"exhibition-{day}.txt", "--operator-secret-file", operator_secret_file(stack)]


def operator_secret_file(stack):
    return stack.run_dir / "operator-secret"


def host_name_options(settings):
    return [word for name in settings.get("host_names", "").split() for word in ("--host-name", name)]


def command_of(process, processes, stack, settings, options, robots):
    """Command line of a process, quoted for supervisor."""
    program, robot = process.program, process.robot
    bus = ["--lcm-url", settings["lcm_url"]]
    if program == WATCHDOG:
        words = ["nao", "watchdog", *bus, "--programs", ",".join(each.program for each in processes)]
    elif program in (SIM, GATEWAY, REFEREE) and (len(robots) > 1 or robot.team):
        words = [program, *bus]
        for one in robots:
            words += ["--robot", one.words()]
    else:
        words = [program, *bus, "--robot", robot.name, "--model", robot.model]
    if program == SIM:
        words += ["--scene", settings["scene"], "--seed", options.seed,
                  *(["--disturbances", options.disturbances] if options.disturbances else []),
                  *(["--lola", stack.lola_socket] if options.backend == "lola" else [])]
    elif program == ROBOT:
        words[0] = ROBOT_WATCHDOG
        if options.backend == "robot":
            words += ["--lola", LOLA_SOCKET]
        else:
            # Nobody presses a simulated robot's button.
            words += ["--lola", stack.lola_socket, "--autostart"]
    elif program == CAMERA and options.backend == "robot":
        words += ["--source", "v4l2"]
    elif program == "nao-motion-files":
        words += ["--folder", stack.motions if len(robots) == 1 else stack.motions / robot.name]
    elif program == GATEWAY:
        words += [*gateway_options(stack, settings), "--tcp-port", settings["tcp_port"], "--scene", settings["scene"],
                  "--audit-log", stack.logs / "phones.jsonl"]
        words += exhibition_options(stack, options.exhibition) if options.exhibition else []
        words += ["--relay", options.relay] if options.relay else []
        words += ["--bluetooth"] if options.bluetooth else []
        # A camera program may run on another host.
        words += ["--overview"] if options.backend != "robot" and (CAMERA in options.programs or options.only) else []
    elif program == VISION:
        words += ["--request", "any"]
        if options.scene != "empty":
            words += [f"--start-pose={robot.start_pose}", "--scene", settings["scene"]]
    elif program == PLAY:
        words += [f"--start-pose={robot.start_pose}", "--scene", settings["scene"]]
        words += ["--autonomous"] if robot.name in options.autonomous_names else []
    elif program == REFEREE:
        words += ["--scene", settings["scene"], "--state-file", stack.run_dir / "match.json",
                  "--events-file", stack.logs / "match.jsonl"]
        words += ["--game-controller"] if options.game_controller else []
        words += ["--start"] if options.autonomous_names and len(options.autonomous_names) == len(robots) else []
    elif program == FOXGLOVE:
        words += ["--port", settings["foxglove_port"], *host_name_options(settings)]
    if options.lock_step and program in (SIM, ROBOT):
        words.append("--lock-step")
    words[0] = f"{settings['bin_dir']}/{words[0]}"
    return " ".join('"' + re.sub(r'(["\\])', r"\\\1", escaped(word)) + '"' for word in words)


def write_configuration(stack, settings, options, processes, robots):
    for path in (stack.run_dir, settings["bin_dir"]):
        if re.search(r"\s[;#]", str(path)):
            raise Failure(f"supervisor takes what follows ' ;' or ' #' in the path {path} for a comment; choose another path")
    text = SUPERVISOR_SECTION.format(socket=escaped(stack.socket), logs=escaped(stack.logs), pid_file=escaped(stack.pid_file),
                                     user="user=root" if os.geteuid() == 0 else "")
    # First, so that it receives the first status of all others.
    for process in [Process(WATCHDOG, WATCHDOG, robots[0]), *processes]:
        is_robot = process.program == ROBOT
        # The bridge ends with status 0 when it was ended by the robot's button.
        # Supervisor expands the names of programs' logs twice.
        text += PROGRAM_SECTION.format(logs=escaped(escaped(stack.logs)), name=process.name,
                                       command=command_of(process, processes, stack, settings, options, robots),
                                       priority=1 if process.program == WATCHDOG else 2,
                                       restart="unexpected" if is_robot else "true",
                                       stop_time=ROBOT_STOP_WAIT_TIME if is_robot else STOP_WAIT_TIME)
    replace_file(stack.configuration, text)


def failed_process(stack, processes):
    """The process that ended several times; None if there is none."""
    log = (stack.logs / "supervisord.log").read_text(errors="replace")
    return next((process for process in processes
                 if log.count(f"exited: {process.name} ") >= MAX_START_FAILURES), None)


class Waiter:
    """Waits from now on until programs are ready."""

    def __init__(self, stack, settings, processes):
        self.stack = stack
        self.processes = processes
        words = ["status", "--this-host", "--timeout", "1000", "--lcm-url", settings["lcm_url"],
                 "--wait", ",".join(process.program for process in processes)]
        self.waiter = subprocess.Popen([f"{settings['bin_dir']}/nao", *words], stderr=subprocess.PIPE, text=True)

    def wait(self, timeout):
        """Waits at most `timeout` s.
        @return whether they are ready, the process that crashed instead (None: none), and what the others wait for."""
        ended = os.pidfd_open(self.waiter.pid)  # readable when the process has ended
        failed, end = None, time.monotonic() + timeout
        while not failed and not select.select([ended], [], [], POLL_PERIOD)[0] and time.monotonic() < end:
            failed = failed_process(self.stack, self.processes)
        os.close(ended)
        self.waiter.terminate()  # it tells what is missing
        report = self.waiter.communicate()[1]
        return self.waiter.returncode == 0, failed, re.sub("^nao: ", "", report, flags=re.MULTILINE)


def begin_programs(stack):
    """Supervisor begins programs when a second has passed, or at a connection."""
    with socket.socket(socket.AF_UNIX) as connection:
        try:
            connection.connect(str(stack.socket))
        except OSError:
            pass  # then after the second


def warn_of_crash(stack, failed, consequence):
    log = stack.logs / f"{failed.name}.log"
    warn(f"{failed.name} does not start{consequence}. Its last words ({log}):")
    print("\n".join(log.read_text(errors="replace").splitlines()[-5:]), file=sys.stderr)
    if shutil.disk_usage(log).free == 0:
        warn(f"the disk of {stack.run_dir} is full; free some space, or take another folder: --run-dir DIR")


def wait_until_ready(stack, settings, options, processes):
    """Waits until the robot can be driven, prints the addresses, and waits a while for the programs that this does not
    need: what crashes among these, or is not ready then, is left out with a warning. With --only, a program may wait for
    programs on other hosts: then a shorter timeout applies and is not an error."""
    timeout = ONLY_READY_TIMEOUT if options.only else READY_TIMEOUT
    if ROBOT in options.programs:
        timeout += ROBOT_READY_TIME
    waiting = f"the programs run and wait for the others; {CALL}status shows when they are there"
    needed = [process for process in processes if process.program in TO_DRIVE] or processes
    others = [process for process in processes if process not in needed]
    others.append(Process(WATCHDOG, WATCHDOG, processes[0].robot))  # ready when all others have begun
    waiter, waiter_for_others = Waiter(stack, settings, needed), Waiter(stack, settings, others)
    begin_programs(stack)
    is_ready, failed, report = waiter.wait(timeout)
    if failed or not is_ready:
        waiter_for_others.waiter.kill()
    if failed:
        warn_of_crash(stack, failed, "")
        stack.stop()
        raise Failure(f"everything is stopped again. More: {CALL}start --help, docs/troubleshooting.md")
    if not is_ready:
        sys.stderr.write(report)
        if options.only:
            warn(waiting)
            if GATEWAY in options.programs:
                print_addresses(stack)
            return
        stack.stop()
        raise Failure(f"not everything became ready within {timeout} s, so everything is stopped again; logs: {stack.logs}")
    if GATEWAY in options.programs:
        print_addresses(stack)
    while True:
        is_ready, failed, report = waiter_for_others.wait(ONLY_READY_TIMEOUT if options.only else OTHERS_READY_TIMEOUT)
        if not failed:
            break
        warn_of_crash(stack, failed, " and is left out; the robot can be driven without it")
        others = [process for process in others if process is not failed and process.program != WATCHDOG]
        if not others:
            return
        waiter_for_others = Waiter(stack, settings, others)
    if not is_ready:
        sys.stderr.write(report)
        warn(waiting if options.only else f"the robot can be driven; {CALL}status shows when the rest is ready")


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
    if settings.get("exhibition"):
        secret = operator_secret_file(stack).read_text().strip()
        say(f"Big display: {urls[0].replace('/#', '/screen#')}\nOperator only: "
            f"{urls[0].replace('/#', '/operator#')}&secret={secret}")
    if settings.get("relay"):
        say(f"From anywhere, over {settings['relay']}: {settings['bin_dir']}/nao invite makes a link for a phone")
    say(f"Clients in other languages: TCP port {settings['tcp_port']}. Watch: {CALL}status. End: {CALL}stop")


def print_foxglove_address(settings):
    if settings.get("foxglove_port"):
        say(f"Foxglove or Lichtblick: ws://127.0.0.1:{settings['foxglove_port']}; layout: tools/foxglove/layout.json")


def choose_settings(options, bin_dir, robots, processes):
    """What scripts/start has chosen, for the other scripts."""
    has_gateway = GATEWAY in options.programs
    return {
        "bin_dir": bin_dir,
        "lcm_url": options.lcm_url,
        "robot": robots[0].name,
        "model": robots[0].model,
        "robots": " ".join(robot.words() for robot in robots),
        "scene": options.scene,
        "programs": " ".join(process.name for process in processes),
        "http_port": choose_port(options.http_port, "--http-port", HTTP_PORT) if has_gateway else "",
        "tcp_port": choose_port(options.tcp_port, "--tcp-port", TCP_PORT) if has_gateway else "",
        "foxglove_port": choose_port(None, "", FOXGLOVE_PORT) if options.foxglove else "",
        "bind": options.bind,
        "exhibition": options.exhibition or "",
        "relay": options.relay or "",
        "host_names": " ".join(options.host_name),
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
        print_foxglove_address(stack.read_settings())
        return
    stack.stop()  # orphans of a killed supervisor

    bin_dir = install_and_build(options)
    if is_urdf(options.model):
        options.model = import_model(options.model, bin_dir)
    robots = place_robots(options, bin_dir)
    # Before any program of this system runs, and while the rest is prepared.
    bus_check = begin_bus_check(bin_dir, options.lcm_url, own_channels(choose_processes(options, robots)))
    check_models(options, robots, bin_dir)
    processes = choose_processes(options, robots)
    settings = choose_settings(options, bin_dir, robots, processes)
    (stack.run_dir / "match.json").unlink(missing_ok=True)  # a new stack plays a new match
    for file in (stack.token_file, operator_secret_file(stack)):
        file.unlink(missing_ok=True)  # the gateway creates a new one
    if options.token:
        replace_file(stack.token_file, options.token + "\n")
    write_configuration(stack, settings, options, processes, robots)
    end_bus_check(bus_check)
    stack.write_settings(settings)
    (stack.logs / "supervisord.log").write_text("")
    succeed([sys.executable, "-m", "supervisor.supervisord", "--configuration", stack.configuration],
            env={**os.environ, "NAO_REMOTE_STACK": str(stack.run_dir)})
    wait_until_ready(stack, settings, options, processes)
    if GATEWAY not in options.programs:
        say(f"Running: {settings['programs']}. Watch: {CALL}status. End: {CALL}stop")
    if len(robots) > 1:
        say(f"Robots: {', '.join(robot.words() for robot in robots)}. One of them: nao --robot {robots[-1].name} walk 0.1 0 0")
    print_foxglove_address(settings)


if __name__ == "__main__":
    run_script(main)
