"""Reads the data of an IFC file as text, without any library: an independent oracle.

`read(path)` returns {number: (CLASS, [attributes])}. An attribute is None ($ and *), a str, a Word
(a number or an enumeration, as written), a Reference, a list, or a Typed value.
"""
import io
import re
import zipfile


class Word(str):
    """A number or an enumeration as written."""


class Reference(int):
    """#12"""


class Typed:
    """IFCLABEL('F60')"""
    def __init__(self, name, value):
        self.name, self.value = name, value


TOKEN = re.compile(r"\s*(?:/\*.*?\*/\s*)*('(?:[^']|'')*'|#\d+|[(),;=$*]|\.[A-Za-z0-9_]+\.|[A-Za-z_][A-Za-z0-9_]*|\"[^\"]*\"|[-+0-9.eE]+)",
                   re.S)
ESCAPE = re.compile(r"''|\\\\|\\S\\(.)|\\X\\([0-9A-F]{2})|\\X2\\([0-9A-F]*)\\X0\\|\\X4\\([0-9A-F]*)\\X0\\|\\P.\\", re.S)


def decoded(text):
    def one(match):
        latin, byte, wide, wider = match.groups()
        if latin is not None:
            return bytes([ord(latin) + 128]).decode("latin-1")
        if byte is not None:
            return bytes.fromhex(byte).decode("latin-1")
        if wide is not None:
            return bytes.fromhex(wide).decode("utf-16-be", "replace")
        if wider is not None:
            return bytes.fromhex(wider).decode("utf-32-be", "replace")
        return {"''": "'", "\\\\": "\\"}.get(match.group(), "")
    return ESCAPE.sub(one, text)


def attributes(tokens, at):
    """The list that begins behind a parenthesis, and the place behind its end."""
    values = []
    while True:
        token = tokens[at]
        at += 1
        if token == ")":
            return values, at
        if token == ",":
            continue
        if token == "(":
            value, at = attributes(tokens, at)
        elif token in "$*":
            value = None
        elif token[0] == "'":
            value = decoded(token[1:-1])
        elif token[0] == "#":
            value = Reference(token[1:])
        elif tokens[at] == "(":
            inner, at = attributes(tokens, at + 1)
            value = Typed(token.upper(), inner[0] if inner else None)
        else:
            value = Word(token)
        values.append(value)


def read(path):
    data = open(path, "rb").read()
    if str(path).lower().endswith(".ifczip"):
        archive = zipfile.ZipFile(io.BytesIO(data))
        data = archive.read(next(name for name in archive.namelist() if name.lower().endswith(".ifc")))
    text = data.decode("utf-8", "surrogateescape")
    text = text[text.index("DATA;") + 5:]
    tokens = TOKEN.findall(text)
    lines, at = {}, 0
    while at + 3 < len(tokens) and tokens[at] != "ENDSEC":
        number, name = int(tokens[at][1:]), tokens[at + 2].upper()
        values, at = attributes(tokens, at + 4)
        lines[number] = (name, values)
        at += 1  # the semicolon
    return lines
