#!/usr/bin/env python3
"""What a call from Python costs over one from C++: a query of one triangle each, and a batch of 10,000 poses.

    call_cost.py [PROGRAM]      PROGRAM: abut-bench-calls, which measures the same from C++

Times are processor time, medians of 25 rounds, so that other work on the machine counts little. Each way is
measured three times in turn; of the three the median is printed.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import abut

CALLS, POSES, ROUNDS = 20000, 10000, 25


def median_ns(work):
    times = []
    for _ in range(ROUNDS):
        start = time.process_time_ns()
        work()
        times.append(time.process_time_ns() - start)
    return statistics.median(times)


def repeat(call):
    def loop():
        for _ in range(CALLS):
            call()
    return loop


def main():
    vertices, faces = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
    rng = np.random.default_rng(1)
    poses = np.tile(np.eye(4), (POSES, 1, 1))
    poses[:, :3, 3] = rng.uniform(1, 3, (POSES, 3))
    model, away = abut.Model(vertices, faces), poses[0].copy()
    ours, theirs = [], []
    with tempfile.TemporaryDirectory() as folder:
        mesh, list_of_poses = pathlib.Path(folder, "triangle.off"), pathlib.Path(folder, "poses.txt")
        mesh.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        np.savetxt(list_of_poses, poses.reshape(-1, 16), fmt="%.17g")
        for _ in range(3):
            nothing = median_ns(repeat(lambda: None))
            ours.append({"distance": (median_ns(repeat(lambda: abut.distance(model, None, model, away))) - nothing) / CALLS,
                         "collide": (median_ns(repeat(lambda: abut.collide(model, None, model, away))) - nothing) / CALLS,
                         "batch": median_ns(lambda: abut.distance(model, None, model, poses))})
            if len(sys.argv) > 1:
                theirs.append(json.loads(subprocess.run([sys.argv[1], mesh, list_of_poses], check=True, capture_output=True).stdout))
    ours, theirs = ({name: statistics.median(each[name] for each in runs) for name in runs[0]} if runs else {} for runs in (ours, theirs))
    print(f"{'':24} {'Python':>10} {'C++':>10} {'over':>10}")
    for name, unit in (("distance", 1), ("collide", 1), ("batch", 1000)):
        label = f"{name}, {'µs of 10,000' if unit > 1 else 'ns a call'}"
        row = f"{label:24} {ours[name] / unit:10.0f}"
        if theirs:
            row += f" {theirs[name] / unit:10.0f} {(ours[name] - theirs[name]) / unit:10.0f}"
        print(row)


if __name__ == "__main__":
    main()
