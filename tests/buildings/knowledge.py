#!/usr/bin/env python3
"""What `abut info --parts --json` knows of the parts of real IFC files, against the files' text.

Usage: knowledge.py ABUT FOLDER-OF-IFC-FILES

An independent reader (step.py) finds for each part: class, name, storeys, buildings, sites and spaces that
contain it, tag, and all values of its property sets and quantities, those of its type included.
"""
import json
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
from step import Reference, Typed, Word, read  # noqa: E402

PLACES = {"IFCBUILDINGSTOREY": "storey", "IFCBUILDING": "building", "IFCSITE": "site", "IFCSPACE": "space"}
TEXTS = {"IFCLABEL", "IFCTEXT", "IFCIDENTIFIER", "IFCDATETIME", "IFCDATE", "IFCTIME", "IFCDURATION", "IFCURIREFERENCE",
         "IFCDESCRIPTIVEMEASURE", "IFCGLOBALLYUNIQUEID"}


def as_text(value):
    """A single value as Abut writes it; None if it is none."""
    if isinstance(value, Typed):
        inner = value.value
        if isinstance(inner, Word):
            if inner in (".T.", ".F."):
                return "true" if inner == ".T." else "false"
            if inner == ".U.":
                return "unknown"
            return as_text(inner)
        return inner if isinstance(inner, str) and inner != "" else None
    if isinstance(value, Word):
        if value.startswith("."):
            return value[1:-1]
        mantissa, mark, exponent = value.partition("E")
        return mantissa[:-1] + mark + exponent if mantissa.endswith(".") else value
    return value if isinstance(value, str) and value != "" else None


class Building:
    def __init__(self, path):
        self.lines = read(str(path))
        self.whole, self.container, self.types, self.sets, self.filled = {}, {}, {}, {}, {}
        opening_of = {}
        for name, values in self.lines.values():
            if name in ("IFCRELAGGREGATES", "IFCRELNESTS"):
                for part in self.references(values[5]):
                    self.whole.setdefault(part, []).append(values[4])
            elif name == "IFCRELCONTAINEDINSPATIALSTRUCTURE":
                for part in self.references(values[4]):
                    self.container.setdefault(part, []).append(values[5])
            elif name == "IFCRELDEFINESBYTYPE":
                for part in self.references(values[4]):
                    self.types.setdefault(part, []).append(values[5])
            elif name == "IFCRELDEFINESBYPROPERTIES":
                for part in self.references(values[4]):
                    self.sets.setdefault(part, []).extend(self.references(values[5]))
            elif name == "IFCRELVOIDSELEMENT":
                opening_of[values[5]] = values[4]
        for name, values in self.lines.values():
            if name == "IFCRELFILLSELEMENT" and values[4] in opening_of:
                self.filled.setdefault(values[5], []).append(opening_of[values[4]])
        self.by_guid = {values[0]: number for number, (name, values) in self.lines.items()
                        if name.startswith("IFC") and values and isinstance(values[0], str) and len(values[0]) == 22
                        and not name.startswith("IFCREL")}

    @staticmethod
    def references(value):
        if isinstance(value, Typed):
            value = value.value
        return [one for one in (value if isinstance(value, list) else [value]) if isinstance(one, Reference)]

    def name(self, number):
        values = self.lines[number][1]
        return values[2] or (values[7] if len(values) > 7 and isinstance(values[7], str) else None) or values[0]

    def places(self, number):
        """{property: names} of the spatial structures that contain a product."""
        step, seen, found = [number], set(), []
        while step and not found:
            seen.update(step)
            found = [each for one in step for each in self.container.get(one, [])]
            found += [one for one in step if one != number and self.lines[one][0] in PLACES]
            step = [each for one in step for each in self.whole.get(one, []) + self.filled.get(one, []) if each not in seen]
        places = {}
        while found:
            for one in found:
                if self.lines[one][0] in PLACES:
                    places.setdefault(PLACES[self.lines[one][0]], set()).add(self.name(one))
            found = [each for one in found for each in self.whole.get(one, [])]
        return places

    def properties_of(self, owner):
        """{name: values} of the property sets of one object or type."""
        result = {}

        def add(path, number, depth):
            kind, values = self.lines.get(number, ("", []))
            if not values or not isinstance(values[0], str) or values[0] == "" or depth == 8:
                return
            name = f"{path}.{values[0]}"
            if kind in ("IFCCOMPLEXPROPERTY", "IFCPHYSICALCOMPLEXQUANTITY"):
                for inner in self.references(values[3 if kind == "IFCCOMPLEXPROPERTY" else 2]):
                    add(name, inner, depth + 1)
                return
            if kind in ("IFCPROPERTYSINGLEVALUE", "IFCPROPERTYENUMERATEDVALUE", "IFCPROPERTYLISTVALUE"):
                found = values[2] if isinstance(values[2], list) else [values[2]]
            elif kind == "IFCPROPERTYBOUNDEDVALUE":
                found = [values[3], values[5] if len(values) > 5 else None, values[2]]
            elif kind.startswith("IFCQUANTITY"):
                found = [values[3]]
            else:
                return
            texts = [text for text in map(as_text, found) if text is not None]
            if texts:
                result.setdefault(name, []).extend(texts)

        for number in owner:
            kind, values = self.lines.get(number, ("", []))
            content = {"IFCPROPERTYSET": 4, "IFCELEMENTQUANTITY": 5}.get(kind)
            if content is not None:
                for inner in self.references(values[content]):
                    add(values[2] or values[0], inner, 0)
        return result

    def properties(self, number):
        own = self.properties_of(self.sets.get(number, []))
        for kind in self.types.get(number, []):
            for name, values in self.properties_of(self.references(self.lines[kind][1][5])).items():
                own.setdefault(name, values)
        return own

    def part(self, guid):
        number = self.by_guid[guid]
        kind, values = self.lines[number]
        # A value that stands twice is one value.
        known = {name: sorted(set(values)) for name, values in self.properties(number).items()}
        known.update({name: sorted(names) for name, names in self.places(number).items()})
        return kind, values[2] or "", known


def compare(abut, path):
    """Returns how many parts and values were compared, and what differs."""
    outcome = subprocess.run([abut, "info", str(path), "--parts", "--json"], capture_output=True, text=True)
    if outcome.returncode != 0:
        raise SystemExit(f"{path}: {outcome.stderr}")
    building, values, differences = Building(path), 0, []
    parts = json.loads(outcome.stdout)["files"][0]["part_list"]
    for part in parts:
        kind, name, expected = building.part(part["id"])
        found = {key: sorted(value if isinstance(value, list) else [value])
                 for key, value in part.get("properties", {}).items() if "." in key or key in PLACES.values()}
        if (part["type"].upper(), part["name"]) != (kind, name):
            differences.append(f"{part['id']}: is {part['type']} '{part['name']}', not {kind} '{name}'")
        for key in sorted(set(expected) | set(found)):
            values += 1
            if expected.get(key) != found.get(key):
                differences.append(f"{part['id']}: {key} is {found.get(key)}, not {expected.get(key)}")
    return len(parts), values, differences


def main(abut, folder):
    files = sorted(each for each in pathlib.Path(folder).rglob("*") if each.suffix.lower() in (".ifc", ".ifczip"))
    total, failed = 0, 0
    for path in files:
        parts, values, differences = compare(abut, path)
        total += values
        failed += len(differences) > 0
        print(f"{path.name}: {parts} parts, {values} values, {len(differences)} differ")
        for line in differences[:10]:
            print("   ", line)
    print(f"{len(files)} files, {total} values compared")
    return 1 if failed or total < 1000 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
