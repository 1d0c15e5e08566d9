import gc
import pickle

import numpy as np
import pytest

import abut
from shapes import box, guard, matrix, random_poses, sphere


def test_pairs_against_single_queries(rng):
    model, convex = abut.Model(*sphere(6)), abut.Convex(box()[0])
    poses = random_poses(rng, 30, 2.2)
    world = abut.World()
    bodies = np.array([world.add(model, pose) for pose in poses])
    assert np.array_equal(bodies, np.arange(30)) and len(world) == 30
    i, k = np.triu_indices(30, 1)
    gaps = abut.distance(model, poses[i], model, poses[k])
    touching = gaps.distance == 0
    guard(touching, 0.02)
    expected = np.stack([i, k], axis=1)[touching]
    assert np.array_equal(world.collide(), expected)
    near = world.within(0.25)
    assert np.array_equal(np.stack([near.a, near.b], axis=1), np.stack([i, k], axis=1)[gaps.distance <= 0.25])
    # The World tells the signed distance; models that meet have distance 0 as surfaces.
    assert np.allclose(np.maximum(near.distance, 0), gaps.distance[gaps.distance <= 0.25], atol=1e-9)
    deep = world.penetration()
    assert np.array_equal(np.stack([deep.a, deep.b], axis=1), expected) and np.all(deep.distance <= 0)
    assert deep.point_a.shape == (len(expected), 3)
    moved = random_poses(rng, 30, 2.2)
    world.move(bodies, moved)
    assert np.allclose(world.world_from_body(7), moved[7])
    touching = abut.distance(model, moved[i], model, moved[k]).distance == 0
    assert np.array_equal(world.collide(), np.stack([i, k], axis=1)[touching])
    world.add(convex, matrix((50, 0, 0)))
    assert world.add(abut.Sphere((0, 0, 0), 1), matrix((51, 0, 0)), is_static=True) == 31
    assert [30, 31] in world.collide().tolist()


def test_curved_shapes():
    world = abut.World()
    floor = world.add(abut.HalfSpace((0, 0, 2), 0), is_static=True)
    cylinder = world.add(abut.Cylinder(abut.Segment((0, 0, 1), (0, 0, 2)), 0.5))
    cone = world.add(abut.Cone(apex=(3, 0, 0.5), base=(3, 0, 1), radius=1))
    ellipsoid = world.add(abut.Ellipsoid((6, 0, 0.5), (1, 2, 0.75)))
    assert world.collide().tolist() == [[floor, ellipsoid]]
    gaps = world.within(1)
    assert gaps.a.tolist() == [floor] * 3 and gaps.b.tolist() == [cylinder, cone, ellipsoid]
    assert np.allclose(gaps.distance, [1, 0.5, -0.25], atol=1e-12)
    assert np.allclose(gaps.normal, [0, 0, 1])
    box_of_floor = world.box(floor)
    assert np.isinf([box_of_floor.lower, box_of_floor.upper]).sum() == 5
    assert abut.Ellipsoid((6, 0, 0.5), (1, 2, 0.75)).semi_axes.tolist() == [1, 2, 0.75]
    with pytest.raises(abut.Error, match="body 4: "):
        world.add(abut.Cone((0, 0, 0), (0, 0, 0), 1))


def test_bodies_end():
    world = abut.World()
    a = world.add(abut.Box3((0, 0, 0), (1, 1, 1)))
    b = world.add(abut.Capsule(abut.Segment((0, 0, 0), (1, 0, 0)), 0.1), matrix((0.5, 0.5, 0.5)))
    assert world.collide().tolist() == [[a, b]]
    world.set_options(b, mask=2)
    assert world.collide().tolist() == []
    world.remove(a)
    assert not world.is_valid(a) and world.is_valid(b)
    again = world.add(abut.Box3((0, 0, 0), (1, 1, 1)))
    assert again != a
    for use in (lambda: world.move(a, np.eye(4)), lambda: world.remove(a), lambda: world.box(a), lambda: world.box(-1)):
        with pytest.raises(abut.Error) as error:
            use()
        assert error.value.code is abut.ErrorCode.bad_argument
    with pytest.raises(ValueError, match="rotation"):
        world.move(b, np.diag((2, 2, 2, 1)))
    with pytest.raises(TypeError):
        world.add("shape", None)


def test_world_keeps_what_it_holds():
    world = abut.World()
    world.add(abut.Model(*sphere(6)), matrix((0.5, 0, 0)))
    world.add(abut.Model(*sphere(6)))
    surface = abut.Deformable(*sphere(6))
    body = world.add(surface)
    del surface
    gc.collect()
    assert len(world.collide()) == 3
    world.remove(body)
    assert len(world.collide()) == 1


def test_filter():
    calls = []

    def filter(a, b):
        calls.append((a, b))
        return (a + b) % 2 == 1

    world = abut.World(filter=filter)
    model = abut.Model(*box())
    for _ in range(4):
        world.add(model)
    assert world.collide().tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]] and calls
    world = abut.World(filter=lambda a, b: 1 / 0)
    world.add(model)
    world.add(model)
    with pytest.raises(ZeroDivisionError):
        world.collide()


def test_filter_must_not_use_the_world():
    world = abut.World(filter=lambda a, b: len(world) > 0)
    model = abut.Model(*box())
    world.add(model)
    world.add(model)
    with pytest.raises(RuntimeError, match="in use"):
        world.collide()


def test_time_of_impact_and_schedule():
    world = abut.World()
    model = abut.Model(*sphere(8))
    a, b = world.add(model, matrix((-5, 0, 0))), world.add(model, matrix((5, 0, 0)))
    motion = abut.Motion(matrix((-5, 0, 0)), velocity=(10, 0, 0))
    impacts = world.time_of_impact({a: motion})
    assert len(impacts) == 1 and impacts[0].a == a and impacts.time[0] == pytest.approx(0.8, abs=1e-3)
    assert np.allclose(impacts.normal[0], (1, 0, 0), atol=0.1)
    assert world.time_of_impact([(a, motion)]).time[0] == impacts.time[0]
    world.set_speed(a, velocity=(1, 0, 0))
    assert world.advance(0).tolist() == []
    assert 5 < world.next_event() <= 8.01
    assert 7.5 < world.time_to_collision() <= 8.01 and world.time_to_collision(limit=3) == 3
    assert 7.5 < world.time_to_collision(a, b) <= 8.01
    with pytest.raises(abut.Error, match="two bodies"):
        world.time_to_collision(a, a)
    world.move(a, matrix((4, 0, 0)))
    assert world.advance(9).tolist() == [[a, b]]
    assert world.schedule_counters().steps >= 2


def test_move_takes_arrays_with_any_strides():
    world, model = abut.World(), abut.Model(*box())
    bodies = np.array([world.add(model) for _ in range(6)])
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, 0, 3] = 10, 20, 30
    world.move(bodies[::2], poses)
    assert [world.world_from_body(int(body))[0, 3] for body in bodies] == [10, 0, 20, 0, 30, 0]
    world.move(bodies[::-2].astype(np.uint64), poses)
    assert [world.world_from_body(int(body))[0, 3] for body in bodies] == [10, 30, 20, 20, 30, 10]
    world.move(np.zeros(0, np.int64), np.zeros((0, 4, 4)))
    with pytest.raises(TypeError):
        world.move(bodies[:3].astype(float), poses)


def test_contact_manifolds():
    world = abut.World()
    floor = world.add(abut.Box3((-5, -5, -1), (5, 5, 0)), is_static=True)
    crate = world.add(abut.Box3((-1, -1, -1), (1, 1, 1)), matrix((0.5, 0, 0.995)))
    ball = world.add(abut.Sphere((0, 0, 0), 0.5), matrix((4, 0, 0.51)))
    contacts = world.contact_manifolds(0.02)
    assert contacts.a.tolist() == [floor, floor] and contacts.b.tolist() == [crate, ball]
    assert contacts["count"].tolist() == [4, 1] and np.allclose(contacts.normal, (0, 0, 1))
    points = contacts[0].points
    assert np.allclose(points["depth"], 0.005) and len(set(points["feature"])) == 4
    assert np.allclose(np.sort(points["point_a"][:, 0]), (-0.5, -0.5, 1.5, 1.5))
    assert np.isclose(contacts[1].points["depth"][0], -0.01)
    assert len(world.contact_manifolds()) == 1
    with pytest.raises(abut.Error):
        world.contact_manifolds(-1)


def test_every_query_updates_the_pairs_first():
    queries = {"collide": lambda w, b: w.collide(), "penetration": lambda w, b: w.penetration(),
               "within": lambda w, b: w.within(0.1), "contacts": lambda w, b: w.contact_manifolds(0.1),
               "time_of_impact": lambda w, b: w.time_of_impact({b: abut.Motion(np.eye(4), velocity=(1, 0, 0))}),
               "advance": lambda w, b: w.advance(0.01), "next_event": lambda w, b: w.next_event(),
               "time_to_collision": lambda w, b: w.time_to_collision(limit=1.0)}
    for name, ask in queries.items():
        world = abut.World()
        stays = world.add(abut.Sphere((0, 0, 0), 0.5), np.eye(4))
        largest = 0
        for _ in range(50):
            body = world.add(abut.Sphere((0, 0, 0), 0.5), np.eye(4))
            largest = max(largest, int(body) & 0xFFFFFFFF)
            ask(world, body)
            assert world.pairs().tolist() == world.begun().tolist() == [[int(stays), int(body)]], name
            ask(world, body)  # the same update
            assert len(world.begun()) == 1 and len(world.ended()) == 0, name
            world.remove(body)
            assert len(world.pairs()) == 1, name  # as of the last update
            ask(world, stays)
            assert len(world.pairs()) == 0 and world.ended().tolist() == [[int(stays), int(body)]], name
        assert largest <= 4, name  # places of removed bodies are used again
        assert len(world) == 1


def test_rays_overlaps_and_sweeps():
    world = abut.World()
    ball = world.add(abut.Sphere([0, 0, 0], 1), ((0, 0, 5), (1, 0, 0, 0)), groups=2)
    box = world.add(abut.Box3([-1, -1, -1], [1, 1, 1]), ((0, 0, 9), (1, 0, 0, 0)))
    hit = world.first_hit([0, 0, 0], [0, 0, 2])
    assert hit and hit.body == ball and hit.t == 2 and list(hit.normal) == [0, 0, -1]
    assert world.first_hit(abut.Ray([0, 0, 0], [0, 0, 2]), groups=1).body == box
    assert world.first_hit([0, 0, 0], [0, 0, 2], filter=lambda body: body != ball).body == box
    assert not world.first_hit([0, 0, 0], [1, 0, 0])
    assert [b for b in world.all_hits([0, 0, 0], [0, 0, 1]).body] == [ball, box]
    place = ((0, 0, 7), (1, 0, 0, 0))
    assert list(world.overlaps(abut.Sphere([0, 0, 0], 1), place)) == [ball, box]
    assert list(world.overlaps(abut.Sphere([0, 0, 0], 0.5), place)) == []
    start = abut.Pose((0, 0, 0), (1, 0, 0, 0))
    swept = world.sweep(abut.Sphere([0, 0, 0], 0.5), abut.Motion(start, velocity=(0, 0, 7)))
    assert swept and swept.body == ball and abs(swept.time - 0.5) < 1e-3
    with pytest.raises(ZeroDivisionError):
        world.first_hit([0, 0, 0], [0, 0, 1], filter=lambda body: 1 // 0)
    with pytest.raises(abut.Error):
        world.first_hit([0, 0, 0], [0, 0, 0])
    with pytest.raises(TypeError):
        world.overlaps("a cup")


def test_compounds_and_user_data():
    table = abut.Compound([abut.Box3((-1, -1, 0.7), (1, 1, 0.8)),
                           (abut.Capsule(abut.Segment((0, 0, 0.1), (0, 0, 0.7)), 0.1), ((0.5, 0, 0), (1, 0, 0, 0)))])
    assert len(table) == 2
    world = abut.World()
    floor = world.add(abut.Box3((-5, -5, -1), (5, 5, 0)), is_static=True, user_data=3)
    body = world.add(table, ((0, 0, -0.01), (1, 0, 0, 0)), user_data=2**40)
    assert len(world) == 2 and world.options(body)["user_data"] == 2**40
    contacts = world.contact_manifolds()
    assert [(m.a, m.b, m.piece_b, m.user_data_a, m.user_data_b) for m in contacts] == [(floor, body, 1, 3, 2**40)]
    world.set_user_data(body, 4)
    assert world.contact_manifolds()[0].user_data_b == 4
    gap, = world.penetration()
    assert gap.piece_a == 0 and gap.piece_b == 1 and gap.distance == pytest.approx(-0.01)
    hit = world.first_hit((0, 0, 5), (0, 0, -1))
    assert hit.body == body and hit.piece == 0
    with pytest.raises(abut.Error, match="piece"):
        abut.Compound([])
    with pytest.raises(TypeError):
        abut.Compound([3])


def test_a_solid_as_convex_pieces():
    box = abut.Model([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)],
                     [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    world = abut.World()
    world.add(abut.Compound(abut.ConvexPieces(box)))
    world.add(abut.Sphere((1.5, 0.5, 0.5), 1))
    assert len(world.collide()) == 1


def test_ids_know_their_world():
    first, second = abut.World(), abut.World()
    ball = abut.Sphere((0, 0, 0), 1)
    a, b = first.add(ball), second.add(ball)
    assert isinstance(a, int) and isinstance(a, abut.BodyId) and a == b == 0 and hash(a) == hash(b)
    motion = abut.Motion.fixed(None)
    for use in (lambda: first.move(b, None), lambda: first.remove(b), lambda: first.box(b), lambda: first.set_options(b),
                lambda: first.time_of_impact({b: motion}), lambda: first.time_of_impact([(b, motion)]),
                lambda: first.time_to_collision(a, b), lambda: first.set_speed(b)):
        with pytest.raises(abut.Error, match="body 0: is a body of another world"):
            use()
    assert first.is_valid(a) and not first.is_valid(b)
    first.move(a, matrix((1, 0, 0)))
    # The ids of single results know it too; arrays and filters have plain integers, which any world takes.
    seen = first.first_hit((-9, 0, 0), (1, 0, 0)).body
    assert first.is_valid(seen) and not second.is_valid(seen)
    assert second.is_valid(0) and second.is_valid(np.array([a])[0])
    # It is an int wherever one is wanted: as a key, an index, in an array, in a pickle.
    assert {a: "x"}[0] == "x" and [5][a] == 5 and np.arange(3)[[a, a]].tolist() == [0, 0] and np.array([a]).dtype.kind == "i"
    assert pickle.loads(pickle.dumps(a)) == 0 and type(pickle.loads(pickle.dumps(a))) is int
    assert (a.index, a.generation, abut.BodyId(3).world) == (0, 0, 0) and a.world != b.world
    # An id outlives its world.
    del second
    gc.collect()
    assert not first.is_valid(b) and abut.World().add(ball).world not in (a.world, b.world)
    first.remove(a)
    for _ in range(3):
        first.update()
    again = first.add(ball)
    assert (again.index, again.generation) == (0, 1) and again == 1 << 32


def test_indices_end_behind_the_pieces_of_compounds():
    world = abut.World()
    ball = abut.Sphere((0, 0, 0), 1)
    ids = [world.add(abut.Compound([ball, (ball, matrix((3, 0, 0))), (ball, matrix((6, 0, 0)))]), matrix((0, 4 * i, 0))) for i in range(3)]
    assert [body.index for body in ids] == [0, 3, 6] and len(world) == 3
    assert world.index_end() == 9


def test_convex_pieces_are_a_body():
    world = abut.World()
    solid = abut.ConvexPieces(abut.Model(*box()))
    world.add(solid)
    world.add(abut.Compound(solid), matrix((0.5, 0, 0)))
    assert world.collide().tolist() == [[0, 1]]
    with pytest.raises(TypeError, match="Compound, ConvexPieces or Deformable"):
        world.add("box")


def test_a_matrix_with_nan_is_said_to_have_one():
    world = abut.World()
    for place in ((3, 3), (3, 0), (0, 0), (2, 1)):
        bad = np.eye(4)
        bad[place] = np.nan
        with pytest.raises(ValueError, match="the matrix has a value that is not finite"):
            world.add(abut.Sphere((0, 0, 0), 1), bad)
    with pytest.raises(ValueError, match="last row"):
        world.add(abut.Sphere((0, 0, 0), 1), np.ones((4, 4)))
