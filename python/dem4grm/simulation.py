# SPDX-License-Identifier: BSD-3-Clause
"""Tests of one's own: grains, rectangular walls, loaded plates, prescribed motions."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Material
from .errors import UsageError
from .micro import MicroAnalysis

__all__ = ["Grain", "Material", "Simulation", "Wall"]

Vector = Sequence[float]
UPRIGHT = (1.0, 0.0, 0.0, 0.0)


class Grain:
    """A grain that was placed: a clump (balls are clumps of one pebble) or a rubber grain, by its number among those."""

    def __init__(self, own: _core.OwnTest, is_rubber: bool, number: int):
        self._own, self._is_rubber, self.number = own, is_rubber, number

    def _row(self, of_clumps: Callable[[], NDArray], of_rubber: Callable[[], NDArray]) -> NDArray:
        return of_rubber()[self.number].mean(axis=0) if self._is_rubber else of_clumps()[self.number].copy()

    @property
    def position(self) -> NDArray[numpy.float64]:
        """[3] m, centroid."""
        return self._row(self._own.clump_positions, self._own.rubber_positions)

    @property
    def velocity(self) -> NDArray[numpy.float64]:
        """[3] m/s, half a time step before the position."""
        return self._row(self._own.clump_velocities, self._own.rubber_velocities)


class Wall:
    """A rectangle. Grains are on the side of its normal, which is side_u x side_v; from behind it does not hold them."""

    def __init__(self, own: _core.OwnTest, number: int, name: str):
        self._own, self.number, self.name = own, number, name

    @property
    def position(self) -> NDArray[numpy.float64]:
        """[3] m, of the corner from which the sides start."""
        return numpy.array(self._own.wall_corner(self.number))

    @property
    def normal(self) -> NDArray[numpy.float64]:
        """[3] unit vector towards the grains."""
        return numpy.array(self._own.wall_normal(self.number))

    @property
    def force(self) -> NDArray[numpy.float64]:
        """[3] N, of the grains on the wall, at the last step."""
        return numpy.array(self._own.wall_force(self.number))

    @property
    def normal_force(self) -> float:
        """N, of the grains on the wall along its normal, compression positive."""
        return float(-self.force @ self.normal)

    @property
    def stiffness(self) -> float:
        """N/m, sum of the tangent normal stiffnesses of its contacts."""
        return self._own.wall_stiffness(self.number)

    @property
    def n_contacts(self) -> int:
        return self._own.wall_n_contacts(self.number)

    @property
    def velocity(self) -> NDArray[numpy.float64]:
        """[3] m/s; when it is set, plates and motions of the wall end."""
        return numpy.array(self._own.wall_velocity(self.number))

    @velocity.setter
    def velocity(self, value: Vector) -> None:
        self._own.free_wall(self.number)
        self._own.set_wall_velocity(self.number, value)

    @property
    def friction(self) -> float:
        """Friction coefficient; a contact has the smaller one of wall and grain."""
        return self._own.wall_friction(self.number)

    @friction.setter
    def friction(self, value: float) -> None:
        self._own.set_wall_friction(self.number, value)

    def move(self, times: ArrayLike, velocities: ArrayLike) -> None:
        """Prescribes the velocity over time: linear between the rows, constant before the first and behind the last.

        times: [n] s, ascending; velocities: [n, 3] m/s. Raises ValueError for other shapes."""
        self._own.set_motion(self.number, numpy.asarray(times, dtype=float), numpy.asarray(velocities, dtype=float))

    def carry(self, force: float | None = None, *, stress: float | None = None, between: Sequence[Wall] | None = None,
              area: float | None = None, gain: float = 0.5, speed_cap: float = 0.1) -> None:
        """Makes a plate of the wall that moves along its normal to carry a force, by the servo of the shear test.

        force      N, compression positive; or instead
        stress     Pa, over `area` (m2), or over the area between four other walls, two opposite ones after the other, wherever
                   they are: carry(stress=1e5, between=(left, right, front, back))
        gain       share of the error that one step removes in quasi-statics, below 1
        speed_cap  m/s, largest speed; the plate approaches with it when it touches nothing
        Source: the proportional wall servo of PFC (src/dem4grm/walls/servo.hpp).
        """
        if (force is None) == (stress is None):
            raise ValueError("a plate carries either a force or a stress")
        if force is not None:
            self._own.set_plate(self.number, force, 0.0, (-1, -1, -1, -1), gain, speed_cap)
            return
        if (area is None) == (between is None):
            raise ValueError("a stress needs an area, or four walls that it is between")
        if area is not None:
            self._own.set_plate(self.number, stress * area, 0.0, (-1, -1, -1, -1), gain, speed_cap)
            return
        numbers = [wall.number for wall in between]
        if len(numbers) != 4:
            raise ValueError("an area is between four walls: two opposite ones, then the other two")
        self._own.set_plate(self.number, 0.0, stress, numbers, gain, speed_cap)

    def remove(self) -> None:
        """From now on grains do not see the wall."""
        self._own.remove_wall(self.number)

    def __repr__(self) -> str:
        return f"<dem4grm.Wall '{self.name}'>"


class Simulation:
    """A test of one's own on the engine of the shear test: the same contact laws, the same bits on any number of threads.

    First describe it (materials, grains, walls), then step it; grains and walls cannot be added once it has begun. Materials are
    those of the published model until they are set: `gravel` and `rubber` of the grains, `wall_material` of all walls.

        sim = Simulation(gravity=(0, 0, -9.81), local_damping=0.2)
        floor = sim.add_wall("floor", (-1, -1, 0), (2, 0, 0), (0, 2, 0), friction=0.5)
        ball = sim.add_ball((0, 0, 0.1), radius=0.005)
        sim.choose_time_step(stress=1e3)
        sim.run(time=0.2)
        floor.normal_force
    """

    def __init__(self, *, gravity: Vector = (0.0, 0.0, 0.0), local_damping: float = 0.0, threads: int = 1):
        """gravity: [3] m/s2; local_damping: alpha of Cundall's damping; threads: of long runs, any number gives the same bits."""
        self._own = _core.OwnTest()
        self._own.gravity = tuple(gravity)
        self._own.local_damping = local_damping
        self._own.threads = threads
        self._walls: dict[str, Wall] = {}

    # ---- description -------------------------------------------------------------------------------------------------
    def _check_open(self) -> None:
        if self._own.is_built:
            raise UsageError("the simulation has begun: materials, grains and walls are described before the first step")

    def _material(name: str):  # noqa: N805  # makes properties
        def get(self) -> Material:
            return getattr(self._own, name)

        def put(self, material: Material) -> None:
            self._check_open()
            setattr(self._own, name, material)

        return property(get, put, doc=f"Material of the {name.replace('_', ' ')}.")

    gravel = _material("gravel")
    rubber = _material("rubber")
    wall_material = _material("wall_material")
    del _material

    @property
    def bond(self) -> _core.Bond:
        """Bonds inside of the rubber grains; to be set before the first step."""
        return self._own.bond

    @property
    def contact_law(self) -> _core.ContactLaw:
        """Unloading rule and dashpots of all contacts; to be set before the first step."""
        return self._own.contact_law

    @property
    def rubber_ball_radius(self) -> float:
        """m, of the 35 balls of every rubber grain; to be set before the first step."""
        return self._own.rubber_ball_radius

    @rubber_ball_radius.setter
    def rubber_ball_radius(self, radius: float) -> None:
        self._check_open()
        self._own.rubber_ball_radius = radius

    def _start(self, grain: Grain, velocity: Vector, spin: Vector) -> Grain:
        if any(velocity) or any(spin):
            self._own.set_start(grain._is_rubber, grain.number, velocity, spin)
        return grain

    def add_ball(self, position: Vector, radius: float, *, material: str = "gravel", velocity: Vector = (0, 0, 0),
                 spin: Vector = (0, 0, 0)) -> Grain:
        """A sphere. position m, radius m, material "gravel" or "rubber", velocity m/s, spin rad/s."""
        self._check_open()
        return self._start(Grain(self._own, False, self._own.add_ball(position, radius, material)), velocity, spin)

    def add_shape(self, name: str, pebbles: ArrayLike) -> None:
        """A clump shape of one's own. pebbles: [n, 4], x, y, z, radius in any frame and unit; they may overlap, and volume and
        inertia are those of their union (docs/theory/clumps.md). Raises CaseError for pebbles that do not hang together."""
        self._check_open()
        self._own.add_shape(name, numpy.asarray(pebbles, dtype=float))

    def add_clump(self, shape: str, position: Vector, sieve_size: float, *, orientation: Vector = UPRIGHT,
                  material: str = "gravel", velocity: Vector = (0, 0, 0), spin: Vector = (0, 0, 0)) -> Grain:
        """A rigid clump: shape "T1" to "T6" or one of add_shape; position of the centroid, m; sieve_size, m: the smallest square
        opening that it passes; orientation: quaternion (w, x, y, z) from the principal axes of the shape to space."""
        self._check_open()
        return self._start(Grain(self._own, False, self._own.add_clump(shape, position, sieve_size, orientation, material)),
                           velocity, spin)

    def add_rubber_grain(self, position: Vector, *, orientation: Vector = UPRIGHT, velocity: Vector = (0, 0, 0),
                         spin: Vector = (0, 0, 0)) -> Grain:
        """A soft grain of 35 bonded balls of rubber_ball_radius. position of its centre, m; orientation of its cube, (w, x, y, z)."""
        self._check_open()
        return self._start(Grain(self._own, True, self._own.add_rubber_grain(position, orientation)), velocity, spin)

    def add_wall(self, name: str, corner: Vector, side_u: Vector, side_v: Vector, *, friction: float = 0.0) -> Wall:
        """A rectangle from a corner along two sides, m, square to each other; grains are where side_u x side_v points.

        The name is how `sim.walls[name]` finds it. Raises UsageError for a name that is taken, ValueError for no rectangle."""
        self._check_open()
        if name in self._walls:
            raise UsageError(f"there is a wall '{name}' already")
        self._walls[name] = Wall(self._own, self._own.add_wall(name, corner, side_u, side_v, friction), name)
        return self._walls[name]

    def add_box(self, size: Vector, *, corner: Vector = (0, 0, 0), overhang: float = 0.0, friction: float = 0.0) -> dict[str, Wall]:
        """Six walls of a closed box: "-x", "+x", "-y", "+y", "-z", "+z", grains inside. size: [3] m; overhang: m by which each wall
        reaches beyond its edges, for walls that will move against each other."""
        low = numpy.asarray(corner, dtype=float)
        high = low + numpy.asarray(size, dtype=float)
        span, axes = high - low + 2.0 * overhang, numpy.eye(3)
        walls = {}
        for axis in range(3):
            first, second = axes[(axis + 1) % 3] * span[(axis + 1) % 3], axes[(axis + 2) % 3] * span[(axis + 2) % 3]
            for sign, at in (("-", low), ("+", high)):
                start = low - overhang
                start[axis] = at[axis]
                u, v = (first, second) if sign == "-" else (second, first)
                name = sign + "xyz"[axis]
                walls[name] = self.add_wall(name, start, u, v, friction=friction)
        return walls

    @property
    def walls(self) -> dict[str, Wall]:
        return dict(self._walls)

    # ---- stepping ----------------------------------------------------------------------------------------------------
    @property
    def time_step(self) -> float:
        """s; when it is set it stays as it is."""
        return self._own.time_step

    @time_step.setter
    def time_step(self, seconds: float) -> None:
        self._own.fix_time_step(seconds)

    def choose_time_step(self, stress: float) -> float:
        """The safe share of the smallest stability limit that grains under about this stress (Pa) have; from then on the step
        follows the stiffest mode of what there is (docs/decisions/0007-time-step.md). Returns it, s."""
        return self._own.choose_time_step(stress)

    def set_friction(self, *, gravel_gravel: float | None = None, gravel_rubber: float | None = None,
                     rubber_rubber: float | None = None, gravel_wall: float | None = None, rubber_wall: float | None = None) -> None:
        """Friction coefficients in force from now on, in place of those of the materials; None leaves one as it is. That of a wall
        caps what its contacts have."""
        given = (gravel_gravel, gravel_rubber, rubber_rubber, gravel_wall, rubber_wall)
        table = [old if new is None else new for old, new in zip(self._own.friction(), given)]
        self._own.set_friction(table[:3], table[3:])

    def run(self, steps: int | None = None, *, time: float | None = None) -> None:
        """So many steps, or steps for that time (s). The lock of the interpreter is released meanwhile.

        Ctrl-C ends it after a whole step and raises KeyboardInterrupt. Raises PhysicsError when the watchdog finds a value that is
        no number or a runaway overlap, CaseError when no time step was chosen, UsageError while another thread steps it."""
        if (steps is None) == (time is None):
            raise ValueError("run takes either steps or a time")
        if steps is not None:
            self._own.run(int(steps))
            return
        end = self.time + time
        while end - self.time > 0.5 * self.time_step:
            self._own.run(max(1, min(5000, round((end - self.time) / self.time_step))))

    def run_until(self, condition: Callable[[], bool], *, every: int = 100, most_steps: int = 10_000_000) -> bool:
        """Steps until condition() holds, which is asked every so many steps; False when it does not after most_steps."""
        for _ in range(0, most_steps, every):
            self._own.run(every)
            if condition():
                return True
        return False

    def stop_grains(self) -> None:
        """Takes all motion from the grains, not from walls."""
        self._own.stop_grains()

    @property
    def threads(self) -> int:
        return self._own.threads

    @threads.setter
    def threads(self, n: int) -> None:
        if n < 1:
            raise ValueError("at least one thread")
        self._own.threads = n

    # ---- what there is -----------------------------------------------------------------------------------------------
    @property
    def time(self) -> float:
        """s, simulated."""
        return self._own.time

    @property
    def steps(self) -> int:
        return self._own.steps

    @property
    def state_hash(self) -> str:
        """Fingerprint of the complete mechanical state: equal hashes, equal bits."""
        return self._own.state_hash

    @property
    def energy(self) -> dict[str, float]:
        """J: kinetic, contact_strain, bond_strain, gravity (-sum m g.x); and works since the start: boundary_work (put in by walls),
        slip, dashpot, local_damping, breakage (lost)."""
        return self._own.energy()

    @property
    def energy_error(self) -> float:
        """J, what the balance of energy leaves open since the start when the grains began at rest, unloaded, at gravity 0:
        stored + lost - boundary_work."""
        e = self.energy
        return sum(value for name, value in e.items() if name != "boundary_work") - e["boundary_work"]

    @property
    def unbalanced_ratio(self) -> float:
        """Mean net contact force on a body over the mean contact force: small at rest (without gravity)."""
        return self._own.unbalanced_ratio

    @property
    def positions(self) -> NDArray[numpy.float64]:
        """[n_clumps, 3] m, centroids of balls and clumps: a view of the live state that cannot be written."""
        return self._own.clump_positions()

    @property
    def velocities(self) -> NDArray[numpy.float64]:
        """[n_clumps, 3] m/s, half a step before the positions; a view as above."""
        return self._own.clump_velocities()

    @property
    def spins(self) -> NDArray[numpy.float64]:
        """[n_clumps, 3] rad/s; a view as above."""
        return self._own.clump_spins()

    @property
    def masses(self) -> NDArray[numpy.float64]:
        """[n_clumps] kg."""
        return self._own.clump_masses()

    @property
    def volumes(self) -> NDArray[numpy.float64]:
        """[n_clumps] m3, solid."""
        return self._own.clump_volumes()

    @property
    def pebbles(self) -> dict[str, NDArray]:
        """Of all clumps: position [n, 3] m, velocity [n, 3] m/s, radius [n] m (views as above), clump [n]."""
        own = self._own
        return {"position": own.pebble_positions(), "velocity": own.pebble_velocities(), "radius": own.pebble_radii(),
                "clump": own.pebble_clumps()}

    @property
    def rubber_balls(self) -> NDArray[numpy.float64]:
        """[n_rubber_grains, 35, 3] m, a copy: in memory the balls of eight grains lie side by side."""
        return self._own.rubber_positions()

    @property
    def rubber_ball_mass(self) -> float:
        """kg, of each of the 35 balls of a rubber grain."""
        return self._own.rubber_ball_mass()

    @property
    def contacts(self) -> dict[str, NDArray]:
        """Contacts between different bodies that carry force, at the last step: ball_i, ball_j, body_i, body_j, kind (0 g-g, 1 g-r,
        2 r-r), point m, normal from i to j, normal_force N, shear_force N on i, branch m, is_sliding. Bodies: rubber grains first."""
        return self._own.contacts()

    @property
    def wall_contacts(self) -> dict[str, NDArray]:
        """Contacts with walls: ball, body, wall, point m, normal to the wall, normal_force N, shear_force N on the ball."""
        return self._own.wall_contacts()

    def micro(self, *, bins: int = 36, level: str = "contact", mean: str = "orientations", strong: str = "normal",
              projection: str = "all", resamples: int = 0, seed: int = 1) -> MicroAnalysis:
        """The micro-mechanics of the contacts; options as of dem4grm.micro.analyse. Numbers of the plates of a shear box are not
        there."""
        return MicroAnalysis(*self._own.analyse(bins, level, mean, strong, projection, resamples, seed))

    # ---- checkpoints -------------------------------------------------------------------------------------------------
    def save(self, path: str | PathLike) -> None:
        """The whole test with its state into one sealed HDF5 file; it goes on from there with the same bits. Raises IoError."""
        self._own.save(Path(path))

    @classmethod
    def load(cls, path: str | PathLike, *, threads: int = 1) -> Simulation:
        """What `save` wrote. Raises IoError when the file is damaged or holds something else, MissingFileError when it is not there."""
        self = cls.__new__(cls)
        self._own = _core.OwnTest.load(Path(path))
        self._own.threads = threads
        self._walls = {name: Wall(self._own, number, name) for number, name in enumerate(self._own.wall_names)}
        return self

    def __repr__(self) -> str:
        return (f"<dem4grm.Simulation of {self._own.n_clumps} clumps, {self._own.n_rubber_grains} rubber grains, "
                f"{len(self._walls)} walls>")
