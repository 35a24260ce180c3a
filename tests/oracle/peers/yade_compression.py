# SPDX-License-Identifier: BSD-3-Clause
"""Compression of a box of spheres in YADE: yade -n -x -j1 yade_compression.py PARAMETERS SCENE.json START.csv RESULT.csv"""
import csv
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade_walls import mindlin_materials

section, scene_file, start, result = sys.argv[1:5]
with open(section) as file:
    parameters = json.load(file)["compression"]
with open(scene_file) as file:
    scene = json.load(file)

grain, plane = mindlin_materials(parameters)
O.materials.append(grain)
O.materials.append(plane)
with open(start) as file:
    for row in csv.DictReader(file):
        O.bodies.append(sphere([float(row[c]) for c in "xyz"], float(row["radius"]), material=grain))
length, width, height = scene["size"]
lid = O.bodies.append(wall(height, axis=2, sense=-1, material=plane))
walls = [lid] + [O.bodies.append(wall(at, axis=axis, sense=sense, material=plane)) for at, axis, sense in
                 ((0.0, 2, 1), (0.0, 0, 1), (length, 0, -1), (0.0, 1, 1), (width, 1, -1))]
O.bodies[lid].state.vel = (0, 0, -parameters["lid_speed"])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=2e-4),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(betan=scene["damping_ratio"], betas=0.0)],
        [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, 0)),
]
O.dt = parameters["time_step"]
axes = (2, 2, 0, 0, 1, 1)
with open(result, "w") as file:
    file.write("displacement,lid,floor,x_low,x_high,y_low,y_high\n")
    for k in range(parameters["samples"]):
        # The forces of step n + 1 belong to the positions after n steps.
        O.run(scene["every"] + (1 if k == 0 else 0), True)
        forces = [abs(O.forces.f(body)[axis]) for body, axis in zip(walls, axes)]
        displacement = parameters["lid_speed"] * O.dt * scene["every"] * (k + 1)
        file.write(",".join(repr(float(value)) for value in [displacement] + forces) + "\n")
