"""Motions in a walk: rays, sweeps, paths, a carried part and a person."""

import json

import numpy as np
import pytest

import abut
from shapes import box, matrix, random_poses, sphere


@pytest.fixture
def walk(tmp_path):
    """A floor of 20 by 20 at z = 0, a wall at x = 3, and a crate on the floor."""
    meshes = [abut.Mesh(*box((20, 20, 0.2))), abut.Mesh(*box((0.2, 20, 3))), abut.Mesh(*box((0.5, 0.5, 0.5)))]
    parts = [abut.Part("floor", 0, matrix((0, 0, -0.1)), colour=abut.Colour(10, 20, 30)),
             abut.Part("wall", 1, matrix((3.1, 0, 1.5))), abut.Part("crate", 2, matrix((0, 2, 0.26)))]
    abut.write_glb(abut.Scene(meshes, parts, file="room.glb", up="z"), tmp_path / "room.glb")
    abut.import_models(tmp_path / "room.glb", tmp_path / "room.abut")
    with abut.open_store(tmp_path / "room.abut") as store:
        return abut.Walk(store, memory=64 << 20)


def numbers(walk):
    return {walk.name(number).id: number for number in (1, 2, 3)}


def up_of(walk):
    """The matrix that turns z up into the store's up axis: glTF is y up."""
    floor = numbers(walk)["floor"]
    return walk.world_from_part(floor) @ np.linalg.inv(matrix((0, 0, -0.1)))


def test_rays_and_sweeps(walk):
    part, turn = numbers(walk), up_of(walk)
    eye, along = (turn @ (0, 0, 1, 1))[:3], (turn @ (1, 0, 0, 0))[:3]
    hit = walk.first_hit(eye, along)
    assert hit and hit.part == part["wall"] and hit.t == pytest.approx(3, abs=1e-5) and hit.complete
    assert not walk.first_hit(abut.Ray(eye, along, 0, 2))
    ball = abut.Sphere((0, 0, 0), 0.5)
    first = walk.sweep(ball, turn @ matrix((0, 0, 1)), 10 * along)
    assert first.meet and first.impact.part == part["wall"]
    assert first.impact.time == pytest.approx(0.25, abs=1e-3) and first.time_free <= first.impact.time
    start = abut.Pose.from_matrix(turn @ matrix((0, 0, 1)))
    motion = abut.Motion(start, velocity=10 * along)
    assert walk.time_of_impact(ball, motion).impact.time == pytest.approx(first.impact.time, abs=1e-6)
    assert walk.parts_in_way(ball, motion).parts.part.tolist() == [part["wall"]]
    assert not walk.time_of_impact(ball, motion, except_part=part["wall"])


def test_parts_at_their_places(walk):
    part = numbers(walk)
    near = walk.distance(part["crate"])
    assert near.gap.part == part["floor"] and near.gap.distance == pytest.approx(0.01, abs=1e-5)
    assert walk.within(part["crate"], None, 0.1).parts.part.tolist() == [part["floor"]]
    assert walk.collide(part["floor"]).parts.tolist() == [part["wall"]]
    with pytest.raises(ValueError, match="None"):
        walk.distance(part["crate"], np.eye(4))


def test_paths_and_a_carried_part(walk):
    part, turn = numbers(walk), up_of(walk)
    crate = abut.carried_part(walk, part["crate"])
    assert len(crate.model.faces) == 12
    way = [turn @ matrix(place) @ np.linalg.inv(turn) for place in ((0, 0, 0), (0, 0, 1), (5, 0, 1))]
    poses = np.array([step @ crate.pose.matrix() for step in way])
    report = abut.check_path(walk, part["crate"], poses)
    assert not report and not report.is_free and report.poses == 3 and report.length == pytest.approx(6)
    assert [contact.impact.part for contact in report.contacts] == [part["wall"]]
    assert 1.5 < report.contacts[0].time < 1.6  # the crate's side is 2.75 from the wall, of 5
    assert json.loads(abut.to_json(report, walk))["contacts"]
    assert abut.check_path(walk, part["crate"], poses[:2]).is_free
    hand = abut.Carry(walk, part["crate"])
    assert hand.part == part["crate"] and not hand.move_to(poses[1]).blocked
    step = hand.move_to(poses[2])
    assert step.blocked and step.contacts.part.tolist() == [part["wall"]] and step.near.part.tolist() == [part["wall"]]
    in_wall = turn @ matrix((3.1, 0, 1)) @ np.linalg.inv(turn) @ crate.pose.matrix()
    assert hand.move_to(in_wall, mode="through").touched.part.tolist() == [part["wall"]]


def test_a_person(walk):
    turn = up_of(walk)
    feet, along = (turn @ (0, 0, 0.5, 1))[:3], (turn @ (1, 0, 0, 0))[:3]
    up = "xyz"[np.abs((turn @ (0, 0, 1, 0))[:3]).argmax()]
    person = abut.Walker(walk, feet, up=up, missing="wait")
    for _ in range(100):
        state = person.step(1.5 * along, 0.05)
    assert state.on_ground and state.blocked
    assert state.feet @ along == pytest.approx(2.7, abs=0.05)  # radius 0.3 before the wall at 3
    assert abs((np.linalg.inv(turn) @ (*state.feet, 1))[2]) < 0.05
    person.set_mode("fly")
    assert person.mode is abut.WalkerMode.fly and person.capsule.radius == pytest.approx(0.3)
    person.move_to(feet)
    assert np.allclose(person.state.feet, feet, atol=0.1) and person.step((0, 0, 0), 0.1).way.shape[1] == 3
    with pytest.raises(TypeError, match="wings"):
        abut.Walker(walk, feet, wings=2)
    with pytest.raises(abut.Error):
        abut.Walker(walk, feet, radius=-1)


def test_they_keep_the_walk(walk):
    feet = (up_of(walk) @ (0, 0, 0.5, 1))[:3]
    person, hand = abut.Walker(walk, feet), abut.Carry(walk, numbers(walk)["crate"])
    del walk
    assert person.state.feet.shape == (3,) and not hand.state.blocked


def test_levels_and_colours(tmp_path, rng):
    parts = [abut.Part(f"p{i}", 0, pose, colour=abut.Colour(255, 0, i)) for i, pose in enumerate(random_poses(rng, 20, 5))]
    path = tmp_path / "scene.glb"
    abut.write_glb(abut.Scene([abut.Mesh(*sphere(20))], parts, file="scene.glb"), path)
    again = abut.read_scene(path)
    assert [str(part.colour) for part in again.parts] == [f"#ff00{i:02x}" for i in range(20)]
    store_path = tmp_path / "scene.abut"
    abut.import_models(path, store_path)
    with abut.open_store(store_path) as store:
        assert not abut.has_levels(store)
    assert abut.build_levels(store_path).built
    with abut.open_store(store_path) as store:
        assert abut.has_levels(store)
