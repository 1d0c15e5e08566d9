#!/usr/bin/env python3
"""Writes the type stubs of the module, from its signatures and docstrings: abut/__init__.pyi.

    PYTHONPATH=build/release/python python/packaging/make_stubs.py > python/abut/__init__.pyi

What a signature does not tell is in the tables below. A test compares the result with the file.
"""

import enum
import re
import sys

import abut

HEAD = '''"""Type stubs of abut, written by python/packaging/make_stubs.py."""

from enum import IntEnum
from os import PathLike
from typing import Any, Callable, Iterable, Protocol, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class _Faces(Protocol):
    """A mesh as trimesh has it."""
    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...

class _Cells(Protocol):
    """A mesh as meshio has it."""
    @property
    def points(self) -> Any: ...
    @property
    def cells_dict(self) -> Any: ...

_Path = Union[str, PathLike[str]]
_ModelPath = Union[_Path, "ModelPath"]
_Mesh = Union["Mesh", "Model", _Path, _Faces, _Cells]
_Point = tuple[float, float, float]
_OnePose = Union[None, "Pose", tuple[Sequence[float], Sequence[float]]]
_RigidShape = Union["Model", "Convex", "Sphere", "Capsule", "Box3", "Cylinder", "Cone", "Ellipsoid", "HalfSpace"]
_Poses = Union[_OnePose, ArrayLike, Sequence["Pose"], tuple[ArrayLike, ArrayLike]]
_Progress = Union[Callable[[str, float], object], None]
_Bodies = Union[int, ArrayLike]
'''

# Parameters whose type is the same everywhere.
PARAMETERS = {
    "vertices": "ArrayLike | _Mesh", "faces": "ArrayLike | None", "mesh": "_Mesh", "path": "_Path", "file": "_Path",
    "folder": "_Path", "text": "_Path", "pose": "_Poses", "pose_a": "_Poses", "pose_b": "_Poses", "start": "_Poses",
    "end": "_Poses", "matrix": "ArrayLike", "points": "ArrayLike", "origin": "ArrayLike", "direction": "ArrayLike | None",
    "t_min": "ArrayLike", "t_max": "ArrayLike", "lower": "ArrayLike", "upper": "ArrayLike", "changed": "ArrayLike | None",
    "translation": "ArrayLike", "rotation": "ArrayLike", "centre": "ArrayLike", "velocity": "ArrayLike",
    "angular_velocity": "ArrayLike", "acceleration": "ArrayLike", "about": "ArrayLike", "position": "ArrayLike",
    "acceleration_bound": "float", "angular_speed": "float", "progress": "_Progress", "tolerance": "float",
    "distance": "float", "upper_bound": "float", "absolute_error": "float", "relative_error": "float", "thickness": "float",
    "max_steps": "int | None", "signed_distance": "bool", "at_end": "bool", "segments": "bool", "triangles": "bool", "separation": "bool",
    "mode": "ContactMode | str", "volume": "Volume | str", "method": "BroadPhaseMethod | str", "scheme": "Scheme | str",
    "broad_phase": "BroadPhaseMethod | str", "assignment": "Assignment | str", "culling": "Culling | str",
    "missing": "MissingParts | str", "order": "WorkOrder | str", "up": "UpAxis | str", "kind": "ElementaryKind | str",
    "kinds": "ElementaryKind | str | ArrayLike", "clearance": "float", "touch_tolerance": "float | None", "self": "bool",
    "rules": "Sequence[ClashRule] | _Path", "memory": "int", "keep": "bool", "keep_hierarchies": "bool", "lines": "int",
    "crew": "Crew | None", "scene": "Scene", "model": "Model", "surface": "Deformable", "segment": "Segment",
    "shape": "Sphere | Box3 | OrientedBox | Segment", "probe": "Probe | Model | Convex | Sphere | Capsule | Box3",
    "body": "int", "other": "Pose", "directions": "ArrayLike", "motion": "Motion", "motion_a": "Motion | Sequence[Motion] | _Poses", "t": "float", "gap": "float",
    "motion_b": "Motion | Sequence[Motion] | _Poses", "motions": "dict[int, Motion] | Iterable[tuple[int, Motion]]",
    "parts": "Sequence[Part]", "paths": "Iterable[_ModelPath] | _ModelPath", "name": "str | None", "note": "str", "unit": "float",
    "models": "Iterable[Scene | _ModelPath] | Scene | _ModelPath", "report": "ClashReport", "file_name": "str",
    "warm_start": "WarmStart | None", "walk": "Walk", "poses": "_Poses", "feet": "ArrayLike", "wish": "ArrayLike",
    "meshes": "Sequence[_Mesh]", "id": "str", "type": "str", "eye": "ArrayLike", "forward": "ArrayLike",
    "towards": "ArrayLike", "velocity": "ArrayLike", "aim": "NamedView | str | Camera | PartAim | PairAim | SidesAim | Clash",
    "colour_by": "ColourBy | str", "by": "ColourBy | str", "picture": "NDArray[Any]", "normal": "ArrayLike",
    "reason": "AllowReason | str", "configuration": "ArrayLike", "properties": "Properties | None",
    "representatives": "Representatives", "representatives_a": "Representatives",
    "representatives_b": "Representatives", "pairs": "ArrayLike", "margin": "float", "vertex_count": "int",
    "relations": "Sequence[PartRelation]", "version": "BcfVersion | str",
}
# The same for one function or class.
OWN_PARAMETERS = {
    "contact_manifolds": {"a": "Model", "b": "Model", "pose_a": "_OnePose", "pose_b": "_OnePose", "margin": "float",
                          "last": "Sequence[ModelManifold] | None"},
    "common_volume": {"a": "Volume | str", "b": "Volume | str"},
    "Camera": {"up": "ArrayLike"}, "TourPoint": {"up": "ArrayLike", "name": "str"}, "look_at_box": {"up": "ArrayLike"},
    "picture": {"models": "Store | Iterable[Scene | _ModelPath] | Scene | _ModelPath", "section_box": "Box3 | None"},
    "PairAim": {"file": "Sequence[str]", "part": "Sequence[str]", "points": "Sequence[ArrayLike] | None"},
    "PictureMaker": {"models": "Store | Iterable[Scene | _ModelPath] | Scene | _ModelPath"},
    "PictureMaker.make": {"section_box": "Box3 | None"}, "NamedPart": {"id": "str", "file": "str"}, "Mark": {"a": "ArrayLike", "b": "ArrayLike"},
    "RenderStyle": {"up": "ArrayLike", "ground": "Ground | None", "section_box": "Box3 | None", "distances": "DistanceColours | None"},
    "on_screen": {"point": "ArrayLike"}, "DistanceColours.distance": {"point": "ArrayLike"}, "Ground": {"middle": "ArrayLike"},
    "Renderer.add_part": {"pose": "_OnePose | ArrayLike"}, "Renderer.move_part": {"pose": "_OnePose | ArrayLike"},
    "Renderer.visible_samples": {"parts": "ArrayLike"}, "distances_from": {"pose": "_OnePose | ArrayLike"},
    "clip_from_world": {"origin": "ArrayLike"}, "record": {"name": "str"},
    "Convex": {"vertices": "ArrayLike | _Mesh"}, "ConvexPieces": {"model": "ArrayLike | _Mesh"}, "OrientedBox": {"pose": "_OnePose | ArrayLike"},
    "check_path": {"probe": "int | Probe | Model | Convex | Sphere | Capsule | Box3", "absolute_error": "float | None"},
    "Walk.sweep": {"absolute_error": "float | None"}, "Walk.time_of_impact": {"absolute_error": "float | None"},
    "Walk.parts_in_way": {"absolute_error": "float | None"}, "Carry.move_to": {"mode": "CarryMode | str"},
    "Walker.set_mode": {"mode": "WalkerMode | str"}, "Walk.first_hit": {"origin": "Ray | ArrayLike"},
    "build_levels": {"store": "_Path"}, "Probe": {"shape": "Model | Convex | Sphere | Capsule | Box3"}, "World.move": {"body": "_Bodies"},
    "World.add": {"shape": "Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace | Compound | ConvexPieces | Deformable"},
    "Compound": {"pieces": "Iterable[_RigidShape | tuple[_RigidShape, _OnePose | ArrayLike]] | ConvexPieces"},
    "World.first_hit": {"origin": "Ray | ArrayLike", "filter": "Callable[[int], bool] | None"}, "World.all_hits": {"origin": "Ray | ArrayLike", "filter": "Callable[[int], bool] | None"},
    "World.overlaps": {"shape": "Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace", "filter": "Callable[[int], bool] | None"},
    "World.sweep": {"shape": "Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace", "filter": "Callable[[int], bool] | None", "motion": "Motion"},
    "Walk.distance": {"probe": "int | Probe | Model | Convex | Sphere | Capsule | Box3"},
    "Walk.within": {"probe": "int | Probe | Model | Convex | Sphere | Capsule | Box3"},
    "Walk.collide": {"probe": "int | Probe | Model | Convex | Sphere | Capsule | Box3"},
    "Walk.penetration": {"probe": "int | Probe | Model | Convex | Sphere | Capsule | Box3"},
    "Cone": {"apex": "ArrayLike", "base": "ArrayLike"}, "Ellipsoid": {"semi_axes": "ArrayLike"},
    "World": {"filter": "Callable[[int, int], bool] | None"}, "BroadPhase": {"filter": "Callable[[int, int], bool] | None"},
    "overlapping_boxes": {"filter": "Callable[[int, int], bool] | None"},
    "self_within": {"vertices": "NearVertices | None"}, "NearVertices": {
        "thickness": "ArrayLike | None", "groups": "ArrayLike | None", "masks": "ArrayLike | None", "moved": "ArrayLike | None"},
    "colour_constraints": {"constraints": "ArrayLike", "fixed": "ArrayLike | None"}, "ConstraintColours.of": {"colour": "int"},
    "Representatives": {"faces": "ArrayLike"}, "Representatives.set_triangles": {"faces": "ArrayLike"},
    "Representatives.set_motion": {"start": "ArrayLike", "end": "ArrayLike"},
    "Deformable.set_motion": {"start": "ArrayLike", "end": "ArrayLike"}, "Deformable.advance": {"end": "ArrayLike"},
    "elementary_impact": {"start": "ArrayLike", "end": "ArrayLike"}, "elementary_impacts": {"start": "ArrayLike", "end": "ArrayLike"},
    "read_elementary_queries": {"kind": "ElementaryKind | str | None"}, "Walk.move_to": {"velocity": "ArrayLike | None"},
    "PartSelector": {"file": "Sequence[str]", "name": "Sequence[str]", "type": "Sequence[str]", "query": "str | PartQuery"},
    "PartQuery": {"text": "str"}, "ClashQuery": {"text": "str"}, "ClashQuery.matches": {"report": "ClashReport", "clash": "int"},
    "ClashQuery.find": {"report": "ClashReport"},
    "IgnoreRule": {"neighbours": "Sequence[Neighbours | str]"}, "matrix_preset": {"name": "str"}, "matrix_preset_text": {"name": "str"},
    "ClashRule": {"name": "str", "clearance": "float | None", "touch_tolerance": "float | None", "severity": "str",
                  "tolerated_depth": "float | None", "kinds": "Sequence[ClashKind | str]"}, "Scene": {"file": "str"},
    "import_models": {"files": "Iterable[_ModelPath] | _ModelPath", "store": "_Path"},
    "remove_models": {"files": "Iterable[_Path]", "store": "_Path"}, "help_find_clashes": {"store": "_Path", "crew": "Crew"},
    "time_of_impact": {"absolute_error": "float | None"}, "World.time_of_impact": {"absolute_error": "float | None"},
    "read_scene": {"path": "_ModelPath"}, "read_mesh": {"path": "_ModelPath"}, "inspect": {"mesh": "ArrayLike | _Mesh"},
    "clash_bcf": {"snapshot": "Callable[[ClashViewpoint], bytes] | None"}, "group_clashes": {"store": "Store | None"},
    "RobotObstacle": {"name": "str", "pose": "_OnePose | ArrayLike"}, "write_srdf": {"base": "_Path | None"},
    "AssemblyPart": {"name": "str", "pose": "_OnePose | ArrayLike"}, "JointKeys": {"poses": "Sequence[Pose]"},
    "AssemblyJoint": {"type": "AssemblyJointType | str", "axis": "ArrayLike"}, "AssemblyLoop": {"pin": "ArrayLike"},
    "Assembly": {"parts": "Sequence[AssemblyPart]"}, "write_motion_csv": {"report": "MotionReport"},
    "write_motion_html": {"report": "MotionReport"},
    "Segment": {"a": "ArrayLike", "b": "ArrayLike"}, "ModelPath": {"up": "UpAxis | str | None"}, "to_json": {"store": "str"},
}
# The meanings of verbs: the first argument, the keywords, and what one question returns. A matrix may be one pose or
# many, which no type tells, so what is returned is Any then.
VERBS = {
    "collide": [("Model", {"mode", "segments", "warm_start", "progress"}, "Contacts"),
                ("ConvexPieces", {"mode", "triangles", "warm_start", "progress"}, "PiecesContacts")],
    "distance": [("Model", {"upper_bound", "absolute_error", "relative_error", "signed_distance", "max_steps", "warm_start", "progress"},
                  "Gap"),
                 ("Convex", {"absolute_error", "warm_start"}, "ConvexGap"),
                 ("ConvexPieces", {"upper_bound", "absolute_error", "warm_start", "progress"}, "PiecesGap")],
    "within": [("Model", {"warm_start", "progress"}, "bool"),
               ("ConvexPieces", {"warm_start", "progress"}, "bool")],
    "penetration": [("Model", {"relative_error", "separation", "max_steps", "progress"}, "Depth"),
                    ("Convex", {"warm_start"}, "ConvexDepth"),
                    ("ConvexPieces", {"separation", "progress"}, "PiecesDepth")],
}
WARM_STARTS = {"Model": "WarmStart", "Convex": "ConvexWarmStart", "ConvexPieces": "PiecesWarmStart"}
# Whole lines, for what the tables above cannot say.
OTHER_OVERLOADS = {
    "collide": ["def collide(robot: Robot, configuration: ArrayLike, *, self_pairs: bool = ..., "
                "obstacles: RobotObstacles | None = ..., root: bool = ..., progress: _Progress = ...) -> Any: ..."],
    "distance": ["def distance(robot: Robot, configuration: ArrayLike, *, self_pairs: bool = ..., "
                 "obstacles: RobotObstacles | None = ..., root: bool = ..., upper_bound: float = ..., "
                 "progress: _Progress = ...) -> Any: ...",
                 "def distance(model: Model, pose: _OnePose | ArrayLike, segment: Segment, *, upper_bound: float = ..., "
                 "absolute_error: float = ..., relative_error: float = ..., max_steps: int | None = ..., "
                 "progress: _Progress = ...) -> Any: ..."],
    "within": ["def within(a: Deformable, b: Deformable, distance: float, *, at_end: bool = ..., "
               "vertices: NearVertices | None = ..., vertices_b: NearVertices | None = ..., "
               "progress: _Progress = ...) -> np.recarray[Any, Any]: ...",
               "def within(surface: Deformable, body: _RigidShape, pose: _OnePose | ArrayLike, distance: float, *, "
               "at_end: bool = ..., vertices: NearVertices | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]: ..."],
    "time_of_impact": [
        "def time_of_impact(robot: Robot, start: ArrayLike, end: ArrayLike, *, self_pairs: bool = ..., "
        "obstacles: RobotObstacles | None = ..., root: bool = ..., absolute_error: float = ..., "
        "max_steps: int | None = ..., progress: _Progress = ...) -> RobotImpact: ...",
        "def time_of_impact(a: Deformable, b: Deformable, *, absolute_error: float = ..., thickness: float = ..., "
        "progress: _Progress = ...) -> FeatureImpact | None: ...",
        "def time_of_impact(a: Model, motion_a: Motion | _OnePose, b: Model, motion_b: Motion | _OnePose, *, "
        "absolute_error: float | None = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Impact: ...",
        "def time_of_impact(a: Model, motion_a: Motion | Sequence[Motion] | _Poses, b: Model, "
        "motion_b: Motion | Sequence[Motion] | _Poses, *, absolute_error: float | None = ..., max_steps: int | None = ..., "
        "progress: _Progress = ...) -> Any: ..."],
    "find_clashes": [
        "def find_clashes(store: Store, *, clearance: float = ..., touch_tolerance: float | None = ..., self: bool = ..., "
        "rules: Sequence[ClashRule] | _Path = ..., progress: _Progress = ..., memory: int = ..., order: WorkOrder | str = ..., "
        "keep: bool = ..., keep_hierarchies: bool = ..., crew: Crew | None = ..., only: str | PartQuery = ..., a: str | PartQuery = ..., b: str | PartQuery = ..., "
        "matrix: ClashMatrix | _Path | None = ..., leave_out: Sequence[Neighbours | str] = ..., sort: ClashOrder | str = ...) -> ClashReport: ...",
        "def find_clashes(models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, *, clearance: float = ..., "
        "touch_tolerance: float | None = ..., self: bool = ..., rules: Sequence[ClashRule] | _Path = ..., "
        "progress: _Progress = ..., only: str | PartQuery = ..., a: str | PartQuery = ..., b: str | PartQuery = ..., "
        "matrix: ClashMatrix | _Path | None = ..., leave_out: Sequence[Neighbours | str] = ..., sort: ClashOrder | str = ...) -> ClashReport: ..."],
    "overlaps": [
        "def overlaps(model: Model, pose: _OnePose | ArrayLike, shape: Sphere | Box3 | OrientedBox | Segment, *, "
        "progress: _Progress = ...) -> bool: ...",
        "def overlaps(model: Model, pose: _OnePose | ArrayLike, lower: _Point, upper: _Point, *, progress: _Progress = ...) -> bool: ...",
        "def overlaps(model: Model, pose: _OnePose | ArrayLike, lower: ArrayLike, upper: ArrayLike, *, "
        "progress: _Progress = ...) -> Any: ..."],
    "nearest": [
        "def nearest(model: Model, pose: _OnePose | ArrayLike, points: _Point, *, upper_bound: float = ..., "
        "signed_distance: bool = ..., progress: _Progress = ...) -> Nearest: ...",
        "def nearest(model: Model, pose: _OnePose | ArrayLike, points: ArrayLike, *, upper_bound: float = ..., "
        "signed_distance: bool = ..., progress: _Progress = ...) -> Any: ..."],
    "contains": [
        "def contains(model: Model, pose: _OnePose | ArrayLike, points: _Point, *, progress: _Progress = ...) -> Containment: ...",
        "def contains(model: Model, pose: _OnePose | ArrayLike, points: ArrayLike, *, progress: _Progress = ...) -> Any: ..."],
    "first_hit": [
        "def first_hit(model: Model, pose: _OnePose | ArrayLike, origin: Ray, *, progress: _Progress = ...) -> RayHit: ...",
        "def first_hit(model: Model, pose: _OnePose | ArrayLike, origin: ArrayLike, direction: ArrayLike, t_min: ArrayLike = ..., "
        "t_max: ArrayLike = ..., *, progress: _Progress = ...) -> Any: ..."],
    "all_hits": [
        "def all_hits(model: Model, pose: _OnePose | ArrayLike, origin: Ray, *, progress: _Progress = ...) -> np.recarray[Any, Any]: ...",
        "def all_hits(model: Model, pose: _OnePose | ArrayLike, origin: ArrayLike, direction: ArrayLike, t_min: ArrayLike = ..., "
        "t_max: ArrayLike = ..., *, progress: _Progress = ...) -> Any: ..."],
}
RETURNS = {
    "common_volume": "Volume",
    "overlapping_triangles": "NDArray[np.uint32]", "self_impacts": "Impacts", "impacts": "Impacts", "overlap_graph": "GraphReport",
    "self_time_of_impact": "FeatureImpact | None", "is_free_of_self_impacts": "bool", "is_free_of_impacts": "bool",
    "self_feature_tests": "np.recarray[Any, Any]", "feature_tests": "np.recarray[Any, Any]",
    "self_within": "np.recarray[Any, Any]", "self_intersections": "np.recarray[Any, Any]",
    "intersections": "np.recarray[Any, Any]", "elementary_impacts": "np.recarray[Any, Any]", "join_crew": "Crew | None",
    "read_frame_positions": "NDArray[np.float64] | None", "Motion.between": "Any", "Motion.screw": "Any", "picture": "NDArray[np.uint8]",
    "PictureMaker.make": "NDArray[np.uint8]", "Renderer.picture": "NDArray[np.uint8]", "Renderer.end_picture": "NDArray[np.uint8]",
    "Renderer.visible_samples": "NDArray[np.uint64]", "on_screen": "NDArray[np.float64] | None",
    "World.penetration": "np.recarray[Any, Any]", "World.within": "np.recarray[Any, Any]",
    "World.contact_manifolds": "np.recarray[Any, Any]",
    "World.add": "BodyId", "World.first_hit": "BodyRayHit", "World.all_hits": "np.recarray[Any, Any]", "World.overlaps": "NDArray[Any]", "World.sweep": "BodySweepHit",
    "World.time_of_impact": "np.recarray[Any, Any]", "read_elementary_queries": "tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]",
}
PROPERTIES = {
    "Convex.faces": "list[NDArray[np.uint32]]", "Contacts.segments": "list[NDArray[np.float64]]",
    "ClashReport.counts": "dict[str, int]", "ClashReport.statuses": "dict[str, int] | None",
    "ClashReport.seconds": "dict[str, float]", "ClashReview.statuses": "dict[str, int]",
}
TWO_SURFACES = {"impacts", "intersections", "is_free_of_impacts"}


def plain_type(text):
    """A type as pybind11 writes it, for Python."""
    text = text.replace("abut._abut.", "").replace("_abut.", "")
    text = re.sub(r"\bnumpy\.ndarray(\[[^\[\]]*(\[[^\[\]]*\])?[^\[\]]*\])?", "NDArray[Any]", text)
    text = re.sub(r"\bList\[(.*)\[\d+\]\]$", r"List[\1]", text)
    text = text.replace("List[", "list[").replace("Tuple[", "tuple[").replace("Dict[", "dict[")
    text = re.sub(r"Optional\[(.*)\]$", r"\1 | None", text)
    return {"object": "Any", "enum": "Any", "array": "NDArray[Any]", "dict": "dict[str, Any]", "list": "list[Any]",
            "function": "Any", "array_proxy": "NDArray[Any]"}.get(text, text)


def parameters_of(text):
    """Names and defaults of a signature's parameters, and the star."""
    depth, words, word = 0, [], ""
    for c in text:
        depth += (c in "([{<") - (c in ")]}>")
        if c == "," and depth == 0:
            words.append(word)
            word = ""
        else:
            word += c
    for word in [*words, word]:
        word = word.strip()
        if not word:
            continue
        match = re.match(r"(\*{0,2}\w*)\s*(?::\s*([^=]*?))?\s*(=.*)?$", word, re.S)
        yield match[1], match[2], bool(match[3])


def arguments(owner, text, typed):
    """The parameters for the stub. In: typed tells a parameter's type when the tables do not."""
    own = OWN_PARAMETERS.get(owner, {})
    result = []
    for name, kind, optional in parameters_of(text):
        if name == "**kwargs":
            result.append("**options: Any")
            continue
        if name == "*" or name.startswith("*") and name != "*args":
            result.append("*")
            continue
        if name in ("*args", "..."):
            result.append("*args: Any")
            continue
        if name == "self" and typed:
            result.append("self")
            continue
        fitting = own.get(name) or (plain_type(kind) if kind and plain_type(kind) != "Any" and "ndarray" not in kind else None)
        annotation = fitting or PARAMETERS.get(name)
        if annotation is None:
            raise SystemExit(f"{owner}: the type of the parameter {name} is not known")
        result.append(f"{name}: {annotation}" + (" = ..." if optional else ""))
    return ", ".join(result)


def whole_doc(function):
    """The docstring with the signature, which Python may have taken out of it."""
    signature = getattr(function, "__text_signature__", None)
    return (f"{function.__name__}{signature}\n" if signature else "") + (function.__doc__ or "")


def signatures(function, name):
    """The signatures that pybind11 wrote: pairs of parameters and return type."""
    doc = function.__doc__ or ""
    found = re.findall(rf"^(?:\d+\. )?{name}\((.*)\) -> (.*)$", doc, re.M)
    return found


def function_lines(owner, name, function, method=False, static=False):
    if owner in VERBS or owner in OTHER_OVERLOADS:
        return verb_lines(owner)
    found = signatures(function, name)
    lines = []
    if found:
        for text, returned in found:
            head = f"def {name}({arguments(owner, text, method)}) -> {RETURNS.get(owner) or return_type(function, returned)}: ..."
            lines.append(head)
    else:
        head = re.search(rf"^{name}\((.*?)\)$", whole_doc(function), re.M | re.S)[1]
        if owner in TWO_SURFACES:
            head = head.replace("a, b", "a: Deformable, b: Deformable", 1)
        if owner == "overlap_graph":
            head = head.replace("store", "store: Store", 1)
        lines.append(f"def {name}({arguments(owner, head, False)}) -> {RETURNS[owner]}: ...")
    if len(lines) > 1:
        lines = [line for text in lines for line in ("@overload", text)]
    return (["@staticmethod"] if static else []) + lines


def return_type(function, returned):
    known = plain_type(returned)
    if known != "Any":
        return known
    match = re.search(r"(?:Returns an?|^An?|as an?) (\w+)", function.__doc__, re.M)
    return match[1] if match and match[1] in abut.__all__ else "Any"


def verb_lines(name):
    lines = []
    for kind, keywords, one in VERBS.get(name, []):
        text = re.search(rf"^{name}\((a, pose_a.*?)\)$", whole_doc(getattr(abut, name)), re.M | re.S)[1]
        order = [word for word, _, _ in parameters_of(text)]
        named = [f"{word}: {WARM_STARTS[kind] + ' | None' if word == 'warm_start' else PARAMETERS[word]} = ..."
                 for word in order if word in keywords]
        named += [f"{word}: {PARAMETERS[word]} = ..." for word in sorted(keywords - set(order))]
        first = ", tolerance: float" if name == "within" else ""
        for pose, returned in (("_OnePose", one), ("_Poses", "Any")):
            lines.append(f"def {name}(a: {kind}, pose_a: {pose}, b: {kind}, pose_b: {pose}{first}, *, {', '.join(named)}) "
                         f"-> {returned}: ...")
    lines += OTHER_OVERLOADS.get(name, [])
    return [line for text in lines for line in ("@overload", text)]


def property_type(owner, name, attribute):
    dtype = getattr(owner, "dtype", None)
    returned = re.match(r"\(.*\) -> (.*)", attribute.fget.__doc__ or "")
    text = attribute.__doc__ or ""
    first = re.match(r"(\w+)", text)
    of_list = re.match(r"list of (\w+)", text)
    if first and first[1] in abut.__all__:
        return first[1] + (" | None" if "else None" in text or "None:" in text else "")
    if of_list and of_list[1] in abut.__all__:
        return f"list[{of_list[1]}]"
    if dtype is not None and name in dtype.names:
        field = dtype.fields[name][0]
        if field.shape:
            return f"NDArray[np.{field.base.name}]"
        kinds = {"b": "bool", "f": "float", "i": "int", "u": "int"}
        if field.kind in kinds:
            return kinds[field.kind]
    known = plain_type(returned[1]) if returned else "Any"
    if known.endswith("Any") and "record array" in text:
        return "np.recarray[Any, Any]"
    for word in ("float64", "uint32", "int64"):
        if known == "NDArray[Any]" and word in text:
            return f"NDArray[np.{word}]"
    return known


def doc_lines(doc, name, indent=""):
    """The docstring without the signatures, which the stub has itself."""
    text = re.sub(r"^Overloaded function\.$|^(\d+\. )?%s\(.*\) -> .*$" % re.escape(name), "", doc or "", flags=re.M)
    while begun := re.match(r"\s*%s\(" % re.escape(name), text):  # signatures that the docstring has in its own words
        depth, end = 1, begun.end()
        while depth and end < len(text):
            depth += (text[end] == "(") - (text[end] == ")")
            end += 1
        text = text[end:].partition("\n")[2]
    lines = [indent + line if line else "" for line in re.sub(r"\n{3,}", "\n\n", text.strip()).split("\n")]
    if lines == [""]:
        return []
    lines[0] = indent + '"""' + lines[0].strip()
    lines[-1] += '"""' if len(lines) == 1 else "\n" + indent + '"""'
    return lines


def with_doc(lines, function, name):
    """The lines of a function with its docstring in the first definition."""
    doc = doc_lines(function.__doc__, name, "    ")
    i = next(i for i, line in enumerate(lines) if line.startswith("def "))
    return lines if not doc else [*lines[:i], lines[i].removesuffix(" ..."), *doc, *lines[i + 1:]]


def class_lines(name, kind):
    if issubclass(kind, enum.IntEnum):
        return [f"class {name}(IntEnum):", *doc_lines(kind.__doc__, name, "    ")] + [f"    {m.name} = {m.value}" for m in kind]
    if issubclass(kind, Exception):
        return [f"class {name}(RuntimeError):", *doc_lines(kind.__doc__, name, "    "), "    code: ErrorCode", "    file: str"]
    body = []
    if hasattr(kind, "dtype"):
        body.append("    dtype: np.dtype[Any]")
    for member, value in vars(kind).items():
        own = f"{name}.{member}"
        if isinstance(value, property):
            known = PROPERTIES.get(own) or property_type(kind, member, value)
            doc = doc_lines(value.__doc__, member, "        ")
            body += ["    @property", f"    def {member}(self) -> {known}:" + ("" if doc else " ..."), *doc]
        elif member == "__init__" and signatures(value, member):
            lines = function_lines(name, member, value, method=True)
            body += ["    " + re.sub(r"-> .*: \.\.\.", "-> None: ...", line) for line in lines]
        elif member in ("__len__", "__bool__"):
            body.append(f"    def {member}(self) -> {'int' if member == '__len__' else 'bool'}: ...")
        elif member == "__mul__":
            body.append(f"    def __mul__(self, other: {name}) -> {name}: ...")
        elif type(value) is int and not member.startswith("_"):
            body.append(f"    {member}: int")
        elif member == "__getitem__":
            body.append("    def __getitem__(self, index: int) -> Contacts: ...")
        elif member == "__enter__":
            body.append(f"    def __enter__(self) -> {name}: ...")
        elif member == "__exit__":
            body.append("    def __exit__(self, *args: Any) -> None: ...")
        elif not member.startswith("_") and member != "dtype":
            static = isinstance(value, staticmethod)
            function = value.__func__ if static else value
            lines = with_doc(function_lines(own, member, function, method=not static, static=static), function, member)
            body += ["    " + line if line else "" for text in lines for line in text.split("\n")]
    base = "(int)" if issubclass(kind, int) else ""
    return [f"class {name}{base}:", *doc_lines(kind.__doc__, name, "    "), *(body or ["    ..."])]


def stubs():
    lines = [HEAD]
    classes = [name for name in abut.__all__ if isinstance(getattr(abut, name), type)]
    for name in sorted(classes):
        lines += [*class_lines(name, getattr(abut, name)), ""]
    for name in sorted(set(abut.__all__) - set(classes)):
        if isinstance(getattr(abut, name), tuple):
            lines += [f"{name}: tuple[str, ...]", ""]
            continue
        lines += with_doc(function_lines(name, name, getattr(abut, name)), getattr(abut, name), name)
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(stubs())
