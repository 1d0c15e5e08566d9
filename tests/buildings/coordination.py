#!/usr/bin/env python3
"""The week of a coordinator on real buildings: import, groups, report, BCF both ways, and again.

Usage: coordination.py ABUT DATA SET

SET is a folder of DATA/ifc, or `hospital` (the GLB files of DATA/bim). Statuses that are set in a BCF file stay
when the files are imported again, also in another order, and when a part has moved away.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

sys.dont_write_bytecode = True
from change import moved_glb, moved_ifc  # noqa: E402

FAR = 5000.0  # metres


def innermost(groups):
    return [inner for group in groups for inner in (innermost(group["groups"]) if "groups" in group else [group])]


class Week:
    def __init__(self, abut, data, name):
        self.abut, self.data, self.name = abut, pathlib.Path(data), name
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="abut-week-"))
        source = self.data / ("bim" if name == "hospital" else "ifc/" + name)
        files = sorted(each for each in source.iterdir()
                       if each.suffix.lower() in (".ifc", ".ifczip") or each.name.startswith("hospital"))
        # ROOT-staal is a copy of IFC-staal.
        self.files = [pathlib.Path(shutil.copy(each, self.folder)) for each in files if "ROOT" not in each.name]
        self.store = str(self.folder / "site.abut")

    def run(self, *arguments, status=0):
        outcome = subprocess.run([self.abut, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder)
        assert outcome.returncode == status, (arguments, outcome.returncode, outcome.stdout[-500:], outcome.stderr[-2000:])
        return outcome.stdout

    def clash(self, store=None, *more, status=0):
        return json.loads(self.run("clash", store or self.store, "--group", "storey,part,place", "--json", *more, status=status))

    def imported(self, files, store=None):
        self.run("import", *[each.name for each in files], store or self.store, "--quiet")

    def checked(self, report):
        """Every clash is in exactly one innermost group, and its row names it."""
        groups = innermost(report["groups"])
        group_of = {clash: group["id"] for group in groups for clash in group["clashes"]}
        assert sum(len(group["clashes"]) for group in groups) == len(report["clashes"]) == len(group_of)
        assert all(clash["group"] == group_of[clash["id"]] for clash in report["clashes"])
        assert all(group["size"] == len(group["clashes"]) for group in groups)
        return {group["id"]: group for group in groups}

    def schema_errors(self, bcf, version):
        if shutil.which("xmllint") is None:
            print("  without xmllint, the schemas are not asked")
            return
        unpacked = self.folder / ("bcf-" + version)
        zipfile.ZipFile(bcf).extractall(unpacked)
        schemas = self.data / "bcf" / ("schemas-" + version)
        count = 0
        for pattern, schema in (("*/markup.bcf", "markup"), ("*/*.bcfv", "visinfo"), ("bcf.version", "version")):
            files = sorted(unpacked.glob(pattern))
            count += len(files)
            for at in range(0, len(files), 500):
                subprocess.run(["xmllint", "--noout", "--schema", schemas / (schema + ".xsd"), *files[at:at + 500]],
                               check=True, capture_output=True)
        assert count > 1

    def edited(self, bcf, guids):
        """Sets status and assignee of topics in a BCF 2.1 file, as another program would, and drops what it does not know."""
        changed = bcf.with_suffix(".edited.bcf")
        with zipfile.ZipFile(bcf) as old, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                content = old.read(name)
                for guid, status in guids.items():
                    if name == guid + "/markup.bcf":
                        text = content.decode()
                        assert 'TopicStatus="Open"' in text
                        text = text.replace('TopicStatus="Open"', f'TopicStatus="{status}"')
                        text = re.sub(r"(</CreationAuthor>)", r"\1<ModifiedDate>2099-01-01T00:00:00Z</ModifiedDate>"
                                      r"<ModifiedAuthor>B</ModifiedAuthor><AssignedTo>Hydra</AssignedTo>", text, count=1)
                        content = text.encode()
                if name != "abut.txt":
                    new.writestr(name, content)
        return changed


def first_job(week):
    """Returns the report and its groups."""
    week.imported(week.files)
    week.clash(None, "--fail-on", "group.change = new", status=1)
    report = week.clash()
    groups = week.checked(report)
    assert len(report["clashes"]) > 10 and len(groups) > 3, (len(report["clashes"]), len(groups))
    assert {group["change"] for group in groups.values()} == {"new"}
    print(f"  {len(week.files)} files, {len(report['clashes'])} clashes in {len(groups)} groups")
    # The same groups, whatever the order of the files.
    other = str(week.folder / "other.abut")
    week.imported(week.files[::-1], other)
    again = week.checked(week.clash(other))
    described = lambda found: {key: (group["name"], sorted(group["clashes"])) for key, group in found.items()}
    assert described(again) == described(groups)
    return report, groups


def exchange(week, groups):
    """Sends groups as BCF, gets statuses back. Returns the topics that the store has then."""
    guid_of = {}
    for version in ("2.1", "3.0"):
        bcf = week.folder / f"out{version}.bcf"
        told = json.loads(week.run("review", week.store, "--bcf-out", bcf, "--bcf-version", version, "--no-snapshots", "--json"))
        assert told["topics"] == len(groups), told
        week.schema_errors(bcf, version)
        week.run("review", week.store, "--bcf-out", bcf, "--bcf-version", version, "--no-snapshots", "--quiet")
    bcf = week.folder / "out2.1.bcf"
    with zipfile.ZipFile(bcf) as archive:
        guid_of = sorted(name.split("/")[0] for name in archive.namelist() if name.endswith("/markup.bcf"))
    statuses = {guid: ("Assigned", "Resolved", "Approved")[i % 3] for i, guid in enumerate(guid_of[:9])}
    merge = json.loads(week.run("review", week.store, "--bcf-in", week.edited(bcf, statuses), "--by", "B", "--json"))
    assert sorted(merge["added"]) == sorted(statuses) and not merge["conflicts"], merge
    # The page's file of edits.
    group = next(iter(groups))
    edits = {"abut_review": 1, "author": "C", "topics": [{"group": group, "due": "2026-12-01", "comments": [{"text": "Why?"}]}]}
    (week.folder / "edits.json").write_text(json.dumps(edits))
    week.run("review", week.store, "--apply", "edits.json", "--quiet")
    topics = {topic["guid"]: topic for topic in week.clash()["topics"]}
    for guid, status in statuses.items():
        assert (topics[guid]["status"], topics[guid]["assignee"]) == (status.lower(), "Hydra"), topics[guid]
    return topics


def expect_kept(week, topics, groups, gone):
    """All topics, and all groups whose clashes are not all gone, are there."""
    report = week.clash()
    now = week.checked(report)
    assert {topic["guid"]: topic for topic in report["topics"]} == topics
    for key, group in groups.items():
        left = set(group["clashes"]) - gone
        if left:
            assert left <= set(now[key]["clashes"]) and now[key]["name"] == group["name"], group["name"]
    return report, now


def part_to_move(week, report, groups):
    """A part that all clashes of a group share, so that the group goes with it: (file, id, ids of its clashes)."""
    clashes = {}
    for clash in report["clashes"]:
        for side in "ab":
            file = pathlib.Path(clash[side + "_file"]).name
            clashes.setdefault((file, clash[side]), set()).add(clash["id"])
    shared = {(pathlib.Path(group["part"]["file"]).name, group["part"]["id"]) for group in groups.values() if "part" in group}
    (file, part), gone = min(((key, ids) for key, ids in clashes.items() if not key[0].endswith("zip")),
                             key=lambda item: (item[0] not in shared, len(item[1]), item[0]))
    return week.folder / file, part, gone


def main(abut, data, name):
    week = Week(abut, data, name)
    try:
        report, groups = first_job(week)
        week.run("clash", week.store, "--group", "storey,part,place", "--out", "report", "--quiet")
        assert all((week.folder / "report" / f"report.{kind}").stat().st_size > 1000 for kind in ("html", "json", "csv"))
        topics = exchange(week, groups)
        # The same files again, in another order.
        week.imported(week.files[::-1])
        expect_kept(week, topics, groups, set())
        # A part moves far away.
        file, part, gone = part_to_move(week, report, groups)
        unit = next(each["unit"] for each in report["models"] if pathlib.Path(each["file"]).name == file.name)
        copy = week.folder / ("new" + file.suffix)
        if file.suffix == ".glb":
            moved_glb(file, copy, part, [0, FAR, 0])
        else:
            moved_ifc(file, copy, part, [0, 0, FAR / unit])
        copy.replace(file)
        week.imported(week.files[::-1])
        after, now = expect_kept(week, topics, groups, gone)
        assert gone.isdisjoint(clash["id"] for clash in after["clashes"])
        assert after["statuses"]["resolved"] == len(gone) and after["statuses"]["new"] == 0, after["statuses"]
        week.clash(None, "--fail-on", "group.change = new", status=0)
        resolved = json.loads(week.run("review", week.store, "--groups", "--json"))["groupings"][0]["changes"]["resolved"]
        assert resolved == len(groups) - len(now)
        week.run("info", week.store, "--verify", "--quiet")
        print(f"  {len(topics)} topics stay; {len(gone)} clashes and {resolved} groups of {part} are resolved")
    finally:
        shutil.rmtree(week.folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
