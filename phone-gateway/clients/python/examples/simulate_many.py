#!/usr/bin/python3
"""Four robots walk in four worlds with different seeds, in parallel and faster than real time.

simulate_many.py
"""

import contextlib

import nao_remote

with contextlib.ExitStack() as stack:
    worlds = [stack.enter_context(nao_remote.simulate(seed=seed)) for seed in range(1, 5)]
    for world in worlds:
        world.walk(0.15, 0, 0)
    for _ in range(10):
        states = nao_remote.step_together(worlds, 100, truth=True)
    for seed, state in enumerate(states, start=1):
        x, y, _ = state.truth.torso_position
        print(f"seed {seed}: {x:.2f} m ahead, {y:+.2f} m to the left after {state.time:.0f} s")
