#pragma once

#include <abut/progress.h>
#include <abut/scene.h>
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

enum class ClashKind : std::uint8_t { hard, touch, contained, duplicate, clearance };
inline constexpr std::array kClashKinds{ClashKind::hard, ClashKind::touch, ClashKind::contained,
                                        ClashKind::duplicate, ClashKind::clearance};
/// "hard", "touch", "contained", "duplicate", "clearance".
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

/// Selects parts by glob patterns (`*`, `?`). A part must match every list that is not empty.
struct PartSelector {
    std::vector<std::string> file, name, type; ///< alternatives: a part matches one of a list
};

/// The pairs of parts that a rule leaves out.
struct IgnoreRule {
    bool same_file = false;
    bool same_type = false;
    std::size_t same_name_prefix = 0; ///< names that agree in this many first characters; 0: none
};

/// A rule selects pairs of parts, one part for each side in either order, and sets their
/// tolerances. The first rule that selects a pair decides about it.
struct ClashRule {
    std::string name;
    PartSelector a, b;
    std::optional<double> clearance, touch_tolerance; ///< metres; default: those of ClashOptions
    IgnoreRule ignore;
};

/// Reads rules from a JSON file; docs/clash.md lists the keys.
///
/// Errors      Error, naming the file: file_not_found, malformed (wrong syntax, an unknown key, or
///             a value of the wrong type or outside its domain).
std::vector<ClashRule> read_rules(const std::string& path);

struct ClashOptions {
    double clearance = 0; ///< metres; reports pairs without contact that are nearer than this
    double touch_tolerance =
        0;             ///< metres; surfaces that meet no deeper than this are of kind `touch`
    bool self = false; ///< with several models: also tests the pairs within each model
    std::vector<ClashRule> rules{}; ///< if empty, all pairs are tested
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
    std::uint64_t triangle_pairs = 0;  ///< number of intersecting triangle pairs
    std::string rule;                  ///< name of the rule that decided; empty if none did
    std::optional<ClashStatus> status; ///< set only for a store; never `resolved`
    std::string note;                  ///< written by the person who reviewed or approved the clash
};

/// A clash as a store lists it. Its parts are described in words, because they may no longer exist.
struct ListedClash {
    std::uint64_t id = 0; ///< as Clash::id
    ClashKind kind = ClashKind::hard;
    ClashStatus status = ClashStatus::fresh;
    std::array<std::string, 2> part, name, type, file; ///< of a and b; `part` is the part's id
    double distance = 0;       ///< metres, as Clash::distance, when the clash was last found
    std::int64_t resolved = 0; ///< when it was found resolved, in seconds since 1970; 0: it exists
    std::string note;
};

/// Returns an id as reports write it: 16 lower-case hexadecimal digits.
std::string clash_id_text(std::uint64_t id);
/// Returns the id, or nothing if the text is not an id.
std::optional<std::uint64_t> parse_clash_id(std::string_view text);

struct ClashReport {
    struct ModelSummary {
        std::string file;
        std::uint64_t parts = 0;
        std::uint64_t triangles = 0; ///< each instance counted
        double unit = 1;             ///< metres per unit of the file
        UpAxis up = UpAxis::y;       ///< up axis of the file
        std::vector<SceneNote> notes{};
    };
    /// The frame of all points and directions: in metres, with the axes of one of the models.
    struct Frame {
        UpAxis up = UpAxis::y;
        std::string of; ///< that model: the first one (in a store, the one imported first)
    };
    struct Seconds {
        double import = 0, build = 0, broad = 0, narrow = 0, total = 0;
    };
    Frame frame;
    std::vector<ModelSummary> models;
    /// Reasons to doubt the result, one line each: for example, models that share no space.
    std::vector<std::string> warnings;
    double clearance = 0, touch_tolerance = 0;
    std::uint64_t candidates = 0; ///< part pairs whose boxes are within the clearance on every axis
    std::array<std::uint64_t, 5> counts{}; ///< by ClashKind
    std::vector<Clash> clashes;            ///< sorted by models, then by part of a, then of b
    /// Set only for a store: the number of clashes of each ClashStatus, and the resolved clashes,
    /// the latest first.
    std::optional<std::array<std::uint64_t, 5>> statuses;
    std::vector<ListedClash> resolved;
    Seconds seconds;
    double peak_rss_mib = 0; ///< MiB; of this process or its largest reader, whichever is larger
};

/// Finds all clashes between parts of different models; for a single model, between its parts.
///
/// In/out      models in metres. A model whose axes differ from the first model's is rotated by
///             quarter turns. `seconds.import` stays 0.
/// Errors      Error{bad_argument} for a negative or NaN tolerance, Error{interrupted}.
/// Cost        the broad phase takes O(n log n + candidates). A hierarchy is built once for each
///             mesh that a candidate needs.
ClashReport find_clashes(const std::vector<Scene>& models, const ClashOptions& options);

/// Report writers. Each is atomic: the file appears complete or not at all.
///
/// Errors      Error{cannot_write}, naming the file.
std::string to_json(const ClashReport& report, const std::vector<Scene>& models);
void write_clash_json(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);
void write_clash_csv(const ClashReport& report, const std::vector<Scene>& models,
                     const std::string& path);
/// Writes one self-contained page with a summary, filters and sorting.
void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);

} // namespace abut
