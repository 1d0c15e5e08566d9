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

/// Every clash and clearance between the parts of some models. docs/clash.md defines each kind.
namespace abut {

enum class ClashKind : std::uint8_t { hard, touch, contained, duplicate, clearance };
inline constexpr std::array kClashKinds{ClashKind::hard, ClashKind::touch, ClashKind::contained,
                                        ClashKind::duplicate, ClashKind::clearance};
/// "hard", "touch", "contained", "duplicate", "clearance".
const char* to_string(ClashKind kind);

/// What has become of a clash between the jobs of a store; docs/clash-status.md tells more.
enum class ClashStatus : std::uint8_t {
    fresh,    ///< "new": it was not there in the previous job of the same question
    active,   ///< it was
    reviewed, ///< someone has looked at it
    approved, ///< someone has said that it may stay
    resolved, ///< it was there in an earlier job, and is not any more
};
inline constexpr std::array kClashStatuses{ClashStatus::fresh, ClashStatus::active,
                                           ClashStatus::reviewed, ClashStatus::approved,
                                           ClashStatus::resolved};
/// "new", "active", "reviewed", "approved", "resolved".
const char* to_string(ClashStatus status);

/// Which parts a rule means: all globs that are given must match (`*`, `?`; an empty list matches
/// all).
struct PartSelector {
    std::vector<std::string> file, name, type; ///< alternatives: one of a list is enough
};

/// Pairs of parts that a rule leaves out.
struct IgnoreRule {
    bool same_file = false;
    bool same_type = false;
    std::size_t same_name_prefix = 0; ///< names that agree in this many first characters; 0: off
};

/// A rule selects pairs (one side each, in either order) and gives them its tolerances. The first
/// rule that selects a pair decides.
struct ClashRule {
    std::string name;
    PartSelector a, b;
    std::optional<double> clearance, touch_tolerance; ///< metres; else those of ClashOptions
    IgnoreRule ignore;
};

/// Reads rules from JSON; docs/clash.md gives the keys.
/// Errors      Error, naming the file: file_not_found, malformed (syntax, an unknown key, a value
///             of the wrong type or out of its domain).
std::vector<ClashRule> read_rules(const std::string& path);

struct ClashOptions {
    double clearance = 0; ///< metres; pairs without contact that are nearer are reported
    double touch_tolerance =
        0;             ///< metres; surfaces that meet no deeper than this are of kind `touch`
    bool self = false; ///< with several models: also the pairs within each
    std::vector<ClashRule> rules{}; ///< none: all pairs
    Progress progress{};
};

struct Clash {
    std::uint64_t id = 0; ///< hash of both parts' files and ids and the kind: the same in every run
    ClashKind kind = ClashKind::hard;
    std::array<std::uint32_t, 2> model{}; ///< index in the models given
    std::array<std::uint32_t, 2> part{};  ///< index in that model's parts
    double distance =
        0; ///< metres; negative: penetration (contained: minus the gap to the enclosing surface)
    Vec3 point_a, point_b; ///< witness on each surface, world frame
    Vec3 direction; ///< unit vector in which b moves to get away from a; zero if there is none
    std::uint64_t triangle_pairs = 0;  ///< intersecting triangle pairs
    std::string rule;                  ///< name of the rule that decided; empty if none
    std::optional<ClashStatus> status; ///< of a store alone; never `resolved`
    std::string note;                  ///< of whoever reviewed or approved it
};

/// A clash as a store lists it: in words, since its parts may be gone.
struct ListedClash {
    std::uint64_t id = 0; ///< as Clash::id
    ClashKind kind = ClashKind::hard;
    ClashStatus status = ClashStatus::fresh;
    std::array<std::string, 2> part, name, type, file; ///< of a and b: part is the id
    double distance = 0;       ///< metres, as Clash::distance, when last seen
    std::int64_t resolved = 0; ///< when it was found gone, in seconds since 1970; 0: it is there
    std::string note;
};

/// An id as reports have it: 16 lower-case hexadecimal digits.
std::string clash_id_text(std::uint64_t id);
/// None if the text is no id.
std::optional<std::uint64_t> parse_clash_id(std::string_view text);

struct ClashReport {
    struct ModelSummary {
        std::string file;
        std::uint64_t parts = 0;
        std::uint64_t triangles = 0; ///< each instance counted
        double unit = 1;             ///< metres per unit of the file
        UpAxis up = UpAxis::y;       ///< of the file
        std::vector<SceneNote> notes{};
    };
    /// The frame of all points and directions: metres, and the axes of a file.
    struct Frame {
        UpAxis up = UpAxis::y;
        std::string of; ///< the first model (of a store, the one that was imported first)
    };
    struct Seconds {
        double import = 0, build = 0, broad = 0, narrow = 0, total = 0;
    };
    Frame frame;
    std::vector<ModelSummary> models;
    /// What makes the result doubtful, a line each: models that share no space.
    std::vector<std::string> warnings;
    double clearance = 0, touch_tolerance = 0;
    std::uint64_t candidates = 0; ///< part pairs whose boxes are within the clearance on every axis
    std::array<std::uint64_t, 5> counts{}; ///< by ClashKind
    std::vector<Clash> clashes;            ///< sorted by model, part of a, then of b
    /// Of a store alone: how many of each status, by ClashStatus, and those that are resolved, the last
    /// ones first.
    std::optional<std::array<std::uint64_t, 5>> statuses;
    std::vector<ListedClash> resolved;
    Seconds seconds;
    double peak_rss_mib = 0; ///< of this process or its largest reader, whichever is larger; MiB
};

/// Finds all clashes between the parts of different models (of one model: between its parts).
///
/// In/out      models in metres; those whose axes are not those of the first are turned to them, by
///             quarter turns. `seconds.import` is left 0.
/// Errors      Error{bad_argument} for a negative or NaN tolerance, Error{interrupted}.
/// Cost        the broad phase O(n log n + candidates); hierarchies are built once a mesh, and only
///             for meshes that a candidate needs.
ClashReport find_clashes(const std::vector<Scene>& models, const ClashOptions& options);

/// Writers, each atomic: the file appears whole or not at all. Errors: Error{cannot_write}, naming
/// the file.
std::string to_json(const ClashReport& report, const std::vector<Scene>& models);
void write_clash_json(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);
void write_clash_csv(const ClashReport& report, const std::vector<Scene>& models,
                     const std::string& path);
/// One self-contained page: summary, filters, sorting.
void write_clash_html(const ClashReport& report, const std::vector<Scene>& models,
                      const std::string& path);

} // namespace abut
