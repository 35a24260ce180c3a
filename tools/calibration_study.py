#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Synthetic calibrations: hidden parameters, data made with them, and how often and how well the desk finds them again.

    tools/calibration_study.py FOLDER --repeats 10              one rubber grain: bond modulus, shear modulus, stiffness ratio
    tools/calibration_study.py FOLDER --gravel --repeats 3      gravel in a small box: shear modulus, friction; data of other seeds

Hidden values are drawn anew for each repeat; data get noise of the size that the desk states. Prints a table and writes study.csv to
the folder; a study that was stopped goes on by the same command. PYTHONPATH must name the package.
"""
import argparse
from pathlib import Path

import numpy
import pandas

import dem4grm

CASES = Path(__file__).resolve().parent.parent / "cases"
GRAIN = {"compression.records": 30, "compression.strain": 0.25}
GRAVEL = {"specimen.rubber_content": 0.0, "box.length": "30 mm", "box.width": "30 mm", "box.height": "30 mm", "shear.velocity": "50 mm/s",
          "shear.displacement": "3 mm"}
GRAIN_RANGES = {"rubber.bond.modulus": (8.0, 60.0, "MPa", "log"), "rubber.shear_modulus": (4.0, 40.0, "MPa", "log"),
                "rubber.bond.stiffness_ratio": (1.5, 9.0, "", "log"), "walls.shear_modulus": (40.0, 160.0, "GPa", "linear")}
GRAVEL_RANGES = {"gravel.shear_modulus": (20.0, 400.0, "MPa", "log"), "gravel.friction": (0.3, 1.2, "", "linear")}
WITHOUT_INFLUENCE = {"walls.shear_modulus"}


def text_of(value: float, unit: str):
    return f"{value!r} {unit}" if unit else value


def toml(value) -> str:
    return f'"{value}"' if isinstance(value, str) else repr(value)


def hidden_values(ranges: dict, random: numpy.random.Generator) -> dict[str, float]:
    """In the middle half of each range, on its scale."""
    found = {}
    for key, (low, high, _, scale) in ranges.items():
        u = random.uniform(0.25, 0.75)
        found[key] = float(low * (high / low)**u if scale == "log" else low + u * (high - low))
    return found


def desk_text(ranges: dict, case: str, settings: dict, options, seed: int, data: str) -> str:
    lines = [f"seed = {seed}", "[[stage]]", f'case = "{CASES / case}"', f"trials = {options.trials}", f"seeds = {options.seeds}",
             f"specimens = {options.specimens}", "[stage.set]"]
    lines += [f'"{key}" = {toml(value)}' for key, value in settings.items()]
    for key, (low, high, unit, scale) in ranges.items():
        lines += ["[[stage.parameter]]", f'key = "{key}"', f"low = {toml(text_of(low, unit))}", f"high = {toml(text_of(high, unit))}",
                  f'scale = "{scale}"']
    return "\n".join(lines) + "\n" + data


def series(quantity: str, x: str, rows, error: str, points: int, extra: str = "") -> str:
    return (f'[[stage.data]]\nquantity = "{quantity}"\nx = "{x}"\nerror = {error}\npoints = {points}\n{extra}'
            f"values = {[[float(a), float(b)] for a, b in rows]}\n")


def grain_data(folder: Path, truth: dict, random: numpy.random.Generator) -> str:
    case = dem4grm.Case.read(CASES / "grain_compression.toml", {**GRAIN, **truth})
    curve = dem4grm.run(case, folder / "hidden", threads=1, message=None).compression
    load = curve.load_N * (1 + 0.01 * random.standard_normal(len(curve))) + 0.02 * random.standard_normal(len(curve))
    poisson = curve.poisson_ratio + 0.005 * random.standard_normal(len(curve))
    return (series("load_N", "strain", zip(curve.strain, load), '["1 %", 0.02]', 40)
            + series("poisson_ratio", "strain", zip(curve.strain, poisson), "0.005", 40))


def gravel_data(folder: Path, truth: dict, random: numpy.random.Generator, specimens: int) -> str:
    """Under each stress the mean curve of the specimens."""
    data = ""
    for stress in ("50 kPa", "100 kPa"):
        seeds = [int(s) for s in random.integers(10_000, 20_000, specimens)]  # none that the desk takes
        curves = []
        for seed in seeds:
            case = dem4grm.Case.read(CASES / "quick.toml", {**GRAVEL, **truth, "shear.normal_stress": stress, "seed": seed})
            curves.append(dem4grm.run(case, folder / f"hidden-{stress.split()[0]}-{seed}", threads=1, message=None).shear)
        x = curves[0].displacement_mm.iloc[10::20]
        where = f'set = {{ "shear.normal_stress" = "{stress}" }}\n'
        for quantity, error in (("shear_stress_kPa", 2.0), ("vertical_displacement_mm", 0.01)):
            mean = numpy.mean([numpy.interp(x, curve.displacement_mm, curve[quantity]) for curve in curves], axis=0)
            data += series(quantity, "displacement_mm", zip(x, mean + error * random.standard_normal(len(x))), str(error), 30, where)
    return data


def repeat_once(place: Path, repeat: int, options) -> list[dict]:
    random = numpy.random.default_rng(1000 + repeat)
    ranges = GRAVEL_RANGES if options.gravel else GRAIN_RANGES
    truth = hidden_values(ranges, random)
    place.mkdir(parents=True, exist_ok=True)
    desk_file = place / "desk.toml"
    if not desk_file.exists():
        texts = {key: text_of(value, ranges[key][2]) for key, value in truth.items()}
        data = gravel_data(place, texts, random, options.specimens) if options.gravel else grain_data(place, texts, random)
        case, settings = ("quick.toml", GRAVEL) if options.gravel else ("grain_compression.toml", GRAIN)
        desk_file.write_text(desk_text(ranges, case, settings, options, repeat + 1, data), encoding="utf-8")
    found = dem4grm.calibrate(desk_file, place / "run", workers=options.workers)
    runs, table = found.result["stages"][0]["runs"], found.parameters
    return [{"repeat": repeat, "key": key, "hidden": value, "best": table.best[key], "error_per_cent": 100 * (table.best[key] / value - 1),
             "low": table.interval_low[key], "high": table.interval_high[key], "runs": runs, "identified": table.identified[key],
             "covered": table.interval_low[key] < value < table.interval_high[key]} for key, value in truth.items()]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--gravel", action="store_true", help="gravel in a small box in place of a rubber grain: hours")
    parser.add_argument("--repeats", type=int, default=10)
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seeds", type=int, default=1, help="tests behind each trial")
    parser.add_argument("--specimens", type=int, default=1, help="of gravel, that the data are the mean of")
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    rows = []
    for repeat in range(options.repeats):
        rows += repeat_once(options.folder / f"repeat-{repeat}", repeat, options)
        table = pandas.DataFrame(rows)
        table.to_csv(options.folder / "study.csv", index=False)
        print(table[table["repeat"] == repeat].round(3).to_string(index=False, header=repeat == 0), flush=True)
    influential = table[~table.key.isin(WITHOUT_INFLUENCE)]
    summary = influential.groupby("key", sort=False).agg(
        covered=("covered", "sum"), identified=("identified", "sum"), median_error=("error_per_cent", lambda e: e.abs().median()),
        largest_error=("error_per_cent", lambda e: e.abs().max()))
    named = table[table.key.isin(WITHOUT_INFLUENCE)]
    print(summary.round(2).to_string())
    print(f"{options.repeats} repeats, {table.runs.iloc[0]} runs each; without influence and named so: {(~named.identified).sum()} of {len(named)}")


if __name__ == "__main__":
    main()
