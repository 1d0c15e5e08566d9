"""Proximity queries on triangle models: do they meet, where, how far apart are they, and when do they meet?

    import abut
    cube = abut.Model(vertices, faces)          # or abut.Model("part.stl"), abut.Model(trimesh_mesh)
    gap = abut.distance(cube, None, cube, [[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    gap.distance, gap.point_a, gap.point_b

Poses are matrices of shape (4, 4), (translation, quaternion) with the quaternion as (w, x, y, z), or
Pose; None leaves a model where it is. An array of poses of shape (n, 4, 4) asks n questions in parallel.
Lengths are in the units of the vertices; model files are in metres. docs/python.md has more.
"""

import os as _os

from . import _abut
from ._abut import *  # noqa: F403

__version__ = _abut.__version__
__all__ = sorted(name for name in vars(_abut) if not name.startswith("_"))
for _name in __all__:  # pickles and messages then name the package
    if isinstance(getattr(_abut, _name), type):
        getattr(_abut, _name).__module__ = "abut"

# The wheel brings along the programs that read some model files.
_helpers = _os.path.join(_os.path.dirname(_os.path.abspath(__file__)), "libexec")
if _os.path.isdir(_helpers):
    _abut.set_helper_folder(_helpers)
