"""Changed copies of model files: one part moves or gets another name, its id stays."""
import json
import re
import struct

from step import read


def moved_ifc(path, to, guid, offset):
    """Moves a product by (x, y, z) in the file's units, as another placement, and renames it."""
    lines = read(path)
    number, (kind, values) = next((number, line) for number, line in lines.items() if line[1][:1] == [guid])
    placement = lines[values[5]]
    axes = lines[placement[1][1]]
    point = lines[axes[1][0]][1][0]
    last = max(lines)
    written = lambda value: "$" if value is None else f"#{int(value)}"
    added = (f"#{last + 1}=IFCCARTESIANPOINT(({','.join(repr(float(p) + d) for p, d in zip(point, offset))}));\n"
             f"#{last + 2}=IFCAXIS2PLACEMENT3D(#{last + 1},{written(axes[1][1])},{written(axes[1][2])});\n"
             f"#{last + 3}=IFCLOCALPLACEMENT({written(placement[1][0])},#{last + 2});\n")
    text = open(path, encoding="latin-1", newline="").read()
    begin = re.search(rf"#{number}\s*=\s*{kind}\s*\(", text, re.I)
    assert begin, f"#{number} is not in the text"
    head, tail = text[:begin.end()], text[begin.end():]
    tail = re.sub(rf"#{int(values[5])}(?!\d)", f"#{last + 3}", tail, count=1)
    end = tail.rindex("ENDSEC")
    open(to, "w", encoding="latin-1", newline="").write(head + tail[:end] + added + tail[end:])


def moved_glb(path, to, name, offset):
    data = open(path, "rb").read()
    size = struct.unpack("<I", data[12:16])[0]
    document = json.loads(data[20:20 + size])
    node = next(each for each in document["nodes"] if each.get("name") == name)
    if "matrix" in node:
        node["matrix"][12:15] = [a + b for a, b in zip(node["matrix"][12:15], offset)]
    else:
        node["translation"] = [a + b for a, b in zip(node.get("translation", [0, 0, 0]), offset)]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + size:]
    head = b"glTF" + struct.pack("<III", 2, 20 + len(text) + len(rest), len(text)) + b"JSON"
    open(to, "wb").write(head + text + rest)
