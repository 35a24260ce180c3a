#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The view of a specimen in a report, decoded by the words of web/src/data.ts and held against results.h5.

    view_test.py PROGRAM

Runs a tiny mixture, takes the data of its report, and compares every ball, radius, force, stress and strain with what h5py reads.
The borders are those of the quantisation: half a step of a place, twice for a predicted one.
"""
import base64
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zlib

import h5py
import numpy as np

PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
CASE = """name = "tiny"
seed = 3
[specimen]
rubber_content = 0.3
preparation_friction = 0.3
generation_void_ratio = 0.85
gravel_grading = [["3.6 mm", 0.0], ["4.0 mm", 1.0]]
rubber_grading = [["3.6 mm", 0.0], ["3.8 mm", 1.0]]
[box]
length = "20 mm"
width  = "20 mm"
height = "20 mm"
upper_height = "40 mm"
[equilibrium]
force_ratio = 0.02
plate_speed = "5 mm/s"
stress_tolerance = 0.05
hold_steps = 200
[shear]
normal_stress = "100 kPa"
velocity      = "200 mm/s"
displacement  = "2 mm"
[recording]
frame_interval = "0.5 mm"
"""


def unpacked(part):
    n, width = part["count"], part["bytes"]
    planes = np.frombuffer(zlib.decompress(base64.b64decode(part["data"])), np.uint8).reshape(width, n).astype(np.int64)
    values = sum(planes[k] << (8 * k) for k in range(width)) if n else np.zeros(0, np.int64)
    if part["zigzag"]:
        values = np.where(values % 2 == 0, values // 2, -(values + 1) // 2)
    return np.cumsum(values) % (1 << 8 * width) if part["delta"] else values


def rubber_places(view, state):
    """[35 n, 3] whole numbers, from the residuals to the predictions."""
    residual = unpacked(state["rubber"]).reshape(3, -1, 35)
    out = np.zeros_like(residual)
    for grain in range(residual.shape[1]):
        for k, (a, b, c) in enumerate(view["rubber_prediction"]):
            if a < 0:
                before = out[:, grain - 1, 0] if grain else 0
            else:
                before = out[:, grain, a] if b < 0 else out[:, grain, a] + out[:, grain, b] - out[:, grain, c]
            out[:, grain, k] = residual[:, grain, k] + before
    return out.reshape(3, -1).T


def rotated(quaternion, vector):
    w, axis = quaternion[:, :1], quaternion[:, 1:]
    twice = 2 * np.cross(axis, vector)
    return vector + w * twice + np.cross(axis, twice)


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        (root / "tiny.toml").write_text(CASE)
        run = lambda *words: subprocess.run([PROGRAM, *words], cwd=root, check=True, stdout=subprocess.PIPE).stdout
        run("run", "tiny.toml", "-o", "out", "-q", "--no-report")
        cls.view = json.loads(run("report", "out", "--data", "--bootstrap", "0"))["tests"][0]["view"]
        cls.results = h5py.File(root / "out/results.h5")
        cls.frames = [cls.results["frames"][name] for name in sorted(cls.results["frames"])]

    @classmethod
    def tearDownClass(cls):
        cls.results.close()
        cls.folder.cleanup()

    def states(self):
        self.assertEqual(len(self.view["states"]), len(self.frames))
        return zip(self.view["states"], self.frames)

    def test_every_ball_is_where_it_was(self):
        origin, step = np.array(self.view["origin_mm"]), np.array(self.view["step_mm"])
        self.assertLess(step.max(), 1.1 * 60 / 16383)
        pebbles = unpacked(self.view["pebble_position"]).reshape(-1, 3) * self.view["radius_step_mm"]
        clump = np.repeat(np.arange(self.view["clumps"]), unpacked(self.view["clump_pebbles"]))
        n_rubber = 35 * self.view["rubber_grains"]
        self.assertGreater(n_rubber, 0)
        for state, frame in self.states():
            self.assertAlmostEqual(state["displacement_mm"], 1e3 * frame.attrs["displacement"], places=9)
            position = 1e3 * frame["balls/position"][:]
            self.assertLess(np.abs(origin + step * rubber_places(self.view, state) - position[:n_rubber]).max(), 0.51 * step.max())
            centre = origin + step * unpacked(state["clump_position"]).reshape(3, -1).T
            turn = unpacked(state["clump_orientation"]).reshape(4, -1).T / 32767
            found = centre[clump] + rotated(turn[clump], pebbles)
            self.assertLess(np.abs(found - position[n_rubber:]).max(), step.max() + 0.002)

    def test_radii(self):
        radius = 1e3 * self.frames[0]["balls/radius"][:]
        n_rubber = 35 * self.view["rubber_grains"]
        step = self.view["radius_step_mm"]
        self.assertLess(np.abs(step * unpacked(self.view["rubber_radius"]) - radius[:n_rubber:35]).max(), step)
        self.assertLess(np.abs(step * unpacked(self.view["pebble_radius"]) - radius[n_rubber:]).max(), step)

    def test_forces_are_those_of_pairs_of_grains(self):
        for state, frame in self.states():
            contacts = frame["contacts"]
            between = contacts["wall"][:] < 0
            i, j = contacts["body_i"][:][between], contacts["body_j"][:][between]
            force = (contacts["normal_force"][:][between, None] * contacts["normal"][:][between]
                     - contacts["shear_force"][:][between])
            force[i > j] *= -1  # of the body with the smaller id on the other
            pairs, place = np.unique(np.c_[np.minimum(i, j), np.maximum(i, j)], axis=0, return_inverse=True)
            whole = np.zeros((len(pairs), 3))
            np.add.at(whole, place.ravel(), force)
            found = dict(zip(zip(unpacked(state["contact_body_i"]).tolist(), unpacked(state["contact_body_j"]).tolist()),
                             (unpacked(state["contact_force"]) * state["force_step_N"]).tolist()))
            self.assertEqual(set(found), set(map(tuple, pairs.tolist())))
            # The normal part of the whole force: never more than it, and equal where one contact makes the pair.
            single = np.bincount(place.ravel()) == 1
            normal = np.zeros(len(pairs))
            np.add.at(normal, place.ravel(), contacts["normal_force"][:][between])
            ours = np.array([found[tuple(pair)] for pair in pairs.tolist()])
            self.assertLess(np.abs(ours - normal)[single].max(), state["force_step_N"])
            self.assertTrue((ours <= np.linalg.norm(whole, axis=1) + state["force_step_N"]).all())
            self.assertAlmostEqual(state["strong_threshold_N"], ours.mean(), delta=2 * state["force_step_N"])

    def test_mean_stress_of_the_grains(self):
        """p = -1/(3 V) sum F . (x - X): force on the grain, its point, the grain's centre and solid volume."""
        frame = self.frames[0]
        contacts, state = frame["contacts"], self.view["states"][0]
        centre = np.r_[frame["rubber_grains/centre"][:], frame["clumps/position"][:]]
        push = contacts["normal_force"][:][:, None] * contacts["normal"][:] - contacts["shear_force"][:]
        i, j, point = contacts["body_i"][:], contacts["body_j"][:], contacts["point"][:]
        trace = np.zeros(len(centre))
        np.add.at(trace, i, np.einsum("ij,ij->i", push, point - centre[i]))
        inner = contacts["wall"][:] < 0
        np.add.at(trace, j[inner], -np.einsum("ij,ij->i", push[inner], point[inner] - centre[j[inner]]))
        radius = frame["balls/radius"][:]
        n = self.view["rubber_grains"]
        volume = np.r_[35 * 4 / 3 * np.pi * radius[:35 * n:35] ** 3 * 1610 / 1150, frame["clumps/mass"][:] / 2710]
        expected = trace / (3 * volume) / 1e3
        found = unpacked(state["body_stress"]) * state["stress_step_kPa"]
        self.assertGreater(expected.mean(), 10)  # compression
        self.assertLess(np.abs(found - expected).max(), state["stress_step_kPa"])

    def test_bond_strain(self):
        for state, frame in self.states():
            rest = frame["bonds/rest_length"][:]
            expected = (1 - frame["bonds/length"][:].reshape(-1, 64) / rest[:, None]).mean(axis=1)
            found = unpacked(state["bond_strain"]) * state["strain_step"]
            self.assertLess(np.abs(found - expected).max(), state["strain_step"])

    def test_walls(self):
        for state, frame in self.states():
            self.assertEqual([wall["name"] for wall in state["walls"]], [n.decode() for n in frame["walls/name"][:]])
            for k, wall in enumerate(state["walls"]):
                np.testing.assert_allclose(wall["corner_mm"], 1e3 * frame["walls/corner"][k])
                np.testing.assert_allclose(wall["u_mm"], 1e3 * frame["walls/u"][k] * frame["walls/lengths"][k, 0], atol=1e-12)


if __name__ == "__main__":
    unittest.main()
