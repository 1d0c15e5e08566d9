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
        return self._points[name]

    def index(self, name):
        return self._triangles[name]

    def __repr__(self):
        return f"DistanceData({sorted(map(str, self.names))}, distance={self.distance:g})"


class CollisionManager:
    """Named meshes at poses: which of them meet, and how far apart are they?

    Collisions are of surfaces, as with trimesh and FCL. Poses are rigid, of shape (4, 4). Distances between
    objects that meet are 0.
    """

    def __init__(self):
        self._world = _abut.World()
        self._models = {}
        self._bodies = {}  # name -> body
        self._names = {}  # body -> name
        self._transforms = {}

    # ------------------------------------------------------------------ objects ---

    def add_object(self, name, mesh, transform=None):
        """Adds a mesh (anything that abut.Model takes) under a name; replaces one of that name."""
        model = mesh if isinstance(mesh, _abut.Model) else _abut.Model(mesh)
        pose = np.eye(4) if transform is None else np.asarray(transform, dtype=np.float64)
        if pose.shape != (4, 4):
            raise ValueError("transform must be (4,4)!")
        body = self._world.add(model, pose)
        if name in self._bodies:
            self.remove_object(name)
        self._models[name] = model
        self._bodies[name] = body
        self._names[body] = name
        self._transforms[name] = pose
        return model

    def remove_object(self, name):
        """Removes an object. ValueError if there is none of that name."""
        self._require(name)
        body = self._bodies.pop(name)
        self._world.remove(body)
        del self._names[body], self._models[name], self._transforms[name]

    def set_transform(self, name, transform):
        """Moves an object. ValueError if there is none of that name."""
        self._require(name)
        pose = np.asarray(transform, dtype=np.float64)
        self._world.move(self._bodies[name], pose)
        self._transforms[name] = pose

    def _require(self, name):
        if name not in self._bodies:
            raise ValueError(f"{name} not in collision manager!")

    # --------------------------------------------------------------- collisions ---

    def in_collision_internal(self, return_names=False, return_data=False):
        """Whether any two objects meet; with the set of name pairs and a list of ContactData if asked for."""
        pairs = [(self._names[int(a)], self._names[int(b)]) for a, b in self._world.collide()]
        names = {tuple(sorted(pair, key=str)) for pair in pairs}
        data = []
        for a, b in pairs if return_data else []:
            data += _contacts((a, b), self._models[a], self._transforms[a], self._models[b], self._transforms[b])
        return _answer(bool(pairs), (return_names, names), (return_data, data))

    def in_collision_single(self, mesh, transform=None, return_names=False, return_data=False):
        """Whether a mesh meets any object; with the set of their names and ContactData if asked for."""
        model = mesh if isinstance(mesh, _abut.Model) else _abut.Model(mesh)
        return self._collide_with([(_EXTERNAL, model, transform)], return_names, return_data, lambda ours, _: ours)

    def in_collision_other(self, other_manager, return_names=False, return_data=False):
        """Whether any object meets one of another manager; with the set of (ours, theirs) if asked for."""
        others = [(name, model, other_manager._transforms[name]) for name, model in other_manager._models.items()]
        return self._collide_with(others, return_names, return_data, lambda ours, theirs: (ours, theirs))

    def _collide_with(self, others, return_names, return_data, label):
        names, data = set(), []
        for theirs, model, pose in others:
            for ours, our_model in self._models.items():
                if not _abut.collide(our_model, self._transforms[ours], model, pose):
                    continue
                names.add(label(ours, theirs))
                if return_data:
                    data += _contacts((ours, theirs), our_model, self._transforms[ours], model, pose)
                if not (return_names or return_data):
                    return True
        return _answer(bool(names), (return_names, names), (return_data, data))

    # ---------------------------------------------------------------- distances ---

    def min_distance_internal(self, name=None, return_names=False, return_data=False):
        """The least distance of two objects, or of one of a name and another; inf if there are none."""
        names = list(self._models)
        if name is None:
            pairs = [(a, b) for i, a in enumerate(names) for b in names[i + 1:]]
        else:
            self._require(name)
            pairs = [(name, b) for b in names if b != name]
        return self._nearest(((a, self._models[a], self._transforms[a], b, self._models[b], self._transforms[b])
                              for a, b in pairs), return_names, return_data)

    def min_distance_single(self, mesh, transform=None, return_name=False, return_data=False):
        """The least distance of a mesh and an object; with the object's name if asked for."""
        model = mesh if isinstance(mesh, _abut.Model) else _abut.Model(mesh)
        answer = self._nearest(((a, self._models[a], self._transforms[a], _EXTERNAL, model, transform)
                                for a in self._models), True, True)
        name = None if answer[1] is None else answer[1][0]
        return _answer(answer[0], (return_name, name), (return_data, answer[2]))

    def min_distance_other(self, other_manager, return_names=False, return_data=False):
        """The least distance of an object and one of another manager; with (ours, theirs) if asked for."""
        theirs = other_manager
        return self._nearest(((a, self._models[a], self._transforms[a], b, theirs._models[b], theirs._transforms[b])
                              for a in self._models for b in theirs._models), return_names, return_data)

    @staticmethod
    def _nearest(pairs, return_names, return_data):
        best, names, data = float("inf"), None, None
        for a, model_a, pose_a, b, model_b, pose_b in pairs:
            gap = _abut.distance(model_a, pose_a, model_b, pose_b, upper_bound=best)
            if gap.distance < best:
                best, names, data = gap.distance, (a, b), DistanceData((a, b), gap)
                if best == 0:
                    break
        return _answer(best, (return_names, names), (return_data, data))


def _contacts(names, model_a, pose_a, model_b, pose_b):
    """A ContactData for each place where two models meet."""
    depth = _abut.penetration(model_a, pose_a, model_b, pose_b, separation=False)
    return [ContactData(names, region.pairs[0] if len(region.pairs) else (0, 0), (region.point_a + region.point_b) / 2,
                        region.normal, region.depth) for region in depth.regions if len(region.pairs)]


def _answer(value, *extras):
    """The value alone, or a tuple with what was asked for."""
    asked = [extra for wanted, extra in extras if wanted]
    return (value, *asked) if asked else value
