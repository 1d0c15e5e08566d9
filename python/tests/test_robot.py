"""Robots: files, queries of one and of many configurations."""

import numpy as np
import pytest

import abut

URDF = """<robot name="arm">
  <link name="base"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
  <joint name="shoulder" type="continuous"><origin xyz="1 0 0"/><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="revolute"><origin xyz="1 0 0"/><parent link="upper"/><child link="lower"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
</robot>
"""


@pytest.fixture
def description(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(URDF)
    return abut.read_robot(path)


def test_description(description):
    assert [link.name for link in description.links] == ["base", "upper", "lower"]
    assert description.joints[1].type == abut.JointType.revolute
    assert description.joints[1].limits.upper == 3
    assert description.links[0].shapes[0].mesh.faces.shape == (12, 3)
    robot = abut.Robot(description)
    assert robot.pairs == [(0, 2)]
    assert [variable.name for variable in robot.variables] == ["shoulder", "elbow"]
    assert robot.default_configuration().tolist() == [0, 0]
    assert robot.beyond_limits([0, 3.5]) == [1]
    assert np.allclose(robot.link_transforms([np.pi / 2, 0])[2][:3, 3], [1, 1, 0])


def test_one_configuration(description):
    robot = abut.Robot(description)
    right_angles = [np.pi / 2, np.pi / 2]
    gap = abut.distance(robot, right_angles)
    assert gap.distance == pytest.approx(0.9)
    assert (gap.pair.link, gap.pair.other) == (0, 2)
    assert abut.collide(robot, right_angles) == []
    assert len(abut.collide(robot, [np.pi, np.pi])) == 1
    impact = abut.time_of_impact(robot, right_angles, [np.pi, np.pi])
    assert impact and 0 < impact.time <= impact.contact_time <= 1


def test_many_configurations(description):
    robot = abut.Robot(description)
    rng = np.random.default_rng(1)
    configurations = rng.uniform(-3, 3, (200, 2))
    gaps = abut.distance(robot, configurations)
    meet = abut.collide(robot, configurations)
    assert gaps.distance.shape == meet.shape == (200,)
    assert ((gaps.distance == 0) == meet).all()
    assert 0 < meet.sum() < 200
    for i in range(0, 200, 20):
        assert abut.distance(robot, configurations[i]).distance == gaps.distance[i]


def test_obstacles(description):
    robot = abut.Robot(description)
    vertices = np.array([[2.5, -1, -1], [2.5, 1, -1], [2.5, 0, 1]])
    wall = abut.RobotObstacles([abut.RobotObstacle("wall", abut.Model(vertices, [[0, 1, 2]]))])
    pairs = abut.collide(robot, [0, 0], obstacles=wall)
    assert [(pair.link, pair.other, pair.is_obstacle) for pair in pairs] == [(2, 0, True)]
    assert abut.collide(robot, [0, 0], obstacles=wall, self_pairs=False) == pairs


def test_allowed_pairs(description, tmp_path):
    robot = abut.Robot(description)
    pairs = abut.propose_allowed_pairs(robot, samples=100)
    assert {pair.reason for pair in pairs} == {abut.AllowReason.adjacent}
    abut.write_srdf(description, pairs, tmp_path / "arm.srdf")
    again = abut.read_srdf(tmp_path / "arm.srdf", description)
    assert [(pair.a, pair.b) for pair in again.allowed] == [(0, 1), (1, 2)]
    assert abut.Robot(description, allowed=[abut.AllowedPair(0, 2)]).pairs == []


def test_errors(description, tmp_path):
    robot = abut.Robot(description)
    with pytest.raises(ValueError):
        abut.collide(robot, [0, 0, 0])
    with pytest.raises(abut.Error):
        abut.collide(robot, [0, np.nan])
    (tmp_path / "bad.urdf").write_text("<robot name='a'><link name='a'/><link name='a'/></robot>")
    with pytest.raises(abut.Error, match="line 1: the link 'a' is defined twice"):
        abut.read_robot(tmp_path / "bad.urdf")
