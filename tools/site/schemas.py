"""The reference of JSON: a page for each schema of docs/schema, with a row for each key."""
import html
import json

INPUTS = {"clash-rules": ("rules", "Read by `abut clash --rules`, as JSON or TOML. [Selecting](../../docs/selecting.md#rules) "
                                   "explains them."),
          "clash-matrix": ("a clash matrix", "Read by `abut clash --matrix`, as JSON or TOML. "
                                             "[Selecting](../../docs/selecting.md#the-clash-matrix) explains it.")}
WORDS = {"string": "text", "number": "number", "integer": "integer", "boolean": "true or false", "null": "null", "object": "object"}


def code(text):
    return f"<code>{html.escape(str(text), quote=False)}</code>"


def kind(schema):
    """The type of a value in a few words, with links to the types that several outputs have."""
    if "$ref" in schema:
        file, _, path = schema["$ref"].partition("#")
        name = path.rpartition("/")[2]
        return f'<a href="{"common.html" if file else ""}#{name}">{name}</a>'
    if "const" in schema:
        return code(json.dumps(schema["const"]))
    if "enum" in schema:
        return " or ".join(code(word) for word in schema["enum"])
    if "anyOf" in schema:
        return " or ".join(kind(one) for one in schema["anyOf"])
    if schema.get("type") == "array":
        inner = schema.get("items", {})
        return "list of " + ("objects" if inner.get("type") == "object" else kind(inner) if inner else "anything")
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types == ["object"] and isinstance(schema.get("additionalProperties"), dict) and not schema.get("properties"):
        return "by name: " + kind(schema["additionalProperties"])
    return " or ".join(WORDS[one] for one in types) or "anything"


def inner_objects(schema, list_marks=""):
    """The objects within a value: pairs of `[]` for each list around it, and the object."""
    for one in schema.get("anyOf", [schema]):
        if "properties" in one:
            yield list_marks, one
        elif isinstance(one.get("items"), dict):
            yield from inner_objects(one["items"], list_marks + "[]")


def rows(schema, before=""):
    required = set(schema.get("required", []))
    for name, value in schema.get("properties", {}).items():
        if name == "$schema":
            continue
        said = html.escape(value.get("description", ""), quote=False)
        yield before + name, name in required, kind(value), said
        for marks, inner in inner_objects(value):
            yield from rows(inner, f"{before}{name}{marks}.")


def table(schema):
    head = "<table><thead><tr><th>key</th><th>value</th><th>meaning</th></tr></thead><tbody>"
    body = "".join(f"<tr><td>{code(name)}{'' if needed else ' <small>optional</small>'}</td><td>{value}</td><td>{said}</td></tr>"
                   for name, needed, value, said in rows(schema))
    return f"{head}{body}</tbody></table>\n" if body else ""


def definitions(schema):
    """The types that the schema defines, each with a heading that links lead to."""
    text = []
    for name, one in schema.get("$defs", {}).items():
        text.append(f'<h2 id="{name}">{name}</h2>\n')
        said = html.escape(one.get("description", ""), quote=False)
        text.append(f"<p>{said[:1].upper() + said[1:]}.</p>\n" if said else "")
        text.append(table(one) or f"<p>Value: {kind(one)}.</p>\n")
    return "".join(text)


def write_schemas(root, site, out):
    """Writes the pages to out/reference/json and returns their paths, the index first."""
    folder = out / "reference" / "json"
    folder.mkdir(parents=True)
    index = ["# JSON\n", "Each page is made from a JSON Schema (draft 2020-12) in `docs/schema`; a test compares the schemas with "
             "what the command prints and reads. [Scripts](../../docs/scripts.md) has the exit statuses.\n"]
    pages = ["reference/json/README.md"]
    for heading, sources in (("What the command prints", sorted((root / "docs/schema/output").glob("*.schema.json"))),
                           ("What the command reads", sorted((root / "docs/schema").glob("*.schema.json")))):
        index += [f"## {heading}\n", "| page | what it is |", "| --- | --- |"]
        for source in sources:
            name, schema = source.name.removesuffix(".schema.json"), json.loads(source.read_text())
            place = source.relative_to(root).as_posix()
            site.add([place])
            title, said = INPUTS.get(name, (schema["title"], schema.get("description", "")))
            title = f"{name}: {title[:1].lower() + title[1:]}"
            text = [f"# {title}\n", f"{said}\n" if said else "", f"Schema: [{source.name}](../../{place}.md).\n",
                    table(schema), definitions(schema)]
            (folder / f"{name}.md").write_text("\n".join(text))
            index.append(f"| [{name}]({name}.md) | {title.partition(': ')[2]} |")
            pages.append(f"reference/json/{name}.md")
        index.append("")
    (folder / "README.md").write_text("\n".join(index))
    return pages
