"""Simulation in lock-step: a private world without windows, clock or network, as fast as the processor allows.

    with nao_remote.simulate(seed=1) as world:
        world.walk(0.1, 0, 0)
        state = world.run(5.0)
        print(state.torso_position)

Each simulation is a process of its own, nao-simulation-server; its protocol is tools/simulation-server/simulation.proto.
"""

from nao_remote.simulation.messages import SimulationDescription, SimulationResult, SimulationState, Truth
from nao_remote.simulation.world import Simulation, simulate, step_together

__all__ = ["Simulation", "SimulationDescription", "SimulationResult", "SimulationState", "Truth", "simulate", "step_together"]
