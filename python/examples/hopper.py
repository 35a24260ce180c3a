#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A wedge-shaped hopper of gravel clumps and rubber grains: filled by gravity, then its gate is taken away.

At rest all walls together carry the weight of the grains, whatever share of it hangs on the inclined sides.
"""
import dem4grm
import numpy
import pandas

GRAVITY, DEPTH, OPENING, HALF = 9.81, 0.022, 0.024, 0.030  # m/s2, m: of the wedge, of the gate, half of its width at the top
HEIGHT = (HALF - OPENING / 2) * numpy.tan(numpy.radians(60))  # sides at 60 degrees


def hopper(layers=3, seed=1):
    """Time (s), share of the mass that has left, share of the weight that the walls carry; and the simulation."""
    random = numpy.random.default_rng(seed)
    sim = dem4grm.Simulation(gravity=(0, 0, -GRAVITY))
    sim.contact_law.normal_damping_ratio = 0.3
    sim.rubber_ball_radius = 0.63e-3
    for place in numpy.ndindex(6, 4, layers):
        at = (numpy.array(place) + 0.5) * 5.4e-3 + (-3 * 5.4e-3, 0.2e-3, HEIGHT)
        turn = random.normal(size=4)
        if sum(place) % 3 == 0:
            sim.add_rubber_grain(at, orientation=turn)
        else:
            sim.add_clump(f"T{1 + sum(place) % 6}", at, 4e-3, orientation=turn)
    half, top, slope = OPENING / 2, HEIGHT + 0.1, numpy.array([HALF - OPENING / 2, 0, HEIGHT])
    sim.add_wall("left side", (-half, 0, 0), (0, DEPTH, 0), slope * (-1, 1, 1), friction=0.3)
    sim.add_wall("right side", (half, 0, 0), slope, (0, DEPTH, 0), friction=0.3)
    sim.add_wall("left", (-HALF, 0, HEIGHT), (0, DEPTH, 0), (0, 0, 0.1))
    sim.add_wall("right", (HALF, 0, HEIGHT), (0, 0, 0.1), (0, DEPTH, 0))
    sim.add_wall("front", (-HALF, 0, 0), (0, 0, top), (2 * HALF, 0, 0))
    sim.add_wall("back", (-HALF, DEPTH, 0), (2 * HALF, 0, 0), (0, 0, top))
    gate = sim.add_wall("gate", (-half, 0, 0), (OPENING, 0, 0), (0, DEPTH, 0), friction=0.3)
    sim.choose_time_step(stress=2e3)
    grain_mass = 35 * sim.rubber_ball_mass
    mass = sim.masses.sum() + len(sim.rubber_balls) * grain_mass
    carried = lambda: -sum(wall.force[2] for wall in sim.walls.values()) / (mass * GRAVITY)
    left = lambda: (sim.masses[sim.positions[:, 2] < 0].sum() + (sim.rubber_balls[:, :, 2].mean(axis=1) < 0).sum() * grain_mass) / mass
    rows = []
    for phase, seconds in (("filling", 0.25), ("flowing", 0.1)):
        if phase == "flowing":
            gate.remove()
        for _ in range(25):
            sim.run(time=seconds / 25)
            rows.append((phase, sim.time, left(), carried(), sim.energy["kinetic"]))
    return pandas.DataFrame(rows, columns=["phase", "time", "left", "carried", "kinetic"]), sim


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    course, _ = hopper()
    plt.plot(course["time"], course["carried"] * 100, label="weight on the walls")
    plt.plot(course["time"], course["left"] * 100, label="mass that has left")
    plt.ylim(0, 300)  # the first blow is much larger
    plt.legend(title="per cent over seconds")
    plt.savefig("hopper.png", dpi=150)
