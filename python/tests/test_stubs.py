"""The type stubs in the repository are those of the module."""

import ast
import pathlib
import subprocess
import sys

import abut

PYTHON = pathlib.Path(__file__).resolve().parents[1]


def test_stubs_match_the_module():
    made = subprocess.run([sys.executable, PYTHON / "packaging/make_stubs.py"], capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    assert made.stdout == (PYTHON / "abut/__init__.pyi").read_text(), "run python/packaging/make_stubs.py"


def test_stubs_name_everything():
    tree = ast.parse((PYTHON / "abut/__init__.pyi").read_text())
    names = {node.name for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    names |= {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
    assert set(abut.__all__) <= names


def test_everything_has_a_docstring():
    nameless = [name for name in abut.__all__ if not getattr(abut, name).__doc__]
    assert not nameless
