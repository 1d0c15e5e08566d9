import numpy as np
import pytest

import abut
from shapes import grid, guard, soup


def test_falling_sheet():
    vertices, faces = grid(6)
    floor, sheet = abut.Deformable(vertices, faces), abut.Deformable(vertices + (0.01, 0.02, 1), faces)
    assert len(abut.impacts(floor, sheet)) == 0 and abut.is_free_of_impacts(floor, sheet)
    sheet.advance(vertices + (0.01, 0.02, -1))
    found = abut.impacts(floor, sheet)
    assert len(found) == len(found.list) > 50 and found.counters.elementary_tests.vertex_face > 0
    assert np.allclose(found.list.time, 0.5, atol=1e-6) and found.list.normal.shape == (len(found), 3)
    faces_first = found.list[found.list.kind == abut.ElementaryKind.vertex_face]
    assert set(faces_first.face_first.tolist()) == {False, True}
    first = abut.time_of_impact(floor, sheet)
    assert first.time == pytest.approx(0.5, abs=1e-6) and first.time == found.list.time.min()
    assert not abut.is_free_of_impacts(floor, sheet)
    assert "FeatureImpact(kind=" in repr(first)


def test_impacts_against_elementary_tests(rng):
    """Every vertex and face of two surfaces, one by one, gives the same list."""
    hits = []
    for _ in range(10):
        a, b = soup(rng, 14, 0.5), soup(rng, 12, 0.5)
        ends = a[0] + rng.uniform(-2, 2, a[0].shape), b[0] + rng.uniform(-2, 2, b[0].shape)
        da, db = abut.Deformable(*a), abut.Deformable(*b)
        da.set_motion(a[0], ends[0])
        db.set_motion(b[0], ends[1])
        found = abut.impacts(da, db).list
        listed = found[(found.kind == abut.ElementaryKind.vertex_face) & ~found.face_first]
        v, f = [x.ravel() for x in np.meshgrid(np.arange(len(a[0])), np.arange(len(b[1])), indexing="ij")]
        gather = lambda pa, pb: np.concatenate([pa[v][:, None], pb[b[1][f]]], axis=1)
        tests = abut.elementary_impacts("vertex_face", gather(a[0], b[0]), gather(*ends))
        assert np.array_equal(np.stack([listed.a, listed.b], 1), np.stack([v, f], 1)[tests.meet])
        assert np.allclose(listed.time, tests.time[tests.meet], atol=1e-8)
        hits += tests.meet.tolist()
        edges = found[found.kind == abut.ElementaryKind.edge_edge]
        assert edges.a.max(initial=0) < len(da.edges) and edges.b.max(initial=0) < len(db.edges)
    guard(hits, 0.002)
    assert sum(hits) > 10


def test_self_queries():
    vertices, faces = grid(8)
    cloth = abut.Deformable(vertices, faces, assignment="adaptive")
    assert cloth.vertex_count == 81 and cloth.faces.shape == (128, 3)
    folded = vertices.copy()
    folded[:, 2] = np.maximum(0, vertices[:, 0]) * 0.3
    folded[:, 0] = -np.abs(vertices[:, 0]) * np.where(vertices[:, 0] > 0, 0.9, 1)
    cloth.advance(folded)
    free = abut.is_free_of_self_impacts(cloth)
    assert free == (len(abut.self_impacts(cloth)) == 0)
    cloth.adapt(abut.self_impacts(cloth))
    flat = abut.Deformable(vertices, faces)
    near = abut.self_within(flat, 0.1)
    assert np.all(near.distance <= 0.1)
    lifted = abut.Deformable(vertices + (0, 0, 0.05), faces)
    assert len(abut.within(flat, lifted, 0.06)) > 0 and len(abut.within(flat, lifted, 0.04)) == 0


def test_intersections_at_rest():
    """A sheet that a blade passes through, and a blade that ends on it."""
    vertices, faces = grid(6)
    blade = np.array([[0.07, 0.11, -1], [0.07, 0.11, 1], [5, 0.11, 9]], float)
    mesh = np.vstack([vertices, blade]), np.vstack([faces, [[49, 50, 51]]])
    both = abut.Deformable(*mesh)
    found = abut.self_intersections(both)
    assert np.all(found.contact == abut.EdgeFaceContact.crossing) and len(found) > 3
    blades = found[(both.edges[found.edge] == (49, 50)).all(axis=1)]
    assert len(blades) == 1 and np.allclose(blades.point[0], (0.07, 0.11, 0))
    assert blades.along[0] == pytest.approx(0.5)
    assert np.allclose(blades.barycentric[0] @ mesh[0][both.faces[blades.face[0]]], blades.point[0])
    sheet, other = abut.Deformable(vertices, faces), abut.Deformable(blade, [[0, 1, 2]])
    two = abut.intersections(sheet, other)
    assert len(two) == len(found) and set(two.face_first.tolist()) == {False, True}
    assert len(abut.self_intersections(sheet)) == 0
    other.advance(blade + (0, 0, 1))
    found = abut.intersections(other, sheet, at_end=True)
    assert len(found) > 1 and np.all(found.contact == abut.EdgeFaceContact.touching)


def test_a_surface_as_a_model():
    vertices, faces = grid(6)
    cloth, ball = abut.Deformable(vertices, faces), abut.Model(*grid(3))
    lifted = abut.distance(cloth.model(), None, ball, ((0, 0, 2), (1, 0, 0, 0)))
    assert lifted.distance == pytest.approx(2)
    cloth.advance(vertices + (0, 0, 1))
    assert np.array_equal(cloth.model().vertices, vertices)
    cloth.advance(vertices + (0, 0, 1))
    assert abut.distance(cloth.model(), None, ball, ((0, 0, 2), (1, 0, 0, 0))).distance == pytest.approx(1)


def test_errors():
    vertices, faces = grid(3)
    cloth = abut.Deformable(vertices, faces)
    with pytest.raises(abut.Error) as error:
        cloth.advance(vertices[:-1])
    assert error.value.code is abut.ErrorCode.bad_argument
    with pytest.raises(abut.Error):
        cloth.advance(vertices + np.inf)
    with pytest.raises(ValueError):
        cloth.advance(vertices[:, :2])
    with pytest.raises(abut.Error):
        abut.self_impacts(cloth, absolute_error=-1)
    other = abut.Deformable(*grid(9))
    other.set_motion(grid(9)[0], grid(9)[0][::-1].copy())
    found = abut.self_impacts(other)
    assert len(found) > 0
    with pytest.raises(ValueError, match="not this surface"):
        cloth.adapt(found)
    with pytest.raises(ValueError):
        abut.Deformable(vertices, faces, scheme="none")


def test_elementary():
    start = np.array([[0.2, 0.2, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    end = start.copy()
    end[0, 2] = -1
    one = abut.elementary_impact("vertex_face", start, end)
    assert one and one.time == pytest.approx(0.5) and np.allclose(one.barycentric, (0.6, 0.2, 0.2))
    many = abut.elementary_impacts(np.array([0, 0]), [start, start], [end, start])
    assert many.meet.tolist() == [True, False]
    with pytest.raises(ValueError):
        abut.elementary_impact("vertex_face", start[:3], end)


def test_representatives_with_another_culling(rng):
    """Pairs of triangles from boxes of numpy lead to the impacts of self_impacts, each once."""
    hits = 0
    for _ in range(5):
        vertices, faces = soup(rng, 30, 0.5)
        end = vertices + rng.uniform(-1, 1, vertices.shape)
        cloth = abut.Deformable(vertices, faces)
        cloth.set_motion(vertices, end)
        surface = abut.Representatives(len(vertices), faces)
        surface.set_motion(vertices, end)
        corners = np.concatenate([vertices[faces], end[faces]], axis=1)
        pairs = abut.overlapping_boxes(corners.min(axis=1), corners.max(axis=1))
        tests = abut.self_feature_tests(surface, pairs)
        found = abut.elementary_impacts(tests.kind, vertices[tests.vertices], end[tests.vertices])
        listed = {(i.kind, i.a, i.b) for i in tests[found.meet]}
        assert listed == {(i.kind, i.a, i.b) for i in abut.self_impacts(cloth).list}
        assert len(listed) == found.meet.sum()
        hits += len(listed)
    assert hits > 10
    before = surface.represented.copy()
    surface.set_triangles(len(vertices), faces[:-1])
    assert np.array_equal(surface.represented, before[:-1]) and len(surface.edges) <= 3 * len(faces)
    assert surface.vertex_count == len(vertices) and surface.bytes > 0 and len(surface.triangles) == len(faces) - 1
    for index in (10**6, 2**32, -1):
        with pytest.raises(abut.Error):
            abut.self_feature_tests(surface, [[0, index]])
    for wrong, error in (([[0.0, 1.0]], TypeError), ([[0, 1, 2]], ValueError)):
        with pytest.raises(error):
            abut.self_feature_tests(surface, wrong)
    other = abut.Representatives(3, [[0, 1, 2]])
    assert len(abut.feature_tests(surface, other, [[0, 0]])) == 15
    assert abut.feature_tests(surface, other, [])[:0].vertices.shape == (0, 4)
