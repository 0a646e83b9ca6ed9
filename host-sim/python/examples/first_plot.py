"""Drags a box over a floor and plots the run as run.png."""

import numpy as np
import stiction

box = [(-0.05, -0.03), (0.05, -0.03), (0.05, 0.03), (-0.05, 0.03)]
floor = stiction.Surface(normal=(0, 1), offset=0, static=0.5, dynamic=0.3)
scene = stiction.Scene(
    vertices=box, start=(0, 0.03, 0), holding_point=(0, 0), translation=500, rotation=0.5, surfaces=[floor]
)
hand = np.column_stack([np.linspace(0, 0.1, 1000), np.full(1000, 0.02), np.zeros(1000)])
run = stiction.Solver(scene).run(hand)
run.plot().savefig("run.png")
print(f"run.png: {run}")
