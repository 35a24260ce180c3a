#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two glass spheres meet head-on, without and with dashpots, beside the closed forms.

Without: Hertz (1882); the largest overlap is (15 m v^2 / (16 E* sqrt(R)))^(2/5), the contact lasts 2.9432751 of it over v, and the
energy comes back. With: the damping ratio for a restitution e is sqrt(5/6) (-ln e) / sqrt(pi^2 + ln^2 e) (Tsuji et al. 1992).
"""
import math

import dem4grm
import numpy
import pandas

GLASS = dem4grm.Material(density=2500.0, friction=0.3, shear_modulus=20e9, poisson_ratio=0.22)
RADIUS, SPEED = 5e-3, 0.4  # m, m/s of approach


def hertz():
    """Largest overlap (m) and duration (s) of the contact."""
    reduced_mass = 0.5 * GLASS.density * 4 / 3 * math.pi * RADIUS**3
    modulus = GLASS.shear_modulus / (1.0 - GLASS.poisson_ratio)  # E* of two equal spheres
    overlap = (15 * reduced_mass * SPEED**2 / (16 * modulus * math.sqrt(RADIUS / 2))) ** 0.4
    return overlap, 2.9432751 * overlap / SPEED


def impact(restitution=1.0, steps=2000):
    """The course of an impact in so many steps of Hertz' duration: time (s), overlap (m), force (N), energy (J), speed (m/s)."""
    sim = dem4grm.Simulation()
    sim.gravel = GLASS
    log = math.log(restitution)
    sim.contact_law.normal_damping_ratio = math.sqrt(5 / 6) * -log / math.sqrt(math.pi**2 + log**2)
    sim.add_ball((-RADIUS * (1 + 1e-9), 0, 0), RADIUS, velocity=(SPEED / 2, 0, 0))
    sim.add_ball((RADIUS * (1 + 1e-9), 0, 0), RADIUS, velocity=(-SPEED / 2, 0, 0))
    sim.time_step = hertz()[1] / steps
    rows = []
    for _ in range(int(1.5 * steps) // 10):
        sim.run(10)
        left, right = sim.positions  # views: no copy
        overlap = 2 * RADIUS - (right - left)[0]
        force = sim.contacts["normal_force"].sum() if overlap > 0 else 0.0
        energy = sim.energy
        rows.append((sim.time, overlap, force, energy["kinetic"] + energy["contact_strain"], sim.velocities[1, 0] * 2))
    return pandas.DataFrame(rows, columns=["time", "overlap", "force", "energy", "speed"])


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    for wanted in (1.0, 0.9, 0.5):
        course = impact(wanted)
        touching = course[course["overlap"] > 0]
        print(f"restitution wanted {wanted}, found {course['speed'].iloc[-1] / SPEED:.4f}")
        plt.plot(touching["overlap"] * 1e6, touching["force"], label=f"restitution {wanted}")
    overlap = numpy.linspace(0, hertz()[0])
    plt.plot(overlap * 1e6, 4 / 3 * GLASS.shear_modulus / (1 - GLASS.poisson_ratio) * (RADIUS / 2) ** 0.5 * overlap**1.5, "k:", label="Hertz")
    plt.gca().set(xlabel="overlap (µm)", ylabel="force (N)")
    plt.legend()
    plt.savefig("impact.png", dpi=150)
