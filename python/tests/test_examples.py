"""The examples run and print what they promise."""

import pathlib
import re
import subprocess
import sys

import abut
import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples/python"


def run(name, *arguments):
    result = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_every_example_is_tested():
    source = pathlib.Path(__file__).read_text()
    assert all(f'"{path.name}"' in source for path in EXAMPLES.glob("*.py"))


def test_building_clashes(tmp_path):
    text = run("building_clashes.py", "--html", tmp_path / "report.html")
    rows = [line.split(" m  ")[1] for line in text.splitlines() if " | " in line]
    assert rows == ["column 01 | through pipe", "column 11 | through pipe", "column 21 | through pipe",
                    "first slab | touching pipe", "first slab | close pipe"]
    assert "3 hard, 1 touch, 0 contained, 0 duplicate, 1 clearance" in text
    assert (tmp_path / "report.html").stat().st_size > 1000


def test_picture_of_the_worst_clash(tmp_path):
    try:
        abut.picture([abut.Scene([abut.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])], [abut.Part("p")])], width=8, height=8)
    except abut.Error as error:
        pytest.skip(str(error))
    run("building_clashes.py", "--png", tmp_path / "worst.png")
    assert (tmp_path / "worst.png").read_bytes().startswith(b"\x89PNG")


def test_robot_trajectory():
    lines = run("robot_trajectory.py").splitlines()
    assert lines[3].startswith("around the base: link 3 meets the cell after") and lines[3].endswith("of motion 3")
    assert lines[-1] == "folded back: free, between the waypoints too"
    # More waypoints of the same trajectory: the contact is found at the same angle.
    finer = run("robot_trajectory.py", "--waypoints", 33).splitlines()[3]
    coarse, fine = (re.search(r"after (\S+) % of motion (\d+)", text).groups() for text in (lines[3], finer))
    assert (int(coarse[1]) + float(coarse[0]) / 100) / 8 == pytest.approx((int(fine[1]) + float(fine[0]) / 100) / 32, abs=0.01)


def test_cloth_step():
    text = run("cloth_step.py", "--steps", 40, "--cells", 12)
    impacts, inside = map(int, re.search(r"(\d+) impacts; (\d+) vertices in the ball", text).groups())
    assert impacts > 50 and inside == 0


def test_distance_field(tmp_path):
    text = run("distance_field.py")
    total, inside, least, most = re.search(r"(\d+) points, (\d+) inside, from (\S+) to (\S+)", text).groups()
    assert int(total) == 4900 and 300 < int(inside) < 1500
    assert float(least) == pytest.approx(-0.39, abs=0.02) and 0.9 < float(most) < 1.3
    assert text.count("#") > 100


def test_distance_field_as_a_picture(tmp_path):
    pytest.importorskip("matplotlib")
    run("distance_field.py", "--png", tmp_path / "field.png")
    assert (tmp_path / "field.png").read_bytes().startswith(b"\x89PNG")
