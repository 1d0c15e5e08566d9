"""The collision manager against brute force over all pairs."""

import numpy as np
import pytest

import abut
from abut.manager import CollisionManager
from shapes import box, brute_force, guard, matrix, place, random_poses, soup, sphere


def placed_triangles(mesh, pose):
    vertices, faces = mesh
    return place(vertices, pose)[faces]


class Expected:
    """Distances of all pairs of objects, by brute force."""

    def __init__(self, objects):
        self.names = list(objects)
        self.triangles = {name: placed_triangles(*objects[name]) for name in self.names}

    def distance(self, a, b):
        return brute_force(self.triangles[a], self.triangles[b])[0].min()


def random_objects(rng, count, prefix):
    poses = random_poses(rng, count, 1.2)
    return {f"{prefix}{i}": (soup(rng, 8, 0.5), poses[i]) for i in range(count)}


def manager_of(objects):
    manager = CollisionManager()
    for name, (mesh, pose) in objects.items():
        manager.add_object(name, abut.Mesh(*mesh), pose)
    return manager


def test_internal_against_brute_force(rng):
    hits = []
    for _ in range(5):
        objects = random_objects(rng, 9, "a")
        manager, expected = manager_of(objects), Expected(objects)
        pairs = [(a, b) for i, a in enumerate(expected.names) for b in expected.names[i + 1:]]
        distances = {pair: expected.distance(*pair) for pair in pairs}
        meeting = {pair for pair in pairs if distances[pair] == 0}
        hits += [distances[pair] == 0 for pair in pairs]
        meet, names, data = manager.in_collision_internal(return_names=True, return_data=True)
        assert meet is bool(meeting) is manager.in_collision_internal() and names == meeting
        assert {tuple(sorted(contact.names)) for contact in data} == meeting
        least = min(distances.values())
        assert manager.min_distance_internal() == pytest.approx(least, abs=1e-9)
        for name in ("a3", "a8"):
            least = min(d for pair, d in distances.items() if name in pair)
            distance, nearest = manager.min_distance_internal(name, return_names=True)
            assert distance == pytest.approx(least, abs=1e-9) and nearest[0] == name
            assert distances[tuple(sorted(nearest))] == pytest.approx(least, abs=1e-9)
    guard(hits, 0.05)


def test_other_and_single_against_brute_force(rng):
    hits = []
    for _ in range(5):
        ours, theirs = random_objects(rng, 6, "a"), random_objects(rng, 5, "b")
        manager, other, expected = manager_of(ours), manager_of(theirs), Expected({**ours, **theirs})
        distances = {(a, b): expected.distance(a, b) for a in ours for b in theirs}
        meeting = {pair for pair, distance in distances.items() if distance == 0}
        hits += [distance == 0 for distance in distances.values()]
        assert manager.in_collision_other(other, return_names=True) == (bool(meeting), meeting)
        assert manager.in_collision_other(other) is bool(meeting)
        distance, names, data = manager.min_distance_other(other, return_names=True, return_data=True)
        assert distance == pytest.approx(min(distances.values()), abs=1e-9)
        assert distances[names] == pytest.approx(distance, abs=1e-9)
        assert np.linalg.norm(data.point(names[0]) - data.point(names[1])) == pytest.approx(distance, abs=1e-9)
        mesh, pose = theirs["b2"]
        model = abut.Model(*mesh)
        meeting = {a for a, b in meeting if b == "b2"}
        assert manager.in_collision_single(model, pose, return_names=True) == (bool(meeting), meeting)
        least = min(d for (a, b), d in distances.items() if b == "b2")
        distance, name = manager.min_distance_single(model, pose, return_name=True)
        assert distance == pytest.approx(least, abs=1e-9) and distances[name, "b2"] == pytest.approx(least, abs=1e-9)
    guard(hits, 0.05)


def test_contact_data():
    manager = CollisionManager()
    manager.add_object("floor", abut.Mesh(*box((4, 4, 1))))
    manager.add_object("ball", abut.Mesh(*sphere(12)), matrix((0.1, 0.2, 1.3)))
    meet, names, data = manager.in_collision_internal(return_names=True, return_data=True)
    assert meet and names == {("ball", "floor")} and len(data) == 1
    contact = data[0]
    assert contact.names == {"ball", "floor"} and contact.depth == pytest.approx(0.2, abs=0.02)
    assert abs(contact.normal[2]) > 0.99 and 0.2 < contact.point[2] < 0.6
    assert 0 <= contact.index("floor") < 12 and "ball" in repr(contact)
    assert manager.min_distance_internal() == 0


def test_objects():
    manager = CollisionManager()
    assert not manager.in_collision_internal() and manager.min_distance_internal() == np.inf
    assert manager.min_distance_single(abut.Mesh(*box()), return_name=True) == (np.inf, None)
    manager.add_object("a", abut.Mesh(*box()))
    manager.add_object("b", abut.Mesh(*box()), matrix((3, 0, 0)))
    assert manager.min_distance_internal(return_names=True) == (2.0, ("a", "b"))
    manager.set_transform("b", matrix((0.5, 0, 0)))
    assert manager.in_collision_internal()
    manager.add_object("b", abut.Mesh(*box()), matrix((0, 0, 5)))  # in place of the first b
    assert manager.min_distance_internal() == 4
    distance, data = manager.min_distance_internal(return_data=True)
    assert data.distance == 4 and data.names == {"a", "b"} and data.point("b")[2] == 4.5
    manager.remove_object("b")
    assert manager.min_distance_internal() == np.inf
    for call in (lambda: manager.remove_object("b"), lambda: manager.set_transform("b", np.eye(4)),
                 lambda: manager.min_distance_internal("b"), lambda: manager.add_object("c", abut.Mesh(*box()), np.eye(3)),
                 lambda: manager.add_object("c", abut.Mesh(*box()), np.diag((1, 1, -1, 1)))):
        with pytest.raises(ValueError):
            call()
    with pytest.raises(TypeError):
        manager.add_object("c", 3)
    assert manager.in_collision_single(abut.Mesh(*box()), return_names=True) == (True, {"a"})
