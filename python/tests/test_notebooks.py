# SPDX-License-Identifier: BSD-3-Clause
"""The example notebooks: committed without outputs, and executed cell by cell in a kernel of Jupyter, where their claims must hold.

Each notebook asserts in its last cell what its text says. Here, numbers that it shows are worked out once more from the files that it
wrote, and every axis of its pictures must name a quantity with its unit.
"""
import json
from pathlib import Path

import nbclient
import nbformat
import numpy
import pandas
import pytest
from ipykernel.kernelspec import write_kernel_spec

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))
MOST_CODE_LINES = 85

# Before the first cell: what is on the axes of each picture is noted when it is shown.
NOTE_AXES = """
import matplotlib.pyplot as _plt
_axes, _show = [], _plt.show
def _note(*words, **more):
    for _number in _plt.get_fignums():
        for _one in _plt.figure(_number).axes:
            _axes.append({"kind": _one.name, "label": _one.get_label(), "x": _one.get_xlabel(), "y": _one.get_ylabel(),
                          "title": _one.get_title(), "curves": _one.get_legend_handles_labels()[1]})
    return _show(*words, **more)
_plt.show = _note
"""


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_is_committed_without_outputs(path):
    text = path.read_text(encoding="utf-8")
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    for cell in code:
        assert cell.outputs == [] and cell.execution_count is None, f"{path.name}: clear the outputs before a commit (docs/how-to/notebooks.md)"
        assert set(cell.metadata) <= {"tags"}, "no times or window states of whoever ran it last"
    assert text == nbformat.writes(notebook) + "\n", "saved as Jupyter saves it, so that differences are those of the content"
    assert set(notebook.metadata) == {"kernelspec", "language_info"} and set(notebook.metadata.language_info) == {"name"}
    assert code[0].source.startswith("# SPDX-License-Identifier: BSD-3-Clause\n") and notebook.cells[0].cell_type == "markdown"
    assert sum(bool(line.strip()) for cell in code for line in cell.source.splitlines()) <= MOST_CODE_LINES


def execute(name, folder, monkeypatch, values, files=None):
    """Runs a notebook in a folder that looks like its place in the source, with files of the reader's own; returns the folder of its runs,
    the values of some expressions at its end, and the number of its pictures."""
    place = folder / "examples/notebooks"
    place.mkdir(parents=True)
    (folder / "cases").symlink_to(ROOT / "cases")
    for file, text in (files or {}).items():
        (place / file).write_text(text, encoding="utf-8")
    write_kernel_spec(folder / "jupyter/kernels/python3")  # of this interpreter, whatever kernels its user has
    for variable in ("JUPYTER_DATA_DIR", "JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR"):
        monkeypatch.setenv(variable, str(folder / "jupyter"))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    notebook = nbformat.read(ROOT / "examples/notebooks" / f"{name}.ipynb", as_version=4)
    ask = ", ".join(f"{key!r}: {expression}" for key, expression in {"axes": "_axes", **values}.items())
    notebook.cells.insert(0, nbformat.v4.new_code_cell(NOTE_AXES))
    notebook.cells.append(nbformat.v4.new_code_cell(f"import json\nprint(json.dumps({{{ask}}}, default=float))"))
    nbclient.NotebookClient(notebook, timeout=240, kernel_name="python3", resources={"metadata": {"path": str(place)}}).execute()
    answer = json.loads("".join(output.text for output in notebook.cells[-1].outputs if output.get("name") == "stdout"))
    pictures = [output.data["image/png"] for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs
                if "image/png" in output.get("data", {})]
    errors = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs if output.output_type == "error"]
    assert not errors and {path.name for path in place.iterdir()} <= {"runs", *(files or {})}, "it writes into runs alone"
    check_axes(answer["axes"])
    return place / "runs", answer, len(pictures)


def check_axes(axes):
    assert axes
    for one in axes:
        if one["kind"] == "polar":
            assert " (N)" in one["title"], "the title names quantity and unit"
        else:
            names = [one["y"]] if one["label"] == "<colorbar>" else [one["x"], one["y"]]
            assert all(name.endswith(")") and " (" in name for name in names), (names, "quantity (unit)")


def test_every_notebook_has_a_test():
    assert {path.stem for path in NOTEBOOKS} == {name.removeprefix("test_notebook_") for name in globals() if name.startswith("test_notebook_")}


def test_notebook_first_test(tmp_path, monkeypatch):
    runs, told, pictures = execute("first_test", tmp_path, monkeypatch, {
        "peak": "facts['peak_shear_stress_kPa']", "a_n": "found.sets.a_n['all']", "theta_n": "found.sets.theta_n_deg['all']",
        "again": "dem4grm.run(case, FOLDER).was_complete"})
    shear, micro = (pandas.read_csv(runs / "first_test" / f"{name}.csv") for name in ("shear", "micro"))
    assert pictures == 3 and told["again"] is True
    assert shear.displacement_mm.iloc[-1] == pytest.approx(3, abs=0.01)
    assert told["peak"] == pytest.approx(shear.shear_stress_kPa.max(), rel=0.05) and 50 < told["peak"] < 250
    assert told["a_n"] == pytest.approx(micro.a_n_all.iloc[-1], rel=1e-9)
    assert told["theta_n"] == pytest.approx(micro.theta_n_all_deg.iloc[-1], rel=1e-9)
    assert "<html" in (runs / "first_test/report.html").read_text(encoding="utf-8")


def test_notebook_figures_of_a_campaign(tmp_path, monkeypatch):
    runs, told, pictures = execute("figures_of_a_campaign", tmp_path, monkeypatch, {
        "contents": "contents", "angle": "envelopes.friction_angle_deg.tolist()", "cohesion": "envelopes.cohesion_kPa.tolist()",
        "strain": "strain.values.tolist()"})
    assert pictures == 4 and told["contents"] == [0, 0.25, 1]
    folders = {path.name: path for path in (runs / "figures/tests").iterdir()}
    assert len(folders) == 9
    for k, content in enumerate(told["contents"]):
        summaries = [json.loads((path / "summary.json").read_text(encoding="utf-8")) for name, path in sorted(folders.items())
                     if f"vrc{100 * content:03.0f}" in name]
        sigma, tau = ([summary[f"{key}_kPa"] for summary in summaries] for key in ("normal_stress_mean", "peak_shear_stress"))
        slope, start = numpy.polyfit(sigma, tau, 1)
        assert told["angle"][k] == pytest.approx(numpy.degrees(numpy.arctan(slope)), rel=1e-6)
        assert told["cohesion"][k] == pytest.approx(start, abs=1e-6 * max(tau))
    for row, content in zip(told["strain"], told["contents"][1:]):
        ends = [pandas.read_csv(path / "micro.csv").bond_strain.iloc[-1] for name, path in sorted(folders.items())
                if f"vrc{100 * content:03.0f}" in name]
        assert row == pytest.approx(ends, rel=1e-9)


def test_notebook_rubber_grain(tmp_path, monkeypatch):
    runs, told, pictures = execute("rubber_grain", tmp_path, monkeypatch, {
        "best": "table.best.to_dict()", "identified": "table.identified.astype(int).to_dict()", "fitted": "fit['fitted']", "runs": "len(trials)"})
    assert pictures == 1 and told["runs"] >= 20
    # Nothing of the truth but the data file may reach the desk.
    assert "17" not in (runs / "rubber_grain/desk.toml").read_text(encoding="utf-8").replace(str(ROOT), "")
    assert told["identified"] == {"rubber.bond.modulus": 1, "rubber.shear_modulus": 1, "walls.shear_modulus": 0}
    assert told["best"]["rubber.bond.modulus"] == pytest.approx(17, rel=0.05) and told["best"]["rubber.shear_modulus"] == pytest.approx(14, rel=0.05)
    without_noise = pandas.read_csv(runs / "rubber_grain/hidden/grain.csv")
    assert numpy.abs(numpy.array(told["fitted"]) - without_noise.poisson_ratio).max() < 0.01


def test_notebook_oedometer(tmp_path, monkeypatch):
    """With a file of a laboratory, whose curve must be drawn; its numbers are made up."""
    laboratory = "source,rubber_content_percent,vertical_stress_kPa,vertical_strain_percent\nmade up,25,50,1.5\nmade up,25,200,5\n"
    _, told, pictures = execute("oedometer", tmp_path, monkeypatch, {
        "contents": "list(tests)", "modulus": "modulus.values.tolist()", "strain": "[table.strain.tolist() for table in tests.values()]",
        "void_ratio": "[table.void_ratio[0] for table in tests.values()]", "layers": "[bounds(vrc, 100e3)[0] for vrc in tests]"},
        {"laboratory.csv": laboratory})
    assert pictures == 2 and told["contents"][0] == 0 and told["contents"][-1] == 1
    assert told["axes"][0]["curves"][-1] == "made up, 25 %" and len(told["axes"][0]["curves"]) == 5
    for column, strains in zip(zip(*told["modulus"]), told["strain"]):
        assert strains[0] == 0 and numpy.all(numpy.diff(strains) > 0)
        assert column == pytest.approx([(load - 10e3) / strain for load, strain in zip((25e3, 50e3, 100e3, 200e3, 400e3), strains[1:])], rel=1e-9)
    # A layer of gravel below one of rubber, with the solid volumes of the mixture: at 100 kPa their settlements add.
    for content, layers in zip(told["contents"], told["layers"]):
        heights = [(1 - content) * (1 + told["void_ratio"][0]), content * (1 + told["void_ratio"][-1])]
        settlement = heights[0] * told["strain"][0][3] + heights[1] * told["strain"][-1][3]
        assert layers == pytest.approx(90e3 * sum(heights) / settlement, rel=1e-9)
