# SPDX-License-Identifier: BSD-3-Clause
"""Bonded cantilevers in YADE: yade -n -x -j1 yade_cantilever.py PARAMETERS FOLDER; every scene of the folder.

The bond is YADE's cohesive contact with moments (CohFrictMat), which is linear in all four directions:
    k_n = E_y r,  k_s = nu_y k_n,  k_r = alpha_kr r^2 k_s,  k_tw = alpha_ktw r^2 k_s      for equal spheres of radius r
A parallel bond of modulus E, stiffness ratio kappa, radius r and length 2 r has
    k_n = E pi r^2 / (2 r),  k_s = k_n / kappa,  k_r = E (pi r^4 / 4) / (2 r),  k_tw = (E / kappa) (pi r^4 / 2) / (2 r)
"""
import csv
import glob
import json
import math
import sys

section, folder = sys.argv[1:3]
with open(section) as file:
    parameters = json.load(file)["cantilever"]
radius = parameters["radius"]


def run(name):
    O.reset()
    with open(name + ".start.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    O.materials.append(CohFrictMat(
        young=0.5 * math.pi * parameters["modulus"], poisson=1.0 / parameters["stiffness_ratio"],
        alphaKr=0.25 * parameters["stiffness_ratio"], alphaKtw=0.5,
        density=parameters["density"], frictionAngle=0.0, normalCohesion=1e30, shearCohesion=1e30, isCohesive=True,
        momentRotationLaw=True, etaRoll=-1.0, etaTwist=-1.0))
    for row in rows:
        O.bodies.append(sphere((row["x"], row["y"], row["z"]), radius))
        if row["held"]:
            O.bodies[-1].state.blockedDOFs = "xyzXYZ"
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.01, label="box")], verletDist=0.0),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.01, label="touch")],
            [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True, setCohesionOnNewContacts=True)],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=False, always_use_moment_law=True)]),
        PyRunner(command="load()", iterPeriod=1, initRun=True),
        NewtonIntegrator(damping=0.0, gravity=(0, 0, 0)),
    ]
    mass = O.bodies[0].state.mass
    inertia = O.bodies[0].state.inertia[0]
    rate = parameters["damping_rate"]

    def load():
        # Same damping as on our side: it acts on velocities and spins, so that it vanishes at rest.
        for k, row in enumerate(rows):
            state = O.bodies[k].state
            O.forces.addF(k, Vector3(row["fx"], row["fy"], row["fz"]) - state.vel * (mass * rate))
            O.forces.addT(k, Vector3(row["tx"], row["ty"], row["tz"]) - state.angVel * (inertia * rate))

    __builtins__.load = load
    O.dt = parameters["time_step"]
    O.step()
    found = sorted({(i.phys.kn, i.phys.ks, i.phys.kr, i.phys.ktw) for i in O.interactions if i.isReal})
    print(name.split("/")[-1], "bonds", sum(1 for i in O.interactions if i.isReal), "stiffnesses", found)
    O.run(parameters["steps"], True)
    with open(name + ".yade.csv", "w") as file:
        file.write("ux,uy,uz,ax,ay,az\n")
        for k, row in enumerate(rows):
            state = O.bodies[k].state
            values = list(state.pos - Vector3(row["x"], row["y"], row["z"])) + list(state.rot())
            file.write(",".join(repr(float(value)) for value in values) + "\n")


for path in sorted(glob.glob(folder + "/cantilever-*.start.csv")):
    run(path[:-len(".start.csv")])
