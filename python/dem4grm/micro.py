# SPDX-License-Identifier: BSD-3-Clause
"""Micro-mechanics of contact networks: fabric, force anisotropy, strong network, stress (docs/theory/micro-mechanics.md).

The shear plane is x-z, angles are counted from x towards z, compression is positive.
"""
from __future__ import annotations

import io
import json
from fnmatch import fnmatchcase
from typing import Any

import numpy
import pandas
from numpy.typing import ArrayLike, NDArray

from . import _core

_SETS = {"all": "all", "g-g": "gravel-gravel", "g-r": "gravel-rubber", "r-r": "rubber-rubber"}


class MicroAnalysis:
    """What an analysis found.

    numbers         quantities of the whole state, units in the names, as in micro.csv; not a number where the network does not tell
    sets            one row a set of contacts (all, g-g, g-r, r-r): amplitudes and directions of fabric and forces, ...
    histograms      polar histograms and fitted curves of each set
    fabric_tensor, fabric_tensor_strong, fabric_tensor_weak   [3, 3], trace 1
    options         of the analysis
    """

    def __init__(self, json_text: str, histogram_text: str, unknown: tuple[str, ...] = ()):
        found = json.loads(json_text)
        self.options: dict[str, Any] = found.pop("options")
        self.state_hash: str = found.pop("state_hash")
        rows = found.pop("sets")
        self.bands: dict[str, Any] = {name: row.pop("bands_95") for name, row in rows.items() if "bands_95" in row}
        self.sets = pandas.DataFrame.from_dict(rows, orient="index").astype(float)
        self.sets.attrs["sets"] = _SETS
        self.fabric_tensor = numpy.array(found.pop("fabric_tensor"))
        self.fabric_tensor_strong = numpy.array(found.pop("fabric_tensor_strong"), dtype=float)
        self.fabric_tensor_weak = numpy.array(found.pop("fabric_tensor_weak"), dtype=float)
        for name in ("state", "displacement_mm"):
            found.pop(name)
        self.zone_name: str = found.pop("zone_name")
        self.is_fabric_isotropic: bool = found.pop("is_fabric_isotropic")
        self.numbers: dict[str, float] = {
            name: float("nan") if value is None or any(fnmatchcase(name, one) for one in unknown) else float(value)
            for name, value in found.items()}
        self._histogram_text = histogram_text

    @property
    def histograms(self) -> pandas.DataFrame:
        return pandas.read_csv(io.StringIO(self._histogram_text), float_precision="round_trip")

    def __repr__(self) -> str:
        row = self.sets.loc["all"]
        return f"<dem4grm.MicroAnalysis of {row['contacts']:.0f} contacts, a {row['a']:.3f}, a_n {row['a_n']:.3f}>"


def _words(bins: int, level: str, mean: str, strong: str, projection: str, resamples: int, seed: int) -> tuple:
    return bins, level, mean, strong, projection, resamples, seed


# What a network of arrays does not tell: names, or beginnings of names that end with *.
_OF_RUBBER_AND_WALLS = ("bond*", "grain_strain*", "volume_strain*", "aspect_ratio*", "closed_second*", "rattlers_*", "boundary*",
                        "plate_stress*", "stress_difference", "strong_spans")
_OF_BODIES = ("coordination*", "rattlers", "strong_clusters", "strong_largest_cluster")
_OF_STRESS = ("stress_?*_kPa", "stress_direction*", "stress_ratio")


def analyse(normals: ArrayLike, normal_force: ArrayLike, shear_force: ArrayLike | None = None, *,
            branches: ArrayLike | None = None, volume: float | None = None, kinds: ArrayLike | None = None,
            sliding: ArrayLike | None = None, bodies: ArrayLike | None = None, n_bodies: int | None = None, bins: int = 36,
            level: str = "contact", mean: str = "orientations", strong: str = "normal", projection: str = "all",
            resamples: int = 0, seed: int = 1) -> MicroAnalysis:
    """Analyses any network of n contacts, whoever made it, with the functions that analyse a shear test.

    normals       [n, 3] unit vectors from the first body of a contact to the second
    normal_force  [n] N, compression positive
    shear_force   [n, 3] N, on the first body, square to the normal; none by default
    branches      [n, 3] m, from the centre of the first body to that of the second, with
    volume        m3, of the sample: give the stress
    kinds         [n] 0 gravel-gravel, 1 gravel-rubber, 2 rubber-rubber; all 0 by default
    sliding       [n] 1 where a contact is at its Coulomb limit
    bodies        [n, 2] numbers of the two bodies from 0, with n_bodies (default: the largest number plus one): give coordination
                  and rattlers, and are needed for level="pair"
    bins, level, mean, strong, projection, resamples, seed    options of `dem4grm micro`: bins of the full circle (even, 18 to 720),
                  "contact" or "pair", f0 over "orientations" or "contacts", strong by "normal" or "magnitude" of the force,
                  "all" or "near-plane" contacts, resamples of the bootstrap

    Arrays of float64 that lie row by row are read where they are. Raises ValueError for shapes and words that do not fit.
    """
    rows = numpy.asarray(normals, dtype=float)
    nothing = numpy.empty(0)
    if rows.size and not numpy.allclose(numpy.einsum("ij,ij->i", numpy.atleast_2d(rows), numpy.atleast_2d(rows)), 1.0, atol=1e-6):
        raise ValueError("normals must be unit vectors")
    if level == "pair" and bodies is None:
        raise ValueError("level 'pair' needs the bodies of the contacts")
    if (branches is None) != (volume is None):
        raise ValueError("the stress needs branches and volume, both")
    pairs = numpy.asarray(bodies, dtype=numpy.intc) if bodies is not None else numpy.empty(0, dtype=numpy.intc)
    if n_bodies is None:
        n_bodies = int(pairs.max()) + 1 if pairs.size else 0
    unknown = _OF_RUBBER_AND_WALLS + (() if bodies is not None else _OF_BODIES) + (() if volume is not None else _OF_STRESS)
    found = _core.analyse_network(
        rows, numpy.asarray(normal_force, dtype=float), nothing if shear_force is None else numpy.asarray(shear_force, dtype=float),
        nothing if branches is None else numpy.asarray(branches, dtype=float),
        numpy.empty(0, dtype=numpy.intc) if kinds is None else numpy.asarray(kinds, dtype=numpy.intc),
        numpy.empty(0, dtype=numpy.intc) if sliding is None else numpy.asarray(sliding, dtype=numpy.intc), pairs, n_bodies,
        volume or 0.0, *_words(bins, level, mean, strong, projection, resamples, seed))
    return MicroAnalysis(*found, unknown=unknown)


def fabric_tensor(normals: ArrayLike) -> NDArray[numpy.float64]:
    """<n_i n_j> of unit normals [n, 3]: [3, 3], trace 1. Source: Satake (1982)."""
    return _core.fabric_tensor(normals)


def stress_tensor(forces: ArrayLike, branches: ArrayLike, volume: float) -> NDArray[numpy.float64]:
    """(1/V) sum f_i l_j in Pa: [3, 3], compression positive.

    forces    [n, 3] N, of the first body of a contact on the second
    branches  [n, 3] m, from the centre of the first body to that of the second (to the contact point on a wall)
    volume    m3
    Source: Love (1927), Weber (1966). Raises ValueError for shapes that do not fit.
    """
    return _core.stress_tensor(forces, branches, volume)
