# SPDX-License-Identifier: BSD-3-Clause
"""A campaign of two tiny tests: plan, stop, go on, collect."""
import dem4grm
import pytest
import tiny

STUDY = """name = "pair"
base = "tiny.toml"
[axes]
shear.normal_stress = ["50 kPa", "100 kPa"]
"""


def test_plan_stop_go_on_and_collect(tmp_path):
    tiny.case().write(tmp_path / "tiny.toml")
    (tmp_path / "pair.toml").write_text(STUDY)
    study = dem4grm.Study(tmp_path / "pair.toml")
    assert study.name == "pair" and len(study.tests) == 2
    assert study.case(study.tests[1]).si("shear.normal_stress") == 100e3
    plan = study.plan(workers=2, threads=1)
    assert len(plan["tests"]) == 2
    with pytest.raises(dem4grm.Stopped):
        study.run(tmp_path / "runs", workers=2, threads=1, progress=lambda status: False)
    told = []
    campaign = study.run(tmp_path / "runs", workers=2, threads=1, progress=told.append)
    assert list(campaign) == study.tests and (campaign.status()["state"] == "done").all()
    assert told and campaign[study.tests[1]].case.si("shear.normal_stress") == 100e3
    tables = campaign.collect()
    assert len(tables.tests) == 2 and set(tables.curves["test"]) == set(study.tests)
    assert "peak" in set(tables.envelopes["quantity"])  # no residual stress within a millimetre


def test_a_bad_study_says_all(tmp_path):
    tiny.case().write(tmp_path / "tiny.toml")
    (tmp_path / "pair.toml").write_text(STUDY.replace("100 kPa", "100"))
    with pytest.raises(dem4grm.CaseError, match="has no unit"):
        dem4grm.Study(tmp_path / "pair.toml")
    with pytest.raises(dem4grm.MissingFileError):
        dem4grm.Campaign(tmp_path)
