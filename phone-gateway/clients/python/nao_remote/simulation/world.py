"""A simulated world that is stepped by its user."""

from __future__ import annotations

import os
import time
from dataclasses import replace
from typing import Mapping, Sequence, Union

from google.protobuf.message import DecodeError

from nao_remote import simulation_pb2 as pb
from nao_remote.errors import CommandFailed, SimulationError, Timeout
from nao_remote.messages import CommandStatus
from nao_remote.simulation.messages import SimulationDescription, SimulationResult, SimulationState
from nao_remote.simulation.pipe import ServerPipe, find_program

# Most ticks of one request (simulation.proto).
MAX_TICKS = 6000

# Angles of all joints in the robot's order, or of some by name.
JointTargets = Union[Mapping[str, float], Sequence[float]]


def simulate(seed: int = 1, realtime: bool = False, disturbances: str = "default", engine: str = "fast", *,
             model: str = "nao", scene: str = "empty", posture: str = "", program: str | os.PathLike[str] | None = None,
             timeout: float = 120.0) -> Simulation:
    """Starts a private simulation: `with nao_remote.simulate(seed=1) as world: world.posture("Sit"); world.run(3)`.

    @param seed  Determines everything random: the same seed and the same calls give the same bits.
    @param realtime  Steps last as long as they do on a robot; otherwise they are as fast as the processor allows.
    @param disturbances  "none", "default", "moderate", "real", or entries of the last one such as "backlash,floor_slope".
    @param engine  Physics: "fast", "simbody", or "mujoco" where it was built.
    @param model, scene  Names in robots/ and scenes/. @param posture  At the start; empty: the one in which walks begin.
    @param program  File of nao-simulation-server; None: searched, see find_program().
    @param timeout  Longest time for a step, s.
    @raise SimulationError  if the server refuses an option or cannot be started.
    """
    command = [find_program(program), "--engine", engine, "--disturbances", disturbances, "--model", model, "--scene", scene]
    return Simulation(ServerPipe(command, timeout), seed, realtime, posture)


class Simulation:
    """One robot in a world, with its motion core: what a real robot would do with the same commands.

    Commands are queued and received by the motion core in the first tick of the next step.
    """

    def __init__(self, pipe: ServerPipe, seed: int, realtime: bool, posture: str) -> None:
        self._pipe = pipe
        self._realtime = realtime
        self._commands: list[pb.Command] = []
        # Times of the present step.
        self._begin = self._duration = 0.0
        self._is_stepping = False
        try:
            self.description = SimulationDescription.from_protocol(self._request(pb.Request(describe=pb.Describe())).description)
            self._state = self.reset(seed, posture)
        except BaseException:
            pipe.close()
            raise

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the simulation."""
        self._pipe.close()

    @property
    def state(self) -> SimulationState:
        """The state after the last step."""
        return self._state

    def reset(self, seed: int, posture: str = "") -> SimulationState:
        """A new world, one tick old. The state has the truth."""
        if not 0 <= seed < 2 ** 64:
            raise SimulationError(f"seed {seed} is outside [0, 2^64)")
        self._commands.clear()
        response = self._request(pb.Request(reset=pb.Reset(seed=seed, posture=posture)))
        return self._take(response)

    # ---- Commands for the next step ----

    def walk(self, vx: float = 0.0, vy: float = 0.0, wz: float = 0.0) -> None:
        """Walks at a velocity, m/s and rad/s to the left, until the next walk or another motion; all zero ends it."""
        self._commands.append(pb.Command(walk=pb.Command.Walk(vx=vx, vy=vy, wz=wz)))

    def move_to(self, x: float = 0.0, y: float = 0.0, theta: float = 0.0) -> None:
        """Walks to a pose relative to the present one: m forward, m to the left, rad."""
        self._commands.append(pb.Command(move_to=pb.Command.MoveTo(x=x, y=y, theta=theta)))

    def posture(self, posture: str, speed: float = 0.5) -> None:
        """Goes to a posture. @param speed  Fraction of the maximum, above 0 up to 1."""
        self._commands.append(pb.Command(posture=pb.Command.Posture(posture=posture, speed=speed)))

    def change_joints(self, changes: Mapping[str, float], speed: float = 0.3, *, is_relative: bool = True,
                      allow_tipping: bool = False) -> None:
        """Turns joints, by the motion core and its guards. @param changes  By joint, rad; with `is_relative=False` angles."""
        self._commands.append(pb.Command(change_joints=pb.Command.ChangeJoints(
            joint_names=list(changes), joint_position=list(changes.values()), is_relative=is_relative, speed=speed,
            allow_tipping=allow_tipping)))

    def action(self, action: str, *, ball: tuple[float, float] | None = None, strength: float | None = None) -> None:
        """Performs an action of the description."""
        request = pb.Command.Action(action=action)
        if ball is not None:
            request.ball_x, request.ball_y = ball
        if strength is not None:
            request.strength = strength
        self._commands.append(pb.Command(action=request))

    def stop(self) -> None:
        """Ends any motion."""
        self._commands.append(pb.Command(stop=pb.Command.Stop()))

    # ---- Steps ----

    def step(self, num_ticks: int = 1, joint_targets: JointTargets | None = None,
             stiffness: Sequence[float] | None = None, truth: bool = False,
             gains: tuple[Sequence[float], Sequence[float]] | None = None) -> SimulationState:
        """Steps the world by control ticks (`state.period` s each).

        @param joint_targets  Servo targets during these ticks, rad, instead of the motion core's: of all joints in the order
                              of the description, or of some by name, while the others keep theirs. The robot then has no
                              balance but yours. None: the motion core moves the robot.
        @param stiffness  Of all joints, 0 to 1; None: all 1.
        @param gains  kp, N m/rad, and kd, N m s/rad, of all joints' servos; None: the robot's own.
        @param truth  The state has the truth, too.
        @raise SimulationError  if a value is refused; the world is unchanged then.
        """
        self.begin_step(num_ticks, joint_targets, stiffness, truth, gains)
        return self.end_step()

    def begin_step(self, num_ticks: int = 1, joint_targets: JointTargets | None = None,
                   stiffness: Sequence[float] | None = None, truth: bool = False,
                   gains: tuple[Sequence[float], Sequence[float]] | None = None) -> None:
        """Sends a step without waiting for its end, so that other simulations step at the same time; end_step() follows."""
        if self._is_stepping:
            raise SimulationError("a step is being executed; call end_step() first")
        commands, self._commands = self._commands, []
        step = pb.Step(num_ticks=max(num_ticks, 0), commands=commands, with_truth=truth)
        if joint_targets is not None:
            step.joint_targets.position.extend(self._all_targets(joint_targets))
            step.joint_targets.stiffness.extend(stiffness or ())
            if gains is not None:
                step.joint_targets.kp.extend(gains[0])
                step.joint_targets.kd.extend(gains[1])
        self._begin = time.monotonic()
        self._duration = num_ticks * self._state.period
        self._pipe.send(pb.Request(step=step).SerializeToString())
        self._is_stepping = True

    def end_step(self) -> SimulationState:
        """@return the state after the step that begin_step() has sent."""
        if not self._is_stepping:
            raise SimulationError("no step is being executed; call begin_step() first")
        self._is_stepping = False
        state = self._take(self._receive())
        if self._realtime:
            time.sleep(max(0.0, self._begin + self._duration - time.monotonic()))
        return state

    def run(self, duration: float, truth: bool = False) -> SimulationState:
        """Steps for a duration of simulated time, s. @return the state at its end, with the results of all of it."""
        num_ticks = max(1, round(duration / self._state.period))
        command_ids: tuple[int, ...] = ()
        results: list[SimulationResult] = []
        while num_ticks > 0:
            part = min(num_ticks, MAX_TICKS)
            num_ticks -= part
            state = self.step(part, truth=truth and num_ticks == 0)
            command_ids += state.command_ids
            results += state.results
        self._state = replace(state, command_ids=command_ids, results=tuple(results))
        return self._state

    def run_until_done(self, timeout: float = 60.0) -> SimulationState:
        """Steps until the last of the queued commands has ended.

        @param timeout  Simulated time, s. @raise CommandFailed  with the robot's reason. @raise Timeout
        """
        if not self._commands:
            raise SimulationError("no command is queued; call posture() or another one first")
        end = self._state.time + timeout
        command_id = 0
        while self._state.time < end:
            state = self.step(10)
            command_id = state.command_ids[-1] if state.command_ids else command_id
            for result in state.results:
                if result.command_id == command_id and result.status == CommandStatus.DONE:
                    return state
                if result.command_id == command_id and result.status != CommandStatus.ACCEPTED:
                    raise CommandFailed(result.reason, result.reason_code)
        raise Timeout(f"the command has not ended within {timeout:g} s of simulated time")

    # ---- Inside ----

    def _all_targets(self, targets: JointTargets) -> Sequence[float]:
        if not isinstance(targets, Mapping):
            return targets
        unknown = set(targets) - set(self.description.joints)
        if unknown:
            raise SimulationError(f"the robot has no joint {', '.join(sorted(unknown))}")
        return [targets.get(name, present) for name, present in zip(self.description.joints, self._state.joint_target)]

    def _request(self, request: pb.Request) -> pb.Response:
        if self._is_stepping:
            raise SimulationError("a step is being executed; call end_step() first")
        self._pipe.send(request.SerializeToString())
        return self._receive()

    def _receive(self) -> pb.Response:
        response = pb.Response()
        try:
            response.ParseFromString(self._pipe.receive())
        except DecodeError as error:
            raise SimulationError("the server sent bytes that are not a Response message") from error
        if response.HasField("error"):
            raise SimulationError(response.error)
        return response

    def _take(self, response: pb.Response) -> SimulationState:
        self._state = SimulationState.from_protocol(response.state)
        return self._state


def step_together(simulations: Sequence[Simulation], num_ticks: int = 1,
                  joint_targets: Sequence[JointTargets | None] | None = None, truth: bool = False) -> list[SimulationState]:
    """Steps several simulations at the same time, each in its own process. @return their states.

    @param joint_targets  One for each simulation, as for Simulation.step().
    """
    for i, simulation in enumerate(simulations):
        simulation.begin_step(num_ticks, None if joint_targets is None else joint_targets[i], truth=truth)
    return [simulation.end_step() for simulation in simulations]
