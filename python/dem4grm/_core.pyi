# SPDX-License-Identifier: BSD-3-Clause
# Types of the extension module. What a user calls is in the modules beside it; paths, JSON texts and lists here are made for them.
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike, NDArray

version: str
commit: str
compiler: str

def kernel_target() -> str: ...
def choose_kernel_target(name: str) -> None: ...
def processors() -> int: ...

class LoadedCase:
    @property
    def source_text(self) -> str: ...
    @property
    def resolved_toml(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def name(self) -> str: ...
    @property
    def test(self) -> str: ...
    def si_value(self, path: str) -> Any: ...
    def keys(self) -> list[dict[str, str]]: ...

def load_case(path: str | PathLike, overrides: Sequence[tuple[str, str]]) -> LoadedCase: ...
def parse_case(text: str, name: str | PathLike, overrides: Sequence[tuple[str, str]]) -> LoadedCase: ...
def new_case_text(test: str, rubber_content_percent: float, normal_stress: str) -> str: ...
def default_folder(name: str) -> Path: ...
def case_facts(loaded: LoadedCase) -> str: ...
def forecast(loaded: LoadedCase, trial: float, threads: int) -> str: ...

class Progress:
    """Where a running test stands; SI units."""

    @property
    def stage(self) -> str: ...
    @property
    def fraction(self) -> float: ...
    @property
    def displacement(self) -> float: ...
    @property
    def shear_stress(self) -> float: ...
    @property
    def normal_stress(self) -> float: ...
    @property
    def void_ratio(self) -> float: ...
    @property
    def inertial_number(self) -> float: ...
    @property
    def unbalanced_ratio(self) -> float: ...
    @property
    def time_step(self) -> float: ...
    @property
    def steps(self) -> int: ...
    @property
    def steps_per_second(self) -> float: ...
    @property
    def wall_time(self) -> float: ...
    @property
    def seconds_left(self) -> float | None: ...

def run_case(
    loaded: LoadedCase,
    folder: str | PathLike,
    *,
    threads: int,
    progress: Callable[[Progress], bool | None] | None,
    interval: float,
    message: Callable[[str, bool], None] | None,
    stop: Any,
    store: str | PathLike,
    specimen: str | PathLike,
    source: str | PathLike,
    is_specimen_only: bool,
    checkpoint_interval: float,
    most_hours: float,
) -> tuple[str, bool]: ...

class Study:
    @property
    def name(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def tests(self) -> list[str]: ...
    def case(self, name: str) -> LoadedCase: ...

def load_study(path: str | PathLike) -> Study: ...
def plan_campaign(study: Study, workers: int, threads: int, memory: float) -> str: ...
def run_campaign(
    study: Study,
    folder: str | PathLike,
    program: str | PathLike,
    workers: int,
    threads: int,
    memory: float,
    retries_physics: bool,
    progress: Callable[[str], bool | None] | None,
    stop: Any,
) -> None: ...
def campaign_status(root: str | PathLike) -> str: ...
def collect_campaign(root: str | PathLike, output: str | PathLike) -> list[str]: ...
def check_seal(path: str | PathLike) -> None: ...
def analyse_state(
    path: str | PathLike,
    displacement: float | None,
    bins: int,
    level: str,
    mean: str,
    strong: str,
    projection: str,
    resamples: int,
    seed: int,
) -> tuple[str, str]: ...
def analyse_network(
    normals: ArrayLike,
    normal_force: ArrayLike,
    shear_force: ArrayLike,
    branches: ArrayLike,
    kinds: ArrayLike,
    sliding: ArrayLike,
    bodies: ArrayLike,
    n_bodies: int,
    volume: float,
    bins: int,
    level: str,
    mean: str,
    strong: str,
    projection: str,
    resamples: int,
    seed: int,
) -> tuple[str, str]: ...
def fabric_tensor(normals: ArrayLike) -> NDArray: ...
def stress_tensor(force: ArrayLike, branch: ArrayLike, volume: float) -> NDArray: ...
def sieve(path: str | PathLike, openings: Sequence[float]) -> tuple[str, str]: ...
def verification_cases() -> list[tuple[str, str, bool]]: ...
def verify_case(name: str, threads: int) -> str: ...

class Material:
    """Density (kg/m3), friction coefficient, shear modulus (Pa), Poisson's ratio."""

    density: float
    friction: float
    shear_modulus: float
    poisson_ratio: float
    def __init__(self, density: float, friction: float, shear_modulus: float, poisson_ratio: float) -> None: ...

class Bond:
    """The bonds inside of rubber grains; docs/theory/parallel-bond.md."""

    modulus: float
    stiffness_ratio: float
    radius_multiplier: float
    moment_scale: float
    damping_ratio: float
    tensile_strength: float
    shear_strength: float
    breakable: bool

class ContactLaw:
    """Options of every contact outside of a grain; docs/theory/contact.md."""

    hz_mode: int
    normal_damping_ratio: float
    shear_damping_ratio: float
    dashpot_mode: int

class OwnTest:
    gravel: Material
    rubber: Material
    wall_material: Material
    gravity: tuple[float, float, float]
    local_damping: float
    time_step_safety: float
    rubber_ball_radius: float
    threads: int
    def __init__(self) -> None: ...
    def __getattr__(self, name: str) -> Any: ...
    @staticmethod
    def load(path: str | PathLike) -> OwnTest: ...
