"""Assemblies in motion: made in Python, and read from a file."""

import math

import numpy as np
import pytest

import abut

CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
FACES = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
         [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]]


@pytest.fixture
def assembly():
    cube = abut.Model(CUBE, FACES)
    slide = abut.AssemblyJoint("prismatic", axis=(1, 0, 0), limits=(0, 20), keys=abut.JointKeys([0, 2], [0, 10]))
    wall = abut.AssemblyPart("wall", cube, pose=abut.Pose((5, 0.5, 0.5)))
    return abut.Assembly([wall, abut.AssemblyPart("box", cube, joint=slide)])


def test_clashes(assembly, tmp_path):
    assert abut.time_range(assembly) == (0, 2)
    assert np.allclose(abut.part_transforms(assembly, 1)[1][:3, 3], [5, 0, 0])
    report = abut.find_motion_clashes(assembly, clearance=0.5)
    assert (report.pairs, report.near, len(report.clashes)) == (1, 1, 1)
    clash = report.clashes[0]
    assert clash.kind == abut.MotionClashKind.contact and clash.status == abut.Status.exact
    assert clash.contacts[0].start == pytest.approx(0.8, abs=1e-5)
    assert clash.contacts[0].end == pytest.approx(1.2, abs=1e-5)
    assert clash.approaches[0].start == pytest.approx(0.7, abs=1e-5)
    assert 0.4 < clash.depth <= clash.depth_at_most
    abut.write_motion_csv(report, assembly, tmp_path / "m.csv")
    abut.write_motion_html(report, assembly, tmp_path / "m.html")
    assert len((tmp_path / "m.csv").read_text().splitlines()) == 3
    assert "<svg" in (tmp_path / "m.html").read_text()


def test_slider_crank():
    cube = abut.Model(0.1 * CUBE, FACES)
    crank = abut.AssemblyJoint("revolute", keys=abut.JointKeys([0, 1], [0, 2 * math.pi]))
    parts = [abut.AssemblyPart("crank", cube, joint=crank),
             abut.AssemblyPart("rod", cube, on=0, joint=abut.AssemblyJoint("revolute", origin=(1, 0, 0))),
             abut.AssemblyPart("piston", cube, joint=abut.AssemblyJoint("prismatic", axis=(1, 0, 0)))]
    engine = abut.Assembly(parts, loops=[abut.AssemblyLoop(1, 2, (4, 0, 0))])
    for time in (0.1, 0.4):
        angle = 2 * math.pi * time
        shift = math.cos(angle) + math.sqrt(9 - math.sin(angle) ** 2) - 4
        assert abut.part_transforms(engine, time)[2][0, 3] == pytest.approx(shift)


def test_file(tmp_path):
    (tmp_path / "cube.off").write_text("OFF\n8 12 0\n" + "\n".join("%g %g %g" % tuple(p) for p in CUBE) + "\n" +
                                       "\n".join("3 %d %d %d" % tuple(f) for f in FACES))
    path = tmp_path / "a.toml"
    text = """[[parts]]
name = "wheel"
model = "cube.off"
joint = { type = "revolute", axis = [0, 0, 1] }
times = [0, 1]
values = [0, 90]
[[parts]]
name = "pinion"
model = "cube.off"
joint = { type = "revolute", origin = [4, 0, 0], follow = "wheel", ratio = -2 }
"""
    path.write_text(text)
    assembly = abut.read_assembly(path)
    assert [part.name for part in assembly.parts] == ["wheel", "pinion"]
    assert assembly.parts[0].joint.keys.values == pytest.approx([0, math.pi / 2])
    assert assembly.parts[1].joint.follow.ratio == -2
    path.write_text(text.replace('"wheel"\nmodel', '"gear"\nmodel'))
    with pytest.raises(abut.Error, match="follow names no part"):
        abut.read_assembly(path)
