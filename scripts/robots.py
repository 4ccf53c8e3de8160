"""The robots of a stack: how many, where they stand, and the processes that serve them."""

import re
import subprocess
from argparse import ArgumentTypeError
from typing import NamedTuple

from stack import PER_ROBOT, SIM, Failure

# As many as two teams of five have.
MAX_ROBOTS = 10


class Robot(NamedTuple):
    """A robot of the stack."""
    name: str
    model: str
    # What follows in --robot NAME:MODEL: its team and number in a match, such as ":0:1".
    team: str
    # X,Y,HEADING on the field.
    start_pose: str

    def words(self):
        """As --robot of a program for several robots."""
        return f"{self.name}:{self.model}{self.team}"


class Process(NamedTuple):
    """A program that supervisor runs."""
    # In supervisor and of the log: the program's, and that of its robot where there are several.
    name: str
    program: str
    robot: Robot


def number_of_robots(text):
    """Value of --robots."""
    if not re.fullmatch("[0-9]{1,2}", text) or not 1 <= int(text) <= MAX_ROBOTS:
        raise ArgumentTypeError(f"'{text}' is not a number from 1 to {MAX_ROBOTS}")
    return int(text)


def team_sizes(text):
    """Value of --match: robots of each team."""
    sizes = re.fullmatch("([1-5])v([1-5])", text)
    if not sizes:
        raise ArgumentTypeError(f"'{text}' is not two teams of 1 to 5 robots, such as 2v2")
    return int(sizes[1]), int(sizes[2])


def choose_robots(line, options):
    """What --robot of nao-sim says of each robot."""
    given = options.robot or ["NAO"]
    if options.match:
        teams = [f"{team}:{number}" for team, size in enumerate(options.match) for number in range(1, size + 1)]
    else:
        teams = [""] * (options.robots or 1)
    if options.match and options.robots:
        line.error("--match says how many robots there are; leave --robots out")
    if len(teams) > 1:
        if len(given) > 1 or ":" in given[0]:
            line.error("--robots and --match name the robots; --robot NAME gives the beginning of the names")
        given = [f"{given[0]}{i}:{options.model}{team and f':{team}'}" for i, team in enumerate(teams, 1)]
    if len(given) > 1 and options.backend != "sim":
        line.error("several robots need --backend sim")
    return given


def choose_autonomous(line, options):
    """Names of the robots that play by themselves; for them the programs of --vision run."""
    if options.match and options.scene == "empty":
        line.error("--match needs a field: leave --scene empty out")
    if options.game_controller and not options.match:
        line.error("--game-controller needs --match")
    if not options.autonomous:
        return []
    if not options.match:
        line.error("--autonomous needs --match")
    names = [words.partition(":")[0] for words in options.robot_words]
    chosen = names if options.autonomous == "all" else re.split("[, ]+", options.autonomous.strip(", "))
    for name in chosen:
        if name not in names:
            line.error(f"--autonomous: no robot '{name}'; there are: {' '.join(names)}")
    options.vision = True
    return chosen


def choose_served_robots(line, options):
    """Names of the robots whose own programs run here."""
    names = [words.partition(":")[0] for words in options.robot_words]
    if not options.only_robots:
        return names
    if not options.only:
        line.error("--only-robots needs --only")
    chosen = re.split("[, ]+", options.only_robots.strip(", "))
    for name in chosen:
        if name not in names:
            line.error(f"--only-robots: no robot '{name}'; there are: {' '.join(names)}")
    return chosen


def place_robots(options, bin_dir):
    """@return The robots, with their teams and places."""
    if len(options.robot_words) == 1:
        name, _, model = options.robot_words[0].partition(":")
        model, _, team = model.partition(":")
        return [Robot(name, model or options.model, team and f":{team}", options.start_pose)]
    command = [bin_dir / SIM, "--print-places", "--scene", options.scene, "--model", options.model]
    for words in options.robot_words:
        command += ["--robot", words]
    result = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode != 0:
        raise Failure(f"the robots cannot be placed: {result.stderr.strip()}")
    robots = []
    for line in result.stdout.splitlines():
        name, model, team, number, pose = line.split()
        robots.append(Robot(name, model, "" if team == "-" else f":{team}:{number}", pose))
    return robots


def choose_processes(options, robots):
    """The processes of supervisor."""
    processes = []
    for program in options.programs:
        if program in PER_ROBOT and len(robots) > 1:
            processes += [Process(f"{program}-{robot.name}", program, robot) for robot in robots
                          if robot.name in options.served_robots]
        else:
            processes.append(Process(program, program, robots[0]))
    return processes
