"""A collision manager with the method names of trimesh.collision.CollisionManager."""

import numpy as np

from . import _abut

_EXTERNAL = "__external"  # the name of a mesh that is no object, as trimesh has it


class ContactData:
    """A contact of two objects.

    names: the two names. point: where, shape (3,). normal: unit vector from the first name's object to the
    second's, or zero. depth: length of the overlap. index(name): a triangle of that object.
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

    names: the two names. distance: length. point(name): the closest point on that object, shape (3,).
    index(name): the triangle that it lies on.
    """

    def __init__(self, names, gap):
        self.names = set(names)
        self.distance = float(gap.distance)
        self._points = dict(zip(names, (np.array(gap.point_a), np.array(gap.point_b))))
        self._triangles = dict(zip(names, (int(gap.triangle_a), int(gap.triangle_b))))

    def point(self, name):
        """The closest point on that object, shape (3,), world frame."""
        return self._points[name]

    def index(self, name):
        """The number of the triangle that the point lies on."""
        return self._triangles[name]

    def __repr__(self):
        return f"DistanceData({sorted(map(str, self.names))}, distance={self.distance:g})"


class _Object:
    """A model at a pose, with a box around it in the world."""

    def __init__(self, mesh, transform):
        self.model = mesh if isinstance(mesh, _abut.Model) else _abut.Model(mesh)
        self.pose = _matrix(transform)
        world = _abut.World()  # checks that the pose is rigid
        box = world.box(world.add(self.model, self.pose))
        self.lower, self.upper = box.lower, box.upper


class CollisionManager:
    """Named meshes at poses: which of them meet, and how far apart are they?

    Collisions are of surfaces, as with trimesh and FCL: a mesh wholly inside another one does not collide with
    it. Poses are rigid, of shape (4, 4). Objects that meet have distance 0.
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
        added = _Object(mesh, transform)
        body = self._world.add(added.model, added.pose)
        if name in self._bodies:
            self.remove_object(name)
        self._objects[name] = added
        self._bodies[name] = body
        self._names[body] = name
        return added.model

    def remove_object(self, name):
        """Removes an object. ValueError if there is none of that name."""
        self._require(name)
        body = self._bodies.pop(name)
        self._world.remove(body)
        del self._names[body], self._objects[name]

    def set_transform(self, name, transform):
        """Moves an object. ValueError if there is none of that name."""
        self._require(name)
        moved = _Object(self._objects[name].model, transform)
        self._world.move(self._bodies[name], moved.pose)
        self._objects[name] = moved

    def _require(self, name):
        if name not in self._bodies:
            raise ValueError(f"there is no object {name!r} in the collision manager")

    # --------------------------------------------------------------- collisions ---

    def in_collision_internal(self, return_names=False, return_data=False):
        """Whether any two objects meet; with the set of pairs of names and a list of ContactData if asked for."""
        pairs = [(self._names[int(a)], self._names[int(b)]) for a, b in self._world.collide()]
        names = {tuple(sorted(pair, key=str)) for pair in pairs}
        data = []
        for a, b in pairs if return_data else []:
            data += _contacts((a, b), self._objects[a], self._objects[b])
        return _answer(bool(pairs), (return_names, names), (return_data, data))

    def in_collision_single(self, mesh, transform=None, return_names=False, return_data=False):
        """Whether a mesh meets any object; with the set of their names and ContactData if asked for."""
        others = {_EXTERNAL: _Object(mesh, transform)}
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
                if not _abut.collide(mine.model, mine.pose, its.model, its.pose):
                    continue
                if not (return_names or return_data):
                    return True
                names.add(label(ours[i], other))
                if return_data:
                    data += _contacts((ours[i], other), mine, its)
        return _answer(bool(names), (return_names, names), (return_data, data))

    # ---------------------------------------------------------------- distances ---

    def min_distance_internal(self, name=None, return_names=False, return_data=False):
        """The least distance of two objects, or of the named one and another; inf if there are not two."""
        first = self._objects
        if name is not None:
            self._require(name)
            first = {name: self._objects[name]}
        return _nearest(first, self._objects, return_names, return_data, name)

    def min_distance_single(self, mesh, transform=None, return_name=False, return_data=False):
        """The least distance of a mesh and an object; with the object's name and DistanceData if asked for."""
        distance, names, data = _nearest({_EXTERNAL: _Object(mesh, transform)}, self._objects, True, True)
        return _answer(distance, (return_name, names and names[1]), (return_data, data))

    def min_distance_other(self, other_manager, return_names=False, return_data=False):
        """The least distance of an object and one of another manager; with (ours, theirs) if asked for."""
        return _nearest(self._objects, other_manager._objects, return_names, return_data)


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


def _nearest(first, second, return_names, return_data, name=None):
    """The nearest of pairs of one of the first and one of the second; the same objects count once, and not
    with themselves."""
    others, lower, upper = _boxes(second)
    same = first is second
    best, names, data = float("inf"), None, None
    for i, (a, one) in enumerate(first.items()):
        # The distance of the boxes is a lower bound, less what rounding may add to it.
        apart = np.maximum(0, np.maximum(lower - one.upper, one.lower - upper))
        bound = np.linalg.norm(apart, axis=1) * (1 - 1e-12)
        if same:
            bound[:i + 1] = np.inf
        for k in np.argsort(bound, kind="stable"):
            if best == 0 or bound[k] >= best:
                break
            b = others[k]
            if name is not None and b == name:
                continue
            other = second[b]
            gap = _abut.distance(one.model, one.pose, other.model, other.pose, upper_bound=best)
            if gap.distance < best:
                best, names, data = gap.distance, (a, b), DistanceData((a, b), gap)
    return _answer(best, (return_names, names), (return_data, data))


def _contacts(names, a, b):
    """A ContactData for each place where two models meet."""
    depth = _abut.penetration(a.model, a.pose, b.model, b.pose, separation=False)
    return [ContactData(names, region.pairs[0], (region.point_a + region.point_b) / 2, region.normal, region.depth)
            for region in depth.regions if len(region.pairs)]


def _answer(value, *extras):
    """The value alone, or a tuple with what was asked for."""
    asked = [extra for wanted, extra in extras if wanted]
    return (value, *asked) if asked else value
