"""Blocks of code and code spans of Markdown pages."""
import pathlib
import re
import subprocess


def pages(source):
    """The Markdown files of the repository."""
    names = subprocess.check_output(["git", "ls-files", "-co", "--exclude-standard", "*.md"], cwd=source, text=True)
    return [name for name in names.splitlines() if (pathlib.Path(source) / name).is_file()]


def blocks(text):
    """Fenced blocks: (language, line of the first line of code, code, the lines above the fence)."""
    lines, found, i = text.split("\n"), [], 0
    while i < len(lines):
        fence = re.match(r"^ *```(\w*)\s*$", lines[i])
        i += 1
        if not fence:
            continue
        begin = i
        while i < len(lines) and not re.match(r"^ *```\s*$", lines[i]):
            i += 1
        found.append((fence[1], begin + 1, "\n".join(lines[begin:i]), "\n".join(lines[max(0, begin - 8):begin - 1])))
        i += 1
    return found


def spans(text):
    """Code spans outside of blocks, with their lines."""
    plain = re.sub(r"^ *```.*?^ *```", lambda block: "\n" * block[0].count("\n"), text, flags=re.M | re.S)
    for span in re.finditer(r"`([^`]+)`", plain):
        yield plain[:span.start()].count("\n") + 1, " ".join(span[1].split())
