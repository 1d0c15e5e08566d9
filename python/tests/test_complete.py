"""What the C++ headers declare is in the module, under the same name."""

import pathlib
import re

import pytest

import abut

# The C interface is for other languages; numpy has vectors.
NOT_FOR_PYTHON = {"c.h", "vector.h"}
HEADERS = sorted(path for path in (pathlib.Path(__file__).resolve().parents[2] / "include/abut").glob("*.h")
                 if path.name not in NOT_FOR_PYTHON)

# Types that Python has in another form.
OTHER_TYPES = {
    "Vec3": "array", "Transform": "matrix", "WalkPart": "int", "IndexPair": "array", "TrianglePair": "array",
    "BodyPair": "array", "PiecePair": "array", "VertexPair": "array", "Placement": "poses", "MotionPair": "motions",
    "BodyMotion": "dict", "RigidShape": "shapes", "BodyQuery": "keywords", "SpeedBounds": "keywords", "MarkChanges": "keywords", "EarlierGroup": "within a store", "WalkQuery": "keywords", "Progress": "function",
    "ElementaryPair": "arrays", "ElementaryQueries": "arrays", "StoreClashReport": "ClashReport", "WalkAnswer": "its members",
    "OffscreenContext": "within Renderer and PictureMaker", "Picture": "array", "ChunkVertex": "arrays of ViewChunk", "ChunkUpload": "dict of ViewFrame", "DifferencePolytope": "within ConvexWarmStart",
    "RobotQuery": "keywords", "Configurations": "arrays",
    "PropertiesBuilder": "Scene(properties=)", "TouchSource": "text",
}
OTHER_FUNCTIONS = {
    "to_string": "members of an enum have a name", "make_mesh": "Mesh", "clash_id_text": "ids are text",
    "parse_clash_id": "ids are text", "set_task_runner": "a pool of threads of C++", "told_distance": "max(rounding, 1e-12) is what counts as 0",
    "inverse": "Pose.inverse", "apply": "Pose.apply", "rotate": "Pose.rotate",
}
OTHER_MEMBERS = {
    "Model": {"mesh": None}, "Mesh": {"positions": "vertices", "triangles": "faces"},
    "Error": {"code": None}, "Pose": {}, "Motion": {},
    "Convex": {"face_count": "len(faces)", "face": "faces"}, "Deformable": {"triangles": "faces"},
    "World": {"size": "__len__"}, "Compound": {"size": "__len__"}, "ConvexPieces": {}, "Crew": {"send": "within the job", "receive": "within the job"},
    "PartQuery": {"condition": "inner"}, "ClashQuery": {"condition": "inner"}, "Clash": {"rule": None}, "ClashReport": {"frame": "up"}, "ListedClash": {"part": "part_ids", "name": "names", "type": "types", "file": "files"},
    "OrientedBox": {"world_from_box": "pose"}, "Intersection": {"corners": "arrays of Contacts.segments"},
    "ConvexWarmStart": {"kind": "inner", "pairs": "inner", "deepest": "inner"},
    "Properties": {"first": "of", "entries": "of", "find": "names"}, "PiecesWarmStart": None, "WarmStart": None, "Impacts": {}, "Impact": {},
    "BodyImpact": {"impact": "its members"}, "BodySweepHit": {"impact": "its members"}, "Store": {"file": "inner"}, "Box3": {}, "ContactRegion": {},
    "PictureMaker": {}, "Renderer": {"draw": "picture", "end": "end_picture: there is no framebuffer of the caller"},
    "ViewChunk": {"lower": "vertices", "step": "vertices", "indices": "faces"},
}


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/|#[^\n]*", "", text, flags=re.S)


def statements(text):
    """The statements and blocks of a body: pairs of head and, for a block, what is in it."""
    depth, start, head, rounds = 0, 0, "", 0
    for i, c in enumerate(text):
        rounds += (c == "(") - (c == ")")
        if c == "{":
            if depth == 0:
                head = text[start:i]
                body = i + 1
            depth += 1
        elif c == "}":
            depth -= 1
            if depth == 0 and not text[i + 1:].lstrip().startswith((";", ",", ")")) or depth == 0 and is_type(head):
                yield head.strip(), text[body:i]
                start = i + 1
        elif c == ";" and depth == 0 and rounds == 0:
            if text[start:i].strip():
                yield text[start:i].strip(), None
            start = i + 1
    assert depth == 0


def is_type(head):
    return re.match(r"\s*(class|struct|enum class)\s+\w+[^()]*$", head)


def declarations(header):
    for head, body in statements(without_comments(header.read_text())):
        if head.startswith("namespace abut") and "::" not in head:
            yield from statements(body)


def types():
    for header in HEADERS:
        for head, body in declarations(header):
            match = re.match(r"(class|struct|enum class)\s+(\w+)", head)
            if match and body is not None:
                yield match[1], match[2], body


def functions():
    for header in HEADERS:
        for head, body in declarations(header):
            if not re.match(r"(class|struct|enum|using|namespace|template|static|static_assert|inline constexpr|constexpr)\b", head):
                match = re.search(r"(\w+)\s*\(", head)
                if match and "operator" not in head:
                    yield match[1]


def public_members(kind, body):
    public = kind == "struct"
    for part in re.split(r"\b(public|private|protected)\s*:", body):
        if part in ("public", "private", "protected"):
            public = part == "public"
            continue
        for head, _ in statements(part) if public else []:
            if is_type(head) or "operator" in head or re.match(r"(using|friend|static|template|virtual ~|~|enum|explicit)\b", head):
                continue
            head = re.sub(r"\{[^{}]*\}|<[^<>]*>|<[^<>]*<[^<>]*>[^<>]*>", "", head)
            if "(" in head.split("=")[0]:
                match = re.search(r"(\w+)\s*\(", head)
                if match and match[1][0].islower():
                    yield match[1]
                continue
            for field in head.split(","):
                match = re.search(r"(\w+)\s*$", field.split("=")[0])
                if match:
                    yield match[1]


def test_headers_are_understood():
    assert len(list(types())) > 100 and len(set(functions())) > 60
    assert set(public_members(*next((k, b) for k, n, b in types() if n == "Gap"))) >= {"distance", "point_a", "point_b", "counters"}


def test_types():
    missing = [name for _, name, _ in types() if not hasattr(abut, name) and name not in OTHER_TYPES
               and not name.endswith(("Options", "Data"))]
    assert not missing


def test_functions():
    missing = [name for name in functions() if not hasattr(abut, name) and name not in OTHER_FUNCTIONS]
    assert not missing


@pytest.mark.parametrize("kind, name, body", [t for t in types() if hasattr(abut, t[1])], ids=lambda value: value if len(str(value)) < 40 else "")
def test_members(kind, name, body):
    ours = getattr(abut, name)
    if kind == "enum class":
        assert [member.name for member in ours] == re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", body.strip())
        return
    known = OTHER_MEMBERS.get(name, {})
    if known is not None:
        assert [m for m in public_members(kind, body) if not hasattr(ours, m) and m not in known and m != "data"] == []


OPTIONS = {
    "BroadPhaseOptions": "BroadPhase", "ClashOptions": "find_clashes", "ConvexOptions": "Convex", "ConvexDistanceOptions": "distance",
    "ConvexPenetrationOptions": "penetration", "PiecesDistanceOptions": "distance", "PiecesWithinOptions": "within",
    "PiecesCollideOptions": "collide", "PiecesPenetrationOptions": "penetration", "DeformableOptions": "Deformable",
    "IntersectionOptions": "self_intersections", "NearOptions": "self_within",
    "ElementaryOptions": "elementary_impact", "ModelOptions": "Model", "ImpactOptions": "time_of_impact",
    "PenetrationOptions": "penetration", "ManifoldOptions": "contact_manifolds", "CollideOptions": "collide", "DistanceOptions": "distance", "WithinOptions": "within",
    "ReadOptions": "read_scene", "NearestOptions": "nearest", "ImportOptions": "import_models", "StoreOptions": "open_store",
    "OutOfCoreOptions": "find_clashes", "GroupOptions": "group_clashes", "MergeOptions": "merge_topics", "WalkOptions": "Walk", "BodyOptions": "World.add", "WorldOptions": "World",
    "SpeedBounds": "World.set_speed", "LevelOptions": "build_levels", "PathOptions": "check_path",
    "CarryOptions": "Carry.move_to", "ViewOptions": "View", "PictureOptions": "picture", "ViewpointOptions": "clash_viewpoints", "ClashBcfOptions": "clash_bcf",
    "WalkerOptions": "Walker", "MarkChanges": "mark_clashes",
    "ClashPageOptions": "write_clash_html", "RobotReadOptions": "read_robot", "RobotOptions": "Robot",
    "RobotDistanceOptions": "distance", "RobotImpactOptions": "time_of_impact",
    "AllowedPairsOptions": "propose_allowed_pairs", "MotionClashOptions": "find_motion_clashes",
}


def test_options_are_keywords():
    found = {name: list(public_members(kind, body)) for kind, name, body in types()}
    assert {name for name in found if name.endswith("Options")} <= OPTIONS.keys()
    found["RobotReadOptions"].remove("read")  # its members
    for name, owner in OPTIONS.items():
        ours = abut
        for word in owner.split("."):
            ours = getattr(ours, word)
        if name == "ClashOptions":  # what a command line asks of the report afterwards
            found[name].remove("asked_later")
        if name == "CarryOptions":  # a step is short: Ctrl-C ends it, and no function watches it
            found[name].remove("progress")
        missing = [m for m in found[name] if m.isidentifier() and not re.search(rf"\b{m}(_part)?\b", ours.__doc__ or "")]
        assert not missing, (name, owner)
