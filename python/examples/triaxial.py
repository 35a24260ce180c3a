#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drained triaxial compression of balls between six servo walls.

First all six walls carry the cell pressure, then top and bottom approach each other while the four others go on carrying it. The
walls are smooth, so their stresses are principal stresses; they are compared with the mean stress of the contacts (Love, Weber).
"""
import dem4grm
import numpy
import pandas

PRESSURE, STRAIN_RATE, LARGEST_STRAIN = 100e3, 1.0, 0.12  # Pa, 1/s (inertial number 1e-3), 1


def triaxial(friction=0.5, cells=6, seed=1):
    """Axial strain, deviator (Pa), mean stress (Pa), volumetric strain (dilation negative), void ratio, coordination number."""
    random = numpy.random.default_rng(seed)
    sim = dem4grm.Simulation(local_damping=0.3)
    sim.gravel = dem4grm.Material(density=2650.0, friction=friction, shear_modulus=500e6, poisson_ratio=0.25)
    cell = 7e-3
    for place in numpy.ndindex(cells, cells, cells):
        radius = random.uniform(2.4e-3, 3.4e-3)
        sim.add_ball((numpy.array(place) + 0.5) * cell + random.uniform(-1, 1, 3) * (cell / 2 - radius), radius)
    walls = sim.add_box([cells * cell] * 3, overhang=cell)
    x, y, z = [(walls["-" + axis], walls["+" + axis]) for axis in "xyz"]
    for pair, between in ((x, y + z), (y, x + z), (z, x + y)):
        for wall in pair:
            wall.carry(stress=PRESSURE, between=between, gain=0.5, speed_cap=0.5)
    sim.choose_time_step(stress=3 * PRESSURE)
    sim.set_friction(gravel_gravel=0.1)  # a dense specimen
    stress = lambda: [wall.normal_force / area() for wall, area in ((x[0], yz), (y[0], xz), (z[0], xy))]
    length = lambda pair: (pair[1].position - pair[0].position) @ pair[0].normal
    xy, xz, yz = (lambda: length(x) * length(y)), (lambda: length(x) * length(z)), (lambda: length(y) * length(z))
    at_rest = lambda: max(abs(s / PRESSURE - 1) for s in stress()) < 5e-3 and sim.unbalanced_ratio < 5e-3
    assert sim.run_until(at_rest, every=500, most_steps=200_000), "the specimen does not come to rest"
    sim.set_friction(gravel_gravel=friction)
    start, height, rows = xy() * length(z), length(z), []
    z[0].velocity, z[1].velocity = (0, 0, STRAIN_RATE * height / 2), (0, 0, -STRAIN_RATE * height / 2)
    while 1 - length(z) / height < LARGEST_STRAIN:
        sim.run(time=0.002 / STRAIN_RATE)
        s1, s2, s3 = sorted(stress(), reverse=True)
        volume = xy() * length(z)
        rows.append((1 - length(z) / height, s1 - (s2 + s3) / 2, (s1 + s2 + s3) / 3, 1 - volume / start,
                     volume / sim.volumes.sum() - 1, 2 * len(sim.contacts["normal_force"]) / len(sim.positions)))
    return pandas.DataFrame(rows, columns=["axial_strain", "deviator", "mean_stress", "volumetric_strain", "void_ratio", "coordination"]), sim


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(2, sharex=True)
    for friction in (0.2, 0.5):
        curve, _ = triaxial(friction, cells=9)
        above.plot(curve["axial_strain"] * 100, curve["deviator"] / curve["mean_stress"], label=f"friction {friction}")
        below.plot(curve["axial_strain"] * 100, curve["volumetric_strain"] * 100)
    above.set(ylabel="q / p")
    above.legend()
    below.set(xlabel="axial strain (%)", ylabel="volumetric strain (%)")
    figure.savefig("triaxial.png", dpi=150)
