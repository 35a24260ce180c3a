#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Packs the states of a results.h5, or a made-up full-size specimen, as the `View` of src/data.ts: to try the view without the program.

usage: pack_sample.py RESULTS.h5 OUT.json
       pack_sample.py full-size OUT.json
"""
import base64
import json
import sys
import zlib

import numpy as np

BALLS = 35
STEPS = 1 << 14  # 14 bits for each coordinate
QUATERNION_UNIT = 32767


def prediction_rows():
    """A corner from its neighbours in the lattice, a centre from the lowest corner of its cell and the first centre."""
    rows = []
    for slot in range(27):
        steps = (1, 3, 9)
        at = (slot % 3, slot // 3 % 3, slot // 9)
        moved = [step for step, place in zip(steps, at) if place > 0]
        twice = [step for step, place in zip(steps, at) if place == 2]
        if not moved:
            rows.append([-1, -1, -1])
        elif len(moved) >= 2:
            rows.append([slot - moved[0], slot - moved[1], slot - moved[0] - moved[1]])
        elif twice:
            rows.append([slot - twice[0], slot - twice[0], slot - 2 * twice[0]])
        else:
            rows.append([0, -1, -1])
    rows.append([0, -1, -1])
    for cell in range(1, 8):
        low = (cell & 1) + 3 * (cell >> 1 & 1) + 9 * (cell >> 2 & 1)
        rows.append([low, 27, 0])
    return rows


ROWS = prediction_rows()


def pack(numbers, zigzag=False, delta=False, bytes_=None):
    numbers = np.asarray(numbers, dtype=np.int64).ravel()
    width_of_value = 0
    if delta and len(numbers):
        width_of_value = int(np.abs(numbers).max()) * (2 if zigzag else 1)
        numbers = np.concatenate([numbers[:1], np.diff(numbers)])
    if zigzag:
        numbers = np.where(numbers < 0, -2 * numbers - 1, 2 * numbers)
    top = max(int(numbers.max()) if len(numbers) else 0, width_of_value)
    bytes_ = bytes_ or (1 if top < 1 << 8 else 2 if top < 1 << 16 else 4)
    words = (numbers & ((1 << 8 * bytes_) - 1)).astype("<u%d" % bytes_)
    planes = words.view(np.uint8).reshape(-1, bytes_).T.tobytes() if len(words) else b""
    return {"count": len(numbers), "bytes": bytes_, "zigzag": zigzag, "delta": delta,
            "data": base64.b64encode(zlib.compress(planes, 9)).decode()}


def residuals(places, grains):
    """Of whole coordinates along one axis, balls in order."""
    p = places.reshape(grains, BALLS)
    out = np.empty_like(p)
    for k, (a, b, c) in enumerate(ROWS):
        if a < 0:
            out[0, 0], out[1:, 0] = p[0, 0], p[1:, 0] - p[:-1, 0]
        elif b < 0:
            out[:, k] = p[:, k] - p[:, a]
        else:
            out[:, k] = p[:, k] - (p[:, a] + p[:, b] - p[:, c])
    return out.ravel()


def inverse_turn(q, v):
    w, u = q[:, :1], -q[:, 1:]
    t = 2 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


class Packer:
    def __init__(self, low, high, rubber_radius, pebbles, pebble_place, pebble_radius):
        self.origin, self.step = low, (high - low) / (STEPS - 1)
        self.grains, self.clumps = len(rubber_radius), len(pebbles)
        radii = np.concatenate([rubber_radius, pebble_radius])
        radius_step = radii.max() / 4096
        self.view = {
            "origin_mm": list(self.origin), "step_mm": list(self.step), "rubber_grains": self.grains, "clumps": self.clumps,
            "radius_step_mm": radius_step, "rubber_radius": pack(np.rint(rubber_radius / radius_step)),
            "rubber_prediction": ROWS, "clump_pebbles": pack(pebbles),
            "pebble_position": pack(np.rint(pebble_place / radius_step), zigzag=True),
            "pebble_radius": pack(np.rint(pebble_radius / radius_step)), "states": [],
        }

    def whole(self, position):
        return np.rint((position - self.origin) / self.step).astype(np.int64)

    def add(self, displacement, rubber, clump_place, clump_turn, stress, strain, body_i, body_j, force, walls):
        places = self.whole(rubber)
        order = np.argsort(body_i, kind="stable")
        body_i, body_j, force = body_i[order], body_j[order], force[order]
        stress_step = max(np.abs(stress).max(), 1e-9) / 32000
        strain_step = max(np.abs(strain).max() if len(strain) else 0, 1e-9) / 32000
        force_step = force.max() / 65535
        self.view["states"].append({
            "displacement_mm": displacement,
            "rubber": pack(np.concatenate([residuals(places[:, a], self.grains) for a in range(3)]), zigzag=True),
            "clump_position": pack(self.whole(clump_place).T, zigzag=True, delta=True),
            "clump_orientation": pack(np.rint(clump_turn * QUATERNION_UNIT).T, zigzag=True),
            "stress_step_kPa": stress_step, "body_stress": pack(np.rint(stress / stress_step), zigzag=True),
            "strain_step": strain_step, "bond_strain": pack(np.rint(strain / strain_step), zigzag=True),
            "contact_body_i": pack(body_i, delta=True), "contact_body_j": pack(body_j),
            "force_step_N": force_step, "contact_force": pack(np.rint(force / force_step)),
            "strong_threshold_N": float(force.mean()), "walls": walls,
        })


def mean_stress(bodies, centre, volume, contacts):
    """Trace of the sum of forces times branches over three volumes, kPa; lengths in mm, forces in N."""
    i, j, point, normal, normal_force = contacts
    force_i = -normal_force[:, None] * normal
    sums = np.zeros(bodies)
    np.add.at(sums, i, np.einsum("ij,ij->i", force_i, point - centre[i]))
    inner = j >= 0
    np.add.at(sums, j[inner], np.einsum("ij,ij->i", -force_i[inner], (point - centre[np.maximum(j, 0)])[inner]))
    return -sums / 3 / volume * 1e3


def from_results(path):
    import h5py
    with h5py.File(path, "r") as results:
        frames = [results["frames"][name] for name in sorted(results["frames"])]
        first = frames[0]
        grains, clumps = len(first["rubber_grains/centre"]), len(first["clumps/position"])
        radius, body = first["balls/radius"][:] * 1e3, first["balls/body"][:]
        everything = np.concatenate([frame["balls/position"][:] for frame in frames]) * 1e3
        pebble = np.arange(BALLS * grains, len(radius))
        owner = body[pebble] - grains
        q = first["clumps/orientation"][:]
        local = inverse_turn(q[owner], (first["balls/position"][:][pebble] - first["clumps/position"][:][owner]) * 1e3)
        packer = Packer(everything.min(0), everything.max(0), radius[:BALLS * grains:BALLS],
                        np.bincount(owner, minlength=clumps), local, radius[pebble])
        volume = np.bincount(body, 4 / 3 * np.pi * radius**3)
        for frame in frames:
            c = frame["contacts"]
            i, j, force = c["body_i"][:], c["body_j"][:], c["normal_force"][:]
            centre = np.concatenate([frame["rubber_grains/centre"][:], frame["clumps/position"][:]]) * 1e3
            stress = mean_stress(grains + clumps, centre, volume, (i, j, c["point"][:] * 1e3, c["normal"][:], force))
            rest = frame["bonds/rest_length"][:]
            strain = 1 - frame["bonds/length"][:].reshape(grains, -1).mean(1) / rest if grains else np.zeros(0)
            w = frame["walls"]
            walls = [{"name": name.decode(), "corner_mm": list(1e3 * corner), "u_mm": list(1e3 * lengths[0] * u), "v_mm": list(1e3 * lengths[1] * v)}
                     for name, corner, lengths, u, v in zip(w["name"][:], w["corner"][:], w["lengths"][:], w["u"][:], w["v"][:])]
            inner = j >= 0
            packer.add(float(frame.attrs["displacement"]) * 1e3, frame["balls/position"][:][:BALLS * grains] * 1e3,
                       frame["clumps/position"][:] * 1e3, frame["clumps/orientation"][:], stress, strain,
                       i[inner], j[inner], force[inner], walls)
        return packer.view


def full_size(clumps=2500, grains=5500, states=10, contacts=30000):
    """As many balls as a full-size test has, on a jittered lattice: a load for the view, no physics."""
    rng = np.random.default_rng(1)
    box = np.array([100.0, 100.0, 100.0])
    n = 20
    cells = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), -1).reshape(-1, 3)
    cells = rng.permutation(cells)[: clumps + grains]
    start = (cells + 0.5) / n * box + rng.normal(0, 0.25, (len(cells), 3))
    slot = np.arange(27)
    site = np.concatenate([np.stack([slot % 3, slot // 3 % 3, slot // 9], -1) - 1.0,
                           np.stack([[c & 1, c >> 1 & 1, c >> 2 & 1] for c in range(8)]) - 0.5])
    ball = 0.62 * np.exp(rng.normal(0, 0.06, grains))
    lattice = site[None] * (4 / np.sqrt(3) * ball)[:, None, None]
    shape = np.array([[0, 0, 0], [.5, .1, 0], [-.45, .15, .1], [.05, -.45, .1], [-.05, .1, -.35]]) * 2.3
    local = np.tile(shape, (clumps, 1))
    packer = Packer(-np.array([4.0, 4.0, 4.0]), box + np.array([16.0, 4.0, 6.0]), ball, np.full(clumps, 5), local,
                    np.tile(np.array([1, .8, .8, .78, .85]) * 2.0, clumps))
    q0 = rng.normal(size=(clumps + grains, 4))
    q0 /= np.linalg.norm(q0, axis=1)[:, None]
    at = np.empty((n, n, n), dtype=np.int64)
    at[tuple(cells.T)] = np.arange(len(cells))
    pairs = np.concatenate([np.stack([at[: n - i, : n - j, : n - k].ravel(), at[i:, j:, k:].ravel()], -1)
                            for i, j, k in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]])
    pairs = rng.permutation(pairs)[:contacts]
    force = rng.exponential(2.0, len(pairs))
    for state in range(states):
        shift = 10.0 * state / max(states - 1, 1)
        band = 1 / (1 + np.exp((start[:, 2] - 50) / 4))
        centre = start + np.stack([shift * band, 0 * band, 0.06 * shift * (1 - band)], -1)
        angle = np.radians(25) * band * (1 - band) * 4 * state / states
        turn = np.stack([np.cos(angle / 2), 0 * angle, np.sin(angle / 2), 0 * angle], -1)
        q = np.stack([turn[:, 0] * q0[:, 0] - turn[:, 2] * q0[:, 2], turn[:, 0] * q0[:, 1] + turn[:, 2] * q0[:, 3],
                      turn[:, 0] * q0[:, 2] + turn[:, 2] * q0[:, 0], turn[:, 0] * q0[:, 3] - turn[:, 2] * q0[:, 1]], -1)
        g = np.repeat(np.arange(grains), BALLS)
        back = q[g] * np.array([1, -1, -1, -1])
        squeezed = (lattice * np.array([1.02, 1.0, 0.97])).reshape(-1, 3) + rng.normal(0, 0.015, (grains * BALLS, 3))
        rubber = centre[g] + inverse_turn(back, squeezed)
        walls = [{"name": name, "corner_mm": [x + (shift if "lower" in name or "bottom" in name else 0), y, z], "u_mm": u, "v_mm": v}
                 for name, x, y, z, u, v in [
                     ("bottom plate", 0, 0, 0, [100, 0, 0], [0, 100, 0]), ("top plate", 0, 0, 100 + 0.06 * shift, [0, 100, 0], [100, 0, 0]),
                     ("lower wall -x", 0, 0, 0, [0, 100, 0], [0, 0, 50]), ("lower wall +x", 100, 0, 0, [0, 0, 50], [0, 100, 0]),
                     ("lower wall -y", 0, 0, 0, [0, 0, 50], [100, 0, 0]), ("lower wall +y", 0, 100, 0, [100, 0, 0], [0, 0, 50]),
                     ("upper wall -x", 0, 0, 50, [0, 100, 0], [0, 0, 60]), ("upper wall +x", 100, 0, 50, [0, 0, 60], [0, 100, 0]),
                     ("upper wall -y", 0, 0, 50, [0, 0, 60], [100, 0, 0]), ("upper wall +y", 0, 100, 50, [100, 0, 0], [0, 0, 60])]]
        packer.add(shift, rubber, centre[grains:], q[grains:], rng.gamma(2.0, 60.0, grains + clumps), rng.normal(0.02, 0.01, grains),
                   pairs[:, 0], pairs[:, 1], force, walls)
    return packer.view


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    made = full_size() if sys.argv[1] == "full-size" else from_results(sys.argv[1])
    with open(sys.argv[2], "w") as out:
        json.dump(made, out, separators=(",", ":"))
    print(f"{sys.argv[2]}: {made['rubber_grains']} rubber grains, {made['clumps']} clumps, {len(made['states'])} states")
