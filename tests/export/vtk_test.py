#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Exports loaded by VTK's own reader: `vtk_test.py DEM4GRM`.

Every array of every file is compared with what h5py finds in the results.h5 that it was made from; strains, rotations, stresses, kinds and
strong contacts are worked out here anew. Ends with 77 where VTK's Python modules are missing. Not tested here: how ParaView draws the
files, except where pvpython and a display are there.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib
import types
import unittest
import xml.etree.ElementTree as xml

import h5py
import numpy as np

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"vtk_test: {missing}; tools/install_dependencies.sh test installs python3-vtk9")
    sys.exit(77)

import tiny_runs

PROGRAM = ""
SERIES = ["balls", "clumps", "rubber_grains", "contacts", "bonds", "walls"]
REAL = np.float32


def load(path):
    """A .vtp file as VTK reads it; an error of the reader is an error of the test."""
    reader = vtkXMLPolyDataReader()
    problems = []
    reader.AddObserver("ErrorEvent", lambda *_: problems.append(str(path)))
    reader.SetFileName(str(path))
    reader.Update()
    if problems or not reader.CanReadFile(str(path)):
        raise AssertionError(f"VTK cannot read {path}")
    return reader.GetOutput()


def arrays(attributes):
    """Arrays of points, cells or fields by name; texts as lists."""
    out = {}
    for k in range(attributes.GetNumberOfArrays()):
        array = attributes.GetAbstractArray(k)
        is_text = array.GetDataTypeAsString() == "string"
        out[array.GetName()] = [array.GetValue(n) for n in range(array.GetNumberOfValues())] if is_text else vtk_to_numpy(array)
    return out


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 3)


def ends(data):
    """Point numbers of lines with two ends, [n, 2]."""
    return vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(-1, 2)


def frames_of(path):
    """All datasets of all states as nested dictionaries, and the displacements in m."""
    def tree(group):
        return {name: tree(item) if isinstance(item, h5py.Group) else item[()] for name, item in group.items()}
    with h5py.File(path) as file:
        return tree(file["frames"]), {name: frame.attrs["displacement"] for name, frame in file["frames"].items()}


def centres(frame):
    return np.vstack([frame["rubber_grains"]["centre"].reshape(-1, 3), frame["clumps"]["position"].reshape(-1, 3)])


def turn_between(before, after):
    """Rotation vector in degrees of unit quaternions (w, x, y, z), the shorter way round."""
    w0, v0 = before[:, :1], -before[:, 1:]
    w1, v1 = after[:, :1], after[:, 1:]
    w = w1 * w0 - np.sum(v1 * v0, axis=1, keepdims=True)
    v = w1 * v0 + w0 * v1 + np.cross(v1, v0)
    v = np.where(w < 0, -v, v)
    sine = np.linalg.norm(v, axis=1, keepdims=True)
    return np.degrees(2 * np.arctan2(sine, np.abs(w)) * v / np.where(sine > 0, sine, 1))


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="dem4grm-export-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.shear = tiny_runs.run_tiny(PROGRAM, cls.folder)
        cls.grain = tiny_runs.run_grain(PROGRAM, cls.folder)
        cls.said = tiny_runs.call(PROGRAM, "export", "shear", "--vtk", folder=cls.folder)
        tiny_runs.call(PROGRAM, "export", "grain", "--vtk", folder=cls.folder)
        cls.frames, cls.at = frames_of(cls.shear / "results.h5")
        cls.first = cls.frames["0000"]

    def same(self, got, wanted, what):
        """To the last bit of what 32 bits hold."""
        wanted = np.asarray(wanted)
        wanted = wanted.astype(REAL) if wanted.dtype.kind == "f" else wanted
        self.assertEqual(got.shape, wanted.shape, what)
        self.assertTrue(np.array_equal(got, wanted, equal_nan=wanted.dtype.kind == "f"), what)

    def each(self, series):
        """Name and content of every state with what VTK read of it."""
        for name, frame in self.frames.items():
            yield name, frame, load(self.shear / f"vtk/states/{series}_{name}.vtp")

    def test_balls(self):
        for _, frame, data in self.each("balls"):
            balls, got = frame["balls"], arrays(data.GetPointData())
            self.assertEqual(data.GetNumberOfVerts(), len(balls["radius"]))
            self.same(points(data), balls["position"] * 1e3, "position")
            self.same(got["radius_mm"], balls["radius"] * 1e3, "radius")
            self.same(got["kind"], balls["material"], "kind")
            self.same(got["body"], balls["body"].astype(np.int32), "body")
            self.same(got["velocity_mm_per_s"], balls["velocity"] * 1e3, "velocity")
            self.same(got["displacement_mm"], (balls["position"] - self.first["balls"]["position"]) * 1e3, "displacement")
            self.assertTrue(np.array_equal(np.isnan(got["bond_strain"]), balls["material"] == 0), "only rubber has bonds")
            grains = arrays(load_beside(data, self.shear, frame, self.frames, "rubber_grains").GetPointData())
            self.same(got["bond_strain"][balls["material"] == 1], np.repeat(grains["bond_strain"], 35), "bond strain")

    def test_clumps(self):
        n_rubber = len(self.first["rubber_grains"]["centre"])
        for _, frame, data in self.each("clumps"):
            clumps, got = frame["clumps"], arrays(data.GetPointData())
            self.same(points(data), clumps["position"] * 1e3, "position")
            for name, wanted in (("orientation", clumps["orientation"]), ("mass_g", clumps["mass"] * 1e3),
                                 ("sieve_size_mm", clumps["sieve_size"] * 1e3), ("spin_rad_per_s", clumps["spin"]),
                                 ("velocity_mm_per_s", clumps["velocity"] * 1e3), ("shape", clumps["shape"].astype(np.int32)),
                                 ("body", n_rubber + np.arange(len(clumps["mass"]), dtype=np.int32))):
                self.same(got[name], wanted, name)
            turn = turn_between(self.first["clumps"]["orientation"], clumps["orientation"])
            np.testing.assert_allclose(got["rotation_vector_deg"], turn, rtol=1e-5, atol=1e-5)
            np.testing.assert_allclose(got["rotation_deg"], np.linalg.norm(turn, axis=1), rtol=1e-5, atol=1e-5)
        self.assertGreater(got["rotation_deg"].max(), 1.0, "grains turn in shear")

    def test_rubber_grains(self):
        for _, frame, data in self.each("rubber_grains"):
            got, bonds = arrays(data.GetPointData()), frame["bonds"]
            self.same(points(data), frame["rubber_grains"]["centre"] * 1e3, "centre")
            strain = 1.0 - bonds["length"].reshape(-1, 64) / bonds["rest_length"][:, None]
            np.testing.assert_allclose(got["bond_strain"], strain.mean(axis=1), rtol=1e-4, atol=1e-8)
            self.same(got["broken_bonds"], bonds["is_broken"].reshape(-1, 64).sum(axis=1).astype(np.int32), "broken")
            moved = frame["rubber_grains"]["centre"] - self.first["rubber_grains"]["centre"]
            self.same(got["displacement_mm"], moved * 1e3, "displacement")

    def test_contacts(self):
        for _, frame, data in self.each("contacts"):
            c, got, place = frame["contacts"], arrays(data.GetCellData()), points(data)
            n = len(c["wall"])
            self.assertEqual((data.GetNumberOfLines(), data.GetNumberOfPoints()), (n, 2 * n), "no two share a point")
            is_wall, body, material = c["wall"] >= 0, centres(frame), frame["balls"]["material"]
            self.assertTrue(0 < is_wall.sum() < n)
            far = np.where(is_wall[:, None], c["point"], body[c["body_j"]])
            self.same(place[ends(data)[:, 0]], body[c["body_i"]] * 1e3, "near end")
            self.same(place[ends(data)[:, 1]], far * 1e3, "far end")
            kind = np.where(is_wall, 3, material[c["ball_i"]].astype(int) + material[c["ball_j"]])
            self.same(got["kind"], kind.astype(np.int32), "kind")
            mean = c["normal_force"][~is_wall].mean()
            clear = np.abs(c["normal_force"] / mean - 1.0) > 1e-9  # the mean may differ in its last bits
            self.same(got["strong"][clear], (c["normal_force"] > mean)[clear].astype(np.uint8), "strong")
            for name, wanted in (("normal_force_N", c["normal_force"]), ("shear_vector_N", c["shear_force"]),
                                 ("normal", c["normal"]), ("point_mm", c["point"] * 1e3), ("sliding", c["is_sliding"]),
                                 ("body_i", c["body_i"].astype(np.int32)), ("body_j", c["body_j"].astype(np.int32)),
                                 ("wall", c["wall"].astype(np.int32))):
                self.same(got[name], wanted, name)
            np.testing.assert_allclose(got["shear_force_N"], np.linalg.norm(c["shear_force"], axis=1), rtol=1e-6)
            at_ends = arrays(data.GetPointData())["normal_force_N"]
            self.same(at_ends[ends(data)[:, 1]], c["normal_force"], "force at the ends, for tubes")

    def test_bonds(self):
        for _, frame, data in self.each("bonds"):
            bonds, got, place = frame["bonds"], arrays(data.GetCellData()), points(data).astype(float)
            n_grains = len(bonds["rest_length"])
            self.assertEqual(data.GetNumberOfLines(), 64 * n_grains)
            self.same(place.astype(REAL), frame["balls"]["position"][:35 * n_grains] * 1e3, "rubber balls")
            length = np.linalg.norm(place[ends(data)[:, 0]] - place[ends(data)[:, 1]], axis=1)
            np.testing.assert_allclose(length, bonds["length"] * 1e3, atol=1e-5, err_msg="lines join bonded balls")
            np.testing.assert_allclose(got["strain"], 1.0 - bonds["length"] / np.repeat(bonds["rest_length"], 64),
                                       rtol=1e-4, atol=1e-8)
            for name, wanted in (("normal_force_N", bonds["normal_force"]), ("shear_force_N", bonds["shear_force"]),
                                 ("moment_mN_m", bonds["moment"] * 1e3), ("broken", bonds["is_broken"]),
                                 ("body", np.repeat(np.arange(n_grains, dtype=np.int32), 64))):
                self.same(got[name], wanted, name)

    def test_walls(self):
        for _, frame, data in self.each("walls"):
            w, got, place = frame["walls"], arrays(data.GetCellData()), points(data)
            self.assertEqual(data.GetNumberOfPolys(), len(w["name"]))
            self.assertEqual(got["name"], [name.decode() for name in w["name"]])
            across = w["u"] * w["lengths"][:, :1], w["v"] * w["lengths"][:, 1:]
            corners = [w["corner"], w["corner"] + across[0], w["corner"] + across[0] + across[1], w["corner"] + across[1]]
            polygon = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 4)
            for k, corner in enumerate(corners):
                self.same(place[polygon[:, k]], corner * 1e3, f"corner {k}")
            self.same(got["force_N"], w["force"], "force")
            self.same(got["velocity_mm_per_s"], w["velocity"] * 1e3, "velocity")
            self.same(got["carrier"], w["carrier"].astype(np.int32), "carrier")

    def test_stresses_of_the_grains_add_up_to_that_of_the_specimen(self):
        """Sum of V p over the grains = volume of the box times the mean stress that `dem4grm micro` finds."""
        case = tomllib.loads((self.shear / "resolved.toml").read_text(encoding="utf-8"))
        density = float(case["gravel"]["density"].removesuffix(" kg/m3"))
        for name, frame, data in self.each("clumps"):
            gravel = arrays(data.GetPointData())
            rubber = arrays(load(self.shear / f"vtk/states/rubber_grains_{name}.vtp").GetPointData())
            c, body = frame["contacts"], np.r_[rubber["contacts"], gravel["contacts"]]
            partners = np.bincount(np.r_[c["body_i"], c["body_j"][c["wall"] < 0]], minlength=len(body))
            self.same(body, partners.astype(np.int32), "contacts of a body")
            numbers = json.loads(tiny_runs.call(PROGRAM, "micro", "shear", "--at", f"{self.at[name] * 1e3}mm", "--json",
                                                folder=self.folder))
            mean = sum(numbers[f"stress_{axis}_kPa"] for axis in ("xx", "yy", "zz")) / 3.0
            radius = frame["balls"]["radius"][:35 * len(rubber["body"]):35]
            solid = {"gravel": gravel["mass_g"] * 1e-3 / density, "rubber": 205.25 * radius**3}
            walls = {w.decode(): k for k, w in enumerate(frame["walls"]["name"])}
            height = frame["walls"]["corner"][walls["top plate"]][2] - frame["walls"]["corner"][walls["bottom plate"]][2]
            area = np.prod(frame["walls"]["lengths"][walls["bottom plate"]])
            total = sum((solid[k] * v["mean_stress_kPa"]).sum() for k, v in (("gravel", gravel), ("rubber", rubber)))
            self.assertAlmostEqual(total / (area * height) / mean, 1.0, delta=1e-4, msg=f"{total / (area * height)} {mean}")

    def test_lists_name_every_state_at_its_displacement(self):
        for series in SERIES:
            entries = xml.parse(self.shear / f"vtk/{series}.pvd").getroot().find("Collection").findall("DataSet")
            self.assertEqual([float(e.get("timestep")) for e in entries], [at * 1e3 for at in self.at.values()])
            for entry, name in zip(entries, self.frames):
                field = arrays(load(self.shear / "vtk" / entry.get("file")).GetFieldData())
                self.assertEqual(field["state"], [name])
                self.assertEqual(field["displacement_mm"], REAL(self.at[name] * 1e3))
        self.assertEqual(list(self.at.values()), sorted(self.at.values()))
        self.assertIn("paraview --script=shear/vtk/view.py", self.said)

    def test_one_grain_between_plates(self):
        frames, at = frames_of(self.grain / "results.h5")
        self.assertEqual(sorted(p.stem for p in self.grain.glob("vtk/*.pvd")), sorted(set(SERIES) - {"clumps"}))
        name, frame = list(frames.items())[-1]
        contacts = load(self.grain / f"vtk/states/contacts_{name}.vtp")
        self.assertEqual(set(arrays(contacts.GetCellData())["kind"]), {3})
        self.assertEqual(load(self.grain / f"vtk/states/bonds_{name}.vtp").GetNumberOfLines(), 64)
        stress = arrays(load(self.grain / f"vtk/states/rubber_grains_{name}.vtp").GetPointData())["mean_stress_kPa"]
        c, centre = frame["contacts"], frame["rubber_grains"]["centre"][0]
        on_grain = c["shear_force"] - c["normal_force"][:, None] * c["normal"]
        volume = 205.25 * frame["balls"]["radius"][0] ** 3
        wanted = -np.sum(on_grain * (c["point"] - centre)) / (3.0 * volume) / 1e3
        np.testing.assert_allclose(stress, [wanted], rtol=1e-4)
        self.assertGreater(wanted, 1.0)
        self.assertGreater(max(at.values()), 0.0)

    def test_same_states_give_same_bytes_and_a_choice_gives_just_these(self):
        tiny_runs.call(PROGRAM, "export", "shear/results.h5", "--vtk", "-o", "again", "--at", "0mm,1mm", folder=self.folder)
        again, whole = self.folder / "again", self.shear / "vtk"
        chosen = sorted(p.name for p in again.glob("states/*"))
        self.assertEqual(chosen, sorted(f"{s}_{n}.vtp" for s in SERIES for n in ("0000", list(self.frames)[-1])))
        for name in chosen:
            self.assertEqual((again / "states" / name).read_bytes(), (whole / "states" / name).read_bytes(), name)
        script = (again / "view.py").read_text()
        self.assertEqual(script.replace(str(again), str(whole)), (whole / "view.py").read_text())
        self.assertFalse(list(again.glob("**/*.tmp")))
        tiny_runs.call(PROGRAM, "export", "shear/specimen.h5", "--vtk", "-o", "specimen", folder=self.folder)
        place = points(load(self.folder / "specimen/states/balls_0000.vtp"))
        self.same(place, self.first["balls"]["position"] * 1e3, "the specimen is the state before shear")

    def test_script_names_only_what_is_there(self):
        """view.py with a stand-in for ParaView that notes files and arrays; the real one draws where it is installed."""
        for folder in (self.shear, self.grain):
            seen = run_with_stand_in(folder / "vtk/view.py")
            self.assertEqual(sorted(seen.files), sorted(str(p) for p in folder.glob("vtk/*.pvd")))
            state = sorted(p.stem.split("_")[-1] for p in folder.glob("vtk/states/*.vtp"))[-1]
            there = {}
            for path in folder.glob(f"vtk/states/*_{state}.vtp"):
                data = load(path)
                there[path.stem.rsplit("_", 1)[0]] = {"POINTS": set(arrays(data.GetPointData())),
                                                      "CELLS": set(arrays(data.GetCellData()))}
            self.assertTrue(seen.arrays)
            for series, place, name in seen.arrays:
                self.assertIn(name, there[series][place], (folder.name, series))

    @unittest.skipUnless(shutil.which("pvpython") and os.environ.get("DISPLAY"), "needs pvpython and a display")
    def test_paraview_draws_it(self):
        picture = self.folder / "picture.png"
        subprocess.run(["pvpython", str(self.shear / "vtk/view.py"), str(picture)], check=True)
        self.assertGreater(picture.stat().st_size, 20000)

    def test_refusals(self):
        for code, text, words in ((64, "name a format", ["shear"]), (64, "has no unit", ["shear", "--vtk", "--at", "7"]),
                                  (66, "there are states at 0, 0.2, 0.5, 1 mm", ["shear", "--vtk", "--at", "7mm"]),
                                  (66, "holds neither", [".", "--vtk"]), (66, "no such file", ["absent", "--vtk"]),
                                  (74, "tiny.toml", ["tiny.toml", "--vtk"]),
                                  (74, "the folder cannot be made", ["shear", "--vtk", "-o", "tiny.toml"])):
            done = subprocess.run([PROGRAM, "export", *words], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, text in done.stderr), (code, True), (words, done.stderr))
        with open(self.shear / "results.h5", "rb") as file:
            (self.folder / "short.h5").write_bytes(file.read()[:20000])
        done = subprocess.run([PROGRAM, "export", "short.h5", "--vtk", "-o", "short"], cwd=self.folder, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, "short.h5" in done.stderr), (74, True), done.stderr)


def load_beside(data, folder, frame, frames, series):
    """Another series of the same state."""
    name = arrays(data.GetFieldData())["state"][0]
    assert frames[name] is frame
    return load(folder / f"vtk/states/{series}_{name}.vtp")


class StandIn:
    """Anything of ParaView: takes every call and every property, and notes the arrays that are named for a series."""

    def __init__(self, notes, series=None, **properties):
        self.__dict__.update(notes=notes, series=series)
        for name, value in properties.items():
            setattr(self, name, value)

    def __setattr__(self, name, value):
        if isinstance(value, (list, tuple)) and len(value) == 2 and value[0] in ("POINTS", "CELLS") and value[1]:
            self.notes.note(self.series, *value)
        self.__dict__[name] = value

    def __getattr__(self, name):
        return StandIn(self.notes, self.series)

    def __call__(self, *arguments, **properties):
        return StandIn(self.notes, self.series, **properties)

    def __getitem__(self, name):
        return StandIn(self.notes, self.series)

    def GetRange(self):
        return (0.0, 4.0) if self.series == "contacts" else (0.0, 1.0)


class Notes:
    def __init__(self):
        self.files, self.arrays, self.made = [], set(), set()

    def note(self, series, place, name):
        if name not in self.made:  # by a calculator of the script
            self.arrays.add((series, place, name))


def run_with_stand_in(script):
    notes = Notes()
    module = types.ModuleType("paraview.simple")

    def read(registrationName, FileName):
        notes.files.append(FileName)
        return StandIn(notes, registrationName)

    def filter_of(Input=None, ResultArrayName=None, **properties):
        notes.made.add(ResultArrayName)
        return StandIn(notes, Input.series if Input is not None else None, **properties)

    def colour(display, array, **_):
        notes.note(display.series, *array)

    def show(source, view):
        return StandIn(notes, source.series)

    module.PVDReader, module.ColorBy, module.Show = read, colour, show
    for name in ("Threshold", "ExtractSurface", "Calculator", "Tube", "Text", "AnnotateTimeFilter"):
        setattr(module, name, filter_of)
    for name in ("GetColorTransferFunction", "GetScalarBar", "GetAnimationScene", "UpdatePipeline", "CreateView", "CreateLayout",
                 "AssignViewToLayout", "ResetCamera", "AddCameraLink", "RenderAllViews", "SaveScreenshot"):
        setattr(module, name, StandIn(notes))
    before = {name: sys.modules.get(name) for name in ("paraview", "paraview.simple")}
    sys.modules.update({"paraview": types.ModuleType("paraview"), "paraview.simple": module})
    try:
        exec(compile(script.read_text(encoding="utf-8"), str(script), "exec"), {"__file__": str(script), "__name__": "view"})
    finally:
        for name, old in before.items():
            sys.modules.pop(name)
            if old is not None:
                sys.modules[name] = old
    return notes


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=1)
