"""Drives a robot of nao-remote from Python.

    with nao_remote.connect("nao.local", token="k7") as robot:
        robot.walk(0.1, duration=3)
        robot.joints["HeadYaw"].move_by(0.3)
        robot.say("Hello")
        robot.image().save("view.jpg")

simulate() starts a private simulation that is stepped in lock-step. connect() is the blocking face; nao_remote.aio.connect() that for asyncio. The protocol is that of phones:
phone-gateway/PROTOCOL.md.
"""

from nao_remote import aio
from nao_remote.address import Address
from nao_remote.blocking import Command, Joint, Light, Robot, Stream, connect
from nao_remote.discovery import discover
from nao_remote.errors import (Closed, CommandFailed, CommandInterrupted, CommandRefused, ConnectionLost, ControlTaken,
                               InvalidArgument, InvalidRequest, MotionNotSafe, NameInUse, NaoError, NoControl, NotAllowed,
                               NotConnected, Refused, RobotUnavailable, SimulationError, Stopped, Timeout, TooLate, TooManyClients, TooManyRequests,
                               WrongToken, WrongVersion)
from nao_remote.messages import (Action, Activity, Body, Client, CommandKind, CommandResult, CommandStatus, Component,
                                 ComponentChanged, Connected, Control, ControlChanged, Disconnected, Event, Image,
                                 JointDescription, JointGroup, Mode, Pong, RobotChanged, RobotDescription, RobotEntry,
                                 RobotsChanged, State)
from nao_remote.simulation import Simulation, SimulationState, simulate, step_together

__version__ = "0.1.0"

__all__ = [
    "Action", "Activity", "Address", "Body", "Client", "Closed", "Command", "CommandFailed", "CommandInterrupted", "CommandKind",
    "CommandRefused", "CommandResult", "CommandStatus", "Component", "ComponentChanged", "Connected", "ConnectionLost",
    "Control", "ControlChanged", "ControlTaken", "Disconnected", "Event", "Image", "InvalidArgument", "InvalidRequest",
    "Joint", "JointDescription", "JointGroup", "Light", "Mode", "MotionNotSafe", "NameInUse", "NaoError", "NoControl",
    "NotAllowed", "NotConnected", "Pong",
    "Refused", "Robot", "RobotChanged", "RobotDescription", "RobotEntry", "RobotsChanged", "RobotUnavailable", "Simulation", "SimulationError", "SimulationState", "State", "Stopped",
    "Stream", "Timeout", "TooLate", "TooManyClients", "TooManyRequests", "WrongToken", "WrongVersion", "aio", "connect", "discover",
    "simulate", "step_together",
]
