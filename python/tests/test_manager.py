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
    assert manager.min_distance_internal() == pytest.approx(-contact.depth, abs=1e-12)


def least_overlap(half_a, pose_a, half_b, pose_b):
    """The overlap of two boxes along the best of the 15 axes that can part them; negative: they are apart."""
    axes_a, axes_b = pose_a[:3, :3].T, pose_b[:3, :3].T
    axes = [*axes_a, *axes_b, *(np.cross(a, b) for a in axes_a for b in axes_b)]
    way = pose_b[:3, 3] - pose_a[:3, 3]
    overlaps = []
    for axis in axes:
        length = np.linalg.norm(axis)
        if length > 1e-9:
            n = axis / length
            overlaps.append(np.abs(axes_a @ n) @ half_a + np.abs(axes_b @ n) @ half_b - abs(way @ n))
    return min(overlaps)


def test_distances_of_overlapping_boxes_against_separating_axes(rng):
    hits = []
    for _ in range(60):
        halves = rng.uniform(0.1, 0.8, (3, 3))
        poses = random_poses(rng, 3, 0.6)
        manager, other = CollisionManager(), CollisionManager()
        for i in range(3):
            mesh = abut.Mesh(*box(2 * halves[i]))
            (manager if i < 2 else other).add_object(f"b{i}", mesh, poses[i])
        depth = least_overlap(halves[0], poses[0], halves[1], poses[1])
        hits.append(depth > 0)
        distance, names, data = manager.min_distance_internal(return_names=True, return_data=True)
        meet, contacts = manager.in_collision_internal(return_data=True)
        assert names == ("b0", "b1") and meet is bool(depth > 0) and len(contacts) == int(meet)
        if meet:
            assert distance == pytest.approx(-depth, abs=1e-9) and data.distance == distance
            assert contacts[0].depth == pytest.approx(depth, abs=1e-9)
            # Moving the second box by the depth along the normal leaves the two touching.
            sign = 1 if data.point("b1") @ contacts[0].normal < data.point("b0") @ contacts[0].normal else -1
            moved = poses[1].copy()
            moved[:3, 3] += sign * (depth + 1e-6) * contacts[0].normal
            assert least_overlap(halves[0], poses[0], halves[1], moved) < 0
        else:
            assert distance > 0
        assert np.linalg.norm(data.point("b0") - data.point("b1")) == pytest.approx(abs(distance), abs=1e-9)
        # A mesh and another manager: the deepest pair.
        depths = {f"b{i}": least_overlap(halves[i], poses[i], halves[2], poses[2]) for i in range(2)}
        deepest = max(depths.values())
        if deepest > 0:
            single = manager.min_distance_single(abut.Mesh(*box(2 * halves[2])), poses[2], return_name=True)
            assert single[0] == pytest.approx(-deepest, abs=1e-9) and depths[single[1]] == deepest
            both = manager.min_distance_other(other, return_names=True)
            assert both[0] == pytest.approx(-deepest, abs=1e-9) and both[1] == (single[1], "b2")
    guard(hits, 0.3)


def test_placements_that_people_use():
    """The distances that trimesh tells: flush, coincident, inside, at a corner; in any order."""
    cube = abut.Mesh(*box())
    small = abut.Mesh(*box((0.2, 0.2, 0.2)))
    for mesh, move, expected in (
            (cube, (0, 0, 0), -1), (cube, (0.75, 0, 0), -0.25), (cube, (0.5, 0.5, 0.5), -0.5), (cube, (1, 0, 0), 0),
            (cube, (1, 1, 0), 0), (cube, (1, 1, 1), 0), (cube, (2, 0, 0), 1), (small, (0, 0, 0), -0.6),
            (small, (0.4, 0, 0), -0.2), (small, (0.6, 0, 0), 0), (small, (0.5, 0, 0), -0.1)):
        for far in (0, 1e6):
            pose, base = matrix(np.array(move) + far), matrix((far, far, far))
            for first, second, at_first, at_second in ((cube, mesh, base, pose), (mesh, cube, pose, base)):
                manager = CollisionManager()
                manager.add_object("a", first, at_first)
                assert manager.min_distance_single(second, at_second) == pytest.approx(expected, abs=1e-9)
                assert manager.in_collision_single(second, at_second) is (expected <= 0)
                manager.add_object("b", second, at_second)
                distance, data = manager.min_distance_internal(return_data=True)
                assert distance == data.distance == pytest.approx(expected, abs=1e-9)
                meet, contacts = manager.in_collision_internal(return_data=True)
                assert meet is (expected <= 0) and len(contacts) == int(meet)
                if meet:
                    assert contacts[0].depth == pytest.approx(-expected, abs=1e-9)
                    assert 0 <= contacts[0].index("a") < 12 and 0 <= data.index("b") < 12
                # One answer, whatever was asked before.
                assert manager.min_distance_internal() == distance


def l_beam():
    """A closed mesh that is not convex: the unit square less its quarter, one high."""
    corners = [(0, 0), (1, 0), (1, 0.5), (0.5, 0.5), (0.5, 1), (0, 1)]
    vertices = np.array([(x, y, z) for z in (0.0, 1.0) for x, y in corners])
    faces = [(0, 2, 1), (0, 3, 2), (0, 5, 3), (3, 5, 4)]
    faces += [(a + 6, c + 6, b + 6) for a, b, c in faces]
    for i in range(6):
        k = (i + 1) % 6
        faces += [(i, k, k + 6), (i, k + 6, i + 6)]
    return vertices, np.array(faces)


def test_meshes_that_are_not_convex():
    beam, small = abut.Mesh(*l_beam()), abut.Mesh(*box((0.2, 0.2, 0.2)))
    assert abut.inspect(beam).closed
    manager = CollisionManager()
    manager.add_object("beam", beam)
    apart = np.sqrt(0.5)  # coincident beams part along the notch's diagonal
    assert manager.min_distance_single(beam) == pytest.approx(-apart, rel=1e-6)
    _, contacts = manager.in_collision_single(beam, return_data=True)
    assert max(contact.depth for contact in contacts) == pytest.approx(apart, rel=1e-6)
    # 0.05 deep in a face; in the notch, which is not inside; in the notch's wall.
    assert manager.min_distance_single(small, matrix((0.25, 0.25, 1.05))) == pytest.approx(-0.05, abs=1e-9)
    assert manager.min_distance_single(small, matrix((0.75, 0.75, 0.5))) == pytest.approx(0.15)
    assert manager.min_distance_single(small, matrix((0.75, 0.55, 0.5))) == pytest.approx(-0.05, abs=1e-9)
    # A surface does not meet what lies inside it; a convex mesh is a solid.
    inside = matrix((0.25, 0.25, 0.5))
    assert not manager.in_collision_single(small, inside) and manager.min_distance_single(small, inside) > 0
    manager.add_object("beam", abut.Mesh(*box((3, 3, 3))), matrix((0.5, 0.5, 0.5)))
    meet, names, contacts = manager.in_collision_single(beam, return_names=True, return_data=True)
    assert meet and names == {"beam"} and len(contacts) > 0
    assert manager.min_distance_single(beam) < -0.9
    # One mesh may have several parts. A mesh of two parts is no convex solid.
    (v, f), (w, g) = box((0.1, 0.1, 0.1)), box((0.1, 0.1, 0.1))
    two = abut.Mesh(np.concatenate([v + 9, w + 0.2]), np.concatenate([f, g + len(v)]))
    assert manager.in_collision_single(two) and manager.min_distance_single(two) < 0
    manager.add_object("beam", abut.Mesh(np.concatenate([v + 9, w + 20]), np.concatenate([f, g + len(v)])))
    assert not manager.in_collision_single(two, matrix((3, 0, 0)))
    # Surfaces without an inside have no depth.
    sheet = abut.Mesh(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.0)]), [(0, 1, 2)])
    upright = abut.Mesh(np.array([(0.2, 0.2, -1), (0.2, 0.2, 1), (2, 2, 0.0)]), [(0, 1, 2)])
    manager = CollisionManager()
    manager.add_object("sheet", sheet)
    assert manager.in_collision_single(upright) and manager.min_distance_single(upright) == 0


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
