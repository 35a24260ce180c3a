# SPDX-License-Identifier: BSD-3-Clause
"""An impact with a normal dashpot as three equations of motion: says what a difference between two programs must be.

A sphere meets a plane (or its mirror image). With d the overlap, u the slip speed at the contact, m the mass that
counts and 3.5 = 1 + m R^2 / I of a solid sphere:
    m d'' = -F,  F = h d^1.5 + c d^0.25 d';   m u' = -3.5 T,  T' = k d^0.5 u,  |T| <= friction x (F or its elastic part)
Levers are R, so it leaves out what is of the order of d / R.
"""
import functools

import numpy as np


@functools.cache
def rebound(angles_deg, poisson, friction, damping_ratio, cap, tension):
    """Tangential speed, spin times radius and normal speed of a sphere after its impact, over the speed of impact.

    cap: "elastic" or "total", the normal force that limits friction; tension: whether the dashpot may pull.
    """
    # Mass, h and speed of impact are 1: the ratios of speeds depend on none of them.
    stiffness_ratio = 2.0 * (1.0 - poisson) / (2.0 - poisson)
    angle = np.radians(np.asarray(angles_deg, dtype=float))
    closing, slip = np.cos(angle), np.sin(angle)
    overlap, shear = np.zeros_like(angle), np.zeros_like(angle)
    impulse = np.zeros_like(angle)
    dashpot = 2.0 * damping_ratio * np.sqrt(1.5)
    dt = 1e-4
    done = np.zeros(angle.shape, dtype=bool)
    while not done.all():
        root = np.sqrt(np.maximum(overlap, 0.0))
        elastic = root**3
        total = elastic + dashpot * np.sqrt(root) * closing
        if not tension:
            total = np.maximum(total, 0.0)
        shear = shear + 1.5 * root * stiffness_ratio * slip * dt
        limit = friction * np.abs(total if cap == "total" else elastic)
        shear = np.where(np.abs(shear) > limit, np.sign(shear) * limit, shear)
        working = ~done
        closing = np.where(working, closing - total * dt, closing)
        slip = np.where(working, slip - 3.5 * shear * dt, slip)
        impulse = np.where(working, impulse + shear * dt, impulse)
        overlap = np.where(working, overlap + closing * dt, overlap)
        done |= (overlap <= 0.0) & (closing < 0.0)
    return np.stack([np.sin(angle) - impulse, 2.5 * impulse, -closing], axis=1)
