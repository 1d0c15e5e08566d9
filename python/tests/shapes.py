"""Meshes as arrays, random poses, and brute force in numpy."""

import numpy as np


def box(size=(1.0, 1.0, 1.0)):
    """A closed box around the origin: 8 vertices, 12 triangles."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return corners * np.asarray(size), faces


def sphere(rings=12, radius=1.0):
    """A closed sphere of latitudes and longitudes."""
    theta = np.linspace(0, np.pi, rings + 1)[1:-1]
    phi = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    ring = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi)),
                     np.outer(np.cos(theta), np.ones_like(phi))], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]]) * radius
    n, top, bottom = 2 * rings, len(ring), len(ring) + 1
    faces = []
    for j in range(n):
        k = (j + 1) % n
        faces.append([top, j, k])
        faces.append([bottom, (rings - 2) * n + k, (rings - 2) * n + j])
        for i in range(rings - 2):
            a, b, c, d = i * n + j, i * n + k, (i + 1) * n + j, (i + 1) * n + k
            faces += [[a, c, d], [a, d, b]]
    return vertices, np.array(faces)


def grid(n=10, size=1.0):
    """An open square of n x n cells in the plane z = 0."""
    x = np.linspace(-size / 2, size / 2, n + 1)
    vertices = np.stack([*np.meshgrid(x, x, indexing="ij"), np.zeros((n + 1, n + 1))], axis=-1).reshape(-1, 3)
    i = np.arange(n * (n + 1)).reshape(n, n + 1)[:, :-1].ravel()
    faces = np.concatenate([np.stack([i, i + n + 1, i + 1], axis=1), np.stack([i + 1, i + n + 1, i + n + 2], axis=1)])
    return vertices, faces


def soup(rng, n, size=0.3):
    """n random triangles within the unit cube, each with vertices of its own."""
    centre = rng.uniform(-1, 1, (n, 1, 3))
    return (centre + rng.uniform(-size, size, (n, 3, 3))).reshape(-1, 3), np.arange(3 * n).reshape(n, 3)


def rotation(q):
    w, x, y, z = np.asarray(q) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def matrix(translation=(0, 0, 0), q=(1, 0, 0, 0)):
    m = np.eye(4)
    m[:3, :3] = rotation(q)
    m[:3, 3] = translation
    return m


def random_poses(rng, n, spread=1.0):
    return np.array([matrix(rng.uniform(-spread, spread, 3), rng.normal(size=4)) for _ in range(n)])


def place(vertices, pose):
    return vertices @ pose[:3, :3].T + pose[:3, 3]


def _segments_distance(p, q, r, s):
    """Distances of segments p-q and r-s, by clamping; arrays of shape (..., 3)."""
    d1, d2, w = q - p, s - r, p - r
    a, e, f = (d1 * d1).sum(-1), (d2 * d2).sum(-1), (d2 * w).sum(-1)
    c, b = (d1 * w).sum(-1), (d1 * d2).sum(-1)
    denominator = a * e - b * b
    with np.errstate(divide="ignore", invalid="ignore"):
        t1 = np.where(denominator > 1e-14 * a * e, np.clip((b * f - c * e) / denominator, 0, 1), 0)
    t2 = np.clip((b * t1 + f) / e, 0, 1)
    t1 = np.clip((b * t2 - c) / a, 0, 1)
    return np.linalg.norm(p + d1 * t1[..., None] - r - d2 * t2[..., None], axis=-1)


def point_triangle_distance(point, a, b, c):
    """Distances of points from triangles, by the inside test and the three edges."""
    n = np.cross(b - a, c - a)
    inside = np.ones(np.broadcast_shapes(point.shape, a.shape)[:-1], bool)
    for u, v in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(v - u, point - u) * n).sum(-1) >= 0
    plane = np.abs(((point - a) * n).sum(-1)) / np.linalg.norm(n, axis=-1)
    best = np.where(inside, plane, np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        t = np.clip(((point - u) * (v - u)).sum(-1) / ((v - u) ** 2).sum(-1), 0, 1)
        best = np.minimum(best, np.linalg.norm(point - u - (v - u) * t[..., None], axis=-1))
    return best


def _edge_crosses(p, q, a, b, c):
    """Whether the segments p-q cross the triangles' insides."""
    n = np.cross(b - a, c - a)
    dp, dq = ((p - a) * n).sum(-1), ((q - a) * n).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = dp / (dp - dq)
    x = p + (q - p) * t[..., None]
    inside = (dp * dq) < 0
    for u, v in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(v - u, x - u) * n).sum(-1) >= 0
    return inside


def brute_force(ta, tb):
    """Matrices of distances and of crossings of triangles ta (n, 3, 3) and tb (m, 3, 3)."""
    a, b = ta[:, None], tb[None]
    crosses = np.zeros((len(ta), len(tb)), bool)
    best = np.full((len(ta), len(tb)), np.inf)
    for i in range(3):
        k = (i + 1) % 3
        crosses |= _edge_crosses(a[..., i, :], a[..., k, :], b[..., 0, :], b[..., 1, :], b[..., 2, :])
        crosses |= _edge_crosses(b[..., i, :], b[..., k, :], a[..., 0, :], a[..., 1, :], a[..., 2, :])
        best = np.minimum(best, point_triangle_distance(a[..., i, :], b[..., 0, :], b[..., 1, :], b[..., 2, :]))
        best = np.minimum(best, point_triangle_distance(b[..., i, :], a[..., 0, :], a[..., 1, :], a[..., 2, :]))
        for j in range(3):
            l = (j + 1) % 3
            best = np.minimum(best, _segments_distance(a[..., i, :], a[..., k, :], b[..., j, :], b[..., l, :]))
    return np.where(crosses, 0, best), crosses


def guard(hits, low=0.1, high=0.9):
    """Fails if hardly any or nearly all of the random cases hit: the test would tell little."""
    share = np.mean(hits)
    assert low <= share <= high, f"{share:.0%} of the cases hit"
