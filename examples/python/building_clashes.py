#!/usr/bin/env python3
"""Prints the clashes of a building as a table, and draws the worst one.

    building_clashes.py [FILE…] [--clearance METRES] [--html REPORT] [--png PICTURE]

Without files it makes a small building of its own: slabs, columns, and pipes of which two are in the way.
"""

import argparse

import numpy as np

import abut


def box(lower, upper):
    lower, upper = np.asarray(lower, float), np.asarray(upper, float)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return abut.Mesh(lower + corners * (upper - lower), np.array(faces))


def at(*place):
    pose = np.eye(4)
    pose[:3, 3] = place
    return pose


def structure():
    """Two slabs, on nine columns that share a mesh."""
    meshes = [box((0, 0, 0), (12, 12, 0.3)), box((-0.2, -0.2, 0.3), (0.2, 0.2, 3))]
    parts = [abut.Part("slab ground", 0, name="ground slab", type="Slab"),
             abut.Part("slab first", 0, at(0, 0, 3), name="first slab", type="Slab")]
    parts += [abut.Part(f"column {x}{y}", 1, at(1 + 5 * x, 1 + 5 * y, 0), name=f"column {x}{y}", type="Column")
              for x in range(3) for y in range(3)]
    return abut.Scene(meshes, parts, file="structure", up="z")


def services():
    """Four pipes below the first slab: one goes through a column, one touches the slab, one is close to it."""
    mesh = box((0, 0, 0), (11, 0.1, 0.1))
    places = {"free": (0.5, 2.5, 2.5), "through": (0.5, 6, 2.5), "touching": (0.5, 4, 2.9), "close": (0.5, 8, 2.88)}
    parts = [abut.Part(f"pipe {name}", 0, at(*place), name=f"{name} pipe", type="Pipe") for name, place in places.items()]
    return abut.Scene([mesh], parts, file="services", up="z")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("files", nargs="*")
    arguments.add_argument("--clearance", type=float, default=0.05, help="metres")
    arguments.add_argument("--html", help="also write the report as a page")
    arguments.add_argument("--png", help="also draw the deepest clash")
    options = arguments.parse_args()
    models = options.files or [structure(), services()]
    report = abut.find_clashes(models, clearance=options.clearance)
    for model in report.models:
        print(f"{model.file}: {model.parts} parts, {model.triangles} triangles")
    print(f"{'kind':10} {'distance':>9}  parts")
    for clash in sorted(report.clashes, key=lambda clash: (round(clash.distance, 6), clash.names)):
        print(f"{clash.kind.name:10} {clash.distance:7.4f} m  {clash.names[0]} | {clash.names[1]}")
    print(", ".join(f"{number} {kind}" for kind, number in report.counts.items()))
    if options.html:
        abut.write_clash_html(report, options.html)
    if options.png and report.clashes:
        worst = min(report.clashes, key=lambda clash: clash.distance)
        abut.write_png(abut.picture(models, worst, width=800, height=500), options.png)


if __name__ == "__main__":
    main()
