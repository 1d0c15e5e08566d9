#pragma once

#include <abut/clash_groups.h>
#include <abut/part_query.h>
#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/topics.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Finds every clash and every insufficient clearance between the parts of some models.
/// docs/clash.md defines each kind.
namespace abut {

/// `undecided`: the surfaces meet, and neither `hard` nor `touch` could be proven within the budget of
/// a pair.
enum class ClashKind : std::uint8_t { hard, touch, contained, duplicate, clearance, undecided };
inline constexpr std::array kClashKinds{ClashKind::hard,      ClashKind::touch,
                                        ClashKind::contained, ClashKind::duplicate,
                                        ClashKind::clearance, ClashKind::undecided};
/// "hard", "touch", "contained", "duplicate", "clearance", "undecided".
const char* to_string(ClashKind kind);

/// The status of a clash across the jobs of a store; see docs/clash-status.md.
enum class ClashStatus : std::uint8_t {
    fresh,    ///< "new": the previous job of the same question did not find it
    active,   ///< the previous job of the same question found it, too
    reviewed, ///< someone has examined it
    approved, ///< someone has accepted it
    resolved, ///< an earlier job found it, and it no longer exists
};
inline constexpr std::array kClashStatuses{ClashStatus::fresh, ClashStatus::active,
                                           ClashStatus::reviewed, ClashStatus::approved,
                                           ClashStatus::resolved};
/// "new", "active", "reviewed", "approved", "resolved".
const char* to_string(ClashStatus status);

/// How two parts belong together, so that their meeting is expected (docs/selecting.md).
enum class Neighbours : std::uint8_t {
    fills,         ///< one fills an opening of the other: a window and its wall
    connected,     ///< they are joined: two pipes at their ports
    covers,        ///< one covers the other: insulation and its pipe
    same_assembly, ///< both belong to one whole, or one is the whole: the flights of a stair
};
inline constexpr std::array kNeighbours{Neighbours::fills, Neighbours::connected,
                                        Neighbours::covers, Neighbours::same_assembly};
/// "fills", "connected", "covers", "same_assembly".
const char* to_string(Neighbours neighbours);

/// Selects parts by glob patterns (`*`, `?`) and a query. A part must match every list that is not
/// empty, and the query.
struct PartSelector {
    std::vector<std::string> file, name, type; ///< alternatives: a part matches one of a list
    PartQuery query{};
};

/// The pairs of parts that a rule leaves out.
struct IgnoreRule {
    bool same_file = false;
    bool same_type = false;
    std::size_t same_name_prefix = 0; ///< names that agree in this many first characters; 0: none
    std::vector<Neighbours> neighbours{}; ///< pairs that belong together in one of these ways
};

/// A rule selects pairs of parts, one part for each side in either order, and sets their
/// tolerances. The first rule that selects a pair decides about it.
struct ClashRule {
    std::string name;
    PartSelector a, b;
    std::optional<double> clearance, touch_tolerance; ///< metres; none: those of ClashOptions
    IgnoreRule ignore;
    /// Metres: parts that meet no deeper than this are left out.
    std::optional<double> tolerated_depth{};
    std::vector<ClashKind> kinds{}; ///< clashes of other kinds are left out; empty: none is
    std::string severity{};         ///< given to the clashes; any word, for example "high"
};

/// Reads rules from a file, which is TOML if its name ends in .toml, else JSON. docs/selecting.md
/// lists the keys.
///
/// Errors      Error, naming the file: file_not_found, malformed (wrong syntax, an unknown key, or
///             a value of the wrong type or outside its domain).
std::vector<ClashRule> read_rules(const std::string& path);

/// Groups of parts, and for pairs of groups whether and how their parts are examined.
struct ClashMatrix {
    struct Group {
        std::string name;
        PartQuery select; ///< a part belongs to the first group that selects it
    };
    struct Cell {
        std::uint32_t a = 0, b = 0; ///< indices of the groups, a <= b
        bool examined = true;
        /// Named "A / B" after the groups. Its selectors are not used.
        ClashRule terms{};
    };
    std::vector<Group> groups;
    /// At most one for two groups. Pairs of parts without a cell are not examined.
    std::vector<Cell> cells;
};

/// Reads a matrix from a file, as read_rules does. docs/selecting.md lists the keys.
ClashMatrix read_matrix(const std::string& path);

/// The names of the matrices that Abut brings along; docs/selecting.md describes them.
inline constexpr std::array<std::string_view, 3> kMatrixPresets{"mep-structure", "clearances",
                                                                "architecture"};
/// Returns a matrix that Abut brings along.
///
/// Errors      Error{bad_argument} if there is none of that name.
ClashMatrix matrix_preset(std::string_view name);
/// Returns the file that such a matrix is read from, in TOML.
std::string_view matrix_preset_text(std::string_view name);

/// The order of a report's clashes.
enum class ClashOrder : std::uint8_t {
    part,   ///< by models, then by part of a, then of b
    volume, ///< as ranked_clashes
};

struct ClashOptions {
    double clearance = 0; ///< metres; reports pairs without contact that are nearer than this
    /// Metres; surfaces that meet no deeper than this are of kind `touch` (docs/clash.md). None:
    /// what the files of a pair tell apart, which Scene::precision says. 0: exact.
    std::optional<double> touch_tolerance{};
    bool self = false;              ///< with several models: also tests the pairs within each model
    std::vector<ClashRule> rules{}; ///< if rules and matrix are empty, all pairs are tested
    ClashMatrix matrix{};           ///< decides about the pairs that no rule selects
    PartQuery only{};               ///< both parts of a pair match it
    PartQuery a{}, b{};             ///< one part of a pair matches a, the other one b
    /// A condition that the caller will ask of the report. It decides about no pair, but what it
    /// asks for must be known, as with `only`.
    ClashQuery asked_later{};
    std::vector<Neighbours> leave_out{}; ///< pairs that belong together in these ways
    ClashOrder order = ClashOrder::part;
    Progress progress{};
};

struct Clash {
    std::uint64_t id = 0; ///< hash of both parts' files and ids and of the kind: equal in every run
    ClashKind kind = ClashKind::hard;
    std::array<std::uint32_t, 2> model{}; ///< indices of the models in the given list
    std::array<std::uint32_t, 2> part{};  ///< indices of the parts in their models
    double distance =
        0; ///< metres; negative: penetration (contained: minus the gap to the enclosing surface)
    Vec3 point_a, point_b; ///< witness points, one on each surface, world frame
    Vec3 direction;        ///< unit vector along which b moves away from a; zero if there is none
    std::uint64_t triangle_pairs = 0; ///< number of intersecting triangle pairs
    std::string rule;                 ///< name of the rule or cell that decided; empty if none did
    std::string severity;             ///< of that rule or cell
    /// Cubic metres that two solids have in common, if they are `hard`, `contained` or `duplicate`;
    /// else 0. The true volume is at most volume_error larger or smaller. docs/clash.md says how it
    /// is found, and when it is not.
    double volume = 0, volume_error = 0;
    /// Metres by which the coordinates of both parts, and lengths between them, are rounded. Writers
    /// give a shorter `distance` as 0.
    double rounding = 0;
    std::optional<Neighbours> neighbours; ///< how the parts belong together, if they do
    std::optional<ClashStatus> status;    ///< set only for a store; never `resolved`
    std::string note; ///< written by the person who reviewed or approved the clash
};

/// Returns the distance of a clash as people should read it: 0 where it is rounding.
///
/// That is a distance of at most Clash::rounding, or below a picometre, which is less than an atom.
double told_distance(const Clash& clash);

/// A clash as a store lists it. Its parts are described in words, because they may no longer exist.
struct ListedClash {
    std::uint64_t id = 0; ///< as Clash::id
    ClashKind kind = ClashKind::hard;
    ClashStatus status = ClashStatus::fresh;
    std::array<std::string, 2> part, name, type, file; ///< of a and b; `part` is the part's id
    double distance = 0;       ///< metres, as told_distance, when the clash was last found
    std::int64_t resolved = 0; ///< when it was found resolved, in seconds since 1970; 0: it exists
    std::string note;
};

/// Returns an id as reports write it: 16 lower-case hexadecimal digits.
std::string clash_id_text(std::uint64_t id);
/// Returns the id, or nothing if the text is not an id.
std::optional<std::uint64_t> parse_clash_id(std::string_view text);

/// Why a pair of parts whose boxes are within the clearance is not in the report.
enum class LeftOut : std::uint8_t {
    not_selected,  ///< no rule and no cell selects the pair, or `only`, `a` and `b` do not
    ignored,       ///< by IgnoreRule::same_file, same_type or same_name_prefix
    off,           ///< its cell is not examined
    fills,         ///< known neighbours, as the four of Neighbours
    connected,     ///< as above
    covers,        ///< as above
    same_assembly, ///< as above
    tolerated,     ///< the parts meet no deeper than their rule or cell tolerates
    other_kind,    ///< their rule or cell wants clashes of other kinds
};
inline constexpr std::array kLeftOut{
    LeftOut::not_selected,  LeftOut::ignored,   LeftOut::off,
    LeftOut::fills,         LeftOut::connected, LeftOut::covers,
    LeftOut::same_assembly, LeftOut::tolerated, LeftOut::other_kind};
/// The enumerator's name.
const char* to_string(LeftOut reason);

/// How many parts that bound no solid a report names.
inline constexpr std::size_t kNamedSurfaces = 100;

/// Where a touch tolerance comes from.
enum class TouchSource : std::uint8_t {
    option,    ///< ClashOptions::touch_tolerance
    precision, ///< the precision that a file states
    rounding,  ///< the coordinates of a file are in single precision
    none,      ///< nothing is known of the precision of the models: exact
};
/// The enumerator's name.
const char* to_string(TouchSource source);

struct ClashReport {
    struct ModelSummary {
        std::string file;
        std::uint64_t parts = 0;
        std::uint64_t triangles = 0; ///< each instance counted
        double unit = 1;             ///< metres per unit of the file
        UpAxis up = UpAxis::y;       ///< up axis of the file
        std::vector<SceneNote> notes{};
        double precision = 0; ///< metres, as ModelPrecision::stated
        double rounding = 0;  ///< metres; the largest rounding of the coordinates of a part
    };
    /// The frame of all points and directions: in metres, with the axes of one of the models.
    struct Frame {
        UpAxis up = UpAxis::y;
        std::string of; ///< that model: the first one (in a store, the one imported first)
    };
    /// Parts whose surface bounds no solid: they contain nothing and have no volume.
    struct Surfaces {
        struct Named {
            std::uint32_t model = 0; ///< index of the model
            std::string id, name, type;
        };
        std::uint64_t count = 0;
        std::vector<Named> first; ///< the first kNamedSurfaces of them, by model and part
    };
    /// The clashes of a matrix, cell by cell.
    struct Matrix {
        struct Cell {
            std::uint32_t a = 0, b = 0; ///< indices of the groups, a <= b
            bool examined = true;
            double clearance = 0; ///< metres
            std::string severity;
            std::array<std::uint64_t, 6> counts{}; ///< by ClashKind
        };
        std::vector<std::string> groups;
        std::vector<Cell> cells;
    };
    struct Seconds {
        double import = 0, build = 0, broad = 0, narrow = 0, total = 0;
    };
    Frame frame;
    std::vector<ModelSummary> models;
    /// Reasons to doubt the result, one line each: for example, models that share no space.
    std::vector<std::string> warnings;
    /// Of all parts with triangles, tested or not. In a store, a mesh in several blocks counts if an
    /// edge is not used by exactly two triangles; one too large for the memory of its import does
    /// not count.
    Surfaces surfaces;
    double clearance = 0;
    /// Metres; of pairs whose rule names none. If the options name none either, each pair has its
    /// own, and these are the largest and the smallest one of the candidates.
    double touch_tolerance = 0, least_touch_tolerance = 0;
    TouchSource touch_source = TouchSource::option;
    std::string touch_file;       ///< of `precision` and `rounding`: the model that decided
    std::uint64_t candidates = 0; ///< part pairs whose boxes are within the clearance on every axis
    std::array<std::uint64_t, 6> counts{}; ///< by ClashKind
    /// Pairs that are not in the report, by LeftOut. Only the last two reasons are counted after a
    /// pair was tested; the other pairs are not tested.
    std::array<std::uint64_t, kLeftOut.size()> left_out{};
    std::array<std::uint64_t, kNeighbours.size()> neighbours{}; ///< clashes, by Neighbours
    std::optional<Matrix> matrix;                               ///< if the options have one
    std::vector<Clash> clashes;                                 ///< in the order of the options
    /// Set only for a store: the number of clashes of each ClashStatus, and the resolved clashes,
    /// the latest first.
    std::optional<std::array<std::uint64_t, 5>> statuses;
    std::vector<ListedClash> resolved;
    /// The criteria of `groups`, outermost first; empty: the clashes are not grouped. Filled in by
    /// the caller with group_clashes.
    std::vector<GroupBy> grouping;
    std::vector<ClashGroup> groups;
    /// Set only for a store that was grouped: the jobs of the question, the earliest first; what
    /// people said of the groups, and the revision of that.
    std::vector<JobCounts> history;
    std::vector<Topic> topics;
    std::int64_t topics_revision = 0;
    Seconds seconds;
    double peak_rss_mib = 0; ///< MiB; of this process or its largest reader, whichever is larger
};

/// Finds all clashes between parts of different models; for a single model, between its parts.
///
/// In/out      models in metres. A model whose axes differ from the first model's is rotated by
///             quarter turns. `seconds.import` stays 0.
/// Errors      Error{bad_argument} for a negative or NaN tolerance, and for a property or a value
///             that `only`, `a`, `b` or `asked_later` ask for and no part has; Error{interrupted}.
/// Cost        the broad phase takes O(n log n + candidates). A hierarchy is built once for each
///             mesh that a candidate needs.
ClashReport find_clashes(const std::vector<Scene>& models, const ClashOptions& options);

/// Returns the indices of the report's clashes, the worst first: `hard`, then `undecided`, by
/// volume, then by depth; `contained` and `duplicate` by volume; `touch` by depth; `clearance` by distance, the nearest
/// first. Clashes of equal rank keep their order.
std::vector<std::uint32_t> ranked_clashes(const ClashReport& report);

/// Report writers. Each is atomic: the file appears complete or not at all.
///
/// Errors      Error{cannot_write}, naming the file.
std::string to_json(const ClashReport& report, const std::vector<Scene>& models);
void write_clash_json(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);
void write_clash_csv(const ClashReport& report, const std::vector<Scene>& models,
                     const std::string& path);
struct ClashPageOptions {
    /// Characters that the 3D view's geometry may take in the page, approximately; 0: no 3D view.
    std::uint64_t building_bytes = 16'000'000;
    Progress progress{};
};

/// Writes one self-contained page: the clashes to filter and sort, and the building in 3D
/// (docs/clash-report.md). The geometry is simplified until it fits `building_bytes`, first that of
/// parts far from clashes. Without meshes in `models`, the page has no 3D view.
///
/// Errors      also Error{bad_argument} if a clash refers to a part that is not in `models`;
///             Error{interrupted}.
void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path, const ClashPageOptions& options);
void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);

} // namespace abut
