"""A collision manager with the method names of trimesh.collision.CollisionManager."""

import functools

import numpy as np

from . import _abut

_EXTERNAL = "__external"  # the name of a mesh that is no object, as trimesh has it


class ContactData:
    """A contact of two objects.

    names: the two names. point: where, shape (3,). normal: unit vector from the first name's object to the
    second's, or zero. depth: length of the overlap; 0 if they only touch. index(name): a triangle of that object.
    """

    def __init__(self, names, triangles, point, normal, depth):
        self.names = set(names)
        self.point = point
        self.normal = normal
        self.depth = depth
        self._triangles = dict(zip(names, map(int, triangles)))

    def index(self, name):
        """The number of a triangle of that object that takes part."""
        return self._triangles[name]

    def __repr__(self):
        return f"ContactData({sorted(map(str, self.names))}, depth={self.depth:g})"


class DistanceData:
    """The distance of two objects and a pair of closest points.

    names: the two names. distance: length; negative if they overlap: minus the depth. point(name): the closest
    point on that object, or if they overlap its deepest one. index(name): the triangle that it lies on.
    """

    def __init__(self, names, distance, points, triangles):
        self.names = set(names)
        self.distance = float(distance)
        self._points = dict(zip(names, map(np.array, points)))
        self._triangles = dict(zip(names, map(int, triangles)))

    def point(self, name):
        """The closest or deepest point on that object, shape (3,), world frame."""
        return self._points[name]

    def index(self, name):
        """The number of the triangle that the point lies on."""
        return self._triangles[name]

    def __repr__(self):
        return f"DistanceData({sorted(map(str, self.names))}, distance={self.distance:g})"


class _Shape:
    """A mesh, and what is known of it. What takes time is found out when it is first needed."""

    def __init__(self, mesh):
        self.model = mesh if isinstance(mesh, _abut.Model) else _abut.Model(mesh)

    @functools.cached_property
    def report(self):
        """The MeshReport."""
        return _abut.inspect(self.model.mesh)

    @functools.cached_property
    def convex(self):
        """Whether the mesh is convex, and thus a solid: a closed surface that turns inward at no edge."""
        return bool(self.report.closed) and self.report.components == 1 and \
            _turns_inward_nowhere(self.model.vertices, self.model.faces)

    @functools.cached_property
    def hull(self):
        """The solid of a convex mesh."""
        return _abut.Convex(self.model.vertices)


class _Object:
    """A shape at a pose, with a box around it in the world."""

    def __init__(self, shape, transform):
        self.shape = shape
        self.pose = _matrix(transform)
        world = _abut.World()  # checks that the pose is rigid
        box = world.box(world.add(shape.model, self.pose))
        self.lower, self.upper = box.lower, box.upper


class CollisionManager:
    """Named meshes at poses: which of them meet, and how far apart are they?

    As with trimesh, a convex mesh is a solid, so that it meets what lies inside it; any other mesh is its
    surface. The distance of objects that overlap is minus the depth: of two convex meshes, the length of the
    shortest translation that parts them, as in trimesh; else the depth that abut.penetration tells, which is
    a lower bound of that length. It is 0 if they only touch. An open mesh contains nothing: it meets what
    crosses or touches its triangles, and two open meshes that cross have the distance 0, since no side of them
    is inside. Poses are rigid, of shape (4, 4).
    """

    def __init__(self):
        self._world = _abut.World()
        self._objects = {}
        self._bodies = {}  # name -> body
        self._names = {}  # body -> name

    # ------------------------------------------------------------------ objects ---

    def add_object(self, name, mesh, transform=None):
        """Adds a mesh under a name, and replaces the object of that name, if there is one.

        mesh: anything that abut.Model takes. transform: the mesh's pose, shape (4, 4). Returns the abut.Model.
        """
        added = _Object(_Shape(mesh), transform)
        body = self._world.add(added.shape.model, added.pose)
        if name in self._bodies:
            self.remove_object(name)
        self._objects[name] = added
        self._bodies[name] = body
        self._names[body] = name
        return added.shape.model

    def remove_object(self, name):
        """Removes an object. ValueError if there is none of that name."""
        self._require(name)
        body = self._bodies.pop(name)
        self._world.remove(body)
        del self._names[body], self._objects[name]

    def set_transform(self, name, transform):
        """Moves an object. ValueError if there is none of that name."""
        self._require(name)
        moved = _Object(self._objects[name].shape, transform)
        self._world.move(self._bodies[name], moved.pose)
        self._objects[name] = moved

    def _require(self, name):
        if name not in self._bodies:
            raise ValueError(f"there is no object {name!r} in the collision manager")

    # --------------------------------------------------------------- collisions ---

    def in_collision_internal(self, return_names=False, return_data=False):
        """Whether any two objects meet; with the set of pairs of names and a list of ContactData if asked for."""
        bodies = {(int(a), int(b)) for a, b in self._world.collide()}
        for pair in map(tuple, self._world.pairs().tolist()):  # whose boxes overlap
            if pair not in bodies and _one_inside(*(self._objects[self._names[body]] for body in pair)):
                bodies.add(pair)
        pairs = [(self._names[a], self._names[b]) for a, b in sorted(bodies)]
        names = {tuple(sorted(pair, key=str)) for pair in pairs}
        data = []
        for a, b in pairs if return_data else []:
            data += _contacts((a, b), self._objects[a], self._objects[b])
        return _answer(bool(pairs), (return_names, names), (return_data, data))

    def in_collision_single(self, mesh, transform=None, return_names=False, return_data=False):
        """Whether a mesh meets any object; with the set of their names and ContactData if asked for."""
        others = {_EXTERNAL: _Object(_Shape(mesh), transform)}
        return self._collide_with(others, return_names, return_data, lambda ours, _: ours)

    def in_collision_other(self, other_manager, return_names=False, return_data=False):
        """Whether any object meets one of another manager; with the set of (ours, theirs) if asked for."""
        others = other_manager._objects
        return self._collide_with(others, return_names, return_data, lambda ours, theirs: (ours, theirs))

    def _collide_with(self, others, return_names, return_data, label):
        ours, lower, upper = _boxes(self._objects)
        names, data = set(), []
        for other, its in others.items():
            for i in np.flatnonzero((lower <= its.upper).all(1) & (upper >= its.lower).all(1)):
                mine = self._objects[ours[i]]
                if not _meet(mine, its):
                    continue
                if not (return_names or return_data):
                    return True
                names.add(label(ours[i], other))
                if return_data:
                    data += _contacts((ours[i], other), mine, its)
        return _answer(bool(names), (return_names, names), (return_data, data))

    # ---------------------------------------------------------------- distances ---

    def min_distance_internal(self, name=None, return_names=False, return_data=False):
        """The least distance of two objects, or of the named one and another; inf if there are not two; with the
        pair of names and DistanceData if asked for. The names are sorted, but a name that is given comes first."""
        first = self._objects
        if name is not None:
            self._require(name)
            first = {name: self._objects[name]}
        distance, names, data = _nearest(first, self._objects, name)
        if names is not None and name is None:
            names = tuple(sorted(names, key=str))
        return _answer(distance, (return_names, names), (return_data, data))

    def min_distance_single(self, mesh, transform=None, return_name=False, return_data=False):
        """The least distance of a mesh and an object; with the object's name and DistanceData if asked for."""
        distance, names, data = _nearest({_EXTERNAL: _Object(_Shape(mesh), transform)}, self._objects)
        return _answer(distance, (return_name, names and names[1]), (return_data, data))

    def min_distance_other(self, other_manager, return_names=False, return_data=False):
        """The least distance of an object and one of another manager; with (ours, theirs) if asked for."""
        distance, names, data = _nearest(self._objects, other_manager._objects)
        return _answer(distance, (return_names, names), (return_data, data))


def _matrix(transform):
    pose = np.eye(4) if transform is None else np.asarray(transform, dtype=np.float64)
    if pose.shape != (4, 4):
        raise ValueError(f"transform: an array of shape (4, 4) is wanted, not {pose.shape}")
    return pose.copy()


def _boxes(objects):
    """Names, and the corners of their boxes, arrays of shape (n, 3)."""
    lower = np.array([o.lower for o in objects.values()]).reshape(-1, 3)
    upper = np.array([o.upper for o in objects.values()]).reshape(-1, 3)
    return list(objects), lower, upper


def _nearest(first, second, name=None):
    """The distance, names and data of the nearest of pairs of one of the first and one of the second; the same
    objects count once, and not with themselves."""
    others, lower, upper = _boxes(second)
    same = first is second
    best, names, data = float("inf"), None, None
    for i, (a, one) in enumerate(first.items()):
        # The distance of the boxes is a lower bound, less what rounding may add to it. If the boxes overlap, so
        # may the objects, by any depth.
        apart = np.maximum(0, np.maximum(lower - one.upper, one.lower - upper))
        bound = np.linalg.norm(apart, axis=1) * (1 - 1e-12)
        if same:
            bound[:i + 1] = np.inf
        for k in np.argsort(bound, kind="stable"):
            if bound[k] > 0 and bound[k] >= best or bound[k] == np.inf:
                break
            b = others[k]
            if name is not None and b == name:
                continue
            other = second[b]
            if bound[k] == 0 and _meet(one, other):
                distance, *where = _overlap(one, other)
            else:
                gap = _abut.distance(one.shape.model, one.pose, other.shape.model, other.pose,
                                     upper_bound=max(best, 0))
                distance, where = gap.distance, ((gap.point_a, gap.point_b), (gap.triangle_a, gap.triangle_b))
            if distance < best:
                best, names, data = distance, (a, b), DistanceData((a, b), distance, *where)
    return best, names, data


def _turns_inward_nowhere(vertices, faces):
    """Whether no vertex of a neighbouring triangle lies before a triangle of a closed mesh, to rounding."""
    points, merged = np.unique(vertices, axis=0, return_inverse=True)
    faces = merged.reshape(-1)[faces]
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    corners = points[faces] - points.mean(axis=0)
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = crosses / np.maximum(np.linalg.norm(crosses, axis=1, keepdims=True), np.finfo(float).tiny)
    # The edge from a to b of one triangle is that from b to a of its neighbour.
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    opposite = np.concatenate([faces[:, 2], faces[:, 0], faces[:, 1]])
    keys, back = edges[:, 0] * len(points) + edges[:, 1], edges[:, 1] * len(points) + edges[:, 0]
    order = np.argsort(keys)
    at = np.minimum(np.searchsorted(keys[order], back), len(keys) - 1)
    neighbour = order[at]
    if len(np.unique(keys)) != len(keys) or np.any(keys[neighbour] != back):
        return False  # partly inside out
    sphere_like = len(np.unique(faces)) - len(edges) // 2 + len(faces) == 2
    heights = np.einsum("ij,ij->i", np.tile(normals, (3, 1)),
                        points[opposite[neighbour]] - points[edges[:, 0]])
    outward = np.sign(np.einsum("ij,ij->", corners[:, 0], crosses))  # of six times the volume
    return bool(sphere_like and np.max(outward * heights) <= 1e-6 * np.linalg.norm(np.ptp(points, axis=0)))


def _meet(a, b):
    """Whether two objects share a point: convex ones as solids, others by their surfaces."""
    return bool(_abut.collide(a.shape.model, a.pose, b.shape.model, b.pose)) or _one_inside(a, b)


def _one_inside(a, b):
    """Whether a part of one object lies in the other, a convex one. The surfaces do not meet."""
    return _part_inside(a, b) or _part_inside(b, a)


def _part_inside(inner, outer):
    if np.any(inner.lower > outer.upper) or np.any(inner.upper < outer.lower) or not outer.shape.convex:
        return False
    # A part that does not meet the surface lies inside as a whole, or outside.
    faces = inner.shape.model.faces
    of_parts = faces[:1, 0] if inner.shape.report.components == 1 else faces[:, 0]
    vertices = inner.shape.model.vertices[of_parts]
    points = vertices @ inner.pose[:3, :3].T + inner.pose[:3, 3]
    return bool(np.any(_abut.contains(outer.shape.model, outer.pose, points).side != _abut.Side.outside))


def _overlap(a, b):
    """Minus the depth of two objects that meet, the two deepest points, and a triangle at each."""
    if a.shape.convex and b.shape.convex:
        found = _abut.penetration(a.shape.hull, a.pose, b.shape.hull, b.pose)
        depth = found.depth
    else:
        found = _abut.penetration(a.shape.model, a.pose, b.shape.model, b.pose, separation=False)
        depth = found.depth if a.shape.report.closed or b.shape.report.closed else 0
    points = found.point_a, found.point_b
    return 0.0 - depth, points, [_triangle_at(o, p) for o, p in zip((a, b), points)]


def _triangle_at(placed, point):
    """The number of the triangle of an object that is nearest to a point."""
    return int(_abut.nearest(placed.shape.model, placed.pose, point).triangle)


def _contacts(names, a, b):
    """A ContactData for each place where two objects meet. Two convex ones meet at one place."""
    if a.shape.convex and b.shape.convex:
        depth = _abut.penetration(a.shape.hull, a.pose, b.shape.hull, b.pose)
        places = [(depth.point_a, depth.point_b, depth.direction, depth.depth, None)]
    else:
        depth = _abut.penetration(a.shape.model, a.pose, b.shape.model, b.pose, separation=False)
        places = [(region.point_a, region.point_b, region.normal, region.depth,
                   region.pairs[0] if len(region.pairs) else None) for region in depth.regions]
        # Solids that coincide have no depth in any place; that of the whole parts them.
        if depth.depth > 0 and not any(place[3] > 0 for place in places):
            places = [(p, q, depth.direction, depth.depth, pair) for p, q, _, _, pair in places]
    return [ContactData(names, pair if pair is not None else (_triangle_at(a, p), _triangle_at(b, q)),
                        (np.array(p) + np.array(q)) / 2, normal, depth)
            for p, q, normal, depth, pair in places]


def _answer(value, *extras):
    """The value alone, or a tuple with what was asked for."""
    asked = [extra for wanted, extra in extras if wanted]
    return (value, *asked) if asked else value
