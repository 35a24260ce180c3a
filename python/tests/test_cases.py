# SPDX-License-Identifier: BSD-3-Clause
"""Cases: the checks and messages of the command line, and what a change may not do."""
import dem4grm
import pytest
import tiny


def test_values_have_units_and_si_values():
    case = tiny.case()
    assert case.name == "tiny" and case.test == "direct_shear"
    assert case["shear.normal_stress"] == "100 kPa" and case.si("shear.normal_stress") == 100e3
    assert case["specimen.rubber_content"] == 0.2
    assert case["specimen.relative_density"] is None  # a key that is not set
    assert "shear.normal_stress" in case and "shear" not in case
    assert "published: 0.72" in case.describe("gravel.friction")
    with pytest.raises(KeyError, match="did you mean shear.normal_stress"):
        case["shear.normal_stres"]


def test_a_refused_change_says_what_the_command_line_says_and_changes_nothing(tmp_path):
    case = tiny.case()
    case.write(tmp_path / "tiny.toml")
    for key, value in [("shear.normal_stress", "60"), ("gravel.friction", -0.1), ("box.lenght", "1 mm"), ("seed", "many")]:
        before = case.text
        with pytest.raises(dem4grm.CaseError) as caught:
            case[key] = value
        assert case.text == before and case.changes == {}
        said = tiny.command("check", "tiny.toml", "--set", f"{key}={value}", folder=tmp_path, expect=65)
        assert str(caught.value) in said
        assert caught.value.exit_code == 65 and len(caught.value.problems) == 1


def test_all_problems_come_at_once():
    with pytest.raises(dem4grm.CaseError) as caught:
        dem4grm.Case(tiny.TEXT + "[gravel]\nfriction = -1.0\ndensity = 3\n", "bad.toml")
    assert len(caught.value.problems) == 2
    assert caught.value.problems[0].startswith("bad.toml:26:12: error: gravel.friction = -1 is outside [0, 5]")


def test_several_keys_change_together_or_not_at_all():
    case = tiny.case()
    with pytest.raises(dem4grm.CaseError, match="must be 0.01 below"):  # one without the other makes no sense
        case["specimen.largest_friction"] = 0.0
    case.update({"seed": 7, "specimen.rubber_content": 0.4})
    assert case["seed"] == 7 and case.changes == {"seed": "7", "specimen.rubber_content": "0.4"}
    del case["seed"]
    assert case["seed"] == 3 and case["specimen.rubber_content"] == 0.4
    case["specimen.gravel_grading"] = [["3.6 mm", 0.0], ["4.2 mm", 1.0]]
    assert case["specimen.gravel_grading"][1] == ["4.2 mm", 1.0]


def test_density_and_friction_of_preparation_take_each_others_place():
    case = tiny.case()
    assert case["specimen.relative_density"] is None and case["specimen.preparation_friction"] is not None
    case["specimen.relative_density"] = 0.4
    assert (case["specimen.relative_density"], case["specimen.preparation_friction"]) == (0.4, None)
    case["specimen.preparation_friction"] = 0.2
    assert (case["specimen.relative_density"], case["specimen.preparation_friction"]) == (None, 0.2)
    with pytest.raises(dem4grm.CaseError, match="exclude each other"):
        case.update({"specimen.preparation_friction": 0.2, "specimen.relative_density": 0.4})


def test_a_written_case_reads_as_the_same(tmp_path):
    case = tiny.case(gravel__friction=0.65)
    assert dem4grm.Case.read(case.write(tmp_path / "mine.toml")) == case == case.copy()
    with pytest.raises(dem4grm.MissingFileError) as caught:
        dem4grm.Case.read(tmp_path / "none.toml")
    assert caught.value.exit_code == 66 and isinstance(caught.value, FileNotFoundError)


def test_new_cases_and_what_follows_from_them():
    case = dem4grm.Case.new(vrc=40, stress="30 kPa")
    assert case.si("shear.normal_stress") == 30e3 and case.si("specimen.rubber_content") == 0.4
    with pytest.raises(dem4grm.CaseError, match="outside"):
        dem4grm.Case.new(vrc=140)
    facts = tiny.case().facts()
    assert (facts["clumps"], facts["rubber_grains"]) == (137, 23)
    assert tiny.case().forecast(0.05, threads=1)["forecast_steps"] > 0
