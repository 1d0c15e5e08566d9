#!/usr/bin/env python3
"""Shows a slice of the signed distance field of a torus, or of a closed model file.

    distance_field.py [MODEL] [--points N] [--png PICTURE]

With matplotlib and --png it draws a picture, else it prints text: one character is one point.
"""

import argparse

import numpy as np

import abut


def torus(n=48, m=24, radius=1.0, tube=0.4):
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, n, endpoint=False), np.linspace(0, 2 * np.pi, m, endpoint=False),
                       indexing="ij")
    across = radius + tube * np.cos(v)
    vertices = np.stack([across * np.cos(u), across * np.sin(u), tube * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = i * m + (j + 1) % m, (i + 1) % n * m + (j + 1) % m
    return abut.Model(vertices, np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)]))


def slice_of(model, n):
    """Signed distances in the middle plane of constant y, an array of shape (n, n), and the two axes."""
    lower, upper = model.vertices.min(axis=0), model.vertices.max(axis=0)
    margin = 0.25 * (upper - lower).max()
    x = np.linspace(lower[0] - margin, upper[0] + margin, n)
    z = np.linspace(lower[2] - margin, upper[2] + margin, n)
    points = np.empty((n, n, 3))
    points[..., 0], points[..., 1], points[..., 2] = x[None, :], (lower[1] + upper[1]) / 2, z[:, None]
    return abut.nearest(model, None, points.reshape(-1, 3), signed_distance=True).distance.reshape(n, n), x, z


def draw(field, x, z, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(8, 5))
    filled = axes.contourf(x, z, field, levels=30, cmap="RdBu")
    axes.contour(x, z, field, levels=[0], colors="black")
    axes.set_aspect("equal")
    figure.colorbar(filled, label="signed distance")
    figure.savefig(path)


def print_text(field):
    """'#' inside, then a digit for every tenth of the largest distance."""
    rows, largest = field[::-2], field.max()
    for row in rows:
        print("".join("#" if value < 0 else str(min(9, int(10 * value / largest))) for value in row))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("model", nargs="?", help="a closed model; a torus if there is none")
    arguments.add_argument("--points", type=int, default=70, help="per axis")
    arguments.add_argument("--png", help="the picture to draw")
    options = arguments.parse_args()
    model = abut.Model(options.model) if options.model else torus()
    field, x, z = slice_of(model, options.points)
    try:
        if options.png:
            draw(field, x, z, options.png)
    except ImportError:
        print("matplotlib is not installed: text instead")
        options.png = None
    if not options.png:
        print_text(field)
    print(f"{field.size} points, {np.count_nonzero(field < 0)} inside, from {field.min():.3f} to {field.max():.3f}")


if __name__ == "__main__":
    main()
