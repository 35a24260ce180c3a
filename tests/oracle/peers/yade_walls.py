# SPDX-License-Identifier: BSD-3-Clause
"""Materials for Hertz-Mindlin contacts in YADE whose walls are as stiff as the spheres.

YADE gives a wall the radius of the sphere that touches it, so that the contact of a sphere with a wall has the
effective radius R/2 instead of R:
    k_no = (4/3) E* sqrt(R/2),  k_so = 8 G* sqrt(R/2)
A stiffer wall makes up for it: both constants are those of a plane of the material of the spheres when E* and G* are
sqrt(2) times as large, that is for a wall of the same Poisson's ratio and E_wall = E / (sqrt(2) - 1).
"""
import math

from yade import FrictMat


def mindlin_materials(parameters):
    """Materials of the spheres and of the walls for a section of parameters.json."""
    common = {"poisson": parameters["poisson"], "frictionAngle": math.atan(parameters["friction"]),
              "density": parameters["density"]}
    grain = FrictMat(young=parameters["young"], label="grain", **common)
    plane = FrictMat(young=parameters["young"] / (math.sqrt(2.0) - 1.0), label="plane", **common)
    return grain, plane
