"""The notebooks are those that examples/python/notebooks/make writes, and their cells run."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples/python/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
SAID = {"building_clashes": "3 hard, 1 touch", "cloth_step": " 0 vertices in the ball", "distance_field": "4900 points",
        "robot_trajectory": "folded back: free"}


def test_every_program_has_a_notebook():
    assert {path.stem for path in NOTEBOOKS} == {path.stem for path in FOLDER.parent.glob("*.py")} == SAID.keys()


def test_notebooks_are_up_to_date(tmp_path):
    subprocess.run([sys.executable, FOLDER / "make", tmp_path], check=True)
    for path in NOTEBOOKS:
        assert (tmp_path / path.name).read_text() == path.read_text(), f"run {FOLDER / 'make'}"


def run_cells(path):
    """Runs the cells of code in turn, as Jupyter does, and returns what they print."""
    names, said = {"__name__": "__main__"}, io.StringIO()
    with contextlib.redirect_stdout(said):
        for number, cell in enumerate(json.loads(path.read_text())["cells"], 1):
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), f"{path.name}, cell {number}", "exec"), names)
    return said.getvalue()


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_cells_run(path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    assert SAID[path.stem] in run_cells(path)


@pytest.mark.skipif(not all(map(importlib.util.find_spec, ("nbconvert", "ipykernel"))), reason="nbconvert is not installed")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_jupyter_runs_them(path, tmp_path):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "HOME": str(tmp_path)}
    result = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", tmp_path, path],
                            env=environment, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    cells = json.loads((tmp_path / path.name).read_text())["cells"]
    said = "".join("".join(output.get("text", "")) for cell in cells for output in cell.get("outputs", []))
    assert SAID[path.stem] in said
