"""Type stubs of abut, written by python/packaging/make_stubs.py."""

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

class AllowReason(IntEnum):
    """The reason why a pair of links is not tested."""
    adjacent = 0
    at_rest = 1
    always = 2
    never = 3
    user = 4

class AllowedPair:
    """A pair of links that may meet."""
    def __init__(self, a: int, b: int, reason: AllowReason | str = ...) -> None: ...
    @property
    def a(self) -> int:
        """index of a link"""
    @property
    def b(self) -> int:
        """index of a link"""
    @property
    def reason(self) -> AllowReason:
        """AllowReason"""

class Assembly:
    """Parts that move on each other, as read_assembly returns them."""
    def __init__(self, parts: Sequence[AssemblyPart], *, loops: list[AssemblyLoop] = ..., ignored: list[tuple[int, int]] = ...) -> None: ...
    @property
    def file(self) -> str:
        """path as given"""
    @property
    def parts(self) -> list[AssemblyPart]:
        """list of AssemblyPart"""
    @property
    def loops(self) -> list[AssemblyLoop]:
        """list of AssemblyLoop"""
    @property
    def ignored(self) -> list[tuple[int, int]]:
        """list of pairs of parts that are not tested"""
    @property
    def up(self) -> UpAxis:
        """UpAxis"""

class AssemblyJoint:
    """How a part moves on the part that it hangs on. Points are those at rest."""
    def __init__(self, type: AssemblyJointType | str = ..., *, origin: ArrayLike = ..., axis: ArrayLike = ..., limits: tuple[float, float] = ..., keys: JointKeys | None = ..., follow: JointFollow | None = ...) -> None: ...
    @property
    def type(self) -> AssemblyJointType:
        """AssemblyJointType"""
    @property
    def origin(self) -> NDArray[Any]:
        """a point of the axis"""
    @property
    def axis(self) -> NDArray[Any]: ...
    @property
    def limits(self) -> JointLimits:
        """JointLimits"""
    @property
    def keys(self) -> JointKeys:
        """JointKeys"""
    @property
    def follow(self) -> JointFollow:
        """JointFollow, or None"""

class AssemblyJointType(IntEnum):
    """How a part moves on the part that it hangs on."""
    fixed = 0
    revolute = 1
    prismatic = 2
    free = 3

class AssemblyLoop:
    """A closed chain: a rod and a piston or a rocker that a pin joins."""
    def __init__(self, coupler: int, closer: int, pin: ArrayLike) -> None: ...
    @property
    def coupler(self) -> int:
        """index of a part: the rod"""
    @property
    def closer(self) -> int:
        """index of a part: the piston or the rocker"""
    @property
    def pin(self) -> NDArray[Any]:
        """a point of the pin's axis at rest"""

class AssemblyPart:
    """A part of an assembly."""
    def __init__(self, name: str, model: Model, *, pose: _OnePose | ArrayLike = ..., on: int | None = ..., joint: AssemblyJoint | None = ...) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> str:
        """of its model; may be empty"""
    @property
    def model(self) -> Model:
        """Model"""
    @property
    def place(self) -> NDArray[Any]:
        """matrix of shape (4, 4): its place at rest"""
    @property
    def on(self) -> int | None:
        """index of the part that it hangs on; None: the world"""
    @property
    def joint(self) -> AssemblyJoint:
        """AssemblyJoint"""

class Assignment(IntEnum):
    """Which one of its triangles represents a vertex or an edge."""
    greedy = 0
    maximal = 1
    uniform_vertex_edge = 2
    uniform_edge_edge = 3
    adaptive = 4

class BcfBitmap:
    """A picture that stands in the model."""
    def __init__(self) -> None: ...
    @property
    def format(self) -> str:
        """png or jpg"""
    @property
    def reference(self) -> str:
        """name of its file"""
    @property
    def location(self) -> NDArray[Any]: ...
    @property
    def normal(self) -> NDArray[Any]: ...
    @property
    def up(self) -> NDArray[Any]: ...
    @property
    def height(self) -> float:
        """metres"""

class BcfCamera:
    """A camera; metres, z up."""
    def __init__(self) -> None: ...
    @property
    def view_point(self) -> NDArray[Any]: ...
    @property
    def direction(self) -> NDArray[Any]: ...
    @property
    def up(self) -> NDArray[Any]: ...
    @property
    def size(self) -> float:
        """perspective: vertical angle in degrees; orthogonal: metres"""
    @property
    def aspect_ratio(self) -> float | None:
        """width / height; None: not stated"""

class BcfClippingPlane:
    """Cuts away one side."""
    def __init__(self) -> None: ...
    @property
    def location(self) -> NDArray[Any]: ...
    @property
    def direction(self) -> NDArray[Any]:
        """points to what is cut away"""

class BcfColouring:
    """Parts of one colour."""
    def __init__(self) -> None: ...
    @property
    def colour(self) -> str:
        """RRGGBB or AARRGGBB"""
    @property
    def components(self) -> list[BcfComponent]:
        """list of BcfComponent"""

class BcfComment:
    """A comment of a topic."""
    def __init__(self) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def date(self) -> str: ...
    @property
    def author(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def viewpoint(self) -> str:
        """GUID; may be empty"""
    @property
    def modified_date(self) -> str: ...
    @property
    def modified_author(self) -> str: ...
    @property
    def unknown(self) -> BcfUnknown:
        """BcfUnknown"""

class BcfComponent:
    """A part of a building."""
    def __init__(self) -> None: ...
    @property
    def ifc_guid(self) -> str:
        """GlobalId, 22 characters; may be empty"""
    @property
    def originating_system(self) -> str:
        """the program whose id follows"""
    @property
    def authoring_tool_id(self) -> str: ...

class BcfDocument:
    """A document of BCF 3.0."""
    def __init__(self) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def filename(self) -> str: ...
    @property
    def description(self) -> str: ...

class BcfDocumentReference:
    """A link to a document."""
    def __init__(self) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def is_external(self) -> bool:
        """True: an address"""
    @property
    def reference(self) -> str: ...
    @property
    def description(self) -> str: ...

class BcfEntry:
    """A file within a BCF file."""
    def __init__(self) -> None: ...
    @property
    def name(self) -> str:
        """path within the BCF file"""
    @property
    def bytes(self) -> bytes: ...

class BcfExtensions:
    """The words that topics may use."""
    def __init__(self) -> None: ...
    @property
    def types(self) -> list[str]: ...
    @property
    def statuses(self) -> list[str]: ...
    @property
    def priorities(self) -> list[str]: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def users(self) -> list[str]: ...
    @property
    def snippet_types(self) -> list[str]: ...
    @property
    def stages(self) -> list[str]: ...

class BcfFile:
    """Returned by read_bcf."""
    def __init__(self) -> None: ...
    @property
    def version(self) -> BcfVersion:
        """BcfVersion of the file that was read"""
    @property
    def project_id(self) -> str: ...
    @property
    def project_name(self) -> str: ...
    @property
    def extension_schema(self) -> str: ...
    @property
    def extensions(self) -> BcfExtensions:
        """BcfExtensions"""
    @property
    def documents(self) -> list[BcfDocument]:
        """list of BcfDocument"""
    @property
    def topics(self) -> list[BcfTopic]:
        """list of BcfTopic, sorted by folder"""
    @property
    def entries(self) -> list[BcfEntry]:
        """list of BcfEntry: what no other member holds"""
    @property
    def warnings(self) -> list[str]: ...

class BcfHeaderFile:
    """A model that a topic is about."""
    def __init__(self) -> None: ...
    @property
    def ifc_project(self) -> str:
        """GlobalId; may be empty"""
    @property
    def ifc_spatial_structure_element(self) -> str: ...
    @property
    def is_external(self) -> bool: ...
    @property
    def filename(self) -> str: ...
    @property
    def date(self) -> str: ...
    @property
    def reference(self) -> str: ...
    @property
    def unknown(self) -> BcfUnknown:
        """BcfUnknown"""

class BcfLimits:
    """Limits of untrusted files."""
    def __init__(self) -> None: ...
    @property
    def entries(self) -> int: ...
    @property
    def bytes(self) -> int:
        """of all entries, unpacked"""
    @property
    def xml_bytes(self) -> int:
        """of one XML entry, unpacked"""

class BcfSnippet:
    """Data in a format of its own."""
    def __init__(self) -> None: ...
    @property
    def type(self) -> str: ...
    @property
    def is_external(self) -> bool: ...
    @property
    def reference(self) -> str: ...
    @property
    def reference_schema(self) -> str: ...

class BcfTopic:
    """One issue. Texts that are not stated are empty."""
    def __init__(self) -> None: ...
    @property
    def folder(self) -> str:
        """in the file"""
    @property
    def guid(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def status(self) -> str: ...
    @property
    def server_assigned_id(self) -> str: ...
    @property
    def files(self) -> list[BcfHeaderFile]:
        """list of BcfHeaderFile"""
    @property
    def reference_links(self) -> list[str]: ...
    @property
    def title(self) -> str: ...
    @property
    def priority(self) -> str: ...
    @property
    def index(self) -> int | None: ...
    @property
    def labels(self) -> list[str]: ...
    @property
    def creation_date(self) -> str:
        """as 2026-03-01T08:00:00Z"""
    @property
    def creation_author(self) -> str: ...
    @property
    def modified_date(self) -> str: ...
    @property
    def modified_author(self) -> str: ...
    @property
    def due_date(self) -> str: ...
    @property
    def assigned_to(self) -> str: ...
    @property
    def stage(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def snippet(self) -> BcfSnippet:
        """BcfSnippet or None"""
    @property
    def documents(self) -> list[BcfDocumentReference]:
        """list of BcfDocumentReference"""
    @property
    def related_topics(self) -> list[str]:
        """GUIDs"""
    @property
    def comments(self) -> list[BcfComment]:
        """list of BcfComment"""
    @property
    def viewpoints(self) -> list[BcfViewpoint]:
        """list of BcfViewpoint"""
    @property
    def unknown(self) -> BcfUnknown:
        """BcfUnknown, in the topic"""
    @property
    def unknown_markup(self) -> BcfUnknown:
        """BcfUnknown, around the topic"""

class BcfUnknown:
    """XML that is in a file, but not in BCF."""
    def __init__(self) -> None: ...
    @property
    def attributes(self) -> list[tuple[str, str]]:
        """list of names and values"""
    @property
    def elements(self) -> str:
        """XML text"""

class BcfVersion(IntEnum):
    """A version of BCF."""
    v2_0 = 0
    v2_1 = 1
    v3_0 = 2

class BcfViewpoint:
    """What a viewer shows; metres, z up."""
    def __init__(self) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def file(self) -> str:
        """name in the topic's folder; empty: only a snapshot"""
    @property
    def snapshot_file(self) -> str:
        """name; empty: no snapshot"""
    @property
    def snapshot(self) -> bytes:
        """of a PNG or JPEG file"""
    @property
    def index(self) -> int | None: ...
    @property
    def content_guid(self) -> str:
        """stated in the viewpoint's own file"""
    @property
    def has_components(self) -> bool:
        """whether components are stated"""
    @property
    def selection(self) -> list[BcfComponent]:
        """list of BcfComponent"""
    @property
    def colouring(self) -> list[BcfColouring]:
        """list of BcfColouring"""
    @property
    def default_visibility(self) -> bool | None:
        """whether parts other than the exceptions are shown"""
    @property
    def spaces_visible(self) -> bool | None: ...
    @property
    def space_boundaries_visible(self) -> bool | None: ...
    @property
    def openings_visible(self) -> bool | None: ...
    @property
    def exceptions(self) -> list[BcfComponent]:
        """list of BcfComponent"""
    @property
    def perspective(self) -> BcfCamera:
        """BcfCamera or None"""
    @property
    def orthogonal(self) -> BcfCamera:
        """BcfCamera or None"""
    @property
    def lines(self) -> list[list[NDArray[Any]]]:
        """list of pairs of points"""
    @property
    def clipping_planes(self) -> list[BcfClippingPlane]:
        """list of BcfClippingPlane"""
    @property
    def bitmaps(self) -> list[BcfBitmap]:
        """list of BcfBitmap"""
    @property
    def unknown(self) -> BcfUnknown:
        """BcfUnknown, of the topic's file"""
    @property
    def unknown_content(self) -> BcfUnknown:
        """BcfUnknown, of its own file"""

class BodyGap:
    """How two bodies lie to each other, world frame."""
    dtype: np.dtype[Any]
    @property
    def a(self) -> int:
        """body"""
    @property
    def b(self) -> int:
        """body"""
    @property
    def distance(self) -> float:
        """length; 0 if they touch, minus the depth if they interpenetrate"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on a"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on b: point_a + distance * normal, to rounding"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from a to b; zero where none is known"""
    @property
    def triangle_a(self) -> int:
        """of a model; else 0"""
    @property
    def triangle_b(self) -> int:
        """of a model; else 0"""
    @property
    def piece_a(self) -> int:
        """of a Compound; else 0"""
    @property
    def piece_b(self) -> int:
        """of a Compound; else 0"""
    @property
    def status(self) -> Status:
        """Status; bound_only: with a model, they go at least so deep into each other; two solids, and models that coincide, may be separated by a shorter motion"""

class BodyId(int):
    """A body of a World: an int that knows its world.

    It is valid until the body is removed, and then never again. Another World refuses it. In an array it becomes a
    plain integer, which any World takes; so does a pickle of it.

    world  number of the World among those of the process; 0: not told
    """
    world: int
    @property
    def index(self) -> int:
        """int: below World.index_end(), so that an array of that length can be read by it"""
    @property
    def generation(self) -> int:
        """int: number of earlier bodies with this index"""

class BodyImpact:
    """A pair of bodies that meet in a step."""
    dtype: np.dtype[Any]
    @property
    def a(self) -> int:
        """body"""
    @property
    def b(self) -> int:
        """body"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the first contact"""
    @property
    def contact_time(self) -> float:
        """a time at which they are in contact"""
    @property
    def gap(self) -> float:
        """length: how far apart they are at `time`, at most"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on a at `time`"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on b at `time`"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from a to b"""
    @property
    def triangle_a(self) -> int:
        """of a model; else 0"""
    @property
    def triangle_b(self) -> int:
        """of a model; else 0"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def piece_a(self) -> int:
        """of a Compound; else 0"""
    @property
    def piece_b(self) -> int:
        """of a Compound; else 0"""

class BodyRayHit:
    """Where a ray first meets a body. True if it meets one."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """if False, nothing else is set"""
    @property
    def body(self) -> int:
        """body"""
    @property
    def t(self) -> float:
        """the ray's parameter; inf if it meets nothing"""
    @property
    def point(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector out of the body; of a surface, towards the ray's origin; zero if the ray begins inside a solid"""
    @property
    def triangle(self) -> int:
        """of a model or deformable; else 0"""
    @property
    def piece(self) -> int:
        """of a Compound; else 0"""
    def __bool__(self) -> bool: ...

class BodySweepHit:
    """The first body that a moving shape meets. True if it meets one."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """if False, only the time is set: 1"""
    @property
    def body(self) -> int:
        """body"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the first contact"""
    @property
    def contact_time(self) -> float:
        """a time at which they are in contact"""
    @property
    def gap(self) -> float:
        """length: how far apart they are at `time`, at most"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on the body at `time`"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on the shape at `time`"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from the body to the shape"""
    @property
    def triangle_a(self) -> int:
        """of a model; else 0"""
    @property
    def triangle_b(self) -> int:
        """of a model; else 0"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def piece(self) -> int:
        """of a Compound; else 0"""
    def __bool__(self) -> bool: ...

class Box3:
    """A closed axis-aligned box, from two points of shape (3,). Without
    arguments it is empty.
    """
    @overload
    def __init__(self) -> None: ...
    @overload
    def __init__(self, lower: ArrayLike, upper: ArrayLike) -> None: ...
    @property
    def lower(self) -> NDArray[Any]: ...
    @property
    def upper(self) -> NDArray[Any]: ...

class BroadPhase:
    """The overlapping pairs of boxes that move, and which begin and end. Touching boxes overlap.

    method  a BroadPhaseMethod
    filter  function of two indices i < k that tells whether the pair is of interest; called from any
            thread. What it says may change only with forget()
    """
    def __init__(self, *, method: BroadPhaseMethod | str = ..., filter: Callable[[int, int], bool] | None = ...) -> None: ...
    def update(self, lower: ArrayLike, upper: ArrayLike, changed: ArrayLike | None = ...) -> None:
        """Takes the boxes of the next step, arrays of shape (n, 3). Only the boxes at the indices `changed` may differ
        from those before, if it is given. Raises Error (bad_argument) if a bound is not a number.
        """
    def forget(self) -> None:
        """Finds everything anew in the next update: the filter has changed."""
    @property
    def pairs(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2), sorted, the lower index first"""
    @property
    def begun(self) -> NDArray[Any]:
        """pairs that began with the last update"""
    @property
    def ended(self) -> NDArray[Any]:
        """pairs that ended with the last update"""

class BroadPhaseMethod(IntEnum):
    """How pairs of boxes are found."""
    automatic = 0
    tree = 1
    sweep = 2
    sweep_and_prune = 3

class Camera:
    """A perspective camera. Lengths in metres, world frame; field_of_view is the vertical angle in
    radians, width and height are pixels of the picture.
    """
    def __init__(self, eye: ArrayLike = ..., forward: ArrayLike = ..., up: ArrayLike = ..., *, field_of_view: float = ..., width: int = ..., height: int = ..., near: float = ..., far: float = ...) -> None: ...
    @property
    def eye(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def forward(self) -> NDArray[Any]:
        """array of shape (3,): viewing direction"""
    @property
    def up(self) -> NDArray[Any]:
        """array of shape (3,), not parallel to forward"""
    @property
    def field_of_view(self) -> float:
        """radians, in (0, pi)"""
    @property
    def width(self) -> int:
        """pixels"""
    @property
    def height(self) -> int:
        """pixels"""
    @property
    def near(self) -> nearest:
        """nearest distance that is seen"""
    @property
    def far(self) -> float:
        """farthest distance that is seen"""

class Capsule:
    """All points at most `radius` from a Segment."""
    def __init__(self, axis: Segment, radius: float) -> None: ...
    @property
    def axis(self) -> Segment:
        """Segment"""
    @property
    def radius(self) -> float:
        """length, at least 0"""

class CarriedPart:
    """A part as it is carried: its model has the world's axes."""
    @property
    def model(self) -> Model:
        """Model"""
    @property
    def pose(self) -> Pose:
        """Pose: where the part is now"""
    @property
    def linear(self) -> NDArray[Any]:
        """matrix of shape (4, 4): rotation and scale"""
    def world_from_part(self, pose: _Poses) -> NDArray[Any]:
        """Where a pose puts the part, as Walk.move takes it."""

class Carry:
    """A part of a Walk in the hand, by its number. Parts that touch it when it is taken do not
    hold it until it has left them. It keeps the walk alive. Errors as Walk.model.
    """
    def __init__(self, walk: Walk, part: int) -> None: ...
    def move_to(self, pose: _Poses, *, mode: CarryMode | str = ..., clearance: float = ..., depths: bool = ..., skin: float = ..., missing: MissingParts | str = ..., depth_steps: int | None = ...) -> CarryStep:
        """Moves the part towards a rigid pose; no contact on the way is missed.

        mode       a CarryMode
        clearance  length; parts within it are reported
        depths     whether depths are computed where parts overlap
        skin       length of the gap that is kept to parts
        missing    MissingParts
        depth_steps most steps of all depths together; None: no limit

        Returns a CarryStep. Raises Error (bad_argument); KeyboardInterrupt at Ctrl-C.
        """
    @property
    def part(self) -> int:
        """its number"""
    @property
    def carried(self) -> CarriedPart:
        """CarriedPart"""
    @property
    def probe(self) -> Probe:
        """Probe, in the frame that the pose places"""
    @property
    def state(self) -> CarryStep:
        """CarryStep, the last one"""

class CarryMode(IntEnum):
    """What a carried part does where it meets another one."""
    through = 0
    stop = 1
    slide = 2

class CarryStep:
    """Where a carried part has got to."""
    @property
    def pose(self) -> Pose:
        """Pose"""
    @property
    def blocked(self) -> bool:
        """a part kept it from the pose that was asked for"""
    @property
    def waits(self) -> bool:
        """parts that are not in memory did"""
    @property
    def complete(self) -> bool:
        """False: parts that are not in memory are missing in the lists"""
    @property
    def contacts(self) -> record:
        """record array of PartImpact: what blocked it, in order"""
    @property
    def touched(self) -> record:
        """record array of WalkGap: the parts that it overlaps or touches"""
    @property
    def near(self) -> record:
        """record array of WalkGap: the others within the clearance"""

class ChunkDraw:
    """A draw call."""
    dtype: np.dtype[Any]
    @property
    def chunk(self) -> int:
        """number of the chunk"""
    @property
    def first_instance(self) -> int:
        """in ViewFrame.instances"""
    @property
    def instances(self) -> int:
        """how many; 0: the chunk is drawn once"""

class ChunkInstance:
    """A part that shows a shared mesh."""
    dtype: np.dtype[Any]
    @property
    def rows(self) -> NDArray[np.float32]:
        """float32 array of shape (12,): three rows, from the mesh to world minus View.origin"""
    @property
    def part(self) -> int:
        """index in View.parts"""

class Clash:
    """Two parts that clash. Lengths in metres, world frame of the report."""
    @property
    def id(self) -> str:
        """16 hexadecimal digits, the same in every run"""
    @property
    def kind(self) -> ClashKind:
        """ClashKind"""
    @property
    def distance(self) -> float:
        """negative: penetration"""
    @property
    def part_ids(self) -> list[str]:
        """ids of both parts"""
    @property
    def names(self) -> list[str]:
        """names of both parts"""
    @property
    def types(self) -> list[str]:
        """types of both parts"""
    @property
    def files(self) -> list[str]:
        """files of both parts"""
    @property
    def model(self) -> NDArray[Any]:
        """indices of both models"""
    @property
    def part(self) -> NDArray[Any]:
        """indices of both parts in their models; of a store, in its report"""
    @property
    def point_a(self) -> NDArray[Any]:
        """witness on the surface of a"""
    @property
    def point_b(self) -> NDArray[Any]:
        """witness on the surface of b"""
    @property
    def direction(self) -> NDArray[Any]:
        """unit vector in which b moves to get away from a"""
    @property
    def triangle_pairs(self) -> int:
        """intersecting pairs of triangles"""
    @property
    def rule(self) -> str:
        """name of the rule or cell that decided"""
    @property
    def severity(self) -> str:
        """of that rule or cell"""
    @property
    def volume(self) -> float:
        """cubic metres that two solids have in common"""
    @property
    def volume_error(self) -> float:
        """bound of its error"""
    @property
    def rounding(self) -> float:
        """metres by which the coordinates of both are rounded"""
    @property
    def neighbours(self) -> Neighbours:
        """Neighbours: how the parts belong together"""
    @property
    def status(self) -> ClashStatus:
        """ClashStatus, of a store alone"""
    @property
    def note(self) -> str:
        """of whoever reviewed it"""

class ClashGroup:
    """Clashes that share a property."""
    @property
    def id(self) -> str:
        """16 hexadecimal digits, the same in every run"""
    @property
    def name(self) -> str: ...
    @property
    def what(self) -> str:
        """the types that clash, with their numbers"""
    @property
    def kind(self) -> GroupKind:
        """GroupKind"""
    @property
    def key(self) -> str:
        """what all clashes share"""
    @property
    def clashes(self) -> list[int]:
        """indices in the report's clashes"""
    @property
    def groups(self) -> list[ClashGroup]:
        """list of ClashGroup, those of the next criterion"""
    @property
    def bounds(self) -> Box3:
        """Box3 of the witness points"""
    @property
    def centre(self) -> NDArray[Any]: ...
    @property
    def counts(self) -> dict[str, Any]:
        """dict of kind to number"""
    @property
    def deepest(self) -> float:
        """the smallest distance, metres"""
    @property
    def part(self) -> list[int[2]] | None:
        """model and part that all clashes share; else None"""
    @property
    def change(self) -> GroupChange | None:
        """GroupChange, of a store; else None"""

class ClashKind(IntEnum):
    """docs/clash.md defines each kind."""
    hard = 0
    touch = 1
    contained = 2
    duplicate = 3
    clearance = 4
    undecided = 5

class ClashMatrix:
    """Groups of parts, and for pairs of groups whether and how their parts are examined."""
    @property
    def groups(self) -> list[tuple[str, PartQuery]]:
        """pairs of name and PartQuery"""
    @property
    def cells(self) -> list[tuple[int, int, bool, ClashRule]]:
        """tuples of two groups, whether their pairs are examined, and a ClashRule"""

class ClashOrder(IntEnum):
    """The order of clashes."""
    part = 0
    volume = 1

class ClashQuery:
    """A condition on clashes and their parts: 'hard and storey = L2'. Raises Error: bad_argument."""
    def __init__(self, text: str = ...) -> None: ...
    @property
    def text(self) -> str:
        """in a canonical form"""
    def matches(self, report: ClashReport, clash: int) -> bool:
        """Whether a clash of a ClashReport matches. It has no group and no topic; find() knows them."""
    def find(self, report: ClashReport) -> list[int]:
        """The indices of the clashes of a ClashReport that match."""
    def empty(self) -> bool:
        """Whether there is no condition."""
    def names(self) -> list[str]:
        """The names that it asks for."""
    def asks_status(self) -> bool:
        """Whether it asks for a status."""

class ClashReport:
    """Returned by find_clashes. Its length is the number of clashes."""
    @property
    def resolved(self) -> list[ListedClash]:
        """list of ListedClash, of a store"""
    @property
    def grouping(self) -> list[GroupBy]:
        """list of GroupBy; empty: not grouped"""
    @property
    def groups(self) -> list[ClashGroup]:
        """list of ClashGroup, once group_clashes was called"""
    @property
    def history(self) -> list[JobCounts]:
        """list of JobCounts, of a store that was grouped"""
    @property
    def topics(self) -> list[Topic]:
        """list of Topic, of a store that was grouped"""
    @property
    def topics_revision(self) -> int:
        """number of their last change"""
    @property
    def touch_tolerance(self) -> float:
        """metres; the largest one if pairs differ"""
    @property
    def least_touch_tolerance(self) -> float:
        """metres; the smallest one if pairs differ"""
    @property
    def touch_source(self) -> str:
        """'option', 'precision', 'rounding' or 'none'"""
    @property
    def touch_file(self) -> str:
        """the model whose precision or rounding gives the tolerance"""
    @property
    def clashes(self) -> list[Clash]:
        """list of Clash, in the order that `sort` asks for"""
    @property
    def counts(self) -> dict[str, int]:
        """dict of kind to number"""
    @property
    def models(self) -> list[ModelSummary]:
        """list of ModelSummary"""
    @property
    def up(self) -> UpAxis:
        """UpAxis of all points"""
    @property
    def warnings(self) -> list[str]:
        """list of str: what makes the result doubtful"""
    @property
    def clearance(self) -> float:
        """metres"""
    @property
    def candidates(self) -> int:
        """pairs of parts whose boxes are near"""
    @property
    def surfaces(self) -> Surfaces:
        """Surfaces: the parts that bound no solid, and so contain nothing"""
    @property
    def left_out(self) -> dict[str, Any]:
        """dict of LeftOut to number of pairs"""
    @property
    def neighbours(self) -> dict[str, Any]:
        """dict of Neighbours to number of clashes"""
    @property
    def matrix(self) -> Matrix:
        """Matrix: the clashes cell by cell; None without a matrix"""
    @property
    def statuses(self) -> dict[str, int] | None:
        """dict of status to number, of a store; else None"""
    @property
    def counters(self) -> OutOfCoreCounters | None:
        """OutOfCoreCounters, of a store; else None"""
    @property
    def seconds(self) -> dict[str, float]:
        """dict of stage to seconds"""
    @property
    def peak_rss_mib(self) -> float:
        """MiB"""
    def __len__(self) -> int: ...

class ClashReview:
    """The clashes of one question, as its last job left them."""
    @property
    def clearance(self) -> float:
        """metres"""
    @property
    def touch_tolerance(self) -> float | None:
        """metres; None: what the files tell apart"""
    @property
    def self(self) -> bool: ...
    @property
    def rules(self) -> int:
        """how many"""
    @property
    def finished(self) -> int:
        """when the job ended, in seconds since 1970"""
    @property
    def statuses(self) -> dict[str, int]:
        """dict of status to number"""
    @property
    def clashes(self) -> list[ListedClash]:
        """list of ListedClash, resolved ones too"""

class ClashRule:
    """Selects pairs of parts, one side each, in either order. Lengths in metres; None: those of the query."""
    def __init__(self, name: str = ..., a: PartSelector = ..., b: PartSelector = ..., *, clearance: float | None = ..., touch_tolerance: float | None = ..., ignore: IgnoreRule = ..., tolerated_depth: float | None = ..., kinds: Sequence[ClashKind | str] = ..., severity: str = ...) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def a(self) -> PartSelector:
        """PartSelector"""
    @property
    def b(self) -> PartSelector:
        """PartSelector"""
    @property
    def clearance(self) -> float | None:
        """metres"""
    @property
    def touch_tolerance(self) -> float | None:
        """metres"""
    @property
    def ignore(self) -> IgnoreRule:
        """IgnoreRule"""
    @property
    def tolerated_depth(self) -> float | None:
        """metres; parts that meet no deeper are left out"""
    @property
    def kinds(self) -> list[ClashKind]:
        """list of ClashKind that are reported; empty: all"""
    @property
    def severity(self) -> str: ...

class ClashStatus(IntEnum):
    """What has become of a clash between the jobs of a store."""
    fresh = 0
    active = 1
    reviewed = 2
    approved = 3
    resolved = 4

class ClashViewpoint:
    """A camera that shows one clash or several. Lengths in metres."""
    @property
    def eye(self) -> NDArray[Any]: ...
    @property
    def direction(self) -> NDArray[Any]:
        """unit vector"""
    @property
    def up(self) -> NDArray[Any]:
        """unit vector"""
    @property
    def fov(self) -> float:
        """vertical angle in radians"""
    @property
    def aspect(self) -> float:
        """width of the picture, divided by its height"""
    @property
    def section_box(self) -> Box3:
        """Box3; what lies outside may be hidden"""
    @property
    def shown_a(self) -> float:
        """fraction of the picture that side a covers"""
    @property
    def shown_b(self) -> float:
        """fraction of the picture that side b covers"""
    @property
    def side_a(self) -> list[ReportPart]:
        """list of ReportPart"""
    @property
    def side_b(self) -> list[ReportPart]:
        """list of ReportPart"""
    @property
    def near(self) -> list[NamedPart]:
        """list of NamedPart: others in the section box"""

class Colour:
    """As displays take it: sRGB, each 0 to 255."""
    def __init__(self, red: int, green: int, blue: int, alpha: int = ...) -> None: ...
    @property
    def red(self) -> int: ...
    @property
    def green(self) -> int: ...
    @property
    def blue(self) -> int: ...
    @property
    def alpha(self) -> int:
        """0: transparent"""

class ColourBy(IntEnum):
    """What parts take their colours from."""
    material = 0
    type = 1
    file = 2
    part = 3
    storey = 4
    clash = 5

class ColourGroup:
    """A row of the legend of colours."""
    @property
    def word(self) -> str:
        """a type, a file, a storey, a kind, or 'none'"""
    @property
    def colour(self) -> Colour:
        """Colour"""
    @property
    def parts(self) -> int:
        """how many"""

class Compound:
    """Several rigid shapes that move as one body of a World.

    pieces  a list of shapes, each alone or as (shape, pose) in the compound's frame; or a ConvexPieces

    Raises Error (bad_argument) if there is no piece; the message names a piece that is not valid.
    """
    def __init__(self, pieces: Iterable[_RigidShape | tuple[_RigidShape, _OnePose | ArrayLike]] | ConvexPieces) -> None: ...
    def __len__(self) -> int: ...

class Cone:
    """The solid between an apex and a disc around `base`, across the axis."""
    def __init__(self, apex: ArrayLike, base: ArrayLike, radius: float) -> None: ...
    @property
    def apex(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def base(self) -> NDArray[Any]:
        """array of shape (3,): centre of the disc"""
    @property
    def radius(self) -> float:
        """length, at least 0"""

class ConstraintColours:
    """Constraints in groups of which no two share a vertex. Returned by colour_constraints."""
    @property
    def order(self) -> NDArray[np.uint32]:
        """uint32 array: the constraints of the first colour, then those of the second, ..."""
    @property
    def begins(self) -> NDArray[np.uint32]:
        """uint32 array: where each colour begins in `order`, and its length"""
    def count(self) -> int:
        """The number of colours."""
    def of(self, colour: int) -> NDArray[Any]:
        """The constraints of a colour: a uint32 array."""
    def __len__(self) -> int: ...

class ContactManifold:
    """A region where two bodies are in contact, world frame."""
    dtype: np.dtype[Any]
    @property
    def a(self) -> int:
        """body"""
    @property
    def b(self) -> int:
        """body"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from a to b"""
    @property
    def region(self) -> int:
        """names the contact region of this pair; 0 for convex bodies"""
    @property
    def piece_a(self) -> int:
        """of a Compound; else 0"""
    @property
    def piece_b(self) -> int:
        """of a Compound; else 0"""
    @property
    def user_data_a(self) -> int:
        """of the body, as add takes it"""
    @property
    def user_data_b(self) -> int:
        """as user_data_a"""
    @property
    def count(self) -> int:
        """of the points that are set"""
    @property
    def points(self) -> list[ContactPoint]:
        """list of ContactPoint: four, the deepest first"""
    @property
    def status(self) -> Status:
        """Status; bound_only: of two models, along the normal; else as of BodyGap"""

class ContactMode(IntEnum):
    """Whether to stop at the first pair."""
    first = 0
    all = 1

class ContactPoint:
    """A point of a ContactManifold."""
    dtype: np.dtype[Any]
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on a"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on b"""
    @property
    def depth(self) -> float:
        """length along the normal; negative: a gap"""
    @property
    def feature(self) -> int:
        """names the two features that make the point; stays while they do"""
    @property
    def triangle_a(self) -> int:
        """of a model or deformable: the triangle of the contact; else 0"""
    @property
    def triangle_b(self) -> int:
        """as triangle_a"""

class ContactRegion:
    """A place where two models meet."""
    @property
    def pairs(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2): triangles of a and of b"""
    @property
    def touching(self) -> bool:
        """nothing crosses: depth 0"""
    @property
    def area(self) -> float:
        """enclosed by the intersection curve, along the normal"""
    @property
    def normal(self) -> NDArray[Any]:
        """unit vector from a to b"""
    @property
    def depth(self) -> float:
        """length, of the deepest point of either surface inside the other"""
    @property
    def depth_at_most(self) -> float:
        """proven: no such point lies deeper"""
    @property
    def point_a(self) -> NDArray[Any]:
        """on the surface of a, world frame"""
    @property
    def point_b(self) -> NDArray[Any]:
        """on the surface of b, world frame"""
    @property
    def direction(self) -> NDArray[Any]:
        """unit vector in which b moves to get out"""

class Contacts:
    """Returned by collide. True if the models meet."""
    @property
    def meet(self) -> bool:
        """whether the surfaces share a point"""
    @property
    def pairs(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2): triangles of a and of b, sorted"""
    @property
    def segments(self) -> list[NDArray[np.float64]]:
        """list of arrays of shape (1 to 6, 3), one for each pair, if asked for"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def counters(self) -> Counters:
        """Counters"""
    def __bool__(self) -> bool: ...

class ContactsList:
    """Returned by collide for many poses: a sequence of Contacts."""
    @property
    def meet(self) -> NDArray[Any]:
        """array of bool of shape (n,)"""
    @property
    def pairs(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 2): the pairs of all poses"""
    @property
    def offsets(self) -> NDArray[np.int64]:
        """int64 array of shape (n + 1,): those of pose i are pairs[offsets[i]:offsets[i + 1]]"""
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> Contacts: ...

class Containment:
    """Returned by contains."""
    dtype: np.dtype[Any]
    @property
    def side(self) -> Side:
        """Side"""
    @property
    def method(self) -> ContainmentMethod:
        """ContainmentMethod"""
    @property
    def winding_number(self) -> float:
        """if the method is winding; else 0"""

class ContainmentMethod(IntEnum):
    """How contains decided: crossings, exact, for closed models; else the winding number."""
    crossings = 0
    winding = 1

class Convex:
    """A solid convex body: the hull of points of shape (n, 3), or a mesh that is convex already. It never
    changes; any number of threads may query it.

    relative_dent  how deep a dent of a mesh is taken for rounding, as a share of its diagonal

    Raises Error (bad_mesh) if there is no point, a coordinate is not finite, or the mesh is not closed
    or not convex.
    """
    def __init__(self, points: ArrayLike, faces: ArrayLike | None = ..., *, relative_dent: float = ...) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]:
        """float64 array of shape (n, 3)"""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2)"""
    @property
    def faces(self) -> list[NDArray[np.uint32]]:
        """list of arrays: the vertices of each face, counter-clockwise as seen from outside"""
    @property
    def source(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n,): which of the points given each vertex is"""
    @property
    def dimension(self) -> int:
        """3, or 2 for a polygon, 1 for a segment, 0 for a point"""
    def mesh(self) -> Mesh:
        """The surface in triangles, a Mesh."""
    @property
    def bytes(self) -> int: ...

class ConvexCounters:
    """The work that a query did."""
    dtype: np.dtype[Any]
    @property
    def feature_pairs(self) -> int:
        """pairs of features that were measured"""
    @property
    def simplices(self) -> int:
        """steps of the search that takes over"""

class ConvexDepth:
    """Returned by penetration of two Convex."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """they share a point"""
    @property
    def depth(self) -> float:
        """length of the shortest translation that leaves them touching"""
    @property
    def at_least(self) -> float:
        """proven: no shorter one does"""
    @property
    def direction(self) -> NDArray[np.float64]:
        """unit vector in which b moves by `depth`"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on the surface, world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on the surface, world frame"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def counters(self) -> ConvexCounters:
        """ConvexCounters"""
    def __bool__(self) -> bool: ...

class ConvexGap:
    """Returned by distance of two Convex."""
    dtype: np.dtype[Any]
    @property
    def distance(self) -> float:
        """length; 0 exactly if they share a point"""
    @property
    def at_least(self) -> float:
        """proven: no two points are closer"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def feature_a(self) -> Feature:
        """Feature that the point lies on"""
    @property
    def feature_b(self) -> Feature:
        """Feature that the point lies on"""
    @property
    def id_a(self) -> int:
        """number of that vertex, edge or face"""
    @property
    def id_b(self) -> int:
        """number of that vertex, edge or face"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def counters(self) -> ConvexCounters:
        """ConvexCounters"""

class ConvexPieces:
    """A closed model as a solid, decomposed into convex pieces. It never changes; any number of threads
    may query it. Takes what Model takes.

    Raises Error (bad_mesh) if the mesh is not closed, or turned inside out.
    """
    def __init__(self, model: ArrayLike | _Mesh, faces: ArrayLike | None = ...) -> None: ...
    def __len__(self) -> int: ...
    @property
    def size(self) -> int:
        """number of pieces"""
    def triangles(self, piece: int) -> NDArray[Any]:
        """The triangles of a piece, a uint32 array of shape (n,)."""
    def hull(self, piece: int) -> Convex:
        """The hull of a piece, a Convex."""
    @property
    def model(self) -> Model: ...
    @property
    def bytes(self) -> int: ...

class ConvexWarmStart:
    """Remembers the closest features of two convex bodies for the next pose."""
    def __init__(self) -> None: ...

class Counters:
    """The work that a query did, the same on every machine."""
    dtype: np.dtype[Any]
    @property
    def volume(self) -> Volume:
        """Volume that was tested; models of different kinds: see common_volume"""
    @property
    def volume_tests(self) -> int:
        """pairs of bounding volumes"""
    @property
    def primitive_tests(self) -> int:
        """pairs of triangles"""
    @property
    def exact_tests(self) -> int:
        """signs that only exact arithmetic could decide"""

class Crew:
    """Processes that do one job together, made by join_crew. Rank 0 is the leader. A context manager: leaving
    it leaves the crew, which waits until the processes that it exchanges messages with have left too.
    """
    @property
    def rank(self) -> int: ...
    @property
    def size(self) -> int: ...
    @property
    def threads(self) -> int:
        """number of threads for this process; set_threads takes it"""
    def leave(self) -> None:
        """Leaves the crew."""
    def __enter__(self) -> Crew: ...
    def __exit__(self, *args: Any) -> None: ...

class Culling(IntEnum):
    """How pairs of triangles that may meet are found."""
    tree = 0
    grid = 1
    sweep = 2

class Cylinder:
    """The solid between two discs of the same radius across the ends of a Segment."""
    def __init__(self, axis: Segment, radius: float) -> None: ...
    @property
    def axis(self) -> Segment:
        """Segment"""
    @property
    def radius(self) -> float:
        """length, at least 0"""

class Deformable:
    """A triangle mesh whose vertices move from step to step: in a step every vertex goes in a straight line from
    its start to its end while t goes from 0 to 1. Takes what Model takes; at rest until the first step.

    lean keeps no boxes of features: less than half of the memory, somewhat slower.
    Several threads may query it; a change while a query runs raises RuntimeError.
    Raises Error (bad_mesh) as Model.
    """
    def __init__(self, vertices: ArrayLike | _Mesh, faces: ArrayLike | None = ..., *, scheme: Scheme | str = ..., assignment: Assignment | str = ..., culling: Culling | str = ..., lean: bool = ...) -> None: ...
    def set_motion(self, start: ArrayLike, end: ArrayLike) -> None:
        """Sets the step: where every vertex is at t = 0 and t = 1, arrays of shape (n, 3).

        Raises Error: bad_argument if there are not as many positions as vertices, bad_mesh if a coordinate is not
        finite or beyond 1e18. Nothing has changed then.
        """
    def advance(self, end: ArrayLike) -> None:
        """Sets the next step: the end of the last one is its start. Errors as set_motion."""
    def set_mesh(self, vertices: ArrayLike | _Mesh, faces: ArrayLike | None = ...) -> None:
        """Takes another mesh, at rest: cutting, fracture, remeshing. Errors as the constructor."""
    def adapt(self, impacts: Impacts) -> None:
        """Moves features off triangles that met something, for assignment='adaptive'. In: the result of
        self_impacts of this surface. Changes no answer.
        """
    def model(self) -> Model:
        """The surface at the start of its step as a Model, for every query that takes one. Its hierarchy is
        refitted from step to step. The model keeps its positions when the surface moves on.
        """
    @property
    def vertex_count(self) -> int: ...
    @property
    def faces(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 3)"""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """uint32 array of shape (k, 2): every pair of vertices that a triangle joins"""
    @property
    def bytes(self) -> int: ...

class DeformableCounters:
    """The work that a query did."""
    dtype: np.dtype[Any]
    @property
    def triangle_pairs(self) -> int:
        """whose boxes overlap"""
    @property
    def candidates(self) -> TestCounts:
        """TestCounts of feature pairs to be tested"""
    @property
    def elementary_tests(self) -> TestCounts:
        """TestCounts of those whose roots were searched"""
    @property
    def exact_fallbacks(self) -> int:
        """of these, those that integers decided"""

class Depth:
    """Returned by penetration. True if the models meet."""
    @property
    def meet(self) -> bool:
        """they share a point, or one lies inside the other"""
    @property
    def interpenetrate(self) -> bool:
        """they do more than touch"""
    @property
    def depth(self) -> float:
        """length; a lower bound of every separating translation's"""
    @property
    def depth_at_most(self) -> float:
        """upper bound of the deepest point's depth"""
    @property
    def direction(self) -> NDArray[Any]:
        """unit vector, of the deepest region"""
    @property
    def point_a(self) -> NDArray[Any]:
        """of the deepest region"""
    @property
    def point_b(self) -> NDArray[Any]:
        """of the deepest region"""
    @property
    def separation(self) -> NDArray[Any]:
        """translation of b after which the models are apart: verified"""
    @property
    def regions(self) -> list[ContactRegion]:
        """list of ContactRegion"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def out_of_steps(self) -> bool:
        """whether max_steps ended the search"""
    @property
    def steps(self) -> int:
        """steps of the search"""
    @property
    def counters(self) -> Counters:
        """Counters"""
    def __bool__(self) -> bool: ...

class DistanceColours:
    """Colours surfaces by their distance from a part; made by distances_from. Red where it is 0, blue
    at the reach; what is farther keeps its part's colour.
    """
    @property
    def reach(self) -> float:
        """length"""
    @property
    def grid(self) -> int:
        """the distance is computed for one pixel in grid x grid and at borders of parts"""
    def distance(self, part: int, point: ArrayLike) -> float:
        """The distance of a point on a part's surface, at most the reach."""

class EdgeFaceContact(IntEnum):
    """How an edge and a face that share a point lie to each other."""
    crossing = 0
    touching = 1
    coplanar = 2

class EdgeFaceIntersection:
    """An edge and a face at rest that share a point."""
    dtype: np.dtype[Any]
    @property
    def face_first(self) -> bool:
        """the face is the first surface's, the edge the second's"""
    @property
    def edge(self) -> int:
        """row of Deformable.edges"""
    @property
    def face(self) -> int:
        """row of Deformable.faces"""
    @property
    def contact(self) -> EdgeFaceContact:
        """EdgeFaceContact"""
    @property
    def point(self) -> NDArray[np.float64]:
        """a shared point; of a shared segment, its middle"""
    @property
    def along(self) -> float:
        """on the edge: 0 at its first vertex, 1 at its second"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """weights in the face"""

class ElementaryImpact:
    """Returned by elementary_impact."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """whether they share a point in [0, 1], or come within the thickness"""
    @property
    def decided_by(self) -> ElementaryStage:
        """ElementaryStage"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the first contact"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """weights in the face, or parameters on the edges"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from the second feature towards the first"""
    def __bool__(self) -> bool: ...

class ElementaryKind(IntEnum):
    """Which features meet."""
    vertex_face = 0
    edge_edge = 1

class ElementaryStage(IntEnum):
    """Who decided a test."""
    filter = 0
    interval = 1
    exact = 2

class Ellipsoid:
    """A solid ellipsoid along the axes of its frame."""
    def __init__(self, centre: ArrayLike, semi_axes: ArrayLike) -> None: ...
    @property
    def centre(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def semi_axes(self) -> NDArray[Any]:
        """array of shape (3,): lengths, at least 0"""

class Error(RuntimeError):
    """Bad data, failed input or output, and limits.

    code: an ErrorCode. file: the file at fault, or an empty string.
    Arguments of a wrong type or shape raise TypeError and ValueError.
    """
    code: ErrorCode
    file: str

class ErrorCode(IntEnum):
    """The kind of fault that an Error reports."""
    bad_argument = 0
    file_not_found = 1
    unreadable = 2
    malformed = 3
    unsupported = 4
    bad_mesh = 5
    reader_failed = 6
    cannot_write = 7
    interrupted = 8

class Feature(IntEnum):
    """The part of a triangle that a point belongs to."""
    vertex = 0
    edge = 1
    face = 2

class FeatureImpact:
    """Two features that meet."""
    dtype: np.dtype[Any]
    @property
    def kind(self) -> ElementaryKind:
        """ElementaryKind"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def face_first(self) -> bool:
        """the face is the first surface's, the vertex the second's"""
    @property
    def a(self) -> int:
        """vertex, or edge"""
    @property
    def b(self) -> int:
        """triangle, or edge"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the contact"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """weights in the face, or parameters on the edges"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from b towards a"""

class FeaturePair:
    """Two features at rest that are near each other. The gradient of their distance by vertices[i] is weights[i] * normal."""
    dtype: np.dtype[Any]
    @property
    def kind(self) -> ElementaryKind:
        """ElementaryKind"""
    @property
    def face_first(self) -> bool:
        """the face is the first surface's, the vertex the second's"""
    @property
    def side(self) -> int:
        """1, -1 or 0: the side of the triangle that the vertex is on, or the sign of the edges' volume. Exact"""
    @property
    def a(self) -> int:
        """vertex, or edge"""
    @property
    def b(self) -> int:
        """triangle, or edge"""
    @property
    def vertices(self) -> NDArray[np.uint32]:
        """those of a, then those of b"""
    @property
    def distance(self) -> float:
        """length"""
    @property
    def limit(self) -> float:
        """the distance up to which this pair is listed"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """of the closest points"""
    @property
    def weights(self) -> NDArray[np.float64]:
        """of the vertices: the sum of weight times position is point_a - point_b"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """closest point of a"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """closest point of b"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from point_b to point_a"""

class FeatureTest:
    """Two features to be tested."""
    dtype: np.dtype[Any]
    @property
    def kind(self) -> ElementaryKind:
        """ElementaryKind"""
    @property
    def face_first(self) -> bool:
        """the face is the first surface's, the vertex the second's"""
    @property
    def a(self) -> int:
        """vertex, or edge"""
    @property
    def b(self) -> int:
        """triangle, or edge"""
    @property
    def vertices(self) -> NDArray[np.uint32]:
        """the vertex, then the face's three; or the edges' two each"""

class FirstContact:
    """Returned by Walk.sweep and Walk.time_of_impact. True if the probe meets a part."""
    @property
    def meet(self) -> bool:
        """if False, impact is not set"""
    @property
    def impact(self) -> PartImpact:
        """PartImpact"""
    @property
    def time_free(self) -> float:
        """in [0, 1]: until then no part is met, whether it is in memory or not"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""
    def __bool__(self) -> bool: ...

class FoundParts:
    """Returned by View.find_parts."""
    @property
    def parts(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n,): indices in View.parts"""
    @property
    def next(self) -> int:
        """where to go on; the number of parts if all were compared"""

class Gap:
    """Returned by distance."""
    dtype: np.dtype[Any]
    @property
    def distance(self) -> float:
        """length; 0 if the surfaces meet"""
    @property
    def at_least(self) -> float:
        """proven: no two points are closer"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """closest point of a, world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """closest point of b, world frame"""
    @property
    def triangle_a(self) -> int:
        """triangle of a with the point"""
    @property
    def triangle_b(self) -> int:
        """triangle of b with the point"""
    @property
    def feature_a(self) -> Feature:
        """Feature of the triangle that the point lies on"""
    @property
    def feature_b(self) -> Feature:
        """Feature of the triangle that the point lies on"""
    @property
    def index_a(self) -> int:
        """which vertex or edge of the triangle"""
    @property
    def index_b(self) -> int:
        """which vertex or edge of the triangle"""
    @property
    def status(self) -> Status:
        """Status; bound_only: nothing nearer than upper_bound, or out of steps"""
    @property
    def out_of_steps(self) -> bool:
        """whether max_steps ended the search"""
    @property
    def steps(self) -> int:
        """steps of the search"""
    @property
    def counters(self) -> Counters:
        """Counters"""

class GraphReport:
    """Returned by overlap_graph."""
    @property
    def nodes(self) -> int:
        """parts"""
    @property
    def edges(self) -> int:
        """pairs of parts whose boxes are near"""
    @property
    def components(self) -> int: ...
    @property
    def isolated(self) -> int:
        """parts without an edge"""
    @property
    def largest_component(self) -> int: ...
    @property
    def highest_valence(self) -> int: ...
    @property
    def mean_valence(self) -> float: ...
    @property
    def bytes(self) -> int:
        """of the models that an edge needs, each once"""
    @property
    def large_meshes(self) -> int: ...
    @property
    def large_bytes(self) -> int: ...
    @property
    def units(self) -> list[WorkUnit]:
        """list of WorkUnit, in the order of work"""
    @property
    def cut_edges(self) -> int:
        """between parts that a partition put apart"""
    @property
    def lines(self) -> NDArray[Any]:
        """array of shape (n, 2, 3): ends of some of the edges"""
    @property
    def seconds(self) -> float: ...

class Ground:
    """A horizontal plane with a grid."""
    def __init__(self, middle: ArrayLike, reach: float = ...) -> None: ...
    @property
    def middle(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def reach(self) -> float:
        """length from the middle where it has faded"""

class GroupBy(IntEnum):
    """A criterion by which clashes are grouped."""
    part = 0
    place = 1
    storey = 2
    system = 3
    types = 4
    discipline = 5

class GroupChange(IntEnum):
    """What has become of a group between two jobs of a store."""
    fresh = 0
    active = 1
    moved = 2
    reopened = 3
    resolved = 4

class GroupKind(IntEnum):
    """What the clashes of a group share."""
    part = 0
    copies = 1
    place = 2
    storey = 3
    system = 4
    types = 5
    discipline = 6

class GroupReview:
    """The groups of one question by one grouping, and their changes."""
    @property
    def clearance(self) -> float:
        """metres"""
    @property
    def touch_tolerance(self) -> float | None:
        """metres; None: what the files tell apart"""
    @property
    def self(self) -> bool: ...
    @property
    def rules(self) -> int:
        """how many"""
    @property
    def by(self) -> list[GroupBy]:
        """list of GroupBy"""
    @property
    def since(self) -> int:
        """end of the job that changes are counted from"""
    @property
    def finished(self) -> int:
        """end of the last job"""
    @property
    def changes(self) -> dict[str, Any]:
        """dict of change to number"""
    @property
    def groups(self) -> list[ListedGroup]:
        """list of ListedGroup"""
    @property
    def history(self) -> list[JobCounts]:
        """list of JobCounts, the earliest first"""

class HalfSpace:
    """All points x with normal . x <= offset."""
    def __init__(self, normal: ArrayLike, offset: float) -> None: ...
    @property
    def normal(self) -> NDArray[Any]:
        """array of shape (3,): points out of the solid"""
    @property
    def offset(self) -> float:
        """in lengths of the normal"""

class HitPart:
    """Returned by Walk.first_hit. True if the ray meets a part."""
    @property
    def meet(self) -> bool:
        """if False, only at_least is set"""
    @property
    def part(self) -> int:
        """number of the part"""
    @property
    def t(self) -> float:
        """the ray's parameter"""
    @property
    def point(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def triangle(self) -> int:
        """of the part's mesh"""
    @property
    def barycentric(self) -> NDArray[Any]:
        """weights of the triangle's vertices"""
    @property
    def side(self) -> HitSide:
        """HitSide"""
    @property
    def at_least(self) -> float:
        """no part is met at a smaller parameter"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""
    def __bool__(self) -> bool: ...

class HitSide(IntEnum):
    """Which side of a triangle a ray comes from."""
    front = 0
    back = 1
    along = 2

class IgnoreRule:
    """Pairs of parts that a rule leaves out."""
    def __init__(self, *, same_file: bool = ..., same_type: bool = ..., same_name_prefix: int = ..., neighbours: Sequence[Neighbours | str] = ...) -> None: ...
    @property
    def same_file(self) -> bool: ...
    @property
    def same_type(self) -> bool: ...
    @property
    def same_name_prefix(self) -> int:
        """names that agree in so many first characters"""
    @property
    def neighbours(self) -> list[Neighbours]:
        """list of Neighbours"""

class Impact:
    """Returned by time_of_impact. True if the models meet."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """whether they meet, to be safe also if that was not decided"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the first contact"""
    @property
    def contact_time(self) -> float:
        """a time at which they are in contact; inf if none was found"""
    @property
    def gap(self) -> float:
        """length: how far apart they are at `time`, at most"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """closest point of a at `time`, world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """closest point of b at `time`, world frame"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from a to b; zero if they meet at the start"""
    @property
    def triangle_a(self) -> int:
        """triangle of a"""
    @property
    def triangle_b(self) -> int:
        """triangle of b"""
    @property
    def status(self) -> Status:
        """Status; bound_only: it was not decided whether they touch"""
    @property
    def out_of_steps(self) -> bool:
        """whether max_steps ended the search"""
    @property
    def steps(self) -> int:
        """steps of the search"""
    @property
    def counters(self) -> Counters:
        """Counters"""
    def __bool__(self) -> bool: ...

class Impacts:
    """Returned by impacts and self_impacts."""
    @property
    def list(self) -> record:
        """record array of FeatureImpact, sorted by kind, face_first, a, b"""
    @property
    def counters(self) -> DeformableCounters:
        """DeformableCounters"""
    def __len__(self) -> int: ...

class ImportOutcome(IntEnum):
    """What an import did to one file."""
    added = 0
    changed = 1
    unchanged = 2

class ImportReport:
    """Returned by import_models."""
    @property
    def models(self) -> list[ImportedModel]:
        """list of ImportedModel"""
    @property
    def new_meshes(self) -> int:
        """stored; the others were there already"""
    @property
    def removed_meshes(self) -> int:
        """that no part uses any more"""
    @property
    def seconds(self) -> float: ...

class ImportedModel:
    """What an import did to one file."""
    @property
    def file(self) -> str:
        """as given"""
    @property
    def outcome(self) -> ImportOutcome:
        """ImportOutcome"""
    @property
    def streamed(self) -> bool:
        """by a reader that does not load the file whole"""
    @property
    def bytes(self) -> int: ...
    @property
    def parts(self) -> int: ...
    @property
    def triangles(self) -> int:
        """each instance counted"""
    @property
    def added(self) -> int:
        """parts"""
    @property
    def changed(self) -> int:
        """parts"""
    @property
    def removed(self) -> int:
        """parts"""
    @property
    def seconds(self) -> float: ...
    @property
    def unit(self) -> float:
        """metres per unit of the file"""
    @property
    def up(self) -> UpAxis:
        """UpAxis of the file"""
    @property
    def notes(self) -> list[SceneNote]:
        """list of SceneNote"""

class Intersection:
    """The points that two triangles share."""
    dtype: np.dtype[Any]
    @property
    def count(self) -> int:
        """corners: 1 a point, 2 a segment, 3 to 6 a polygon"""

class JobCounts:
    """The numbers of one job of a store."""
    @property
    def finished(self) -> int:
        """seconds since 1970"""
    @property
    def kinds(self) -> dict[str, Any]:
        """dict of kind to number"""
    @property
    def statuses(self) -> dict[str, Any]:
        """dict of status to number"""
    @property
    def groups(self) -> dict[str, Any]:
        """dict of change to number"""

class JointFollow:
    """A joint that follows that of another part: ratio * value + offset."""
    def __init__(self, part: int, ratio: float = ..., offset: float = ...) -> None: ...
    @property
    def part(self) -> int:
        """index of the part that is followed"""
    @property
    def ratio(self) -> float: ...
    @property
    def offset(self) -> float:
        """radians or metres"""

class JointKeys:
    """The value of a joint over time; between two keys it changes at a constant rate."""
    def __init__(self, times: list[float] = ..., values: list[float] = ..., poses: Sequence[Pose] = ...) -> None: ...
    @property
    def times(self) -> list[float]:
        """list of seconds, ascending"""
    @property
    def values(self) -> list[float]:
        """list of radians or metres, one for each time"""
    @property
    def poses(self) -> list[Pose]:
        """list of Pose, one for each time, of a free joint"""

class JointLimits:
    """Bounds of a joint's value."""
    @property
    def lower(self) -> float:
        """radians or metres; -inf: none"""
    @property
    def upper(self) -> float:
        """radians or metres; inf: none"""

class JointMimic:
    """A joint that follows another: multiplier * value + offset."""
    @property
    def joint(self) -> int:
        """index of the joint that is followed"""
    @property
    def multiplier(self) -> float: ...
    @property
    def offset(self) -> float:
        """radians or metres"""

class JointType(IntEnum):
    """How a joint moves its child link."""
    fixed = 0
    revolute = 1
    continuous = 2
    prismatic = 3
    planar = 4
    floating = 5

class LeftOut(IntEnum):
    """Why a pair is not in a report."""
    not_selected = 0
    ignored = 1
    off = 2
    fills = 3
    connected = 4
    covers = 5
    same_assembly = 6
    tolerated = 7
    other_kind = 8

class LevelReport:
    """Returned by build_levels."""
    @property
    def built(self) -> bool:
        """False: the levels were there and are current"""
    @property
    def chunks(self) -> int: ...
    @property
    def new_chunks(self) -> int:
        """made now; others were kept"""
    @property
    def triangles(self) -> int:
        """of all chunks"""
    @property
    def stored_bytes(self) -> int: ...
    @property
    def geometry_bytes(self) -> int:
        """stored bytes of the meshes"""
    @property
    def seconds(self) -> float: ...

class ListedClash:
    """A clash as a store lists it: in words, since its parts may be gone."""
    @property
    def id(self) -> str:
        """16 hexadecimal digits"""
    @property
    def kind(self) -> ClashKind:
        """ClashKind"""
    @property
    def status(self) -> ClashStatus:
        """ClashStatus"""
    @property
    def distance(self) -> float:
        """metres"""
    @property
    def part_ids(self) -> list[str]:
        """ids of both parts"""
    @property
    def names(self) -> list[str]: ...
    @property
    def types(self) -> list[str]: ...
    @property
    def files(self) -> list[str]: ...
    @property
    def resolved(self) -> int:
        """when it was found gone, in seconds since 1970; 0: it is there"""
    @property
    def note(self) -> str: ...

class ListedGroup:
    """A group as a store lists it."""
    @property
    def id(self) -> str: ...
    @property
    def path(self) -> str:
        """names of the groups around it"""
    @property
    def name(self) -> str: ...
    @property
    def what(self) -> str: ...
    @property
    def kind(self) -> GroupKind:
        """GroupKind"""
    @property
    def change(self) -> GroupChange:
        """GroupChange"""
    @property
    def size(self) -> int:
        """clashes that it has now"""
    @property
    def centre(self) -> NDArray[Any]: ...
    @property
    def appeared(self) -> int:
        """seconds since 1970; 0: never"""
    @property
    def reopened(self) -> int:
        """seconds since 1970; 0: never"""
    @property
    def moved(self) -> int:
        """seconds since 1970; 0: never"""
    @property
    def resolved(self) -> int:
        """seconds since 1970; 0: never"""
    @property
    def topic(self) -> Topic:
        """Topic; None if nobody has said anything"""

class Mark:
    """A segment or, if both ends are equal, a dot, drawn over a picture."""
    def __init__(self, a: ArrayLike, b: ArrayLike, *, colour: Colour = ..., width: float = ...) -> None: ...
    @property
    def a(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def b(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def colour(self) -> Colour:
        """Colour"""
    @property
    def width(self) -> float:
        """pixels; the diameter of a dot"""

class Matrix:
    """The clashes of a ClashReport by groups of parts."""
    @property
    def groups(self) -> list[str]:
        """names"""
    @property
    def cells(self) -> list[MatrixCell]:
        """list of MatrixCell"""

class MatrixCell:
    """A cell of a report's Matrix."""
    @property
    def a(self) -> int:
        """index of a group"""
    @property
    def b(self) -> int:
        """index of a group"""
    @property
    def examined(self) -> bool: ...
    @property
    def clearance(self) -> float:
        """metres"""
    @property
    def severity(self) -> str: ...
    @property
    def counts(self) -> dict[str, Any]:
        """dict of kind to number"""

class Mesh:
    """Indexed triangles: vertices of shape (n, 3), faces of shape (m, 3) with indices from 0.
    Any object that Model takes may be given in place of both arrays. The arrays are copied.

    Raises Error (bad_mesh) if an index is out of range.
    """
    def __init__(self, vertices: ArrayLike | _Mesh, faces: ArrayLike | None = ...) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]:
        """float64 array of shape (n, 3); it cannot be written to"""
    @property
    def faces(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 3); it cannot be written to"""

class MeshReport:
    """Returned by inspect. Vertices at equal positions count as one."""
    @property
    def vertices(self) -> int:
        """as stored"""
    @property
    def distinct_vertices(self) -> int:
        """after equal positions are merged"""
    @property
    def triangles(self) -> int:
        """as stored"""
    @property
    def degenerate_triangles(self) -> int:
        """of exactly zero area"""
    @property
    def duplicate_triangles(self) -> int:
        """beyond the first of the same positions"""
    @property
    def boundary_edges(self) -> int:
        """used by one triangle"""
    @property
    def nonmanifold_edges(self) -> int:
        """used by three triangles or more"""
    @property
    def flipped_edges(self) -> int:
        """used by two triangles in the same direction"""
    @property
    def components(self) -> int:
        """sets of triangles connected by vertices"""
    @property
    def closed(self) -> bool:
        """every edge is used by exactly two triangles"""
    @property
    def bounds(self) -> Box3:
        """Box3 of the vertices that a triangle uses"""

class MissingParts(IntEnum):
    """What a query does about parts that are not in memory."""
    wait = 0
    skip = 1

class Model:
    """Triangles with the hierarchy that queries need. It never changes; any number of threads may
    query it.

    vertices  array of shape (n, 3), float32 or float64 in any order of memory; units are the caller's
    faces     array of shape (m, 3), int32, int64 or uint32, with indices from 0
    path      model file, read as by read_mesh: metres, all parts in one model
    mesh      a Mesh, or an object with .vertices and .faces (trimesh) or .points and .cells_dict
              (meshio: triangles, and quadrilaterals cut in two)
    volume    a Volume, the bounding volume of the hierarchy
    progress  function of (stage, fraction), of reading a path

    The arrays are copied once. Raises Error: bad_mesh if an index is out of range or a coordinate is not
    finite or beyond 1e18; the codes of read_mesh for a path. KeyboardInterrupt at Ctrl-C.
    """
    def __init__(self, vertices: ArrayLike | _Mesh, faces: ArrayLike | None = ..., *, volume: Volume | str = ..., progress: _Progress = ...) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]:
        """float64 array of shape (n, 3); it cannot be written to"""
    @property
    def faces(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 3); it cannot be written to"""
    @property
    def mesh(self) -> Mesh:
        """a copy of the mesh"""
    @property
    def bytes(self) -> int:
        """memory of mesh and hierarchy"""

class ModelManifold:
    """A region where two models meet, as a contact solver needs it."""
    @property
    def normal(self) -> NDArray[Any]:
        """unit vector from a to b"""
    @property
    def region(self) -> int:
        """names the region"""
    @property
    def count(self) -> int:
        """of the points, 1 to 4"""
    @property
    def points(self) -> record:
        """record array of ContactPoint: the deepest comes first"""
    @property
    def status(self) -> Status:
        """Status"""

class ModelPath:
    """A path with the unit and the axis of its file."""
    def __init__(self, path: _Path, unit: float = ..., up: UpAxis | str | None = ...) -> None: ...
    @property
    def path(self) -> str: ...
    @property
    def unit(self) -> float:
        """metres per unit of the file; 0: as the format defines"""
    @property
    def up(self) -> UpAxis | None:
        """UpAxis; None: as the format defines"""

class ModelPrecision:
    """What a model tells apart."""
    @property
    def stated(self) -> float:
        """metres, as the file states it; 0: it does not"""
    @property
    def single_meshes(self) -> bool:
        """whether coordinates of meshes are in single precision"""
    @property
    def single_transforms(self) -> bool:
        """whether transforms of parts are, too"""

class ModelSummary:
    """A model of a ClashReport."""
    @property
    def file(self) -> str: ...
    @property
    def parts(self) -> int: ...
    @property
    def triangles(self) -> int:
        """each instance counted"""
    @property
    def unit(self) -> float:
        """metres per unit of the file"""
    @property
    def up(self) -> UpAxis:
        """UpAxis of the file"""
    @property
    def notes(self) -> list[SceneNote]:
        """list of SceneNote"""
    @property
    def precision(self) -> float:
        """metres, as the file states it"""
    @property
    def rounding(self) -> float:
        """metres; the largest rounding of the coordinates of a part"""

class Motion:
    """How a body moves while t goes from 0 to 1: it turns about `centre` (a world point at t = 0) at
    constant angular velocity (radians per unit of t), while the centre moves at constant velocity.
    """
    def __init__(self, start: _Poses, centre: ArrayLike = ..., velocity: ArrayLike = ..., angular_velocity: ArrayLike = ...) -> None: ...
    @staticmethod
    def fixed(pose: _Poses) -> Motion:
        """No motion."""
    @staticmethod
    def between(start: _Poses, end: _Poses, about: ArrayLike = ...) -> Any:
        """The body's point `about` moves in a straight line, and the body turns about it along the shortest
        arc. With arrays of shape (n, 4, 4) a list of motions.
        """
    @staticmethod
    def screw(start: _Poses, end: _Poses) -> Any:
        """Along the one screw that takes `start` to `end`. With arrays of shape (n, 4, 4) a list of motions."""
    @property
    def start(self) -> Pose: ...
    @property
    def centre(self) -> NDArray[Any]: ...
    @property
    def velocity(self) -> NDArray[Any]: ...
    @property
    def angular_velocity(self) -> NDArray[Any]: ...

class MotionClash:
    """What happens between two parts over time."""
    @property
    def a(self) -> int:
        """index of a part"""
    @property
    def b(self) -> int:
        """index of a part, above a"""
    @property
    def kind(self) -> MotionClashKind:
        """MotionClashKind"""
    @property
    def contacts(self) -> list[MotionInterval]:
        """list of MotionInterval"""
    @property
    def approaches(self) -> list[MotionInterval]:
        """list of MotionInterval"""
    @property
    def gap(self) -> float:
        """metres: the least that was measured"""
    @property
    def gap_at_least(self) -> float:
        """a proven lower bound of it"""
    @property
    def gap_time(self) -> float:
        """seconds"""
    @property
    def point_a(self) -> NDArray[Any]:
        """the nearest point then"""
    @property
    def point_b(self) -> NDArray[Any]:
        """the nearest point then"""
    @property
    def depth(self) -> float:
        """metres: the largest that was measured"""
    @property
    def depth_at_most(self) -> float:
        """an upper bound of it; may be inf"""
    @property
    def depth_time(self) -> float:
        """seconds"""
    @property
    def depth_point(self) -> NDArray[Any]:
        """on b then"""
    @property
    def samples(self) -> list[MotionSample]:
        """list of MotionSample"""
    @property
    def status(self) -> Status:
        """Status; bound_only: contact was not decided"""
    @property
    def steps(self) -> int:
        """measurements"""

class MotionClashKind(IntEnum):
    """Whether a pair meets, or only comes near."""
    contact = 0
    clearance = 1

class MotionInterval:
    """A span of time in which a pair is in contact, or near."""
    @property
    def start(self) -> float:
        """never later than the first contact"""
    @property
    def end(self) -> float:
        """never earlier than the last contact"""
    @property
    def seen(self) -> float:
        """a time of contact; inf: none was seen"""

class MotionReport:
    """The clashes of an assembly over time."""
    @property
    def start(self) -> float:
        """seconds"""
    @property
    def end(self) -> float:
        """seconds"""
    @property
    def clearance(self) -> float:
        """as asked, metres"""
    @property
    def tolerance(self) -> float:
        """as asked, metres"""
    @property
    def clashes(self) -> list[MotionClash]:
        """list of MotionClash, contacts first"""
    @property
    def pairs(self) -> int:
        """all pairs of parts"""
    @property
    def still(self) -> int:
        """of them: without relative motion"""
    @property
    def joined(self) -> int:
        """of them: joined by a joint or a loop"""
    @property
    def ignored(self) -> int:
        """of them: left out on request"""
    @property
    def near(self) -> int:
        """of them: measured"""
    @property
    def slices(self) -> int:
        """of time"""
    @property
    def steps(self) -> int:
        """measurements"""

class MotionSample:
    """The gap of a pair at a time."""
    @property
    def time(self) -> float:
        """seconds"""
    @property
    def gap(self) -> float:
        """metres"""

class NamedPart:
    """A part by its words."""
    def __init__(self, file: str, id: str) -> None: ...
    @property
    def file(self) -> str: ...
    @property
    def id(self) -> str: ...

class NamedState:
    """Values of some joints under a name."""
    @property
    def name(self) -> str: ...
    @property
    def group(self) -> str: ...
    @property
    def joints(self) -> list[tuple[str, list[float]]]:
        """list of (name, values)"""

class NamedSurface:
    """A part of a ClashReport that bounds no solid."""
    @property
    def model(self) -> int:
        """index of its model"""
    @property
    def id(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str: ...

class NamedView(IntEnum):
    """Directions from which a whole model is seen."""
    iso = 0
    front = 1
    back = 2
    left = 3
    right = 4
    top = 5
    bottom = 6

class NearParts:
    """Returned by Walk.within and Walk.penetration."""
    @property
    def parts(self) -> record:
        """record array of WalkGap, sorted by part"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""

class NearVertices:
    """What a query of near features knows of the vertices of a surface: arrays with an entry for each vertex.

    thickness  lengths; a feature is as thick as the thickest of its vertices. None: 0
    groups     bit sets; a feature belongs to every group that one of its vertices belongs to. None: 1
    masks      bit sets; a feature meets the groups that all its vertices meet. None: all
    moved      true for vertices that have moved: only pairs with such a vertex are listed. None: all pairs
    """
    def __init__(self, thickness: ArrayLike | None = ..., groups: ArrayLike | None = ..., masks: ArrayLike | None = ..., moved: ArrayLike | None = ...) -> None: ...
    @property
    def thickness(self) -> NDArray[np.float64]:
        """float64 array; empty: 0"""
    @property
    def groups(self) -> NDArray[np.uint32]:
        """uint32 array; empty: 1"""
    @property
    def masks(self) -> NDArray[np.uint32]:
        """uint32 array; empty: all"""
    @property
    def moved(self) -> NDArray[Any]:
        """bool array; empty: all pairs"""

class Nearest:
    """Returned by nearest: a point of the surface."""
    dtype: np.dtype[Any]
    @property
    def distance(self) -> float:
        """length; negative inside if signed_distance"""
    @property
    def point(self) -> NDArray[np.float64]:
        """on the surface, world frame"""
    @property
    def triangle(self) -> int:
        """with the point; the least of several"""
    @property
    def feature(self) -> Feature:
        """Feature of the triangle that the point lies on"""
    @property
    def index(self) -> int:
        """which vertex or edge"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """weights of the triangle's vertices"""
    @property
    def status(self) -> Status:
        """Status; bound_only: no point is nearer than upper_bound"""

class NearestPart:
    """Returned by Walk.distance."""
    @property
    def found(self) -> bool:
        """else no part is nearer than the bound"""
    @property
    def gap(self) -> WalkGap:
        """WalkGap"""
    @property
    def at_least(self) -> float:
        """no part is nearer"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""

class Neighbours(IntEnum):
    """How two parts belong together (docs/selecting.md)."""
    fills = 0
    connected = 1
    covers = 2
    same_assembly = 3

class NoteKind(IntEnum):
    """What became of something that a scene does not have as its file means it."""
    space = 0
    cut_away = 1
    not_built = 2
    open = 3

class OrientedBox:
    """A solid Box3 in a frame of its own."""
    def __init__(self, box: Box3, pose: _OnePose | ArrayLike) -> None: ...
    @property
    def box(self) -> Box3:
        """Box3"""
    @property
    def pose(self) -> NDArray[Any]:
        """matrix of shape (4, 4)"""

class OutOfCoreCounters:
    """The work of a job on a store."""
    @property
    def units(self) -> int:
        """work units"""
    @property
    def meshes(self) -> int:
        """that a candidate needs, large ones left out"""
    @property
    def mesh_loads(self) -> int:
        """each time that one was read"""
    @property
    def blocks(self) -> int:
        """mesh blocks that were needed"""
    @property
    def block_loads(self) -> int:
        """each time that one was read"""
    @property
    def bytes_needed(self) -> int: ...
    @property
    def bytes_read(self) -> int: ...
    @property
    def hierarchies_found(self) -> int:
        """in the store"""
    @property
    def hierarchies_kept(self) -> int:
        """in the store"""
    @property
    def peak_bytes(self) -> int:
        """of models in memory at once"""
    @property
    def kept(self) -> bool:
        """in the store"""
    @property
    def recalled_pairs(self) -> int:
        """done before, by an earlier job"""
    @property
    def workers(self) -> list[WorkerCounters]:
        """list of WorkerCounters, in the order of ranks"""

class PairAim:
    """A pair of parts in red and blue, seen from where most of both shows."""
    def __init__(self, file: Sequence[str], part: Sequence[str], points: Sequence[ArrayLike] | None = ...) -> None: ...
    @property
    def file(self) -> list[str]:
        """names of two files"""
    @property
    def part(self) -> list[str]:
        """ids of two parts"""
    @property
    def points(self) -> list[NDArray[Any]] | None:
        """points of both surfaces, or None: they are computed"""

class Part:
    """A placed mesh of a Scene."""
    def __init__(self, id: str, mesh: int = ..., pose: _Poses = ..., *, name: str | None = ..., type: str = ..., colour: Colour | None = ...) -> None: ...
    @property
    def id(self) -> str:
        """unique within its scene"""
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str:
        """may be empty"""
    @property
    def mesh(self) -> int:
        """index in Scene.meshes"""
    @property
    def world_from_mesh(self) -> NDArray[Any]:
        """matrix of shape (4, 4)"""
    @property
    def colour(self) -> Colour | None:
        """Colour of most of its triangles; else None"""

class PartAim:
    """One part, by its id or name, filling a picture; all others are ghosts."""
    def __init__(self, part: str) -> None: ...
    @property
    def part(self) -> str:
        """id or name"""

class PartColouring:
    """The colours of the parts of a Store or of models."""
    @property
    def colours(self) -> list[Colour]:
        """list of Colour, in the order of View.parts or of models"""
    @property
    def groups(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n,): of each part, its row in legend"""
    @property
    def legend(self) -> list[ColourGroup]:
        """list of ColourGroup, the largest first; of 'type', 'file', 'storey' and 'clash'"""

class PartDistances:
    """Colours surfaces by their exact distance from a part."""
    def __init__(self, part: str, reach: float = ...) -> None: ...
    @property
    def part(self) -> str:
        """id or name"""
    @property
    def reach(self) -> float:
        """length up to which surfaces are coloured"""

class PartImpact:
    """When a moving probe first meets a part."""
    dtype: np.dtype[Any]
    @property
    def part(self) -> int:
        """number of the part"""
    @property
    def time(self) -> float:
        """in [0, 1], never later than the contact"""
    @property
    def contact_time(self) -> float:
        """a time at which they are in contact"""
    @property
    def gap(self) -> float:
        """length: how far apart they are at `time`, at most"""
    @property
    def point_part(self) -> NDArray[np.float64]:
        """on the part at `time`"""
    @property
    def point_probe(self) -> NDArray[np.float64]:
        """on the probe at `time`"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from the part to the probe, or zero"""
    @property
    def triangle_part(self) -> int:
        """of a mesh; else 0"""
    @property
    def triangle_probe(self) -> int:
        """of a mesh; else 0"""
    @property
    def status(self) -> Status:
        """Status"""

class PartQuery:
    """A condition on parts (docs/selecting.md): 'type = IfcWall* and storey = L2'. Without text it matches
    every part. Raises Error: bad_argument.
    """
    def __init__(self, text: str = ...) -> None: ...
    @property
    def text(self) -> str:
        """in a canonical form"""
    def matches(self, scene: Scene, part: int) -> bool:
        """Whether a part of a Scene matches."""
    def empty(self) -> bool:
        """Whether there is no condition."""
    def names(self) -> list[str]:
        """The names that it asks for."""

class PartRelation:
    """Two parts of a Scene that belong together: a fills b, a is a part of b."""
    @property
    def a(self) -> int:
        """index in Scene.parts"""
    @property
    def b(self) -> int:
        """index in Scene.parts"""
    @property
    def kind(self) -> RelationKind:
        """RelationKind"""

class PartSelector:
    """Which parts a rule means: all globs that are given must match (* and ?), one of each list, and the PartQuery."""
    def __init__(self, *, file: Sequence[str] = ..., name: Sequence[str] = ..., type: Sequence[str] = ..., query: str | PartQuery = ...) -> None: ...
    @property
    def file(self) -> list[str]: ...
    @property
    def name(self) -> list[str]: ...
    @property
    def type(self) -> list[str]: ...
    @property
    def query(self) -> PartQuery:
        """PartQuery"""

class PartState:
    """How a Renderer draws a part."""
    def __init__(self, colour: Colour = ..., *, hidden: bool = ..., ghosted: bool = ..., highlighted: bool = ...) -> None: ...
    @property
    def colour(self) -> Colour:
        """Colour; its alpha has no effect"""
    @property
    def hidden(self) -> bool: ...
    @property
    def ghosted(self) -> bool:
        """transparent grey, whatever its colour"""
    @property
    def highlighted(self) -> bool:
        """with a bright outline"""

class PartsInWay:
    """Returned by Walk.parts_in_way."""
    @property
    def parts(self) -> record:
        """record array of PartImpact, sorted by time, then by part"""
    @property
    def time_free(self) -> float:
        """as FirstContact.time_free"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""

class PathClearance:
    """The least distance along a path."""
    @property
    def found(self) -> bool:
        """else no part is nearer than the largest clearance"""
    @property
    def distance(self) -> float:
        """length, attained at `time`"""
    @property
    def at_least(self) -> float:
        """length: a proven lower bound"""
    @property
    def time(self) -> float:
        """in poses"""
    @property
    def part(self) -> int:
        """number of the part"""
    @property
    def point_part(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def point_probe(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""

class PathContact:
    """A part that is met on a path."""
    @property
    def time(self) -> float:
        """in poses: 3.25 is a quarter of the way from 3 to 4"""
    @property
    def impact(self) -> PartImpact:
        """PartImpact between the two poses"""

class PathReport:
    """Returned by check_path. True if the path is free."""
    @property
    def is_free(self) -> bool:
        """no part is met"""
    @property
    def poses(self) -> int:
        """number of poses"""
    @property
    def length(self) -> float:
        """of the way"""
    @property
    def touched_at_start(self) -> NDArray[np.int64]:
        """int64 array of shape (n,): parts that the probe touches at the first pose"""
    @property
    def contacts(self) -> list[PathContact]:
        """list of PathContact, sorted by time"""
    @property
    def clearance(self) -> PathClearance:
        """PathClearance"""
    def __bool__(self) -> bool: ...

class PictureMaker:
    """Makes several pictures of the same models: a Store, or a Scene or path, or several. The OpenGL
    context and the list of parts are made once, which is most of the time of a small picture. Only the
    thread that made it may use it.

    Raises Error: unsupported if EGL or OpenGL 3.3 is not available; those of the files.
    """
    def __init__(self, models: Store | Iterable[Scene | _ModelPath] | Scene | _ModelPath, *, progress: _Progress = ...) -> None: ...
    def make(self, aim: NamedView | str | Camera | PartAim | PairAim | SidesAim | Clash = ..., *, width: int = ..., height: int = ..., colour_by: ColourBy | str = ..., samples: int = ..., edges: bool = ..., ambient_occlusion: bool = ..., ground: bool = ..., sections: list[SectionPlane] = ..., section_box: Box3 | None = ..., distances: PartDistances | None = ..., progress: _Progress = ...) -> NDArray[np.uint8]:
        """As picture, with the same result."""

class PiecesContacts:
    """Returned by collide of two ConvexPieces."""
    @property
    def meet(self) -> bool:
        """the solids share a point"""
    @property
    def contained(self) -> bool:
        """one lies inside the other and no pieces meet"""
    @property
    def pairs(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2): pieces that meet, to rounding"""
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n, 2), if asked for"""
    @property
    def counters(self) -> PiecesCounters:
        """PiecesCounters"""
    def __bool__(self) -> bool: ...

class PiecesCounters:
    """The work that a query did."""
    dtype: np.dtype[Any]
    @property
    def hull_pairs(self) -> int:
        """pairs of hulls that were measured"""
    @property
    def directions(self) -> int:
        """pairs of hulls compared along one direction"""
    @property
    def sphere_pairs(self) -> int:
        """pairs of spheres around them"""
    @property
    def feature_pairs(self) -> int:
        """pairs of features that were measured"""
    @property
    def simplices(self) -> int:
        """steps of the search that takes over"""

class PiecesDepth:
    """Returned by penetration of two ConvexPieces."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """they share a point"""
    @property
    def depth(self) -> float:
        """proven: no shorter translation separates them"""
    @property
    def direction(self) -> NDArray[np.float64]:
        """unit vector in which b moves by `depth` to part the two pieces"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def piece_a(self) -> int:
        """piece of a"""
    @property
    def piece_b(self) -> int:
        """piece of b"""
    @property
    def separation(self) -> NDArray[np.float64]:
        """translation of b after which the solids are apart: verified"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def counters(self) -> PiecesCounters:
        """PiecesCounters"""
    def __bool__(self) -> bool: ...

class PiecesGap:
    """Returned by distance of two ConvexPieces."""
    dtype: np.dtype[Any]
    @property
    def distance(self) -> float:
        """length; 0 if the solids share a point"""
    @property
    def at_least(self) -> float:
        """proven: no two points are closer"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """world frame"""
    @property
    def piece_a(self) -> int:
        """piece of a"""
    @property
    def piece_b(self) -> int:
        """piece of b"""
    @property
    def triangle_a(self) -> int:
        """triangle of a's model"""
    @property
    def triangle_b(self) -> int:
        """triangle of b's model"""
    @property
    def feature_a(self) -> Feature:
        """Feature of the triangle"""
    @property
    def feature_b(self) -> Feature:
        """Feature of the triangle"""
    @property
    def index_a(self) -> int:
        """which vertex or edge"""
    @property
    def index_b(self) -> int:
        """which vertex or edge"""
    @property
    def status(self) -> Status:
        """Status"""
    @property
    def counters(self) -> PiecesCounters:
        """PiecesCounters"""

class PiecesWarmStart:
    """Remembers the closest pieces of two solids for the next pose."""
    def __init__(self) -> None: ...

class Pose:
    """A rigid pose: x_world = R(rotation) x_model + translation. The quaternion (w, x, y, z)
    need not be of unit length.
    """
    def __init__(self, translation: ArrayLike = ..., rotation: ArrayLike = ...) -> None: ...
    @staticmethod
    def from_matrix(matrix: ArrayLike) -> Pose:
        """The pose of a matrix of shape (4, 4). ValueError if it is no rotation and translation, to 1e-6."""
    def matrix(self) -> NDArray[Any]:
        """The matrix of shape (4, 4). Error if the quaternion has zero length."""
    @property
    def translation(self) -> NDArray[Any]: ...
    @property
    def rotation(self) -> NDArray[Any]: ...
    def __mul__(self, other: Pose) -> Pose: ...
    def inverse(self) -> Pose:
        """The Pose that undoes this one."""
    def apply(self, points: ArrayLike) -> NDArray[Any]:
        """Where the pose takes points: an array of shape (3,) or (n, 3), as the argument has."""
    def rotate(self, directions: ArrayLike) -> NDArray[Any]:
        """As apply, but directions are only rotated."""

class Probe:
    """A Model, Convex, Sphere, Capsule or Box3 that is moved about in a walk. Make it once."""
    def __init__(self, shape: Model | Convex | Sphere | Capsule | Box3) -> None: ...

class Properties:
    """What the parts of a Scene are known to be, as names and texts: 'storey', 'system', 'Pset_WallCommon.FireRating'."""
    @property
    def names(self) -> list[str]:
        """list of str, ascending"""
    @property
    def values(self) -> list[str]:
        """list of str: different values"""
    def of(self, part: int) -> dict[str, Any]:
        """The properties of a part by its index: a dict of names and lists of values."""
    def value(self, part: int, name: str) -> str:
        """The first value of that name; empty if the part has none."""

class Ray:
    """The points origin + t direction."""
    def __init__(self, origin: ArrayLike, direction: ArrayLike | None, t_min: float = ..., t_max: float = ...) -> None: ...
    @property
    def origin(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def direction(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def t_min(self) -> float:
        """in lengths of the direction"""
    @property
    def t_max(self) -> float:
        """in lengths of the direction"""

class RayHit:
    """Returned by first_hit. True if the ray meets the model."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """whether the ray meets a triangle"""
    @property
    def t(self) -> float:
        """the ray's parameter; inf if it meets nothing"""
    @property
    def point(self) -> NDArray[np.float64]:
        """on the triangle, world frame"""
    @property
    def triangle(self) -> int:
        """the least of several at the same t"""
    @property
    def barycentric(self) -> NDArray[np.float64]:
        """weights of its vertices"""
    @property
    def side(self) -> HitSide:
        """HitSide"""
    def __bool__(self) -> bool: ...

class RelationKind(IntEnum):
    """How two parts of a Scene belong together."""
    fills = 0
    connected = 1
    covers = 2
    part_of = 3

class RemovalReport:
    """Returned by remove_models."""
    @property
    def models(self) -> list[RemovedModel]:
        """list of RemovedModel"""
    @property
    def removed_meshes(self) -> int:
        """that no part uses any more"""

class RemovedModel:
    """A model that was taken out of a store."""
    @property
    def file(self) -> str: ...
    @property
    def parts(self) -> int: ...

class RenderStatistics:
    """Work of a Renderer."""
    @property
    def triangles(self) -> int:
        """of the last picture"""
    @property
    def draw_calls(self) -> int:
        """of the last picture"""
    @property
    def hidden_triangles(self) -> int:
        """of the last picture: left out in software, because others hide them or they are outside"""
    @property
    def chunks(self) -> int:
        """on the graphics card now"""
    @property
    def bytes(self) -> int:
        """in vertex and index buffers now"""
    @property
    def uploaded_bytes(self) -> int:
        """of all pictures"""

class RenderStyle:
    """How a Renderer draws. It checks the values when it draws."""
    def __init__(self, *, up: ArrayLike = ..., edges: bool = ..., ambient_occlusion: bool = ..., ground: Ground | None = ..., samples: int = ..., detail: float = ..., leave_out_backs: bool = ..., quick: bool = ..., sections: list[SectionPlane] = ..., section_box: Box3 | None = ..., distances: DistanceColours | None = ..., background_low: Colour = ..., background_high: Colour = ...) -> None: ...
    @property
    def up(self) -> NDArray[Any]:
        """array of shape (3,), for the light from the sky"""
    @property
    def edges(self) -> bool:
        """dark lines at silhouettes and creases"""
    @property
    def ambient_occlusion(self) -> bool:
        """darker corners"""
    @property
    def ground(self) -> Ground | None:
        """Ground; else None"""
    @property
    def samples(self) -> int:
        """along each side of a pixel: 1, 2 or 4"""
    @property
    def detail(self) -> float:
        """length, about the size of a common part: how far occlusion reaches"""
    @property
    def leave_out_backs(self) -> bool:
        """whether backs of closed surfaces are left out; faster in software"""
    @property
    def quick(self) -> bool:
        """whether shading takes fewer steps, with samples=1 and without ambient_occlusion; faster in software"""
    @property
    def sections(self) -> list[SectionPlane]:
        """list of SectionPlane, at most 7"""
    @property
    def section_box(self) -> Box3 | None:
        """Box3; what lies outside is cut away; else None"""
    @property
    def distances(self) -> DistanceColours | None:
        """DistanceColours; else None"""
    @property
    def background_low(self) -> Colour:
        """Colour"""
    @property
    def background_high(self) -> Colour:
        """Colour"""

class Renderer:
    """Draws what a View chooses, into pictures in memory, with an OpenGL context of its own. Only the
    thread that made it may use it. Give it every frame of the View in turn: each holds only the
    chunks that are new.

    parts   number of parts: len(View.parts)
    origin  what chunks are relative to: View.origin

    Raises Error: unsupported if EGL or OpenGL 3.3 is not available.
    """
    def __init__(self, parts: int, origin: ArrayLike = ...) -> None: ...
    def set_state(self, part: int, state: PartState) -> None:
        """Sets the PartState of a part. Raises Error (bad_argument)."""
    def state(self, part: int) -> PartState:
        """The PartState of a part. Raises Error (bad_argument)."""
    def add_part(self, mesh: _Mesh, pose: _OnePose | ArrayLike = ..., state: PartState = ...) -> int:
        """Draws a mesh beside the view, at most 64 at a time. Returns its number.
        Raises Error (bad_argument) if there are 64.
        """
    def move_part(self, part: int, pose: _OnePose | ArrayLike) -> None:
        """Places a part that add_part made. Raises Error (bad_argument)."""
    def remove_part(self, part: int) -> None:
        """Removes a part that add_part made. Raises Error (bad_argument)."""
    @property
    def has_ghosts(self) -> bool:
        """whether any part is ghosted and not hidden"""
    def picture(self, frame: ViewFrame, camera: Camera, style: RenderStyle = ..., marks: list[Mark] = ...) -> NDArray[np.uint8]:
        """Draws a ViewFrame as a Camera sees it. Equal to begin, add, end_picture.

        Returns a uint8 array of shape (height, width, 3). Raises Error: bad_argument if the camera or
        the style is not valid, unsupported.
        """
    def begin(self, camera: Camera, style: RenderStyle = ...) -> None:
        """Begins a picture that is drawn in several steps. Raises Error: as picture."""
    def add(self, frame: ViewFrame) -> None:
        """Adds a ViewFrame to the picture. Raises Error (bad_argument) if none was begun."""
    def add_ghosts(self, frame: ViewFrame) -> None:
        """Adds the ghosted parts of a ViewFrame, after all calls of add. Raises Error (bad_argument)."""
    def end_picture(self, marks: list[Mark] = ...) -> NDArray[np.uint8]:
        """Ends a picture. Returns a uint8 array of shape (height, width, 3). Raises Error (bad_argument)
        if none was begun.
        """
    def part_at(self, x: int, y: int) -> int | None:
        """The part that the last picture shows at a pixel, from the top left corner; None for the
        background and for ghosts.
        """
    def visible_samples(self, parts: ArrayLike) -> NDArray[np.uint64]:
        """uint64 array of shape (n,): in how many samples of the last picture each part is visible."""
    @property
    def statistics(self) -> RenderStatistics:
        """RenderStatistics"""

class ReportPart:
    """A part by the indices that clashes use."""
    @property
    def model(self) -> int: ...
    @property
    def part(self) -> int: ...

class Representatives:
    """The triangles of a surface, with exactly one of its triangles for every vertex and every edge: the one that
    represents it. For a culling of your own, with self_feature_tests and feature_tests.

    Several threads may read it; a change meanwhile raises RuntimeError.
    Raises Error (bad_mesh) if an index is out of range.
    """
    def __init__(self, vertex_count: int, faces: ArrayLike, *, assignment: Assignment | str = ...) -> None: ...
    def set_triangles(self, vertex_count: int, faces: ArrayLike) -> None:
        """Replaces the triangles and forgets the motion. A triangle that keeps its index and its vertices keeps its edges'
        numbers and the features that it represents. Errors as the constructor.
        """
    def set_motion(self, start: ArrayLike, end: ArrayLike) -> None:
        """Sets where every vertex is at t = 0 and t = 1, arrays of shape (n, 3). From then on only features are tested
        whose boxes come near each other. Errors as Deformable.set_motion.
        """
    @property
    def vertex_count(self) -> int: ...
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 3)"""
    @property
    def edges(self) -> NDArray[np.uint32]:
        """uint32 array of shape (k, 2); 2^32 - 1 twice where there is no edge any more"""
    @property
    def represented(self) -> NDArray[Any]:
        """uint8 array: bit k for a triangle's vertex k, bit 3 + k for its edge k"""
    @property
    def bytes(self) -> int: ...

class Robot:
    """A robot that is ready for queries.

    description     RobotDescription
    allowed         AllowedPair of links that are not tested
    allow_adjacent  whether links that a joint connects are left out, too
    """
    def __init__(self, description: RobotDescription, *, allowed: list[AllowedPair] = ..., allow_adjacent: bool = ...) -> None: ...
    @property
    def description(self) -> RobotDescription:
        """RobotDescription"""
    @property
    def variables(self) -> list[RobotVariable]:
        """list of RobotVariable"""
    @property
    def pairs(self) -> list[tuple[int, int]]:
        """list of the pairs of links that are tested"""
    def default_configuration(self) -> NDArray[Any]:
        """Every variable is 0, or the limit that is nearest to 0."""
    def link_transforms(self, configuration: ArrayLike) -> list[NDArray[Any]]:
        """Returns the matrix of every link."""
    def beyond_limits(self, configuration: ArrayLike) -> list[int]:
        """Returns the indices of the variables beyond their limits."""

class RobotDescription:
    """A tree of links, as read_robot returns it."""
    @property
    def name(self) -> str: ...
    @property
    def file(self) -> str:
        """path as given"""
    @property
    def links(self) -> list[RobotLink]:
        """list of RobotLink"""
    @property
    def joints(self) -> list[RobotJoint]:
        """list of RobotJoint, parents first"""
    @property
    def root(self) -> int:
        """index of the link that no joint moves"""
    @property
    def warnings(self) -> list[str]:
        """list of str"""

class RobotGap:
    """The nearest pair of a robot."""
    dtype: np.dtype[Any]
    @property
    def distance(self) -> float:
        """metres; 0: a pair meets; inf: there is none"""
    @property
    def pair(self) -> RobotPair:
        """RobotPair"""
    @property
    def point_a(self) -> NDArray[np.float64]:
        """on the link, world frame"""
    @property
    def point_b(self) -> NDArray[np.float64]:
        """on the other, world frame"""
    @property
    def status(self) -> Status:
        """Status"""

class RobotImpact:
    """The first contact on the way between two configurations."""
    dtype: np.dtype[Any]
    @property
    def meet(self) -> bool:
        """whether a pair meets, or may meet"""
    @property
    def time(self) -> float:
        """in [0, 1]; the way is free up to it"""
    @property
    def contact_time(self) -> float:
        """a time at which the pair is in contact; inf if none was found"""
    @property
    def pair(self) -> RobotPair:
        """RobotPair"""
    @property
    def gap(self) -> float:
        """metres: of the pair at `time`"""
    @property
    def status(self) -> Status:
        """Status; bound_only: contact was not decided"""
    @property
    def steps(self) -> int:
        """steps of the search"""
    def __bool__(self) -> bool: ...

class RobotJoint:
    """A joint between two links."""
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> JointType:
        """JointType"""
    @property
    def parent(self) -> int:
        """index of a link"""
    @property
    def child(self) -> int:
        """index of a link"""
    @property
    def parent_from_joint(self) -> NDArray[Any]:
        """matrix of shape (4, 4): the child's frame where all values are 0"""
    @property
    def axis(self) -> NDArray[Any]:
        """unit vector in the joint's frame"""
    @property
    def limits(self) -> JointLimits:
        """JointLimits"""
    @property
    def mimic(self) -> JointMimic:
        """JointMimic, or None"""

class RobotLink:
    """A link of a robot."""
    @property
    def name(self) -> str: ...
    @property
    def shapes(self) -> list[RobotShape]:
        """list of RobotShape"""

class RobotObstacle:
    """Something that stands still around a robot."""
    def __init__(self, name: str, model: Model, pose: _OnePose | ArrayLike = ...) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def model(self) -> Model:
        """Model"""
    @property
    def world_from_model(self) -> NDArray[Any]:
        """matrix of shape (4, 4)"""

class RobotObstacles:
    """Obstacles that are ready for queries: made of RobotObstacle."""
    def __init__(self, obstacles: list[RobotObstacle]) -> None: ...
    @property
    def list(self) -> list[RobotObstacle]:
        """list of RobotObstacle"""

class RobotPair:
    """A link, and another link or an obstacle."""
    dtype: np.dtype[Any]
    @property
    def link(self) -> int:
        """index of a link"""
    @property
    def other(self) -> int:
        """index of a link, or of an obstacle"""
    @property
    def is_obstacle(self) -> bool:
        """whether `other` is an obstacle"""

class RobotSemantics:
    """The content of an SRDF file."""
    @property
    def allowed(self) -> list[AllowedPair]:
        """list of AllowedPair"""
    @property
    def states(self) -> list[NamedState]:
        """list of NamedState"""
    @property
    def warnings(self) -> list[str]:
        """list of str"""

class RobotShape:
    """A collision shape of a link."""
    @property
    def name(self) -> str:
        """path of its mesh, or 'box', 'cylinder', 'sphere'"""
    @property
    def mesh(self) -> Mesh:
        """Mesh in the shape's frame, in metres"""
    @property
    def link_from_shape(self) -> NDArray[Any]:
        """matrix of shape (4, 4)"""
    @property
    def excess(self) -> float:
        """metres: how far the mesh reaches out of the shape, at most"""

class RobotVariable:
    """A number that places a joint."""
    @property
    def name(self) -> str: ...
    @property
    def joint(self) -> int:
        """index of its joint"""
    @property
    def limits(self) -> JointLimits:
        """JointLimits"""
    @property
    def is_angle(self) -> bool:
        """radians, else metres"""

class Scene:
    """A file's parts, in metres. Parts may share a mesh. From Python: meshes are what Model takes, parts are
    Part, properties a list with a dict for each part. Raises IndexError if a part's mesh is not there,
    ValueError if there are more or fewer dicts than parts.
    """
    def __init__(self, meshes: Sequence[_Mesh], parts: list[Part], *, file: str = ..., up: UpAxis | str = ..., properties: Properties | None = ...) -> None: ...
    @property
    def file(self) -> str:
        """path as given"""
    @property
    def meshes(self) -> list[Mesh]:
        """list of Mesh"""
    @property
    def parts(self) -> list[Part]:
        """list of Part"""
    @property
    def unit(self) -> float:
        """metres per unit of the file; applied already"""
    @property
    def up(self) -> UpAxis:
        """UpAxis of the world"""
    @property
    def notes(self) -> list[SceneNote]:
        """list of SceneNote"""
    @property
    def properties(self) -> Properties:
        """Properties of the parts"""
    @property
    def relations(self) -> list[PartRelation]:
        """list of PartRelation"""
    @property
    def project(self) -> str:
        """GlobalId of an IFC file's project; else empty"""
    @property
    def map_from_project(self) -> Any:
        """matrix of shape (4, 4): from an IFC project to the map that its file names"""
    @property
    def precision(self) -> ModelPrecision:
        """ModelPrecision"""

class SceneNote:
    """Something that a scene does not have as its file means it."""
    @property
    def kind(self) -> NoteKind:
        """NoteKind"""
    @property
    def id(self) -> str:
        """of the part"""
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str:
        """may be empty"""
    @property
    def text(self) -> str:
        """one line"""

class ScheduleCounters:
    """The work that `advance` has done."""
    dtype: np.dtype[Any]
    @property
    def steps(self) -> int: ...
    @property
    def pairs(self) -> int:
        """that may ever meet, summed over the steps"""
    @property
    def estimates(self) -> int:
        """of these, those that were due"""
    @property
    def distance_queries(self) -> int:
        """of these, those that boxes and planes did not decide"""

class Scheme(IntEnum):
    """How pairs of triangles that may meet become tests of features."""
    representative = 0
    database = 1
    markup = 2
    basic = 3
    features = 4
    pairwise = 5

class SectionPlane:
    """Cuts away the points with dot(normal, point) > offset."""
    def __init__(self, normal: ArrayLike, offset: float) -> None: ...
    @property
    def normal(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def offset(self) -> float:
        """length"""

class Segment:
    """A closed segment between two points."""
    def __init__(self, a: ArrayLike, b: ArrayLike) -> None: ...
    @property
    def a(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def b(self) -> NDArray[Any]:
        """array of shape (3,)"""

class Side(IntEnum):
    """Where a point is."""
    outside = 0
    inside = 1
    on_surface = 2

class SidesAim:
    """Two sets of parts in red and blue, as a Camera sees them; the parts
    around them are ghosts. No other part is drawn.
    """
    def __init__(self, camera: Camera, sides: list[list[NamedPart]], around: list[NamedPart] = ...) -> None: ...
    @property
    def camera(self) -> Camera:
        """Camera; its size is ignored"""
    @property
    def sides(self) -> list[list[NamedPart]]:
        """two lists of NamedPart"""
    @property
    def around(self) -> list[NamedPart]:
        """list of NamedPart"""

class Sphere:
    """A closed ball."""
    def __init__(self, centre: ArrayLike, radius: float) -> None: ...
    @property
    def centre(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def radius(self) -> float:
        """length, at least 0"""

class Status(IntEnum):
    """How far a result can be relied on.

    exact: the answer, numbers to double rounding. converged: within the error that was
    allowed. bound_only: the numbers are a proven bound.
    """
    exact = 0
    converged = 1
    bound_only = 2

class Store:
    """An open store, made by open_store. A context manager: leaving it closes the store, and every use
    of a closed store raises ValueError.
    """
    def close(self) -> None:
        """Closes the store; a walk through it keeps the file open."""
    @property
    def closed(self) -> bool: ...
    @property
    def path(self) -> str: ...
    def __enter__(self) -> Store: ...
    def __exit__(self, *args: Any) -> None: ...

class StoreSummary:
    """Returned by summary."""
    @property
    def path(self) -> str: ...
    @property
    def version(self) -> int: ...
    @property
    def up(self) -> UpAxis:
        """UpAxis of the world"""
    @property
    def complete(self) -> bool:
        """all models are"""
    @property
    def generation(self) -> int:
        """grows with each import that changes something"""
    @property
    def models(self) -> list[StoredModel]:
        """list of StoredModel"""
    @property
    def parts(self) -> int: ...
    @property
    def triangles(self) -> int:
        """each instance counted"""
    @property
    def meshes(self) -> int: ...
    @property
    def stored_triangles(self) -> int:
        """each mesh once"""
    @property
    def blocks(self) -> int:
        """mesh blocks"""
    @property
    def raw_bytes(self) -> int:
        """of coordinates and indices"""
    @property
    def stored_bytes(self) -> int:
        """of the compressed blocks"""
    @property
    def hierarchies(self) -> int:
        """that jobs have kept"""
    @property
    def hierarchy_bytes(self) -> int: ...
    @property
    def levels(self) -> bool:
        """whether there are levels of detail"""
    @property
    def level_chunks(self) -> int: ...
    @property
    def level_bytes(self) -> int:
        """stored"""
    @property
    def file_bytes(self) -> int: ...
    @property
    def unused_bytes(self) -> int:
        """of the file"""
    @property
    def bounds(self) -> Box3:
        """Box3 of all parts in the world"""
    @property
    def properties(self) -> list[StoredProperty]:
        """list of StoredProperty"""
    @property
    def relations(self) -> int:
        """how many; see PartRelation"""

class StoredModel:
    """A model of a StoreSummary."""
    @property
    def file(self) -> str: ...
    @property
    def complete(self) -> bool:
        """False: its import has not ended"""
    @property
    def parts(self) -> int: ...
    @property
    def triangles(self) -> int:
        """each instance counted"""
    @property
    def generation(self) -> int: ...
    @property
    def unit(self) -> float:
        """metres per unit of the file"""
    @property
    def up(self) -> UpAxis:
        """UpAxis of the file"""
    @property
    def notes(self) -> list[SceneNote]:
        """list of SceneNote"""
    @property
    def project(self) -> str:
        """as Scene.project"""
    @property
    def map_from_project(self) -> NDArray[Any]:
        """as Scene.map_from_project"""

class StoredProperty:
    """A property that parts of a store have."""
    @property
    def name(self) -> str: ...
    @property
    def parts(self) -> int:
        """that have it"""
    @property
    def values(self) -> int:
        """how many different ones"""

class SurfaceContact:
    """A point of a surface that is near a rigid body, or in it. Outside of the body the gradient of the distance by vertices[i] is weights[i] * normal."""
    dtype: np.dtype[Any]
    @property
    def feature(self) -> Feature:
        """Feature: the part of the surface that has the point in its inside"""
    @property
    def id(self) -> int:
        """vertex, row of Deformable.edges or of Deformable.faces"""
    @property
    def vertices(self) -> NDArray[np.uint32]:
        """of that part; the last one is repeated"""
    @property
    def weights(self) -> NDArray[np.float64]:
        """of the vertices, sum 1"""
    @property
    def distance(self) -> float:
        """along the normal; negative in a solid"""
    @property
    def limit(self) -> float:
        """the distance up to which this contact is listed"""
    @property
    def point(self) -> NDArray[np.float64]:
        """on the surface"""
    @property
    def point_on_body(self) -> NDArray[np.float64]:
        """on the body's boundary"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector out of the body"""
    @property
    def triangle(self) -> int:
        """of a Model, that of point_on_body; else 0"""

class Surfaces:
    """The parts of a ClashReport that bound no solid."""
    @property
    def count(self) -> int:
        """number of them"""
    @property
    def first(self) -> list[NamedSurface]:
        """list of NamedSurface: the first 100 of them"""

class TestCounts:
    """A number for each kind of test."""
    dtype: np.dtype[Any]
    @property
    def vertex_face(self) -> int: ...
    @property
    def edge_edge(self) -> int: ...

class Topic:
    """An issue to be settled by people."""
    def __init__(self) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def status(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def priority(self) -> str: ...
    @property
    def stage(self) -> str: ...
    @property
    def assignee(self) -> str: ...
    @property
    def due(self) -> str:
        """YYYY-MM-DD; empty: none"""
    @property
    def labels(self) -> list[str]: ...
    @property
    def reference_links(self) -> list[str]: ...
    @property
    def group(self) -> str:
        """id of the group; may be empty"""
    @property
    def clashes(self) -> list[str]:
        """ids"""
    @property
    def created_by(self) -> str: ...
    @property
    def modified_by(self) -> str: ...
    @property
    def created(self) -> int:
        """seconds since 1970"""
    @property
    def modified(self) -> int:
        """seconds since 1970"""
    @property
    def comments(self) -> list[TopicComment]:
        """list of TopicComment, by time"""

class TopicComment:
    """What someone said of a topic."""
    def __init__(self, text: str = ..., *, author: str = ..., time: int = ..., guid: str = ..., viewpoint: str = ...) -> None: ...
    @property
    def guid(self) -> str: ...
    @property
    def author(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def time(self) -> int:
        """seconds since 1970"""
    @property
    def viewpoint(self) -> str:
        """GUID; may be empty"""

class TopicConflict:
    """A field that two people have changed."""
    @property
    def guid(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def field(self) -> str: ...
    @property
    def base(self) -> str: ...
    @property
    def stored(self) -> str:
        """the value that stays"""
    @property
    def edited(self) -> str:
        """the value that is kept in a comment"""

class TopicMerge:
    """Returned by merge_topics and apply_review."""
    @property
    def revision(self) -> int:
        """of the store after the merge"""
    @property
    def added(self) -> list[str]:
        """GUIDs"""
    @property
    def changed(self) -> list[str]:
        """GUIDs"""
    @property
    def comments(self) -> int:
        """new ones"""
    @property
    def marked(self) -> int:
        """clashes whose mark has changed"""
    @property
    def conflicts(self) -> list[TopicConflict]:
        """list of TopicConflict"""
    @property
    def warnings(self) -> list[str]:
        """places of a BCF file that other programs may read differently"""

class TouchedParts:
    """Returned by Walk.collide."""
    @property
    def parts(self) -> NDArray[np.int64]:
        """int64 array of shape (n,), sorted"""
    @property
    def complete(self) -> bool:
        """False if parts that may matter were not in memory and skipped"""
    @property
    def candidates(self) -> int:
        """parts whose boxes were in reach"""
    @property
    def misses(self) -> int:
        """of these, those that were not in memory"""

class Tour:
    """Viewpoints in the order of their times, or a path of the camera."""
    def __init__(self, points: list[TourPoint] = ...) -> None: ...
    @property
    def points(self) -> list[TourPoint]:
        """list of TourPoint"""

class TourPoint:
    """Where the camera is at a time."""
    def __init__(self, seconds: float, eye: ArrayLike, forward: ArrayLike, up: ArrayLike = ..., name: str = ...) -> None: ...
    @property
    def seconds(self) -> float: ...
    @property
    def eye(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def forward(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def up(self) -> NDArray[Any]:
        """array of shape (3,)"""
    @property
    def name(self) -> str:
        """of a saved viewpoint; empty for others"""

class UpAxis(IntEnum):
    """The axis that points up."""
    x = 0
    y = 1
    z = 2

class View:
    """Chooses and loads what a renderer draws of a Store that has levels (build_levels). One thread
    at a time may use it.

    memory           bytes for the tree of levels and for chunks on their way
    gpu_memory       bytes of the renderer's buffers
    pixel_error      largest error in pixels; more if the budgets demand it
    triangle_budget  triangles of a frame
    draw_budget      draw calls of a frame
    upload_budget    bytes that one frame hands over
    look_ahead       seconds of the path for which chunks are read ahead
    background       whether a second thread reads

    Raises Error: bad_argument if the store has no current levels.
    """
    def __init__(self, store: Store, *, memory: int = ..., gpu_memory: int = ..., pixel_error: float = ..., triangle_budget: int = ..., draw_budget: int = ..., upload_budget: int = ..., look_ahead: float = ..., background: bool = ...) -> None: ...
    def frame(self, camera: Camera, velocity: ArrayLike = ...) -> ViewFrame:
        """Chooses what a Camera sees. Returns a ViewFrame.

        velocity  of the eye, in units a second, for loading ahead

        Raises Error: bad_argument, malformed if a chunk is damaged.
        """
    def wait(self) -> None:
        """Waits until all that the last frame wanted is loaded, or memory is full."""
    def set_hidden(self, part: int, hidden: bool) -> None:
        """Leaves a part out of the picture, or brings it back."""
    def set_occlusion(self, on: bool) -> None:
        """Sets whether parts that others hide are left out; at first they are."""
    def set_budgets(self, triangles: int, draws: int) -> None:
        """Changes triangle_budget and draw_budget from the next frame on."""
    @property
    def statistics(self) -> ViewStatistics:
        """ViewStatistics"""
    @property
    def origin(self) -> NDArray[Any]:
        """array of shape (3,): chunks are relative to it"""
    @property
    def bounds(self) -> Box3:
        """Box3, world frame"""
    @property
    def up(self) -> UpAxis:
        """UpAxis"""
    @property
    def parts(self) -> NDArray[np.int64]:
        """int64 array of shape (n,): rows of the store's table part"""
    def index_of(self, number: int) -> int | None:
        """The index in parts of a row; None if there is no such part."""
    def part(self, index: int) -> ViewPart:
        """The ViewPart of an index in parts. Raises Error (bad_argument)."""
    def find_parts(self, text: str, most: int = ..., from_part: int = ..., seconds: float = ...) -> FoundParts:
        """Finds parts whose id, name or type contains a text. Returns FoundParts."""

class ViewChunk:
    """A piece of geometry that is drawn at once."""
    @property
    def vertices(self) -> NDArray[np.float64]:
        """float64 array of shape (n, 3): of an instanced mesh, or world minus View.origin"""
    @property
    def faces(self) -> NDArray[np.uint32]:
        """uint32 array of shape (m, 3)"""
    @property
    def closed_triangles(self) -> int:
        """the first triangles, of closed surfaces whose fronts are outside"""
    @property
    def parts(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n,): of each vertex, the index in View.parts"""

class ViewFrame:
    """Returned by View.frame: what to draw."""
    @property
    def drops(self) -> NDArray[np.uint32]:
        """uint32 array of shape (n,): chunks that are no longer needed"""
    @property
    def uploads(self) -> dict[str, Any]:
        """dict of number and ViewChunk: chunks that are needed from this frame on"""
    @property
    def draws(self) -> record:
        """record array of ChunkDraw, nearest first"""
    @property
    def instances(self) -> record:
        """record array of ChunkInstance"""
    @property
    def complete(self) -> bool:
        """every chunk is at the level asked for"""
    @property
    def loaded(self) -> bool:
        """nothing that was wanted is missing"""
    @property
    def pixel_error(self) -> float:
        """largest error of what is drawn"""

class ViewPart:
    """A part of a View."""
    @property
    def number(self) -> int:
        """its row in the store's table part"""
    @property
    def file(self) -> str: ...
    @property
    def id(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def box(self) -> Box3:
        """Box3, world frame"""
    @property
    def colour(self) -> Colour | None:
        """Colour; else None"""

class ViewStatistics:
    """Work of a View."""
    @property
    def triangles(self) -> int:
        """of the last frame"""
    @property
    def draw_calls(self) -> int:
        """of the last frame"""
    @property
    def wanted(self) -> int:
        """chunks of the last cut"""
    @property
    def missing(self) -> int:
        """chunks of the last cut not in memory"""
    @property
    def lookups(self) -> int:
        """chunks wanted, of all frames"""
    @property
    def misses(self) -> int:
        """chunks missing, of all frames"""
    @property
    def culled_by_frustum(self) -> int:
        """nodes of the last frame"""
    @property
    def culled_by_occlusion(self) -> int:
        """nodes of the last frame"""
    @property
    def bytes_loaded(self) -> int:
        """of all frames"""
    @property
    def bytes(self) -> int:
        """in memory"""
    @property
    def peak_bytes(self) -> at:
        """at most View's memory"""
    @property
    def gpu_bytes(self) -> int:
        """of the renderer's buffers"""
    @property
    def peak_gpu_bytes(self) -> at:
        """at most View's gpu_memory"""
    @property
    def seconds_selecting(self) -> float:
        """of the last frame"""

class Volume(IntEnum):
    """The bounding volume that a model's hierarchy is made of."""
    automatic = 0
    aabb = 1
    sphere = 2
    kdop14 = 3
    kdop18 = 4
    kdop26 = 5
    obb = 6
    pss = 7
    lss = 8
    rss = 9
    ssv = 10

class Walk:
    """A region of interest that moves through an open Store, and queries about what is there. Answers are
    those that all parts in memory would give. A part is an int. One thread at a time may use a walk. The
    walk keeps the store's file open.

    memory      bytes for tables, geometry and hierarchies
    look_ahead  seconds of the predicted path along which parts are read
    prefetch    whether a second thread reads ahead

    Raises Error as open_store; bad_argument if an import has not ended or the memory is too small.
    """
    def __init__(self, store: Store, *, memory: int = ..., look_ahead: float = ..., prefetch: bool = ...) -> None: ...
    def move_to(self, position: ArrayLike, velocity: ArrayLike | None = ...) -> None:
        """Says where the region of interest is, and its velocity in units a second. Never waits for the disk."""
    def wait(self) -> None:
        """Waits until what is near and ahead is in memory, or memory is full."""
    def distance(self, probe: int | Probe | Model | Convex | Sphere | Capsule | Box3, pose: _Poses = ..., *, upper_bound: float = ..., missing: MissingParts | str = ..., except_part: int = ...) -> NearestPart:
        """The part nearest to the probe: a NearestPart.

        probe        a Probe, or what one is made of; or the number of a part, at its place
        pose         of the probe; None for a part
        upper_bound  length; parts farther away are ignored
        missing      MissingParts
        except_part  number of a part to leave out; 0: none

        Ctrl-C ends this query and those below.
        """
    def within(self, probe: int | Probe | Model | Convex | Sphere | Capsule | Box3, pose: _Poses, tolerance: float, *, missing: MissingParts | str = ..., except_part: int = ...) -> NearParts:
        """All parts at most `tolerance` away, and how far: NearParts. Otherwise as distance."""
    def collide(self, probe: int | Probe | Model | Convex | Sphere | Capsule | Box3, pose: _Poses = ..., *, mode: ContactMode | str = ..., missing: MissingParts | str = ..., except_part: int = ...) -> TouchedParts:
        """The parts that share a point with the probe: TouchedParts. Otherwise as distance."""
    def penetration(self, probe: int | Probe | Model | Convex | Sphere | Capsule | Box3, pose: _Poses = ..., *, missing: MissingParts | str = ..., except_part: int = ..., max_steps: int | None = ...) -> NearParts:
        """The parts that share a point with the probe, and how deep they go into each other:
        NearParts. max_steps: most steps of all depths together; a depth that needs more is
        bound_only. Otherwise as distance.
        """
    def first_hit(self, origin: Ray | ArrayLike, direction: ArrayLike | None = ..., t_min: float = ..., t_max: float = ..., *, missing: MissingParts | str = ..., except_part: int = ...) -> HitPart:
        """The first part that a ray meets: a HitPart.

        origin     a Ray, or its origin, shape (3,)
        direction  array of shape (3,), if the origin is no Ray
        """
    def sweep(self, probe: Probe | Model | Convex | Sphere | Capsule | Box3, pose: _Poses, translation: ArrayLike, *, missing: MissingParts | str = ..., except_part: int = ..., absolute_error: float | None = ...) -> FirstContact:
        """The first contact of a probe that moves in a straight line by `translation` while the
        time goes from 0 to 1: a FirstContact. None is missed, however far it moves.

        absolute_error  length, as for time_of_impact
        """
    def time_of_impact(self, probe: Probe | Model | Convex | Sphere | Capsule | Box3, motion: Motion, *, missing: MissingParts | str = ..., except_part: int = ..., absolute_error: float | None = ...) -> FirstContact:
        """The first contact of a probe that moves and turns: a FirstContact."""
    def parts_in_way(self, probe: Probe | Model | Convex | Sphere | Capsule | Box3, motion: Motion, *, missing: MissingParts | str = ..., except_part: int = ..., absolute_error: float | None = ...) -> PartsInWay:
        """All parts that a moving probe meets, each with its own time: PartsInWay."""
    def add(self, model: Model, pose: _Poses) -> int:
        """Brings in a part that is not in the store; returns its number."""
    def move(self, part: int, pose: _Poses) -> None:
        """Puts a part elsewhere, for this walk. Error (bad_argument) if there is no such part."""
    def remove(self, part: int) -> None:
        """Takes a part out, for this walk."""
    def name(self, part: int) -> WalkPartName:
        """A WalkPartName."""
    def world_from_part(self, part: int) -> NDArray[Any]:
        """The part's pose, a matrix of shape (4, 4)."""
    def model(self, part: int) -> Model:
        """The part's Model."""
    @property
    def statistics(self) -> WalkStatistics: ...

class WalkGap:
    """How a part and the probe lie to each other, world frame."""
    dtype: np.dtype[Any]
    @property
    def part(self) -> int:
        """number of the part"""
    @property
    def distance(self) -> float:
        """length; 0 if they touch, negative: minus the depth"""
    @property
    def point_part(self) -> NDArray[np.float64]:
        """on the part"""
    @property
    def point_probe(self) -> NDArray[np.float64]:
        """on the probe"""
    @property
    def normal(self) -> NDArray[np.float64]:
        """unit vector from the part to the probe"""
    @property
    def triangle_part(self) -> int:
        """of a mesh; else 0"""
    @property
    def triangle_probe(self) -> int:
        """of a mesh; else 0"""
    @property
    def status(self) -> Status:
        """Status"""

class WalkPartName:
    """A part by name."""
    @property
    def file(self) -> str:
        """empty for a part that was added"""
    @property
    def id(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str: ...

class WalkStatistics:
    """What a walk did since it began."""
    @property
    def lookups(self) -> int: ...
    @property
    def misses(self) -> int: ...
    @property
    def seconds_waited(self) -> float: ...
    @property
    def read_ahead(self) -> int: ...
    @property
    def read_in_query(self) -> int: ...
    @property
    def evicted(self) -> int: ...
    @property
    def parts_in_memory(self) -> int: ...
    @property
    def table_bytes(self) -> int: ...
    @property
    def bytes(self) -> int: ...
    @property
    def peak_bytes(self) -> int: ...

class Walker:
    """A person, as a capsule, who walks or flies through a Walk and never passes through a part.
    Lengths in metres, angles in radians. It keeps the walk alive.

    feet      the lowest point of the person, shape (3,), world frame
    steepest  slope of the steepest floor that can be stood on
    skin      length of the gap that is kept to parts
    missing   'skip': waits at parts that are not in memory; 'wait': reads them in step

    Raises Error (bad_argument) if a value is not finite or a length not as its name says.
    """
    def __init__(self, walk: Walk, feet: ArrayLike, **options: Any) -> None: ...
    def step(self, wish: ArrayLike, seconds: float, *, duck: bool = ..., jump: bool = ...) -> WalkerState:
        """Moves the person for some time; returns the WalkerState.

        wish  velocity that is asked for, shape (3,), world frame
        """
    @property
    def state(self) -> WalkerState: ...
    @property
    def capsule(self) -> Capsule:
        """a Capsule around the person now, world frame"""
    @property
    def mode(self) -> WalkerMode:
        """WalkerMode"""
    def set_mode(self, mode: WalkerMode | str) -> None:
        """Walks or flies from now on."""
    def set_except(self, part: int) -> None:
        """A part to pass through, for example one that is carried. 0: none."""
    def move_to(self, feet: ArrayLike) -> None:
        """Puts the person elsewhere."""

class WalkerMode(IntEnum):
    """How a person moves."""
    walk = 0
    fly = 1

class WalkerState:
    """Where a person is after a step."""
    @property
    def feet(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def eye(self) -> NDArray[Any]:
        """array of shape (3,), world frame"""
    @property
    def velocity(self) -> NDArray[Any]:
        """array of shape (3,): mean of the last step"""
    @property
    def way(self) -> NDArray[np.float64]:
        """float64 array of shape (n, 3): the corners of the feet's way in the last step"""
    @property
    def on_ground(self) -> bool: ...
    @property
    def ducked(self) -> bool: ...
    @property
    def blocked(self) -> bool:
        """a part kept the person from its way"""
    @property
    def waits(self) -> bool:
        """stopped at parts that are not in memory"""
    @property
    def squeezed(self) -> overlaps:
        """overlaps a part and cannot be pushed out"""

class WarmStart:
    """Remembers where two models met or were closest, for the next pose.
    Use one for each pair of models. Answers do not depend on it, but for which of several
    closest pairs is found.
    """
    def __init__(self) -> None: ...
    @property
    def used(self) -> bool: ...
    @property
    def last(self) -> tuple:
        """the two triangles"""

class WorkOrder(IntEnum):
    """How the work on a store is put into an order."""
    partition = 0
    random = 1

class WorkUnit:
    """Parts that a job on a store works on together."""
    @property
    def parts(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def meshes(self) -> int:
        """in memory together; large ones are not counted"""
    @property
    def bytes(self) -> int:
        """of these meshes"""
    @property
    def bounds(self) -> Box3:
        """Box3 of the centres of the parts' boxes"""
    @property
    def middle(self) -> NDArray[Any]:
        """mean of these centres"""

class WorkerCounters:
    """The work of one process."""
    @property
    def units(self) -> int:
        """work units"""
    @property
    def pairs(self) -> int:
        """of parts"""
    @property
    def mesh_loads(self) -> int:
        """each time that a mesh was read"""
    @property
    def blocks(self) -> int:
        """mesh blocks that were needed"""
    @property
    def block_loads(self) -> int:
        """each time that one was read"""
    @property
    def block_bytes_needed(self) -> int:
        """of those blocks, each once"""
    @property
    def hierarchies_found(self) -> int:
        """in the store"""
    @property
    def bytes_read(self) -> int:
        """from the store"""
    @property
    def peak_bytes(self) -> int:
        """of models in memory at once"""
    @property
    def processor_seconds(self) -> float:
        """of all threads"""
    @property
    def waiting_seconds(self) -> float:
        """without work"""
    @property
    def peak_rss_mib(self) -> float:
        """MiB"""

class World:
    """Many bodies that move: which of them meet, how near they are, when they may meet. A model is its surface;
    all other shapes are solid. A world keeps its models and deformables alive.

    A body is a BodyId, an int; it is valid until the body is removed, and then never again.

    broad_phase  a BroadPhaseMethod
    filter       function of two bodies, a before b, that tells whether they may meet; called from any thread.
                 What it says may change only with refilter(). If it raises, the pair counts as filtered out
                 and the call that asked raises the same

    One thread at a time may use a world: a second one gets RuntimeError. Queries give sorted results, the same
    for any number of threads, and stop at Ctrl-C; the world is as before then.
    """
    def __init__(self, *, broad_phase: BroadPhaseMethod | str = ..., filter: Callable[[int, int], bool] | None = ...) -> None: ...
    def add(self, shape: Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace | Compound | ConvexPieces | Deformable, pose: _Poses = ..., *, is_static: bool = ..., groups: int = ..., mask: int = ..., user_data: int = ...) -> BodyId:
        """Adds a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid, HalfSpace, Compound, ConvexPieces or Deformable;
        returns its body, a BodyId.

        pose       rigid: a matrix of shape (4, 4), (translation, quaternion) or a Pose; none for a Deformable
        is_static  static bodies do not meet each other
        groups     bits: the groups that the body belongs to
        mask       bits: the groups that it meets; both bodies must agree
        user_data  a number of yours, at least 0; contacts carry it

        Raises Error (bad_argument) if a value is not finite or a shape is not valid; ValueError for a matrix that is
        no rotation and translation.
        """
    def move(self, body: _Bodies, pose: _Poses) -> None:
        """Moves a body; or many: an array of bodies of shape (n,) and one of poses of shape (n, 4, 4).

        Raises Error (bad_argument) if the body is not valid or is a deformable. A BodyId of another World is not valid;
        the integers of an array do not tell their World.
        """
    def refresh(self, body: int) -> None:
        """Says that a deformable has another step."""
    def remove(self, body: int) -> None:
        """Removes a body. Error (bad_argument) if it is not valid."""
    def set_options(self, body: int, *, is_static: bool = ..., groups: int = ..., mask: int = ..., user_data: int = ...) -> None:
        """Changes which bodies the body can meet."""
    def options(self, body: int) -> dict[str, Any]:
        """What set_options takes: a dict."""
    def set_user_data(self, body: int, user_data: int) -> None:
        """Changes the number that contacts of the body carry."""
    def refilter(self) -> None:
        """Says that the filter has changed."""
    def is_valid(self, body: int) -> bool: ...
    def __len__(self) -> int: ...
    def index_end(self) -> int:
        """How many entries an array needs that is read by BodyId.index: often more than len(), since each piece of a
        Compound takes an index, and that of a removed body is used again only later.
        """
    def world_from_body(self, body: int) -> NDArray[Any]:
        """The body's pose, a matrix of shape (4, 4)."""
    def box(self, body: int) -> Box3:
        """A Box3 that encloses the body."""
    def update(self) -> None:
        """Finds the pairs of bodies whose boxes overlap. Every query does so first if a body has changed."""
    def pairs(self) -> NDArray[Any]:
        """Pairs of bodies whose boxes overlapped at the last update: int64 array of shape (n, 2)."""
    def begun(self) -> NDArray[Any]:
        """Pairs that began with the last update, or with the query that made it."""
    def ended(self) -> NDArray[Any]:
        """Pairs that ended with the last update, or with the query that made it."""
    def collide(self, *, progress: _Progress = ...) -> NDArray[Any]:
        """All pairs of bodies that share a point: int64 array of shape (n, 2). Exact for models, boxes and convex
        bodies; others to rounding.
        """
    def penetration(self, *, progress: _Progress = ...) -> np.recarray[Any, Any]:
        """All pairs that share a point, with how deep they go into each other: a record array of BodyGap."""
    def within(self, distance: float, *, progress: _Progress = ...) -> np.recarray[Any, Any]:
        """All pairs at most `distance` apart, a length, and their signed distances: a record array of BodyGap. Pairs that share
        a point are as in penetration. Error (bad_argument) if the distance is negative.
        """
    def time_of_impact(self, motions: dict[int, Motion] | Iterable[tuple[int, Motion]], *, absolute_error: float | None = ..., max_steps: int | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
        """When bodies that move first meet, each pair once: a record array of BodyImpact.

        motions  a dict of body to Motion, or a list of (body, Motion); others stay where they are, and
                 deformables move as their steps say. Two bodies at rest are no pair

        Bodies that share a point at t = 0 have the time 0, a zero normal, and one point of both for point_a and
        point_b.
        """
    def contact_manifolds(self, margin: float = ..., *, progress: _Progress = ...) -> np.recarray[Any, Any]:
        """The contacts of all pairs at most `margin` apart, a length: for each region a normal and up to four points.
        A simulator's margin is at least the largest speed times the step; time_of_impact finds what is faster. A
        record array of ContactManifold. A body inside a closed model, clear of its surface, is apart from it by the
        distance of that surface. Error (bad_argument) if the margin is negative.
        """
    def first_hit(self, origin: Ray | ArrayLike, direction: ArrayLike | None = ..., t_min: float = ..., t_max: float = ..., *, groups: int = ..., filter: Callable[[int], bool] | None = ..., progress: _Progress = ...) -> BodyRayHit:
        """The first body that a ray meets: a BodyRayHit. Solids include their inside; models and deformables are
        surfaces.

        origin     a Ray, or its origin, shape (3,)
        direction  array of shape (3,), if the origin is no Ray
        groups     bits: bodies that belong to one of these groups
        filter     function of a body that tells whether it is asked about
        """
    def all_hits(self, origin: Ray | ArrayLike, direction: ArrayLike | None = ..., t_min: float = ..., t_max: float = ..., *, groups: int = ..., filter: Callable[[int], bool] | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
        """The first point of each body that a ray meets, sorted along it: a record array of BodyRayHit. Otherwise as
        first_hit.
        """
    def overlaps(self, shape: Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace, pose: _Poses = ..., *, groups: int = ..., filter: Callable[[int], bool] | None = ..., progress: _Progress = ...) -> NDArray[Any]:
        """The bodies that share a point with a shape, sorted: int64 array of shape (n,). As collide would tell it of a
        body in that place.

        shape   a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid or HalfSpace
        groups  bits: bodies that belong to one of these groups
        filter  function of a body that tells whether it is asked about
        """
    def sweep(self, shape: Model | Convex | Sphere | Capsule | Box3 | Cylinder | Cone | Ellipsoid | HalfSpace, motion: Motion, *, groups: int = ..., filter: Callable[[int], bool] | None = ..., absolute_error: float | None = ..., max_steps: int | None = ..., progress: _Progress = ...) -> BodySweepHit:
        """The first body that a moving shape meets, where the bodies stay: a BodySweepHit. Otherwise as overlaps and
        time_of_impact.
        """
    def set_speed(self, body: int, velocity: ArrayLike = ..., acceleration: ArrayLike = ..., acceleration_bound: float = ..., angular_speed: float = ..., angular_acceleration: float = ..., angular_velocity: ArrayLike = ...) -> None:
        """Bounds on the body's motion from its place and the time of the last `advance`. Call it before `move`.

        velocity, acceleration  of its origin, as far as they are known
        acceleration_bound      length of another acceleration, at most
        angular_velocity        known, about its origin: radians per unit of time
        angular_speed           length of another angular velocity, at most
        angular_acceleration    how fast that may grow, at most

        A deformable needs no bounds: it is tested anew after each refresh.
        """
    def advance(self, time: float, *, progress: _Progress = ...) -> NDArray[Any]:
        """Lets time pass, and returns the pairs that share a point at the places that the bodies have now. Looks only
        at pairs that may have met by then.
        """
    def next_event(self) -> float:
        """For so long from the last `advance` on, no pair that does not touch now can begin to."""
    def time_to_collision(self, a: int | None = ..., b: int | None = ..., *, limit: float = ..., progress: _Progress = ...) -> float:
        """Of all bodies: as `next_event`, however far ahead, but at most `limit`; infinite if no bodies can ever meet.
        Of two: for so long from the last `advance` on, they cannot begin to touch; 0 if they touch.

        Raises Error (bad_argument) if the limit is negative, a body is not valid or both are the same.
        """
    def schedule_counters(self) -> ScheduleCounters: ...

COMMON_PROPERTIES: tuple[str, ...]

@overload
def all_hits(model: Model, pose: _OnePose | ArrayLike, origin: Ray, *, progress: _Progress = ...) -> np.recarray[Any, Any]:
    """Every triangle that each ray meets, sorted by t, then by index.

    model      Model
    pose       one pose, as for collide
    origin     a Ray; or an array of shape (3,) or (n, 3)
    direction  array of shape (3,) or (n, 3), of any length but 0
    t_min      number or array of shape (n,): where rays begin, in lengths of the direction
    t_max      number or array of shape (n,): where they end
    progress   function of (stage, fraction)

    Returns a record array with the fields of RayHit; for many rays a list of them. Otherwise as first_hit.
    """
@overload
def all_hits(model: Model, pose: _OnePose | ArrayLike, origin: ArrayLike, direction: ArrayLike, t_min: ArrayLike = ..., t_max: ArrayLike = ..., *, progress: _Progress = ...) -> Any: ...
def apply_review(store: Store, path: _Path, *, base: int | None = ..., author: str = ..., now: int = ...) -> TopicMerge:
    """Merges a file of edits, as the report page saves it. Otherwise as merge_topics."""
def at(motion: Motion, t: float) -> NDArray[Any]:
    """The matrix of shape (4, 4) to which the motion has taken the body at time t."""
def bcf_bytes(file: BcfFile, version: BcfVersion | str = ...) -> bytes:
    """The bytes of a BCF file. Raises Error (bad_argument)."""
def bcf_revision(file: BcfFile) -> int | None:
    """The revision of a store's topics that a BcfFile was exported from, or None."""
def build_levels(store: _Path, *, memory: int = ..., progress: _Progress = ...) -> LevelReport:
    """Builds the levels of detail of a store, a path, if they are missing or outdated. Work that
    was interrupted is continued.

    memory  bytes that the work may use, at least 64 MiB

    Returns a LevelReport. Raises Error: bad_argument, cannot_write, those of open_store;
    KeyboardInterrupt at Ctrl-C.
    """
def camera_at(tour: Tour, seconds: float, lens: Camera = ...) -> Camera:
    """The Camera at a time: the position on a Catmull-Rom spline through the points.

    lens  Camera with the field of view, size and clipping distances

    Raises Error (bad_argument) if the tour has no points or one is not valid.
    """
def carried_part(walk: Walk, part: int) -> CarriedPart:
    """The CarriedPart of a part. Errors as Walk.model."""
def check_path(walk: Walk, probe: int | Probe | Model | Convex | Sphere | Capsule | Box3, poses: _Poses, *, except_part: int = ..., largest_clearance: float = ..., clearance_error: float = ..., max_queries: int = ..., absolute_error: float | None = ..., progress: _Progress = ...) -> PathReport:
    """Whether a part can be carried along poses: which parts are met, and how near others are.

    walk               a Walk
    probe              a Probe or what one is made of; or the number of a part of the walk
    poses              array of shape (n, 4, 4), or a list of poses, all rigid
    except_part        number of a part that is not in the way; 0: none
    largest_clearance  length; clearances above it are not measured
    clearance_error    length by which the clearance may exceed the least one
    max_queries        limit of the search for the clearance
    absolute_error     length, of contacts, as for time_of_impact
    progress           function of (stage, fraction)

    Returns a PathReport. Raises Error (bad_argument); KeyboardInterrupt at Ctrl-C.
    """
def clash_bcf(report: ClashReport, models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, *, author: str = ..., time: int = ..., project: str = ..., clip: bool = ..., snapshot: Callable[[ClashViewpoint], bytes] | None = ..., progress: _Progress = ...) -> BcfFile:
    """The groups of a report as topics of BCF, with viewpoints in metres, z up. Without groups, each clash is a topic.

    models    what the report is about: list of Scene or paths, or a Store
    author    who creates the topics
    time      when, in seconds since 1970; 0: now
    project   name of the project
    clip      whether planes cut away what lies outside of section boxes
    snapshot  function of a ClashViewpoint that returns the bytes of a PNG file

    Returns a BcfFile. Raises Error: bad_argument, those of the store.
    """
def clash_topic_guid(clash: str) -> str:
    """The GUID of the topic of a clash, by its id."""
@overload
def clash_viewpoint(report: ClashReport, models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, clash: int, *, fov: float = ..., aspect: float = ..., near: bool = ...) -> ClashViewpoint:
    """As clash_viewpoints, for one clash.

    The best viewpoint of a clash as review_clashes lists it.

    Raises Error: bad_argument if the store lacks a part of the clash, those of the store.
    """
@overload
def clash_viewpoint(store: Store, clash: ListedClash, *, fov: float = ..., aspect: float = ..., near: bool = ..., progress: _Progress = ...) -> ClashViewpoint: ...
def clash_viewpoints(report: ClashReport, models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, clashes: list[list[int]], *, fov: float = ..., aspect: float = ..., near: bool = ..., progress: _Progress = ...) -> list[ClashViewpoint]:
    """The best viewpoint of each list of clashes, by their indices in the report.

    models   what the report is about: list of Scene or paths, or a Store
    fov      vertical angle in radians
    aspect   of the picture: width / height
    near     whether the other parts in the section boxes are listed

    Returns a list of ClashViewpoint. Raises Error: bad_argument, those of the store.
    """
def clip_from_world(camera: Camera, origin: ArrayLike = ...) -> NDArray[Any]:
    """Matrix of shape (4, 4), float32, from world minus `origin` to clip space (OpenGL).
    Raises Error (bad_argument) if the camera is not as its members say.
    """
@overload
def collide(a: Model, pose_a: _OnePose, b: Model, pose_b: _OnePose, *, mode: ContactMode | str = ..., segments: bool = ..., warm_start: WarmStart | None = ..., progress: _Progress = ...) -> Contacts:
    """The pairs of triangles that share a point. Touching counts; a model inside another does not collide.

    a, b            two Model, or two ConvexPieces
    pose_a, pose_b  None, a matrix of shape (4, 4), (translation, quaternion) or a Pose; or many: an array of
                    shape (n, 4, 4). One pose of a model is used with all of the other's
    mode            'first': stop at the first pair. 'all': every pair
    segments        whether Contacts.segments tells where each pair meets (models only)
    triangles       whether PiecesContacts.triangles is filled (ConvexPieces only)
    warm_start      a WarmStart or PiecesWarmStart, for a first contact; not with many poses
    progress        function of (stage, fraction)

    Returns Contacts (PiecesContacts); with many poses ContactsList (a list of PiecesContacts), computed in
    parallel. Exact. Raises Error (bad_argument) if a pose is not finite; KeyboardInterrupt at Ctrl-C.
    """
@overload
def collide(a: Model, pose_a: _Poses, b: Model, pose_b: _Poses, *, mode: ContactMode | str = ..., segments: bool = ..., warm_start: WarmStart | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def collide(a: ConvexPieces, pose_a: _OnePose, b: ConvexPieces, pose_b: _OnePose, *, mode: ContactMode | str = ..., warm_start: PiecesWarmStart | None = ..., progress: _Progress = ..., triangles: bool = ...) -> PiecesContacts: ...
@overload
def collide(a: ConvexPieces, pose_a: _Poses, b: ConvexPieces, pose_b: _Poses, *, mode: ContactMode | str = ..., warm_start: PiecesWarmStart | None = ..., progress: _Progress = ..., triangles: bool = ...) -> Any: ...
@overload
def collide(robot: Robot, configuration: ArrayLike, *, self_pairs: bool = ..., obstacles: RobotObstacles | None = ..., root: bool = ..., progress: _Progress = ...) -> Any: ...
def colour_constraints(constraints: ArrayLike, fixed: ArrayLike | None = ...) -> ConstraintColours:
    """Colours constraints on two, three or four vertices each, so that no two of a colour share a vertex.

    constraints  integer array of shape (n, k), k from 2 to 4: Deformable.edges, or `vertices` of what
                 within returned. A constraint may repeat a vertex
    fixed        true for vertices that no constraint moves: these may be shared

    Returns ConstraintColours: each constraint has the first colour that no earlier one at its vertices has.
    Raises Error (bad_argument) if a vertex has no entry in fixed.
    """
def common_volume(a: Volume | str, b: Volume | str) -> Volume:
    """The Volume that a query of two models of these kinds tests: their own if it is the same,
    ssv for different swept spheres (sphere, pss, lss, rss, ssv), and else the boxes that every
    model has, automatic.
    """
def contact_manifolds(a: Model, pose_a: _OnePose, b: Model, pose_b: _OnePose, *, margin: float = ..., last: Sequence[ModelManifold] | None = ..., progress: _Progress = ...) -> list[ModelManifold]:
    """A normal and up to four points for each region where two Model touch.

    margin    triangles that are at most this far apart give points with negative depth
    last      the list of the last step: regions keep its names
    progress  function of (stage, fraction)

    Returns a list of ModelManifold. Raises Error (bad_argument) if a pose or the margin is not finite,
    or the margin is negative; KeyboardInterrupt at Ctrl-C.
    """
@overload
def contains(model: Model, pose: _OnePose | ArrayLike, points: _Point, *, progress: _Progress = ...) -> Containment:
    """Whether each point lies inside the model, outside or on its surface.

    model     Model. A closed one is decided exactly, another by its winding number
    pose      one pose, as for collide
    points    array of shape (3,) or (n, 3), world frame
    progress  function of (stage, fraction)

    Returns Containment, or a record array of shape (n,), computed in parallel:
    contains(model, None, points).side == Side.inside is an array of bool.
    """
@overload
def contains(model: Model, pose: _OnePose | ArrayLike, points: ArrayLike, *, progress: _Progress = ...) -> Any: ...
@overload
def distance(a: Model, pose_a: _OnePose, b: Model, pose_b: _OnePose, *, upper_bound: float = ..., absolute_error: float = ..., relative_error: float = ..., signed_distance: bool = ..., max_steps: int | None = ..., warm_start: WarmStart | None = ..., progress: _Progress = ...) -> Gap:
    """The distance of two surfaces, or of two convex bodies or solids, and a pair of closest points.

    a, b             two Model, two Convex or two ConvexPieces
    segment          a Segment in the world frame
    pose_a, pose_b   as for collide
    upper_bound      length; greater distances are not computed (not for Convex)
    absolute_error   length by which the distance may exceed the true one
    relative_error   share of the result by which it may (models only)
    signed_distance  minus the depth where models go into each other (models only)
    max_steps        limit of the search (models only)
    warm_start       a WarmStart, ConvexWarmStart or PiecesWarmStart; not with many poses
    progress         function of (stage, fraction)

    Returns Gap, ConvexGap or PiecesGap; with many poses a record array of shape (n,) with their fields,
    computed in parallel (Convex: one after another). Lengths are those of the vertices. Accurate to double
    rounding, and 0 exactly if they meet. Raises Error (bad_argument) if a pose is not finite or a bound is
    negative; KeyboardInterrupt at Ctrl-C.
    """
@overload
def distance(a: Model, pose_a: _Poses, b: Model, pose_b: _Poses, *, upper_bound: float = ..., absolute_error: float = ..., relative_error: float = ..., signed_distance: bool = ..., max_steps: int | None = ..., warm_start: WarmStart | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def distance(a: Convex, pose_a: _OnePose, b: Convex, pose_b: _OnePose, *, absolute_error: float = ..., warm_start: ConvexWarmStart | None = ...) -> ConvexGap: ...
@overload
def distance(a: Convex, pose_a: _Poses, b: Convex, pose_b: _Poses, *, absolute_error: float = ..., warm_start: ConvexWarmStart | None = ...) -> Any: ...
@overload
def distance(a: ConvexPieces, pose_a: _OnePose, b: ConvexPieces, pose_b: _OnePose, *, upper_bound: float = ..., absolute_error: float = ..., warm_start: PiecesWarmStart | None = ..., progress: _Progress = ...) -> PiecesGap: ...
@overload
def distance(a: ConvexPieces, pose_a: _Poses, b: ConvexPieces, pose_b: _Poses, *, upper_bound: float = ..., absolute_error: float = ..., warm_start: PiecesWarmStart | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def distance(robot: Robot, configuration: ArrayLike, *, self_pairs: bool = ..., obstacles: RobotObstacles | None = ..., root: bool = ..., upper_bound: float = ..., progress: _Progress = ...) -> Any: ...
@overload
def distance(model: Model, pose: _OnePose | ArrayLike, segment: Segment, *, upper_bound: float = ..., absolute_error: float = ..., relative_error: float = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Any: ...
def distance_colour(fraction: float) -> Colour:
    """The Colour of a fraction of the reach, in [0, 1]; for a legend."""
def distances_from(part: int, model: Model, pose: _OnePose | ArrayLike, reach: float, *, grid: int = ...) -> DistanceColours:
    """The DistanceColours by the exact distance from the surface of a part, which itself keeps its
    colour.

    part   its number in the renderer
    model  Model of the part, placed by pose
    reach  length, positive
    grid   1: the distance is computed for every pixel

    Raises Error (bad_argument).
    """
def duration(tour: Tour) -> float:
    """The time of the last point; 0 if none."""
def elementary_impact(kind: ElementaryKind | str, start: ArrayLike, end: ArrayLike, *, absolute_error: float = ..., thickness: float = ...) -> ElementaryImpact:
    """The first time in [0, 1] at which a moving vertex and face, or two moving edges, share a point.

    kind            'vertex_face' or 'edge_edge'
    start, end      arrays of shape (4, 3): the vertex and the face's three, or the edges' two and two
    absolute_error  length; 0: exact. Else pairs that come so near may be reported too
    thickness       length at which features count as meeting

    Returns ElementaryImpact. Raises Error (bad_argument) if a value is not finite or negative.
    """
def elementary_impacts(kinds: ElementaryKind | str | ArrayLike, start: ArrayLike, end: ArrayLike, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
    """Many pairs in parallel: start and end of shape (n, 4, 3), one kind for all or an array of shape (n,).

    Returns a record array of shape (n,) with the fields of ElementaryImpact.
    """
def feature_tests(representatives_a: Representatives, representatives_b: Representatives, pairs: ArrayLike, *, margin: float = ...) -> np.recarray[Any, Any]:
    """As self_feature_tests, but between two surfaces: pairs of a triangle of each."""
@overload
def find_clashes(store: Store, *, clearance: float = ..., touch_tolerance: float | None = ..., self: bool = ..., rules: Sequence[ClashRule] | _Path = ..., progress: _Progress = ..., memory: int = ..., order: WorkOrder | str = ..., keep: bool = ..., keep_hierarchies: bool = ..., crew: Crew | None = ..., only: str | PartQuery = ..., a: str | PartQuery = ..., b: str | PartQuery = ..., matrix: ClashMatrix | _Path | None = ..., leave_out: Sequence[Neighbours | str] = ..., sort: ClashOrder | str = ...) -> ClashReport:
    """All clashes and clearances between the parts of different models; of one model, between its parts.

    models            list of Scene or paths, or one of them
    store             an open Store: models of any size in little memory
    clearance         metres; pairs without contact that are nearer are reported
    touch_tolerance   metres; surfaces that meet no deeper than this are of kind touch; None: what the files tell apart
    self              also the pairs within each model
    rules             list of ClashRule, or the path of a JSON or TOML file
    progress          function of (stage, fraction)
    memory            bytes for geometry, hierarchies and tables
    order             a WorkOrder
    keep              whether what is done is kept in the store, if that can be written to
    keep_hierarchies  whether hierarchies are kept with it
    crew              a Crew: the processes that do the job together, this one as their leader
    only              a condition, as text or PartQuery: both parts match it
    a, b              conditions: one part matches a, the other one b
    matrix            a ClashMatrix, the path of its file, or the name of a preset
    leave_out         list of Neighbours that are not tested
    sort              a ClashOrder: the order of the clashes

    Returns a ClashReport. Raises Error: bad_argument for a negative length, those of read_scene and of the store;
    KeyboardInterrupt at Ctrl-C.
    """
@overload
def find_clashes(models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, *, clearance: float = ..., touch_tolerance: float | None = ..., self: bool = ..., rules: Sequence[ClashRule] | _Path = ..., progress: _Progress = ..., only: str | PartQuery = ..., a: str | PartQuery = ..., b: str | PartQuery = ..., matrix: ClashMatrix | _Path | None = ..., leave_out: Sequence[Neighbours | str] = ..., sort: ClashOrder | str = ...) -> ClashReport: ...
def find_motion_clashes(assembly: Assembly, *, clearance: float = ..., tolerance: float = ..., step: float = ..., joined: bool = ..., max_steps: int = ..., progress: _Progress = ...) -> MotionReport:
    """Finds every clash between the parts of an assembly while it moves.

    clearance  also finds pairs that come at most this near
    tolerance  parts at most this far apart count as in contact
    step       seconds: shorter contacts and separations may be joined; 0: a thousandth of the duration
    joined     whether pairs that a joint or a loop connects are tested, too
    max_steps  measurements of a pair, before they become coarse
    progress   function of (stage, fraction)

    Returns MotionReport. No contact is missed between samples.
    """
@overload
def first_hit(model: Model, pose: _OnePose | ArrayLike, origin: Ray, *, progress: _Progress = ...) -> RayHit:
    """The first triangle that each ray meets.

    model      Model
    pose       one pose, as for collide
    origin     a Ray; or an array of shape (3,) or (n, 3)
    direction  array of shape (3,) or (n, 3), of any length but 0
    t_min      number or array of shape (n,): where rays begin, in lengths of the direction
    t_max      number or array of shape (n,): where they end
    progress   function of (stage, fraction)

    Returns RayHit, or a record array of shape (n,), computed in parallel. Which triangles are met is
    exact; a ray through an edge slips through nowhere. Raises Error (bad_argument) for a zero direction.
    """
@overload
def first_hit(model: Model, pose: _OnePose | ArrayLike, origin: ArrayLike, direction: ArrayLike, t_min: ArrayLike = ..., t_max: ArrayLike = ..., *, progress: _Progress = ...) -> Any: ...
def forget_resolved_clashes(store: Store) -> int:
    """Removes resolved clashes and their marks. Returns how many."""
def group_clashes(report: ClashReport, *, store: Store | None = ..., by: ColourBy | str = ..., least: int = ..., reach: float = ..., progress: _Progress = ...) -> None:
    """Groups the clashes of a report: sets report.groups.

    store     the store of the report: clashes stay in their earlier groups, which keep their ids and names
    by        criteria, outermost first: 'storey,part', or a list of GroupBy; default 'part,place'
    least     clashes that must share a part to be a group of it
    reach     metres; the largest distance of a clash from the centre of its place
    progress  function of (stage, fraction)

    Raises Error (bad_argument), those of the store.
    """
def group_topic_guid(group: str) -> str:
    """The GUID of the topic of a group, by its id."""
def groups_of_clashes(report: ClashReport) -> list[str] | None:
    """The id of the innermost group of each clash; None: not grouped."""
def has_levels(store: Store) -> bool:
    """Whether a Store has levels for all its parts as they are now."""
def help_find_clashes(store: _Path, crew: Crew, *, progress: _Progress = ...) -> None:
    """Takes part in the job of the leader, which calls find_clashes(store, crew=crew). Returns when the leader has
    left the crew.

    store  path of the leader's store, or of a copy of it
    """
def impacts(a: Deformable, b: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> Impacts:
    """Every vertex and face, and every two edges, of two Deformable that meet during their step.

    absolute_error  length; 0: exact. Else features that come so near may be reported too
    thickness       length at which features count as meeting
    progress        function of (stage, fraction)

    Returns Impacts. Complete and exact. Raises Error (bad_argument) also if their schemes differ.
    """
def import_models(files: Iterable[_ModelPath] | _ModelPath, store: _Path, *, memory: int = ..., unit: float = ..., up: UpAxis | str = ..., spaces: bool = ..., map: bool = ..., allow_outside_files: bool = ..., progress: _Progress = ...) -> ImportReport:
    """Brings model files into a store, one SQLite file, which is made if it is not there. A file that has not
    changed costs nothing.

    files   list of paths, with units and axes as read_scene takes them
    store   path of the store
    memory  bytes that the import may keep in memory, at least 16 MiB
    Others as read_scene.

    Returns an ImportReport. Raises Error as read_scene and open_store; after one, and after Ctrl-C, the store
    holds each model as it was before or as it is now.
    """
def innermost_groups(groups: list[ClashGroup]) -> list[ClashGroup]:
    """The groups that hold no other group: a list of ClashGroup."""
def inspect(mesh: ArrayLike | _Mesh) -> MeshReport:
    """Counts what a mesh has that may be wrong with it. Takes what Model takes.

    Returns a MeshReport. Raises Error (bad_mesh) if a coordinate is not finite or beyond 1e18.
    """
def intersections(a: Deformable, b: Deformable, *, at_end: bool = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
    """Every edge and face of two Deformable at rest that share a point.

    at_end    take the positions at the end of the step, not those at its start
    progress  function of (stage, fraction)

    Returns a record array of EdgeFaceIntersection, each pair once, sorted. Exact.
    """
def into_one_frame(scenes: list[Scene]) -> list[Scene]:
    """Returns copies of the scenes, turned so that the axis points up that does in the first one."""
def is_free_of_impacts(a: Deformable, b: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> bool:
    """Whether no features of two Deformable meet during their step. Stops at the first that do.

    absolute_error  length; 0: exact. Else features that come so near may be reported too
    thickness       length at which features count as meeting
    progress        function of (stage, fraction)

    Returns a bool.
    """
def is_free_of_self_impacts(surface: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> bool:
    """Whether no features of a Deformable meet during its step. Stops at the first that do.

    absolute_error  length; 0: exact. Else features that come so near may be reported too
    thickness       length at which features count as meeting
    progress        function of (stage, fraction)

    Returns a bool.
    """
def is_helper() -> bool:
    """Whether this process was started as one of several and is not the first of them."""
def is_store(path: _Path) -> bool:
    """Whether a file begins as a store does."""
def join_crew() -> Crew | None:
    """The Crew in which `mpirun` started this process; None if it was started alone.

    Raises Error (unsupported) if this build has no MPI, or another one than the one that started the process.
    """
def last_clash_options(store: Store) -> dict[str, Any]:
    """The options of the last job that finished, as keyword arguments of find_clashes.
    Raises Error: bad_argument if there is none, or if the store did not keep its rules.
    """
def length_of_pixel(camera: Camera) -> float:
    """The length at distance 1 that a pixel covers, in the middle of the picture."""
def look_at_box(box: Box3, towards: ArrayLike, up: ArrayLike, lens: Camera = ...) -> Camera:
    """The Camera that sees a whole Box3 from a direction: `towards` is where it looks."""
def mark_clashes(store: Store, *, reviewed: list[str] = ..., approved: list[str] = ..., cleared: list[str] = ..., note: str = ...) -> None:
    """Marks clashes by their ids, all of them or, after an error, none. The store is opened with read_only=False.

    Raises Error: bad_argument, naming the clash, cannot_write.
    """
def matrix_preset(name: str) -> ClashMatrix:
    """A ClashMatrix that Abut brings along. Raises Error: bad_argument."""
def matrix_preset_text(name: str) -> str:
    """The TOML file of such a matrix. Raises Error: bad_argument."""
def merge_bcf(store: Store, file: BcfFile, *, base: int | None = ..., author: str = ..., now: int = ...) -> TopicMerge:
    """Merges the topics of a BcfFile into a store.

    base    revision that the file was exported from; None: what the file says
    author  who made the changes; empty: whom the file names
    now     the time of the change, in seconds since 1970; 0: the clock

    Returns a TopicMerge. Raises Error as merge_topics does.
    """
def merge_topics(store: Store, edited: list[Topic], *, base: int | None = ..., author: str = ..., now: int = ...) -> TopicMerge:
    """Merges edited topics into a store that was opened with read_only=False.

    edited  list of Topic
    base    the revision that they were made from; None: the last one
    author  who made the changes
    now     seconds since 1970; 0: the clock

    Returns a TopicMerge. Raises Error: bad_argument, cannot_write.
    """
@overload
def nearest(model: Model, pose: _OnePose | ArrayLike, points: _Point, *, upper_bound: float = ..., signed_distance: bool = ..., progress: _Progress = ...) -> Nearest:
    """The surface point nearest to each point.

    model            Model
    pose             one pose, as for collide
    points           array of shape (3,) or (n, 3), world frame
    upper_bound      length; greater distances are not computed
    signed_distance  negative strictly inside; Error (bad_argument) if the model is not closed
    progress         function of (stage, fraction)

    Returns Nearest, or a record array of shape (n,), computed in parallel. Raises Error (bad_argument) if a
    value is not finite or beyond 1e18.
    """
@overload
def nearest(model: Model, pose: _OnePose | ArrayLike, points: ArrayLike, *, upper_bound: float = ..., signed_distance: bool = ..., progress: _Progress = ...) -> Any: ...
def on_screen(camera: Camera, point: ArrayLike) -> NDArray[np.float64] | None:
    """An array of shape (3,): where a Camera sees a point, in pixels from the top left corner, and
    the depth along the viewing direction. None if it is not in front of the camera.
    Raises Error (bad_argument).
    """
def open_store(path: _Path, *, read_only: bool = ...) -> Store:
    """Opens a Store. Raises Error: file_not_found, malformed, unsupported (a newer version's), unreadable (another
    process writes it).
    """
def overlap_graph(store: Store, *, clearance: float = ..., touch_tolerance: float | None = ..., self: bool = ..., rules: Sequence[ClashRule] | _Path = ..., progress: _Progress = ..., memory: int = ..., lines: int = ..., keep: bool = ...) -> GraphReport:
    """The graph of a store's parts: an edge where boxes are at most the clearance apart.

    lines  of about how many edges the ends are wanted
    keep   whether edges and work units are kept in the store for SQL
    Others as find_clashes. Returns a GraphReport.
    """
def overlapping_boxes(lower: ArrayLike, upper: ArrayLike, *, gap: float = ..., filter: Callable[[int, int], bool] | None = ...) -> NDArray[Any]:
    """The pairs of boxes at most `gap` apart on every axis.

    lower, upper  corners, arrays of shape (n, 3)
    filter        function of two indices i < k; called from any thread

    Returns a sorted uint32 array of shape (m, 2). Exact. Raises Error (bad_argument) if a bound is not a
    number or the gap is negative.
    """
def overlapping_triangles(model: Model, pose: _Poses, shape: Sphere | Box3 | OrientedBox | Segment, *, progress: _Progress = ...) -> NDArray[np.uint32]:
    """The triangles that share a point with a Sphere, Box3, OrientedBox or Segment, as a sorted uint32 array of
    shape (n,). Otherwise as overlaps.
    """
@overload
def overlaps(model: Model, pose: _OnePose | ArrayLike, shape: Sphere | Box3 | OrientedBox | Segment, *, progress: _Progress = ...) -> bool:
    """Whether the surface and a solid shape share a point. Exact; touching counts.

    model         Model, as a surface: a shape wholly inside a closed one does not overlap it
    pose          one pose, as for collide
    shape         Sphere, Box3, OrientedBox or Segment, world frame
    lower, upper  corners of boxes, arrays of shape (3,) or (n, 3)
    progress      function of (stage, fraction)

    Returns a bool; for many boxes an array of bool of shape (n,), computed one after another.
    """
@overload
def overlaps(model: Model, pose: _OnePose | ArrayLike, lower: _Point, upper: _Point, *, progress: _Progress = ...) -> bool: ...
@overload
def overlaps(model: Model, pose: _OnePose | ArrayLike, lower: ArrayLike, upper: ArrayLike, *, progress: _Progress = ...) -> Any: ...
def parse_bcf(bytes: bytes, name: str, limits: BcfLimits = ...) -> BcfFile:
    """As read_bcf, for the bytes of a file; `name` stands in errors."""
def parse_grouping(text: str) -> list[enum]:
    """Criteria of a text such as 'storey,part': a list of GroupBy."""
def parse_model_path(text: _Path) -> ModelPath:
    """The ModelPath of 'pump.stl:mm' or 'part.obj:mm:y-up'. Raises Error (bad_argument)."""
@overload
def part_colouring(store: Store, by: ColourBy | str = ...) -> PartColouring:
    """The PartColouring of the parts of a Store, or of models, model by model. Raises Error: those of the
    store; bad_argument for models by 'clash'.

    Of a Scene or path, or several.
    """
@overload
def part_colouring(models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, by: ColourBy | str = ...) -> PartColouring: ...
@overload
def part_colours(store: Store, by: ColourBy | str = ...) -> list[Colour]:
    """The list of Colour of a Store's parts, in the order of View.parts, or of some ViewPart. Equal
    words get equal colours in every model.

    Of ViewParts, all are grey by 'storey' and 'clash'.

    Of a Scene or path, or several. Raises Error (bad_argument) by 'clash'.
    """
@overload
def part_colours(parts: list[ViewPart], by: ColourBy | str = ...) -> list[Colour]: ...
@overload
def part_colours(models: Iterable[Scene | _ModelPath] | Scene | _ModelPath, by: ColourBy | str = ...) -> list[Colour]: ...
def part_transforms(assembly: Assembly, time: float) -> list[NDArray[Any]]:
    """The place of each part at a time: list of matrices of shape (4, 4)."""
def peak_resident_mib() -> float:
    """The largest resident memory of this process, or of an ended child if larger, in MiB."""
@overload
def penetration(a: Model, pose_a: _OnePose, b: Model, pose_b: _OnePose, *, relative_error: float = ..., separation: bool = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Depth:
    """How deep two models go into each other, where, and a translation that parts them.

    a, b            two Model, two Convex or two ConvexPieces
    pose_a, pose_b  as for collide
    relative_error  width that [depth, depth_at_most] should have, as a share (models only)
    separation      False: leave `separation` zero, and save its time (not for Convex)
    max_steps       limit of the search (models only)
    warm_start      a ConvexWarmStart (Convex only); not with many poses
    progress        function of (stage, fraction)

    Returns Depth, ConvexDepth or PiecesDepth. With many poses a list of Depth, or a record array of the
    others; only those of ConvexPieces are computed in parallel. Raises Error (bad_argument) if a pose is not
    finite; KeyboardInterrupt at Ctrl-C.
    """
@overload
def penetration(a: Model, pose_a: _Poses, b: Model, pose_b: _Poses, *, relative_error: float = ..., separation: bool = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def penetration(a: Convex, pose_a: _OnePose, b: Convex, pose_b: _OnePose, *, warm_start: ConvexWarmStart | None = ...) -> ConvexDepth: ...
@overload
def penetration(a: Convex, pose_a: _Poses, b: Convex, pose_b: _Poses, *, warm_start: ConvexWarmStart | None = ...) -> Any: ...
@overload
def penetration(a: ConvexPieces, pose_a: _OnePose, b: ConvexPieces, pose_b: _OnePose, *, separation: bool = ..., progress: _Progress = ...) -> PiecesDepth: ...
@overload
def penetration(a: ConvexPieces, pose_a: _Poses, b: ConvexPieces, pose_b: _Poses, *, separation: bool = ..., progress: _Progress = ...) -> Any: ...
def picture(models: Store | Iterable[Scene | _ModelPath] | Scene | _ModelPath, aim: NamedView | str | Camera | PartAim | PairAim | SidesAim | Clash = ..., *, width: int = ..., height: int = ..., colour_by: ColourBy | str = ..., samples: int = ..., edges: bool = ..., ambient_occlusion: bool = ..., ground: bool = ..., sections: list[SectionPlane] = ..., section_box: Box3 | None = ..., distances: PartDistances | None = ..., progress: _Progress = ...) -> NDArray[np.uint8]:
    """Draws models at full detail, without a window.

    models             a Store, or a Scene or path, or several
    aim                NamedView or its name, Camera, PartAim, PairAim, SidesAim, or a
                       Clash of these models
    width, height      pixels, at most 8192
    colour_by          ColourBy: 'material', 'type', 'file', 'part', 'storey' or, of a Store, 'clash'
    samples            along each side of a pixel: 1, 2 or 4
    edges              dark lines at silhouettes and creases
    ambient_occlusion  darker corners
    ground             a grid below the model
    sections           at most 6 SectionPlane
    section_box        Box3: what lies outside is cut away
    distances          PartDistances: surfaces are coloured by their distance from a part
    progress           function of (stage, fraction)

    Returns a uint8 array of shape (height, width, 3): red, green, blue, rows from the top.
    Raises Error: unsupported if EGL or OpenGL 3.3 is not available; bad_argument if no part or
    several have the id; those of the files. KeyboardInterrupt at Ctrl-C.
    """
def png_bytes(picture: NDArray[Any]) -> bytes:
    """The bytes of a PNG file of an array of shape (height, width, 3), uint8. Raises Error (bad_argument)
    if it has no pixels.
    """
def propose_allowed_pairs(robot: Robot, *, samples: int = ..., seed: int = ..., progress: _Progress = ...) -> list[AllowedPair]:
    """Proposes the pairs of links that need no test. Returns a list of AllowedPair."""
def ranked_clashes(report: ClashReport) -> list[int]:
    """Indices of a ClashReport's clashes, the worst first: hard ones by volume, then by depth."""
def ray_through(camera: Camera, x: float, y: float) -> Ray:
    """The Ray from the eye through a pixel; (0, 0) is the top left corner of the picture."""
def read_assembly(path: _Path, *, allow_outside_files: bool = ..., progress: _Progress = ...) -> Assembly:
    """Reads an assembly in motion from a TOML or JSON file.

    allow_outside_files  whether models outside of the file's folder may be read
    progress             function of (stage, fraction)

    Returns Assembly. Raises Error, naming the file and the element.
    """
def read_bcf(path: _Path, limits: BcfLimits = ...) -> BcfFile:
    """Reads a BCF file of version 2.0, 2.1 or 3.0. Returns a BcfFile. Raises Error: file_not_found, unreadable, malformed, unsupported."""
def read_elementary_queries(file: str, kind: ElementaryKind | str | None = ...) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Reads pairs from comma-separated text. Returns (kinds, start, end, truth): arrays of shapes (n,),
    (n, 4, 3), (n, 4, 3) and (n,), the last empty if the file does not tell.

    Raises Error: file_not_found, unreadable, malformed, bad_argument.
    """
def read_frame(path: _Path) -> Mesh:
    """Reads one frame of a deforming sequence, PLY or OBJ, as a Mesh: vertices as the file has them, in its order.

    Raises Error: file_not_found, unreadable, unsupported, malformed, bad_mesh.
    """
def read_frame_positions(path: _Path, vertex_count: int, faces: ArrayLike | None) -> NDArray[np.float64] | None:
    """The positions of a frame that has so many vertices and these faces, an array of shape (n, 3); None if it has
    others. Errors as read_frame.
    """
def read_matrix(path: _Path) -> ClashMatrix:
    """Reads a ClashMatrix from JSON or TOML. Raises Error: file_not_found, malformed."""
def read_mesh(path: _ModelPath, *, unit: float = ..., up: UpAxis | str = ..., spaces: bool = ..., map: bool = ..., time_limit: float = ..., memory_limit: int = ..., allow_outside_files: bool = ..., progress: _Progress = ...) -> Mesh:
    """Reads a model file as one mesh.

    unit                 metres per unit, for OBJ, OFF, PLY and STL; 0: 1
    up                   'x', 'y' or 'z': what points up in these
    spaces               whether IFC's spaces become parts
    map                  whether IFC parts lie on the map that the file names
    time_limit           seconds after which a reader is stopped; 0: none
    memory_limit         bytes that a reader may use; 0: no limit
    allow_outside_files  whether files outside of the model's folder may be referred to
    progress             function of (stage, fraction)

    Returns a Mesh of all parts, in metres.
    The path may end with a unit and axis: 'pump.stl:mm', 'part.obj:mm:y-up'.
    Raises Error: file_not_found, unreadable, malformed, unsupported, bad_mesh, reader_failed.
    """
def read_parts(store: Store, model: int = ...) -> Scene:
    """The parts of a model of a store as a Scene without meshes, with their properties and relations. model is an index in
    StoreSummary.models. Raises Error: bad_argument, malformed.
    """
def read_robot(path: _Path, *, package_folders: list[str] = ..., visual: bool = ..., allow_outside_files: bool = ..., progress: _Progress = ...) -> RobotDescription:
    """Reads a URDF file with its meshes.

    package_folders      folders that hold the packages of package://NAME/…
    visual               whether to read the visual shapes in place of the collision shapes
    allow_outside_files  whether meshes outside of their package may be read
    progress             function of (stage, fraction)

    Returns RobotDescription. Raises Error, naming the file and the line.
    """
def read_rules(path: _Path) -> list[ClashRule]:
    """Reads rules from JSON or TOML: a list of ClashRule. Raises Error: file_not_found, malformed."""
def read_scene(path: _ModelPath, *, unit: float = ..., up: UpAxis | str = ..., spaces: bool = ..., map: bool = ..., time_limit: float = ..., memory_limit: int = ..., allow_outside_files: bool = ..., progress: _Progress = ...) -> Scene:
    """Reads a model file: glTF, GLB, OBJ, PLY, STL, OFF, FBX, COLLADA, 3MF, IFC.

    unit                 metres per unit, for OBJ, OFF, PLY and STL; 0: 1
    up                   'x', 'y' or 'z': what points up in these
    spaces               whether IFC's spaces become parts
    map                  whether IFC parts lie on the map that the file names
    time_limit           seconds after which a reader is stopped; 0: none
    memory_limit         bytes that a reader may use; 0: no limit
    allow_outside_files  whether files outside of the model's folder may be referred to
    progress             function of (stage, fraction)

    Returns a Scene in metres, in the file's axes.
    The path may end with a unit and axis: 'pump.stl:mm', 'part.obj:mm:y-up'.
    Raises Error: file_not_found, unreadable, malformed, unsupported, bad_mesh, reader_failed.
    """
def read_scenes(paths: Iterable[_ModelPath] | _ModelPath, *, progress: _Progress = ...) -> list[Scene]:
    """Reads several model files in parallel, with the options' defaults. Returns a list of Scene. Errors as
    read_scene.
    """
def read_srdf(path: _Path, robot: RobotDescription) -> RobotSemantics:
    """Reads the allowed pairs and the named states of an SRDF file. Returns RobotSemantics."""
def read_topics(store: Store) -> list[Topic]:
    """The topics of a store. Raises Error (malformed)."""
def read_tour(path: _Path) -> Tour:
    """Reads a Tour from JSON. Raises Error: file_not_found, unreadable, malformed, unsupported."""
def record(tour: Tour, seconds: float, camera: Camera, name: str = ...) -> None:
    """Appends a point, unless the last one without a name is less than 1/30 second older.
    Raises Error (bad_argument) if the time is before that of the last point.
    """
def remove_models(files: Iterable[_Path], store: _Path) -> RemovalReport:
    """Takes models out of a store, all of them or none. Returns a RemovalReport. Raises Error (bad_argument) if a file
    is no model of the store.
    """
def review_clashes(store: Store) -> list[ClashReview]:
    """One ClashReview for each question that the store has been asked. Raises Error (malformed)."""
def review_groups(store: Store, since: int | None = ...) -> list[GroupReview]:
    """One GroupReview for each question and grouping of a store: what has become of the groups since the last job that
    ended before a time (seconds since 1970); None: since the job before the last one.
    """
def self_feature_tests(representatives: Representatives, pairs: ArrayLike, *, margin: float = ...) -> np.recarray[Any, Any]:
    """The tests to which pairs of triangles of one surface lead, each once.

    pairs   array of shape (n, 2): each pair of triangles at most once, also neighbours
    margin  length: features nearer than this are tested too

    Returns a record array of FeatureTest. Raises Error (bad_argument) for an index out of range.
    """
def self_impacts(surface: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> Impacts:
    """Every vertex and face, and every two edges, of a Deformable that meet during its step.

    absolute_error  length; 0: exact. Else features that come so near may be reported too
    thickness       length at which features count as meeting
    progress        function of (stage, fraction)

    Returns Impacts. Complete and exact. Raises Error (bad_argument) for a negative length.
    """
def self_intersections(surface: Deformable, *, at_end: bool = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
    """Every edge and face of a Deformable at rest that share a point, but no vertex: where it passes through itself.

    at_end    take the positions at the end of the step, not those at its start
    progress  function of (stage, fraction)

    Returns a record array of EdgeFaceIntersection, each pair once, sorted. Exact.
    """
def self_time_of_impact(surface: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> FeatureImpact | None:
    """The earliest of self_impacts.

    absolute_error  length; 0: exact. Else features that come so near may be reported too
    thickness       length at which features count as meeting
    progress        function of (stage, fraction)

    Returns FeatureImpact, or None.
    """
def self_within(surface: Deformable, distance: float, *, at_end: bool = ..., vertices: NearVertices | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]:
    """Every vertex and face, and every two edges, of a Deformable that are near each other at one end of the step.

    distance    length; the thicknesses of both features are added to it
    at_end      take the positions at the end of the step, not those at its start
    vertices    NearVertices: thickness, groups, masks and marks of moved vertices; within() of two surfaces
                has vertices_b as well
    progress    function of (stage, fraction)

    Returns a record array of FeaturePair, each pair once, sorted. Raises Error (bad_argument) if the distance
    is negative, or if an array has another length than there are vertices.
    """
def set_helper_folder(folder: _Path) -> None:
    """Tells where the helper programs lie that read some model files. The package calls it for those of the wheel."""
def set_threads(count: int) -> None:
    """Sets the number of threads of parallel work in this process. 0: all of the machine's."""
def summary(store: Store) -> StoreSummary:
    """A StoreSummary. Raises Error (malformed) if the store is damaged."""
@overload
def time_of_impact(robot: Robot, start: ArrayLike, end: ArrayLike, *, self_pairs: bool = ..., obstacles: RobotObstacles | None = ..., root: bool = ..., absolute_error: float = ..., max_steps: int | None = ..., progress: _Progress = ...) -> RobotImpact:
    """The first time in [0, 1] at which two moving models, or two Deformable, share a point.

    a, b                two Model
    motion_a, motion_b  a Motion, a pose (no motion), or a list of Motion; one is used with all of the other's
    absolute_error      length: how far apart the models may be at the time returned; None: a millionth of
                        the smaller model's diagonal
    max_steps           limit of the search
    progress            function of (stage, fraction)

    Returns Impact; with lists of motions a record array of shape (n,), computed in parallel. Of deformables
    FeatureImpact, or None. Never later than the first contact. Raises Error (bad_argument) if a value is not
    finite; KeyboardInterrupt at Ctrl-C.
    """
@overload
def time_of_impact(a: Deformable, b: Deformable, *, absolute_error: float = ..., thickness: float = ..., progress: _Progress = ...) -> FeatureImpact | None: ...
@overload
def time_of_impact(a: Model, motion_a: Motion | _OnePose, b: Model, motion_b: Motion | _OnePose, *, absolute_error: float | None = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Impact: ...
@overload
def time_of_impact(a: Model, motion_a: Motion | Sequence[Motion] | _Poses, b: Model, motion_b: Motion | Sequence[Motion] | _Poses, *, absolute_error: float | None = ..., max_steps: int | None = ..., progress: _Progress = ...) -> Any: ...
def time_range(assembly: Assembly) -> tuple[float, float]:
    """The first and the last time of all keys."""
@overload
def to_json(report: ClashReport) -> str:
    """The JSON text that the command writes: of a ClashReport, of a ClashReview, or of a list of ClashReview and the path
    of their store.
    """
@overload
def to_json(merge: TopicMerge) -> str: ...
@overload
def to_json(review: GroupReview) -> str: ...
@overload
def to_json(review: ClashReview) -> str: ...
@overload
def to_json(reviews: list[ClashReview], store: str) -> str: ...
@overload
def to_json(report: PathReport, walk: Walk) -> str: ...
def to_mesh(scene: Scene) -> Mesh:
    """All parts of a scene as one Mesh in the world. Raises Error (bad_mesh) if there are too many vertices."""
def topics_of_groups(report: ClashReport) -> list[Topic]:
    """One Topic for each innermost group of a report; then the others."""
def topics_revision(store: Store) -> int:
    """The number of the last change of topics."""
def turn_up(scene: Scene, up: UpAxis | str) -> None:
    """Turns a scene by quarter turns, so that this axis points up."""
def untouched_topics(store: Store) -> list[Topic]:
    """The topics of a store's groups and clashes, also of resolved ones, before anybody says anything about them."""
def update_bcf(earlier: BcfFile, later: BcfFile) -> BcfFile:
    """Updates a BcfFile by a later export; what people have changed in it stays."""
def variables_of(type: str) -> int:
    """The number of values that place a joint of this type."""
def verify(store: Store, *, progress: _Progress = ...) -> None:
    """Reads all of a store and checks it against its checksums. Raises Error (malformed)."""
def verify_jobs(store: Store) -> None:
    """Checks what the store keeps of jobs and clashes. Raises Error (malformed)."""
@overload
def within(a: Model, pose_a: _OnePose, b: Model, pose_b: _OnePose, tolerance: float, *, warm_start: WarmStart | None = ..., progress: _Progress = ...) -> bool:
    """Whether some two points are at most `tolerance` apart, a length.

    a, b            two Model or two ConvexPieces
    pose_a, pose_b  as for collide
    surface_a, _b   two Deformable: lists all near pairs of features, as self_within
    surface, body   a Deformable and a rigid shape (Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone,
                    Ellipsoid, HalfSpace): lists the parts of the surface that are near it or in it
    at_end          take the positions at the end of the step
    vertices        NearVertices of the (first) surface; vertices_b: of the second

    Returns a bool; with many poses an array of bool of shape (n,). Of two deformables a record array of
    FeaturePair, of a deformable and a body one of SurfaceContact.
    Raises Error (bad_argument) if the tolerance is negative; KeyboardInterrupt at Ctrl-C.
    """
@overload
def within(a: Model, pose_a: _Poses, b: Model, pose_b: _Poses, tolerance: float, *, warm_start: WarmStart | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def within(a: ConvexPieces, pose_a: _OnePose, b: ConvexPieces, pose_b: _OnePose, tolerance: float, *, warm_start: PiecesWarmStart | None = ..., progress: _Progress = ...) -> bool: ...
@overload
def within(a: ConvexPieces, pose_a: _Poses, b: ConvexPieces, pose_b: _Poses, tolerance: float, *, warm_start: PiecesWarmStart | None = ..., progress: _Progress = ...) -> Any: ...
@overload
def within(a: Deformable, b: Deformable, distance: float, *, at_end: bool = ..., vertices: NearVertices | None = ..., vertices_b: NearVertices | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]: ...
@overload
def within(surface: Deformable, body: _RigidShape, pose: _OnePose | ArrayLike, distance: float, *, at_end: bool = ..., vertices: NearVertices | None = ..., progress: _Progress = ...) -> np.recarray[Any, Any]: ...
def write_bcf(file: BcfFile, path: _Path, version: BcfVersion | str = ...) -> None:
    """Writes a BCF file of version 2.1 or 3.0. Raises Error: bad_argument, cannot_write."""
def write_clash_csv(report: ClashReport, path: _Path) -> None:
    """Writes a report as comma-separated text. Raises Error (cannot_write)."""
def write_clash_html(report: ClashReport, path: _Path, models: Iterable[Scene | _ModelPath] | Scene | _ModelPath = ..., *, building_bytes: int = ..., progress: _Progress = ...) -> None:
    """Writes a report as one page of HTML, with the building in 3D if the models are given.

    models           what the report is about: list of Scene or paths, or a Store
    building_bytes   of the page for the 3D view, approximately; 0: no 3D view

    Raises Error: cannot_write, bad_argument, those of the store.
    """
def write_clash_json(report: ClashReport, path: _Path) -> None:
    """Writes a report as JSON. Raises Error (cannot_write)."""
def write_frame(mesh: _Mesh, path: _Path) -> None:
    """Writes a frame as binary PLY. Takes what Model takes. Raises Error: unsupported, bad_mesh, cannot_write."""
def write_glb(scene: Scene, path: _Path) -> None:
    """Writes a scene as binary glTF. Raises Error (cannot_write)."""
def write_motion_csv(report: MotionReport, assembly: Assembly, path: _Path) -> None:
    """Writes a row for each contact and each approach."""
def write_motion_html(report: MotionReport, assembly: Assembly, path: _Path) -> None:
    """Writes one HTML page with a chart over time and tables."""
def write_png(picture: NDArray[Any], path: _Path) -> None:
    """Writes an array of shape (height, width, 3), uint8, as PNG, atomically. Raises Error (cannot_write)."""
def write_srdf(robot: RobotDescription, allowed: list[AllowedPair], path: _Path, base: _Path | None = ...) -> None:
    """Writes allowed pairs as an SRDF file; all else is taken from `base`, if it is given."""
def write_tour(tour: Tour, path: _Path) -> None:
    """Writes a Tour as JSON, atomically. Raises Error: bad_argument, cannot_write."""
