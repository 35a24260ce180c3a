# SPDX-License-Identifier: BSD-3-Clause
"""What the tests share: a direct shear test that takes a second, and the program of the same build."""
import subprocess

import dem4grm

# The case of tests/support/command_line.hpp: 137 clumps and 23 rubber grains.
TEXT = """name = "tiny"
seed = 3
[specimen]
rubber_content = 0.2
preparation_friction = 0.3
generation_void_ratio = 0.85
gravel_grading = [["3.6 mm", 0.0], ["4.0 mm", 1.0]]
rubber_grading = [["3.6 mm", 0.0], ["3.8 mm", 1.0]]
[box]
length = "21 mm"
width  = "21 mm"
height = "21 mm"
upper_height = "40 mm"
[equilibrium]
force_ratio = 0.02
plate_speed = "5 mm/s"
stress_tolerance = 0.05
hold_steps = 200
[shear]
normal_stress = "100 kPa"
velocity      = "200 mm/s"
displacement  = "1 mm"
[recording]
frame_interval = "0.5 mm"
"""


def case(**changes):
    return dem4grm.Case(TEXT, "tiny.toml", {key.replace("__", "."): value for key, value in changes.items()})


def run(tiny_case, folder, **options):
    """Without messages: the tiny case is unusual and says so."""
    return dem4grm.run(tiny_case, folder, threads=1, message=None, **options)


def command(*words, folder, expect=0):
    """The command line of the same build; returns what it printed to stderr."""
    answer = subprocess.run([dem4grm.program(), *words], cwd=folder, capture_output=True, text=True, check=False)
    assert answer.returncode == expect, answer.stderr
    return answer.stderr
