# SPDX-License-Identifier: BSD-3-Clause
"""Oblique impacts in YADE: yade -n -x -j1 yade_impact.py PARAMETERS SCENE.json START.csv RESULT.csv"""
import csv
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade_walls import mindlin_materials

section, scene_file, start, result = sys.argv[1:5]
with open(section) as file:
    parameters = json.load(file)["impact"]
with open(scene_file) as file:
    scene = json.load(file)

grain, plane = mindlin_materials(parameters)
O.materials.append(grain)
O.materials.append(plane)
with open(start) as file:
    for row in csv.DictReader(file):
        row = {name: float(value) for name, value in row.items()}
        O.bodies.append(sphere((row["x"], row["y"], row["z"]), row["radius"], material=grain))
        O.bodies[-1].state.vel = (row["vx"], row["vy"], row["vz"])
n = len(O.bodies)
if scene["at_wall"]:
    O.bodies.append(wall(0.0, axis=2, sense=1, material=plane))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=1e-4),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(betan=scene["damping_ratio"], betas=0.0)],
        [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, 0)),
]
O.dt = scene["time_step"]
O.run(scene["steps"], True)
with open(result, "w") as file:
    file.write("vx,vy,vz,wx,wy,wz\n")
    for k in range(n):
        state = O.bodies[k].state
        file.write(",".join(repr(float(value)) for value in list(state.vel) + list(state.angVel)) + "\n")
