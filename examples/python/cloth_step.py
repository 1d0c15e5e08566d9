#!/usr/bin/env python3
"""Drops a cloth on a ball: a solver in numpy that takes its contacts from Abut.

    cloth_step.py [--steps N] [--cells N]

In every step the solver moves the vertices, asks for the impacts of that motion, takes out of the motion what
leads into the ball, and asks again until there are none. So the cloth never goes through the ball.
"""

import argparse

import numpy as np

import abut


def grid(cells, size):
    x = np.linspace(-size / 2, size / 2, cells + 1)
    vertices = np.stack([*np.meshgrid(x, x, indexing="ij"), np.zeros((cells + 1, cells + 1))], axis=-1).reshape(-1, 3)
    i = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    faces = np.concatenate([np.stack([i, i + cells + 1, i + 1], 1), np.stack([i + 1, i + cells + 1, i + cells + 2], 1)])
    return vertices, faces


def ball(rings=16, radius=0.5):
    theta, phi = np.linspace(0, np.pi, rings + 1)[1:-1], np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    ring = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi)),
                     np.outer(np.cos(theta), np.ones_like(phi))], axis=-1).reshape(-1, 3)
    n, top, bottom = 2 * rings, len(ring), len(ring) + 1
    faces = []
    for j in range(n):
        k = (j + 1) % n
        faces += [[top, j, k], [bottom, (rings - 2) * n + k, (rings - 2) * n + j]]
        for i in range(rings - 2):
            a, b, c, d = i * n + j, i * n + k, (i + 1) * n + j, (i + 1) * n + k
            faces += [[a, c, d], [a, d, b]]
    return radius * np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]]), np.array(faces)


def keep_lengths(positions, edges, lengths, rounds=15):
    """Moves the ends of each edge towards its length; each vertex by the mean of what its edges ask for."""
    count = np.bincount(edges.ravel(), minlength=len(positions))[:, None]
    for _ in range(rounds):
        along = positions[edges[:, 1]] - positions[edges[:, 0]]
        now = np.linalg.norm(along, axis=1)
        pull = along * (0.5 * (now - lengths) / now)[:, None]
        move = np.zeros_like(positions)
        np.add.at(move, edges[:, 0], pull)
        np.add.at(move, edges[:, 1], -pull)
        positions = positions + 1.5 * move / count
    return positions


def cloth_vertices(impact, cloth):
    """The vertices of the cloth that take part in an impact, their weights, and the normal from ball to cloth."""
    if impact.kind == abut.ElementaryKind.vertex_face:
        if impact.face_first:  # the cloth's face, the ball's vertex
            return cloth.faces[impact.b], np.asarray(impact.barycentric), -impact.normal
        return np.array([impact.a]), np.array([1.0]), impact.normal
    t = impact.barycentric[0]
    return cloth.edges[impact.a], np.array([1 - t, t]), impact.normal


def contact_free_step(cloth, obstacle, start, end):
    """Changes the ends until nothing meets; returns them and the number of impacts that were seen."""
    seen = 0
    for attempt in range(60):
        cloth.set_motion(start, end)
        impacts = abut.impacts(cloth, obstacle)
        if len(impacts) == 0:
            return end, seen
        seen += len(impacts)
        end = end.copy()
        for impact in impacts.list:
            vertices, weights, normal = cloth_vertices(impact, cloth)
            if attempt > 20:  # what still meets stays where it is
                end[vertices] = start[vertices]
                continue
            into = min(0.0, weights @ (end[vertices] - start[vertices]) @ normal)
            end[vertices] -= 1.05 * into / (weights @ weights) * weights[:, None] * normal
    return start, seen


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--steps", type=int, default=60)
    arguments.add_argument("--cells", type=int, default=16)
    options = arguments.parse_args()
    vertices, faces = grid(options.cells, 2.0)
    positions = vertices + (0.013, 0.007, 0.6)
    cloth, obstacle = abut.Deformable(positions, faces), abut.Deformable(*ball())
    edges = cloth.edges.astype(int)
    lengths = np.linalg.norm(positions[edges[:, 1]] - positions[edges[:, 0]], axis=1)
    velocity, dt, total = np.zeros_like(positions), 0.02, 0
    for step in range(options.steps):
        velocity = 0.98 * (velocity + dt * np.array((0, 0, -9.81)))
        end = keep_lengths(positions + dt * velocity, edges, lengths)
        end, impacts = contact_free_step(cloth, obstacle, positions, end)
        velocity, positions, total = (end - positions) / dt, end, total + impacts
        if step % 10 == 9:
            print(f"step {step + 1:3}: {impacts:5} impacts, lowest point {positions[:, 2].min():6.3f}")
    side = abut.contains(abut.Model(*ball()), None, positions).side
    print(f"{total} impacts; {np.count_nonzero(side == abut.Side.inside)} vertices in the ball")


if __name__ == "__main__":
    main()
