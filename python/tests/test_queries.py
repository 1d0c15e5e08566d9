"""Queries of two models and of one model, against brute force in numpy."""

import numpy as np
import pytest

import abut
from shapes import (box, brute_force, grid, guard, matrix, place, point_triangle_distance, random_poses, soup, sphere)


def triangles(mesh, pose):
    return place(mesh[0], pose)[mesh[1]]


def test_pairs_and_distance_against_brute_force(rng):
    hits = []
    for spread in np.linspace(0.2, 2.2, 30):
        a, b = soup(rng, 20), soup(rng, 15)
        poses = random_poses(rng, 2, spread)
        distances, crosses = brute_force(triangles(a, poses[0]), triangles(b, poses[1]))
        ma, mb = abut.Model(*a), abut.Model(*b)
        contacts = abut.collide(ma, poses[0], mb, poses[1], mode="all", segments=True)
        assert np.array_equal(contacts.pairs, np.argwhere(crosses))
        assert len(contacts.segments) == len(contacts.pairs)
        assert bool(contacts) == contacts.meet == crosses.any()
        gap = abut.distance(ma, poses[0], mb, poses[1])
        assert gap.distance == pytest.approx(distances.min(), abs=1e-9)
        assert np.linalg.norm(gap.point_a - gap.point_b) == pytest.approx(gap.distance, abs=1e-9)
        assert distances[gap.triangle_a, gap.triangle_b] == pytest.approx(gap.distance, abs=1e-9)
        assert abut.within(ma, poses[0], mb, poses[1], distances.min() + 1e-6)
        if distances.min() > 1e-6:
            assert not abut.within(ma, poses[0], mb, poses[1], distances.min() - 1e-6)
        hits.append(crosses.any())
    guard(hits)


def test_batches_equal_single_queries(rng):
    a, b = abut.Model(*sphere(10)), abut.Model(*box((1, 2, 3)))
    poses_a, poses_b = random_poses(rng, 300, 2), random_poses(rng, 300, 2)
    gaps = abut.distance(a, poses_a, b, poses_b)
    contacts = abut.collide(a, poses_a, b, poses_b)
    near = abut.within(a, poses_a, b, poses_b, 0.3)
    assert gaps.shape == near.shape == (300,) and gaps.point_a.shape == (300, 3) and len(contacts) == 300
    guard(contacts.meet)
    guard(near)
    for i in range(300):
        gap = abut.distance(a, poses_a[i], b, poses_b[i])
        assert gap.distance == gaps.distance[i] and np.array_equal(gap.point_b, gaps[i].point_b)
        assert gap.counters.volume_tests == gaps.counters.volume_tests[i]
        assert contacts[i].meet == contacts.meet[i] == (gap.distance == 0)
        assert near[i] == (gap.distance <= 0.3)
        assert np.array_equal(contacts.pairs[contacts.offsets[i]:contacts.offsets[i + 1]], contacts[i].pairs)
    assert np.array_equal(abut.distance(a, None, b, poses_b).distance, abut.distance(a, np.tile(np.eye(4), (300, 1, 1)), b, poses_b).distance)
    quaternions = rng.normal(size=(300, 4))
    by_pair = abut.distance(a, None, b, (poses_b[:, :3, 3], quaternions))
    by_list = abut.distance(a, None, b, [abut.Pose(p[:3, 3], q) for p, q in zip(poses_b, quaternions)])
    assert np.array_equal(by_pair.distance, by_list.distance)
    with pytest.raises(ValueError, match="pose_b"):
        abut.distance(a, poses_a, b, poses_b[:7])
    poses_b[17, 0, 3] = np.nan
    with pytest.raises(abut.Error, match="placement 17: "):
        abut.distance(a, poses_a, b, poses_b)
    assert len(abut.distance(a, None, b, np.zeros((0, 4, 4)))) == 0


def test_options_and_results():
    a = abut.Model(*sphere(10))
    apart = matrix((3, 0, 0))
    far = abut.distance(a, None, a, apart, upper_bound=0.5)
    assert far.status is abut.Status.bound_only and far.distance == 0.5
    inside = abut.distance(a, None, a, matrix((0.5, 0, 0)), signed_distance=True)
    assert inside.distance < -0.1
    few = abut.distance(a, None, a, apart, max_steps=1)
    assert few.out_of_steps and few.at_least <= 1
    warm = abut.WarmStart()
    assert not warm.used
    first = abut.distance(a, None, a, apart, warm_start=warm)
    assert warm.used and abut.distance(a, None, a, apart, warm_start=warm).distance == first.distance
    text = repr(first)
    assert text.startswith("Gap(distance=") and "status=exact" in text and "volume_tests" in text
    assert first.feature_a in abut.Feature
    assert first == abut.distance(a, None, a, apart) or first.counters != abut.distance(a, None, a, apart).counters
    with pytest.raises(TypeError, match="unexpected keyword"):
        abut.distance(a, None, a, apart, upper=1)
    with pytest.raises(TypeError, match="missing argument 'pose_b'"):
        abut.distance(a, None, a)
    with pytest.raises(TypeError, match="is not for str"):
        abut.distance("a", None, a, None)
    class Trimesh:
        vertices, faces = [], []
    for mesh in (Trimesh(), abut.Mesh(*box())):
        with pytest.raises(TypeError, match="make an abut.Model of a mesh first"):
            abut.distance(mesh, None, mesh, None)
    with pytest.raises(TypeError, match="is not for abut.*Model and str: help"):
        abut.distance(a, None, "a", None)
    with pytest.raises(TypeError, match="positional"):
        abut.distance(a, None, a, None, 3)
    with pytest.raises(ValueError, match="'some' is no ContactMode"):
        abut.collide(a, None, a, None, mode="some")
    assert abut.collide(a=a, pose_a=None, b=a, pose_b=None).meet
    with pytest.raises(abut.Error) as error:
        abut.distance(a, None, a, None, upper_bound=-1)
    assert error.value.code is abut.ErrorCode.bad_argument


def test_contact_manifolds():
    ground = abut.Model(*box())
    place = matrix((0.25, 0.125, 0.9))
    (found,) = abut.contact_manifolds(ground, None, ground, place)
    assert found.count == 4 and found.normal == pytest.approx((0, 0, 1)) and found.status == abut.Status.exact
    assert found.points.depth == pytest.approx(0.1) and len(set(found.points.feature)) == 4
    assert np.allclose(found.points.point_a - found.points.point_b, (0, 0, 0.1))
    (again,) = abut.contact_manifolds(ground, None, ground, place, margin=0.01, last=[found])
    assert again.region == found.region and again.points.feature.tolist() == found.points.feature.tolist()
    assert abut.contact_manifolds(ground, None, ground, matrix((3, 0, 0))) == []
    with pytest.raises(abut.Error):
        abut.contact_manifolds(ground, None, ground, place, margin=-1)


def test_penetration():
    a = abut.Model(*box())
    pose = matrix((0.9, 0.1, 0))
    depth = abut.penetration(a, None, a, pose)
    assert depth and depth.interpenetrate and depth.depth == pytest.approx(0.1, rel=0.02)
    moved = pose.copy()
    moved[:3, 3] += depth.separation
    assert not abut.collide(a, None, a, moved)
    assert depth.regions[0].pairs.shape[1] == 2
    many = abut.penetration(a, None, a, np.array([pose, matrix((3, 0, 0))]))
    assert [bool(d) for d in many] == [True, False]


def test_time_of_impact(rng):
    a = abut.Model(*sphere(8))
    motion = abut.Motion.between(matrix((-5, 0, 0)), matrix((5, 0.1, 0)))
    impact = abut.time_of_impact(a, None, a, motion)
    assert impact and 0.29 < impact.time < 0.31
    at = abut.at(motion, impact.time)
    assert abut.distance(a, None, a, at).distance <= 1e-4
    starts, ends = random_poses(rng, 100, 4), random_poses(rng, 100, 4)
    motions = abut.Motion.between(starts, ends)
    impacts = abut.time_of_impact(a, None, a, motions)
    guard(impacts.meet)
    for i in range(0, 100, 10):
        assert abut.time_of_impact(a, None, a, motions[i]).time == impacts.time[i]
    assert len(abut.Motion.screw(starts, ends)) == 100
    with pytest.raises(ValueError):
        abut.time_of_impact(a, motions[:3], a, motions)


def test_nearest_against_brute_force(rng):
    mesh = sphere(8)
    model = abut.Model(*mesh)
    pose = random_poses(rng, 1)[0]
    points = rng.uniform(-2, 2, (200, 3))
    t = triangles(mesh, pose)
    expected = point_triangle_distance(points[:, None], t[None, :, 0], t[None, :, 1], t[None, :, 2]).min(axis=1)
    found = abut.nearest(model, pose, points)
    assert np.allclose(found.distance, expected, atol=1e-12)
    assert np.allclose(np.linalg.norm(points - found.point, axis=1), found.distance)
    weighted = (t[found.triangle] * found.barycentric[:, :, None]).sum(axis=1)
    assert np.allclose(weighted, found.point)
    one = abut.nearest(model, pose, points[3])
    assert one.distance == found.distance[3] and one.barycentric.shape == (3,)
    signed = abut.nearest(model, pose, points, signed_distance=True).distance
    inside = abut.contains(model, pose, points).side == abut.Side.inside
    assert np.array_equal(signed < 0, inside)
    guard(inside, 0.02)
    local = (points - pose[:3, 3]) @ pose[:3, :3]
    assert inside[np.linalg.norm(local, axis=1) < 0.9].all() and not inside[np.linalg.norm(local, axis=1) > 1].any()
    with pytest.raises(ValueError):
        abut.nearest(model, pose, points[:, :2])


def test_rays(rng):
    mesh = grid(4, 2.0)
    model = abut.Model(*mesh)
    origins = np.column_stack([rng.uniform(-2, 2, (300, 2)), np.full(300, 3.0)])
    hits = abut.first_hit(model, None, origins, (0, 0, -2))
    expected = (np.abs(origins[:, :2]) <= 1).all(axis=1)
    guard(expected)
    assert np.array_equal(hits.meet, expected)
    assert np.allclose(hits.t[expected], 1.5) and np.all(np.isinf(hits.t[~expected]))
    assert np.allclose(hits.point[expected][:, :2], origins[expected][:, :2])
    one = abut.first_hit(model, None, origins[0], (0, 0, -2))
    assert one.meet == expected[0] == bool(one)
    assert abut.first_hit(model, None, abut.Ray(origins[0], (0, 0, -2), t_max=1)).meet is False
    short = abut.first_hit(model, None, origins, (0, 0, -2), t_max=np.where(np.arange(300) % 2, 1.0, 2.0))
    assert np.array_equal(short.meet, expected & (np.arange(300) % 2 == 0))
    ball = abut.Model(*sphere(8))
    assert len(abut.all_hits(ball, None, (0.1, 0.05, 3), (0, 0, -1))) == 2
    assert [len(h) for h in abut.all_hits(ball, None, [(0.1, 0.05, 3), (5, 5, 5)], (0, 0, -1))] == [2, 0]
    with pytest.raises(abut.Error):
        abut.first_hit(model, None, (0, 0, 1), (0, 0, 0))


def test_shapes(rng):
    model = abut.Model(*box((2, 2, 2)))
    assert abut.overlaps(model, None, abut.Sphere((2, 0, 0), 1))
    assert not abut.overlaps(model, None, abut.Sphere((2, 0, 0), 0.99))
    assert not abut.overlaps(model, None, abut.Sphere((0, 0, 0), 0.99))
    assert abut.overlaps(model, None, abut.Segment((0, 0, 0), (2, 0, 0)))
    assert abut.overlaps(model, None, abut.OrientedBox(abut.Box3((0, 0, 0), (1, 1, 1)), matrix((0.5, 0, 0))))
    lower = rng.uniform(-3, 2, (200, 3))
    upper = lower + rng.uniform(0, 1, (200, 3))
    expected = (lower <= 1).all(1) & (upper >= -1).all(1) & ~((lower > -1).all(1) & (upper < 1).all(1))
    guard(expected, 0.05)
    assert np.array_equal(abut.overlaps(model, None, lower, upper), expected)
    assert np.array_equal(abut.overlaps(model, None, lower=lower, upper=upper), expected)
    triangles = abut.overlapping_triangles(model, None, abut.Box3((0.5, -2, -2), (2, 2, 2)))
    assert 2 <= len(triangles) <= 12 and np.all(np.diff(triangles.astype(int)) > 0)
    assert abut.distance(model, None, abut.Segment((3, 0, 0), (4, 0, 0))).distance == 2
    with pytest.raises(TypeError, match="missing"):
        abut.overlaps(model, None, 3)
    with pytest.raises(abut.Error):
        abut.overlaps(model, None, abut.Sphere((0, 0, 0), -1))


def test_convex(rng):
    a, b = abut.Convex(box()[0]), abut.Convex(*sphere(6))
    assert a.dimension == 3 and len(a.faces) == 6 and a.edges.shape == (12, 2)
    poses = random_poses(rng, 200, 2)
    gaps = abut.distance(a, None, b, poses)
    depths = abut.penetration(a, None, b, poses)
    guard(depths.meet)
    assert np.array_equal(gaps.distance == 0, depths.meet)
    models = abut.distance(abut.Model(*box()), None, abut.Model(*sphere(6)), poses)
    apart = gaps.distance > 0
    assert np.allclose(gaps.distance[apart], models.distance[apart], atol=1e-9)
    warm = abut.ConvexWarmStart()
    for i, pose in enumerate(poses):
        assert abut.distance(a, None, b, pose, warm_start=warm).distance == pytest.approx(gaps.distance[i], abs=1e-9)
    moved = poses[depths.meet].copy()
    moved[:, :3, 3] += depths.direction[depths.meet] * (depths.depth[depths.meet] + 1e-9)[:, None]
    assert np.all(abut.penetration(a, None, b, moved).depth < 1e-8)
    with pytest.raises(abut.Error) as error:
        abut.Convex(abut.Mesh(*grid(3)))
    assert error.value.code is abut.ErrorCode.bad_mesh


def test_convex_pieces(rng):
    solid = abut.ConvexPieces(abut.Model(*sphere(6)))
    assert len(solid) >= 1 and solid.hull(0).dimension == 3
    cube = abut.ConvexPieces(*box())
    poses = random_poses(rng, 100, 2)
    gaps = abut.distance(solid, None, cube, poses)
    meet = np.array([c.meet for c in abut.collide(solid, None, cube, poses)])
    guard(meet)
    assert np.array_equal(gaps.distance == 0, meet)
    assert np.array_equal(abut.within(solid, None, cube, poses, 0.2), gaps.distance <= 0.2)
    depths = abut.penetration(solid, None, cube, poses)
    assert np.array_equal(depths.meet, meet)
    warm = abut.PiecesWarmStart()
    assert abut.distance(solid, None, cube, poses[0], warm_start=warm).distance == pytest.approx(gaps.distance[0], abs=1e-12)
    inside = abut.collide(solid, None, cube, None, triangles=True, mode="all")
    assert inside.meet and inside.triangles.shape == (0, 2)
    with pytest.raises(IndexError):
        solid.hull(99999)
    with pytest.raises(abut.Error):
        abut.ConvexPieces(abut.Model(*grid(3)))


def test_boxes(rng):
    lower = rng.uniform(0, 1, (150, 3))
    upper = lower + rng.uniform(0, 0.3, (150, 3))
    meet = (lower[:, None] <= upper[None]).all(-1) & (upper[:, None] >= lower[None]).all(-1)
    expected = np.argwhere(np.triu(meet, 1))
    guard(np.triu(meet, 1)[np.triu_indices(150, 1)], 0.005)
    assert np.array_equal(abut.overlapping_boxes(lower, upper), expected)
    even = abut.overlapping_boxes(lower, upper, filter=lambda i, k: (i + k) % 2 == 0)
    assert np.array_equal(even, expected[expected.sum(1) % 2 == 0])
    phase = abut.BroadPhase(method="sweep")
    phase.update(lower, upper)
    assert np.array_equal(phase.pairs, expected) and np.array_equal(phase.begun, expected)
    upper[3], lower[3] = upper[3] + 9, lower[3] + 9
    phase.update(lower, upper, [3])
    assert np.array_equal(phase.ended, expected[(expected == 3).any(axis=1)])
    with pytest.raises(ZeroDivisionError):
        abut.overlapping_boxes(lower, upper, filter=lambda i, k: 1 / 0)
