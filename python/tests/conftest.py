# SPDX-License-Identifier: BSD-3-Clause
"""One run of the tiny case for all tests that only look at a finished folder."""
import pytest
import tiny


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    return tiny.run(tiny.case(), tmp_path_factory.mktemp("finished") / "run")
