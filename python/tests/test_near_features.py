"""Near features of deformables, contacts with rigid bodies, and colours of constraints."""

import numpy as np
import pytest

import abut


def sheet(cells=6, height=0.0):
    x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1), indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.full(x.size, height)], axis=1)
    i = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    return vertices, np.concatenate([np.stack([i, i + cells + 1, i + 1], 1), np.stack([i + 1, i + cells + 1, i + cells + 2], 1)])


def two_layers(gap):
    vertices, faces = sheet()
    upper = vertices + (0.03, 0.02, gap)
    return np.concatenate([vertices, upper]), np.concatenate([faces, faces + len(vertices)])


def test_gradients_move_pairs_to_their_limit():
    vertices, faces = two_layers(0.01)
    cloth = abut.Deformable(vertices, faces)
    pairs = abut.self_within(cloth, 0.02)
    assert len(pairs) > 50 and set(pairs.side) == {-1, 1}
    points = np.einsum("nk,nkd->nd", pairs.weights, vertices[pairs.vertices])
    np.testing.assert_allclose(points, pairs.point_a - pairs.point_b, atol=1e-15)
    np.testing.assert_allclose(points, pairs.distance[:, None] * pairs.normal, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(pairs.normal, axis=1), 1)
    assert np.all(pairs.distance <= pairs.limit) and np.all(pairs.limit == 0.02)


def test_options():
    vertices, faces = two_layers(0.01)
    cloth = abut.Deformable(vertices, faces)
    cloth.set_motion(vertices, np.float32(vertices + np.repeat([[0, 0, 0], [0, 0, 0.5]], len(vertices) // 2, axis=0)))
    assert len(abut.self_within(cloth, 0.02)) > 0
    assert len(abut.self_within(cloth, 0.02, at_end=True)) == 0
    n = len(vertices)
    thick = abut.NearVertices(thickness=np.full(n, 0.01))
    assert np.array_equal(abut.self_within(cloth, 0, vertices=thick).a, abut.self_within(cloth, 0.02).a)
    layer = np.repeat([1, 2], n // 2)
    apart = abut.NearVertices(groups=layer, masks=layer)
    assert len(abut.self_within(cloth, 0.02, vertices=apart)) == 0
    moved = np.zeros(n, bool)
    moved[3] = True
    some = abut.self_within(cloth, 0.02, vertices=abut.NearVertices(moved=moved))
    assert 0 < len(some) < len(abut.self_within(cloth, 0.02)) and np.all(np.any(some.vertices == 3, axis=1))
    assert abut.NearVertices(moved=moved).moved[3] and len(abut.NearVertices().groups) == 0
    with pytest.raises(abut.Error):
        abut.self_within(cloth, 0.02, vertices=abut.NearVertices(thickness=[1, 2]))
    with pytest.raises(TypeError):
        abut.NearVertices(groups=[0.5])


def test_two_surfaces_have_vertices_of_both():
    lower, upper = abut.Deformable(*sheet()), abut.Deformable(sheet()[0] + (0.03, 0.02, 0.01), sheet()[1])
    near = abut.within(lower, upper, 0.02)
    thick = abut.NearVertices(thickness=np.full(upper.vertex_count, 0.02))
    assert len(near) > 50
    assert np.array_equal(abut.within(lower, upper, 0.0, vertices_b=thick).distance, near.distance)
    assert np.array_equal(abut.within(lower, upper, np.float32(0.25)).limit, np.full(len(abut.within(lower, upper, 0.25)), 0.25))


@pytest.mark.parametrize("shape", [abut.Sphere((0, 0, 0), 0.1), abut.Capsule(abut.Segment((0, 0, 0), (0, 0, -1)), 0.1),
                                   abut.Convex(0.1 * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]))],
                         ids=["sphere", "capsule", "convex"])
def test_contacts_with_bodies(shape):
    vertices, faces = sheet(2)
    cloth = abut.Deformable(vertices, faces)
    pose = ((0.6, 0.7, -0.15), (0, 0, 0, 1))
    contacts = abut.within(cloth, shape, pose, 0.06)
    assert len(contacts) >= 1
    np.testing.assert_allclose(contacts.distance.min(), 0.05, atol=1e-12)
    np.testing.assert_allclose(contacts.normal, np.tile((0, 0, 1), (len(contacts), 1)), atol=1e-9)
    points = np.einsum("nk,nkd->nd", contacts.weights, vertices[contacts.vertices])
    np.testing.assert_allclose(points, contacts.point, atol=1e-12)
    assert len(abut.within(cloth, shape, pose, 0.04)) == 0
    by_name = abut.within(cloth, shape, distance=0.06, pose=pose)
    assert np.array_equal(by_name.id, contacts.id)
    with pytest.raises(TypeError):
        abut.within(cloth, "no shape", pose, 0.06)


def test_contacts_with_a_model():
    vertices, faces = sheet(4)
    cloth = abut.Deformable(vertices, faces)
    box = abut.Model(*_box((0.3, 0.3, -1), (0.7, 0.7, 0.1)))
    contacts = abut.within(cloth, box, None, 0)
    inside = contacts[contacts.feature == abut.Feature.vertex]
    assert list(inside.id) == [12]
    np.testing.assert_allclose(inside.distance, -0.1, atol=1e-12)


def _box(lower, upper):
    corners = np.array([[(lower, upper)[(i >> k) & 1][k] for k in range(3)] for i in range(8)], float)
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    return corners, np.array(faces)


def test_colours():
    cloth = abut.Deformable(*two_layers(0.01))
    for constraints in (cloth.edges, cloth.faces, abut.self_within(cloth, 0.02).vertices):
        colours = abut.colour_constraints(constraints)
        assert len(colours) == colours.count() > 1 and colours.begins[-1] == len(constraints)
        assert sorted(colours.order) == list(range(len(constraints)))
        for colour in range(len(colours)):
            vertices = constraints[colours.of(colour)].ravel()
            assert len(set(vertices)) == len(vertices)
    assert len(abut.colour_constraints(cloth.edges, fixed=np.ones(cloth.vertex_count))) == 1
    assert len(abut.colour_constraints(np.zeros((0, 2), int))) == 0
    with pytest.raises(abut.Error):
        abut.colour_constraints([[0, 5]], fixed=[0, 0])
    with pytest.raises(ValueError):
        abut.colour_constraints([[0]])
    with pytest.raises(IndexError):
        colours.of(len(colours))
