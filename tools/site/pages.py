"""The pages of the repository as mkdocs wants them, with the files that they link to."""
import os
import pathlib
import re
import shutil
import subprocess

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s#]*)(#[^)\s]*)?\)")
FENCE = re.compile(r"^ *(```|~~~)")
ITEM = re.compile(r"^( *)([-*]|\d+\.) +")
LEXERS = {".h": "cpp", ".cpp": "cpp", ".py": "python", ".mjs": "js", ".js": "js", ".cmake": "cmake"}


def split_code(text):
    """Pairs (is code, lines) of a page, fences included in the code."""
    parts, inside = [], False
    for line in text.split("\n"):
        fence = bool(FENCE.match(line))
        code = inside or fence
        if not parts or parts[-1][0] != code or (fence and not inside):
            parts.append((code, []))
        parts[-1][1].append(line)
        if fence:
            inside = not inside
            if not inside:
                parts.append((False, []))
    return parts


def for_python_markdown(text):
    """GitHub's Markdown as Python-Markdown reads it: a list, a table and a fence need an empty line before
    them, and what belongs to an item four spaces; a bar in a code span of a table needs no backslash."""
    out, item, fence_margin = [], False, 0
    for code, lines in split_code(text):
        for i, line in enumerate(lines):
            if not code and i == 0 and line.strip() and out:
                out.append("")  # after a fence
            begun = ITEM.match(line)
            margin = len(line) - len(line.lstrip(" "))
            if code:
                if i == 0:
                    fence_margin = margin if item else 0
                    if out and out[-1].strip():
                        out.append("")
                out.append(" " * (4 * ((fence_margin + 3) // 4)) + line[fence_margin:] if fence_margin else line)
                continue
            if begun and not item and out and out[-1].strip() and not out[-1].startswith("#"):
                out.append("")
            if line.startswith("|") and out and out[-1].strip() and not out[-1].startswith("|"):
                out.append("")
            if line.strip():
                item = bool(begun) or (item and (margin > 0 or bool(out and out[-1].strip())))
            if item and 0 < margin:
                line = " " * (4 * ((margin + 3) // 4)) + line.lstrip(" ")
            if line.startswith("|"):
                line = re.sub(r"`[^`]*`", lambda span: span[0].replace("\\|", "|"), line)
            out.append(line)
    return "\n".join(out)


class Site:
    """Copies pages to a folder, and with each page the pages, pictures and sources it links to."""

    def __init__(self, root, out):
        self.root, self.out = root, out
        listed = subprocess.check_output(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, text=True)
        self.files = {name for name in listed.splitlines() if (root / name).is_file()}
        self.done = set()
        self.faults = []
        self.sources = []  # the pages that show a source

    def add(self, names, edit=lambda name, text: text):
        """Adds pages and all that they lead to."""
        waiting = list(names)
        while waiting:
            name = waiting.pop()
            if name in self.done:
                continue
            self.done.add(name)
            if not name.endswith(".md"):
                self.copy(name)
                continue
            text = edit(name, (self.root / name).read_text())
            parts = []
            for code, lines in split_code(text):
                part = "\n".join(lines)
                parts.append(part if code else LINK.sub(lambda link: self.linked(name, link, waiting), part))
            self.write(name, for_python_markdown("\n".join(parts)))

    def linked(self, name, link, waiting):
        mark, text, target, anchor = link[1], link[2], link[3], link[4] or ""
        if not target or re.match(r"[a-z]+:", target):
            return link[0]
        if "[" in text:  # a picture in a link
            text = LINK.sub(lambda inner: self.linked(name, inner, waiting), text)
        path = (self.root / name).parent / target
        to = path.resolve().relative_to(self.root).as_posix()
        if path.is_dir():
            inside = f"{to}/README.md"
            if inside in self.files:
                waiting.append(inside)
            elif to != "bench/results":  # its README.md is made
                self.faults.append(f"{name}: links to the folder {target}, which has no README.md")
            target = target.rstrip("/") + "/README.md"
        elif to.startswith("docs/schema/") and to.endswith(".schema.json") and to in self.files:  # its page is made
            page = f"reference/json/{path.name.removesuffix('.schema.json')}.md"
            return f"[{text}]({os.path.relpath(page, pathlib.PurePath(name).parent)})"
        elif to not in self.files:
            self.faults.append(f"{name}: links to {target}, which is not there")
        else:
            waiting.append(to)
            if not mark and not to.endswith((".md", ".png", ".svg")):
                target += ".md"
        if mark and target.endswith(".svg"):
            return self.figure(path, text)
        return f"{mark}[{text}]({target}{anchor})"

    def figure(self, path, text):
        """A drawing as a part of the page, so that it is dark where the page is."""
        drawing = path.read_text()
        style = re.search(r"<style>(.*?)</style>", drawing, re.S)
        drawing = drawing.replace(style[0], "")
        drawing = re.sub(r"<title>.*?</title>\n?", "", drawing)
        drawing = re.sub(r'(<svg [^>]*?) width="\d+" height="\d+"', r"\1", drawing, count=1)
        light, _, dark = style[1].partition("@media (prefers-color-scheme: dark){")
        rules = scoped(light, ".figure ") + scoped(dark, '[data-md-color-scheme="slate"] .figure ')
        width = re.search(r'viewBox="0 0 (\d+)', drawing)[1]
        label = re.sub(r"\s+", " ", text).replace('"', "'")
        drawing = drawing.replace('role="img"', f'role="img" aria-label="{label}" style="max-width:{width}px"', 1)
        return f"\n<figure class=\"figure\"><style>{rules}</style>{drawing.strip()}</figure>\n"

    def copy(self, name):
        """A picture as it is, a source as a page."""
        if name.endswith((".png", ".svg")):
            (self.out / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.root / name, self.out / name)
            return
        path = pathlib.PurePath(name)
        text = (self.root / name).read_text(errors="replace").rstrip("\n")
        lexer = LEXERS.get(path.suffix, "bash" if text.startswith("#!/usr/bin/env bash") else "text")
        self.sources.append(name)
        self.write(name + ".md", f"# {path.name}\n\n`{name}`\n\n````{lexer}\n{text}\n````\n")

    def write(self, name, text):
        (self.out / name).parent.mkdir(parents=True, exist_ok=True)
        (self.out / name).write_text(text)


def scoped(rules, before):
    """Rules of a style sheet that hold below `before` only."""
    return "".join(f"{before}{names.strip()}{{{body}}}" for names, body in re.findall(r"([^{}]+)\{([^{}]*)\}", rules))
