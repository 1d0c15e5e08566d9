"""The programs of docs/python.md and docs/python-scenes.md run in turn, and print what their comments say."""

import contextlib
import io
import os
import pathlib
import re

import abut
import abut.manager

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


def test_python_pages(tmp_path):
    text = "".join((DOCS / page).read_text() for page in ("python.md", "python-scenes.md"))
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
    assert len(blocks) >= 9
    names, here = {}, os.getcwd()
    os.chdir(tmp_path)
    try:
        for block in blocks:
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(block, names)
            promised = re.findall(r"^print\(.*\)\s+# (.*)$", block, re.M)
            for line in promised:
                if "…" not in line and "fields" not in line:
                    assert line in printed.getvalue().splitlines()
    finally:
        os.chdir(here)


def test_names_of_the_moving_page():
    """Every `abut.name(…keyword=…)` of the page is there."""
    text = (DOCS / "python-moving.md").read_text()
    names = set(re.findall(r"\babut\.([A-Za-z_.0-9]+)", text))
    assert len(names) > 15
    for name in names:
        value = abut
        for word in name.rstrip(".").split("."):
            value = getattr(value, word)
    for keyword in ("mode", "segments", "signed_distance", "volume", "warm_start"):
        assert f"{keyword}=" in text and any(keyword in (getattr(abut, n).__doc__ or "") for n in ("collide", "distance", "Model"))
