# SPDX-License-Identifier: BSD-3-Clause
"""Spheres, clumps or bonded clusters in YADE: yade -n -x -jN yade.py FOLDER SCENE STEPS YOUNG POISSON FRICTION"""
import csv
import math
import sys
import time

folder, scene, steps, young, poisson, friction = sys.argv[1:7]
steps, young, poisson, friction = int(steps), float(young), float(poisson), float(friction)
angle = math.atan(friction)
bonded = scene.startswith("clusters")
if bonded:
    material = CohFrictMat(young=young, poisson=poisson, frictionAngle=angle, density=1610, alphaKr=1.0, alphaKtw=0.5,
                           normalCohesion=1e30, shearCohesion=1e30, isCohesive=True, momentRotationLaw=True,
                           etaRoll=-1.0, etaTwist=-1.0)
else:
    material = FrictMat(young=young, poisson=poisson, frictionAngle=angle, density=2710)
O.materials.append(material)
with open(f"{folder}/{scene}.csv") as file:
    rows = [(int(r["body"]), float(r["radius"]), [float(r[c]) for c in "xyz"]) for r in csv.DictReader(file)]
size = [float(word) for word in open(f"{folder}/{scene}.box").read().split()]
spheres = [sphere(at, radius, material=material) for _, radius, at in rows]
if scene == "clumps":
    bodies = {}
    for (body, _, _), ball in zip(rows, spheres):
        bodies.setdefault(body, []).append(ball)
    for balls in bodies.values():
        O.bodies.appendClumped(balls)
else:
    O.bodies.append(spheres)
for axis in range(0 if bonded else 3):  # bonded material knows no walls; a little less work for YADE
    O.bodies.append(wall(0.0, axis=axis, sense=1, material=material))
    O.bodies.append(wall(size[axis], axis=axis, sense=-1, material=material))
verlet = 2e-4 if not bonded else 3e-5
if bonded:
    # All that touches at the start is bonded, contacts between clusters too: one law handles bonds and contacts.
    loop = InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.001)],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=True)],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True, always_use_moment_law=True)])
else:
    loop = InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                           [Ip2_FrictMat_FrictMat_MindlinPhys(betan=0.0, betas=0.0)],
                           [Law2_ScGeom_MindlinPhys_Mindlin()])
boxes = [Bo1_Sphere_Aabb(aabbEnlargeFactor=1.001), Bo1_Wall_Aabb()]
O.engines = [ForceResetter(), InsertionSortCollider(boxes, verletDist=verlet), loop,
             NewtonIntegrator(damping=0.2 if bonded else 0.0, gravity=(0, 0, 0))]
O.dt = 1e-13
O.step()
O.run(steps // 10 + 2, True)
start = time.perf_counter()
O.run(steps, True)
seconds = time.perf_counter() - start
touching = sum(1 for i in O.interactions if i.isReal)
print("RESULT", len(rows), touching, seconds)
