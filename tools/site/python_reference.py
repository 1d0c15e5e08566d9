"""The reference of the Python module, from its stubs: python/abut/__init__.pyi, which has the docstrings.

A page a room of python/src; what a source binds stands on the page of its room, in the order of the stubs.
"""
import ast
import html
import re

ROOMS = {
    "": ("Types, errors, shapes", "Poses, boxes, simple shapes, errors, threads."),
    "models": ("Models and scenes", "Meshes, models, parts, files."),
    "queries": ("Queries of one or two models", "Contact, distance, depth, times of impact, rays, points; convex bodies and pieces."),
    "bodies": ("Bodies that move or deform", "Worlds, broad phases, deformable surfaces."),
    "robots": ("Robots", "Arms from URDF and SRDF: contact, distance, times of impact of configurations."),
    "assemblies": ("Assemblies in motion", "Parts on joints over time, and the clashes between them."),
    "stores": ("Stores and clashes", "Models larger than memory, clash jobs, reviews, levels of detail."),
    "walks": ("Walks", "What is near someone who walks through a plant, and what is carried."),
    "pictures": ("Pictures and views", "Cameras, tours, pictures, what a renderer draws."),
}


def rooms_of(root):
    """The room of each name: that of the source that has it as a literal."""
    found = {}
    # A verb that several rooms have belongs to the first.
    order = list(ROOMS)
    paths = [path for path in sorted((root / "python/src").rglob("*.cpp")) if path.parent.name in (*ROOMS, "src")]
    for path in sorted(paths, key=lambda path: order.index(path.parent.name.replace("src", ""))):
        room = path.parent.name.replace("src", "")
        for name in re.findall(r'"([A-Za-z_]\w*)"', path.read_text()):
            found.setdefault(name, room)
    return found


def doc_of(node):
    """The docstring: paragraphs as they are, indented or aligned ones as code."""
    text = ast.get_docstring(node) or ""
    parts = []
    for part in text.split("\n\n"):
        if re.search(r"^\S+  +\S|\n {2,}\S", part):
            parts.append(f"```text\n{part}\n```")
        elif part:
            parts.append(re.sub(r"([<>*_])", r"\\\1", part))
    return "\n\n".join(parts)


def signature(node):
    words = ast.unparse(node.args).replace("self, ", "", 1) if node.args.args and node.args.args[0].arg == "self" else ast.unparse(node.args)
    words = "" if words == "self" else words
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    text = f"{node.name}({words}){returned}"
    if len(text) > 96:
        inner = ",\n    ".join(re.split(r", (?![^\[\(]*[\]\)])", words))
        text = f"{node.name}(\n    {inner}){returned}"
    return text


def is_property(node):
    return any(isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list)


def class_text(node):
    text = [f"## {node.name}\n", doc_of(node)]
    values = [each for each in node.body if isinstance(each, ast.Assign)]
    if values and any(ast.unparse(base) == "IntEnum" for base in node.bases):
        text.append("Members: " + ", ".join(f"`{ast.unparse(each.targets[0])}`" for each in values) + ".")
    attributes = [each for each in node.body if isinstance(each, ast.FunctionDef) and is_property(each)]
    if attributes:
        rows = [f"| `{each.name}` | `{ast.unparse(each.returns)}`".replace(" | None", " or None") + " | "
                + html.escape(" ".join((ast.get_docstring(each) or "").split()), quote=False).replace("|", "\\|") + " |"
                for each in attributes]
        text += ["\n".join(["| attribute | type | |", "| --- | --- | --- |", *rows])]
    text += [function_text(group) for group in overloads(each for each in node.body if isinstance(each, ast.FunctionDef)
                                                         and not is_property(each) and not each.name.startswith("__"))]
    return "\n\n".join(part for part in text if part)


def overloads(functions):
    """Functions of one name together."""
    groups = {}
    for each in functions:
        groups.setdefault(each.name, []).append(each)
    return groups.values()


def function_text(group, level="###"):
    signatures = "\n".join(signature(each) for each in group)
    docs = "\n\n".join(filter(None, (doc_of(each) for each in group)))
    return f"{level} {group[0].name}\n\n```python\n{signatures}\n```\n\n{docs}"


def write_reference(root, out):
    """Writes the pages to out/reference/python and returns their paths, the index first."""
    tree = ast.parse((root / "python/abut/__init__.pyi").read_text())
    rooms = rooms_of(root)
    bodies = {room: [] for room in ROOMS}
    classes = [each for each in tree.body if isinstance(each, ast.ClassDef) and not each.name.startswith("_")]
    functions = overloads(each for each in tree.body if isinstance(each, ast.FunctionDef))
    names = {room: [] for room in ROOMS}
    for group in functions:
        room = rooms.get(group[0].name, "")
        bodies[room].append(function_text(group, "##"))
        names[room].append(group[0].name)
    for each in classes:
        room = rooms.get(each.name, "")
        bodies[room].append(class_text(each))
        names[room].append(each.name)
    folder = out / "reference" / "python"
    folder.mkdir(parents=True)
    rows = ["# Python reference\n", "From the docstrings of the module; `help(abut.distance)` prints the same.\n",
            "| page | what it has |", "| --- | --- |"]
    pages = []
    for room, (title, words) in ROOMS.items():
        if not bodies[room]:
            continue
        page = room or "types"
        (folder / f"{page}.md").write_text(f"# {title}\n\n{words}\n\n" + "\n\n".join(bodies[room]) + "\n")
        rows.append(f"| [{title}]({page}.md) | " + ", ".join(f"`{name}`" for name in names[room]) + " |")
        pages.append({title: f"reference/python/{page}.md"})
    (folder / "README.md").write_text("\n".join(rows) + "\n")
    return ["reference/python/README.md", *pages]
