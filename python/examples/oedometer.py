#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Oedometer of a regular packing of rubber balls, loaded in steps, beside its closed form.

In a smooth square tube of width 4 R lie layers of four balls in the corners and of one ball in the middle in turn, corners at both
ends. Under F each of the four contacts between two layers carries f = F / (4 nz) along n = (nx, nx, nz), a corner ball presses
f nx on both of its walls for each layer that it touches, and all overlaps follow from Hertz' law.
"""
import dem4grm
import pandas

RUBBER = dem4grm.Material(density=1150.0, friction=0.0, shear_modulus=2e6, poisson_ratio=0.5)
RADIUS, CELLS, LOADS = 5e-3, 3, [0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2]  # m, 1, N
WIDTH = 4 * RADIUS


def overlap(force, radius, other):
    """m, of a ball and a body of a material. Source: Hertz (1882)."""
    modulus = 1 / sum((1 - m.poisson_ratio) / (2 * m.shear_modulus) for m in (RUBBER, other))
    return (force / (4 / 3 * modulus * radius**0.5)) ** (2 / 3)


def closed_form(load, walls):
    """(height m, force N on one side wall) under a load (N)."""
    height, side = 2 * (RADIUS - overlap(load / 4, RADIUS, walls)), 0.0
    for touched, count in ((1, 2), (2, 2 * CELLS - 2)):  # layers that a corner ball touches; contacts of that kind in a column
        nx = nz = 0.5
        for _ in range(50):  # the direction depends on how far the walls give way
            f = load / (4 * nz)
            distance = 2 * RADIUS - overlap(f, RADIUS / 2, RUBBER)
            across = WIDTH / 2 - RADIUS + overlap(touched * f * nx, RADIUS, walls)
            nx, nz = across / distance, (1 - 2 * (across / distance) ** 2) ** 0.5
        height, side = height + count * distance * nz, side + count * 2 * f * nx
    return height, side


def oedometer(loads=LOADS):
    """Height (m), void ratio, force (N) on a side wall at rest under each load (N), and height and force of the closed form."""
    sim = dem4grm.Simulation(local_damping=0.7)
    sim.gravel = RUBBER
    for k in range(2 * CELLS + 1):
        for x, y in [(2, 2)] if k % 2 else [(1, 1), (1, 3), (3, 1), (3, 3)]:
            sim.add_ball((x * RADIUS, y * RADIUS, RADIUS + k * 2**0.5 * RADIUS), RADIUS)
    walls = sim.add_box((WIDTH, WIDTH, 2 * RADIUS * (1 + 2**0.5 * CELLS)))
    sim.choose_time_step(stress=max(loads) / WIDTH**2)
    rows = []
    for load in loads:
        walls["+z"].carry(load, speed_cap=0.05)
        sim.run_until(lambda: abs(walls["-z"].normal_force / load - 1) < 1e-7 and sim.energy["kinetic"] < 1e-15)
        height = walls["+z"].position[2]
        void_ratio = height * WIDTH**2 / sim.volumes.sum() - 1
        rows.append((load, height, void_ratio, walls["-x"].normal_force, *closed_form(load, sim.wall_material)))
    return pandas.DataFrame(rows, columns=["load", "height", "void_ratio", "side", "height_of_form", "side_of_form"])


if __name__ == "__main__":
    curve = oedometer()
    axes = curve.plot("load", "height_of_form", logx=True, label="closed form")
    curve.plot("load", "height", style="o", label="engine", ax=axes, xlabel="load (N)", ylabel="height (m)").figure.savefig("oedometer.png", dpi=150)
