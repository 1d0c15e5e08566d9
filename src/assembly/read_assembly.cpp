#include <abut/assembly.h>
#include <abut/error.h>

#include "assembly/kinematics.h"
#include "assembly/motion_table.h"
#include "assembly/part_models.h"
#include "clash/rules/settings_file.h"
#include "clash/rules/settings_reader.h"
#include "io/file/companion_file.h"
#include "io/file/fault.h"
#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace abut {

namespace {

using Json = nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;
/// More parts than this are refused.
constexpr std::size_t kMostParts = 100'000;

class AssemblyReader {
public:
    AssemblyReader(const std::string& path, const ReadOptions& options)
        : path_(path), options_(options), reader_(path), root_(read_settings(path)) {}

    Assembly read() {
        reader_.require_keys(root_, "the file",
                             {"$schema", "unit", "up", "parts", "loops", "ignore", "table"});
        assembly_.file = path_;
        read_frame();
        PartModels models(options_, assembly_.up);
        std::size_t number = 0;
        for (const Json& value : reader_.read_list(root_, "parts", "part"))
            read_part(value, "parts[" + std::to_string(number++) + "]", models);
        for (auto& [part, name, where] : hangs_)
            assembly_.parts[part].on = find(name, where);
        for (auto& [part, name, where] : follows_)
            assembly_.parts[part].joint.follow->part = find(name, where);
        read_loops();
        read_ignored();
        if (root_.contains("table"))
            read_motion_table(table_path(), units_, assembly_);
        try {
            const AssemblyKinematics checked(assembly_);
            if (checked.key_times().size() < 2)
                reader_.fail("the file", "has no joint with two keys, so nothing moves");
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_argument)
                throw;
            throw Error(ErrorCode::malformed, path_, error.what());
        }
        return std::move(assembly_);
    }

private:
    /// A part that names another one.
    struct Reference {
        std::uint32_t part = 0;
        std::string name, where;
    };

    void read_frame() {
        units_.angle = kDegree;
        if (root_.contains("unit")) {
            const std::string unit = reader_.read_text(root_, "unit", "the file");
            const std::unordered_map<std::string, double> known{
                {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
            if (!known.contains(unit))
                reader_.fail("unit", "must be m, cm, mm, in or ft, not \"" + unit + "\"");
            units_.length = known.at(unit);
        }
        if (root_.contains("up")) {
            const std::string up = reader_.read_text(root_, "up", "the file");
            if (up != "x" && up != "y" && up != "z")
                reader_.fail("up", "must be x, y or z, not \"" + up + "\"");
            assembly_.up = up == "x" ? UpAxis::x : up == "y" ? UpAxis::y : UpAxis::z;
        }
    }

    [[nodiscard]] double read_number(const Json& value, const std::string& where) const {
        if (!value.is_number() || !std::isfinite(value.get<double>()))
            reader_.fail(where, "must be a finite number");
        return value.get<double>();
    }

    [[nodiscard]] std::vector<double> read_numbers(const Json& object, const char* key,
                                                   const std::string& where,
                                                   std::size_t count = 0) const {
        const std::string here = where + "." + key;
        if (!object.contains(key) || !object[key].is_array() ||
            (count > 0 && object[key].size() != count))
            reader_.fail(here, count > 0 ? "must be a list of " + std::to_string(count) + " numbers"
                                         : "must be a list of numbers");
        std::vector<double> numbers;
        for (const Json& value : object[key])
            numbers.push_back(
                read_number(value, here + "[" + std::to_string(numbers.size()) + "]"));
        return numbers;
    }

    [[nodiscard]] Vec3 read_vector(const Json& object, const char* key, const std::string& where,
                                   double unit) const {
        const std::vector<double> v = read_numbers(object, key, where, 3);
        return {v[0] * unit, v[1] * unit, v[2] * unit};
    }

    /// Reads {move = [x, y, z], turn = [axis x, y, z, angle]}, both optional.
    [[nodiscard]] Pose read_pose(const Json& object, const std::string& where) const {
        Pose pose;
        if (object.contains("move"))
            pose.translation = read_vector(object, "move", where, units_.length);
        if (object.contains("turn")) {
            const std::vector<double> turn = read_numbers(object, "turn", where, 4);
            const Vec3 axis = normalized_or_zero({turn[0], turn[1], turn[2]});
            if (length_sq(axis) == 0)
                reader_.fail(where + ".turn", "has an axis of length 0");
            const double half = 0.5 * turn[3] * units_.angle;
            const Vec3 v = std::sin(half) * axis;
            pose.rotation = {std::cos(half), v.x, v.y, v.z};
        }
        return pose;
    }

    void read_part(const Json& value, std::string where, PartModels& models) {
        reader_.require_keys(value, where,
                             {"name", "model", "select", "each", "move", "turn", "on", "joint",
                              "times", "values", "poses"});
        const std::string name = reader_.read_text(value, "name", where);
        where += " (\"" + name + "\")";
        if (name.empty())
            reader_.fail(where, "has no name");
        AssemblyJoint joint = read_joint(value, where);
        read_keys(value, joint, where);
        const Pose place = read_pose(value, where);
        const bool each = reader_.read_flag(value, "each", false, where);
        for (PartModels::Selected& selected : read_models(value, each, where, models)) {
            const std::string full = each ? name + "/" + selected.id : name;
            const auto part = static_cast<std::uint32_t>(assembly_.parts.size());
            if (!numbers_.emplace(full, part).second)
                reader_.fail(where, "has the name of another part");
            if (part == kMostParts)
                reader_.fail("the file", "has more than 100,000 parts");
            if (value.contains("on"))
                hangs_.push_back({part, reader_.read_text(value, "on", where), where + ".on"});
            if (joint.follow)
                follows_.push_back({part, reader_.read_text(value["joint"], "follow", where),
                                    where + ".joint.follow"});
            assembly_.parts.push_back({full, file_, Model(std::move(selected.mesh)),
                                       Transform(place), std::nullopt, joint});
        }
    }

    std::vector<PartModels::Selected> read_models(const Json& value, bool each,
                                                  const std::string& where, PartModels& models) {
        const std::string text = reader_.read_text(value, "model", where);
        PartQuery query;
        if (value.contains("select")) {
            (void)reader_.read_text(value, "select", where);
            query = reader_.read_query(value["select"], where + ".select");
        }
        try {
            const ModelPath model = model_beside(text, path_, options_.allow_outside_files);
            file_ = model.path;
            std::vector<PartModels::Selected> found = models.select(model, query, each);
            if (found.empty())
                reader_.fail(where, "selects no part of '" + text + "'");
            return found;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::interrupted || error.file() == path_)
                throw;
            throw Error(error.code(), path_, where + ".model: " + error.what());
        }
    }

    [[nodiscard]] AssemblyJoint read_joint(const Json& part, const std::string& of_part) const {
        AssemblyJoint joint;
        if (!part.contains("joint"))
            return joint;
        const Json& value = part["joint"];
        const std::string where = of_part + ".joint";
        reader_.require_keys(value, where,
                             {"type", "origin", "axis", "limits", "follow", "ratio", "offset"});
        const std::string type = reader_.read_text(value, "type", where);
        const auto known = std::ranges::find_if(
            kAssemblyJointTypes, [&](AssemblyJointType each) { return type == to_string(each); });
        if (known == kAssemblyJointTypes.end())
            reader_.fail(where + ".type",
                         "must be fixed, revolute, prismatic or free, not \"" + type + "\"");
        joint.type = *known;
        const bool turns = joint.type == AssemblyJointType::revolute;
        const double unit = turns ? units_.angle : units_.length;
        if (value.contains("origin"))
            joint.origin = read_vector(value, "origin", where, units_.length);
        if (value.contains("axis"))
            joint.axis = read_vector(value, "axis", where, 1);
        if (length_sq(joint.axis) == 0)
            reader_.fail(where + ".axis", "has length 0");
        if (value.contains("limits")) {
            const std::vector<double> limits = read_numbers(value, "limits", where, 2);
            joint.limits = {limits[0] * unit, limits[1] * unit};
        }
        if (value.contains("follow"))
            joint.follow = JointFollow{
                0, value.contains("ratio") ? read_number(value["ratio"], where + ".ratio") : 1,
                value.contains("offset") ? read_number(value["offset"], where + ".offset") * unit
                                         : 0};
        else if (value.contains("ratio") || value.contains("offset"))
            reader_.fail(where, "has a ratio or an offset, but follows no joint");
        return joint;
    }

    void read_keys(const Json& part, AssemblyJoint& joint, const std::string& where) const {
        const bool is_free = joint.type == AssemblyJointType::free;
        if (!part.contains("times")) {
            if (part.contains("values") || part.contains("poses"))
                reader_.fail(where, "has values or poses, but no times");
            return;
        }
        joint.keys.times = read_numbers(part, "times", where);
        if (part.contains(is_free ? "values" : "poses"))
            reader_.fail(where, is_free ? "is free, so it needs poses, not values"
                                        : "needs values, not poses: its joint is not free");
        if (!is_free) {
            const double unit =
                joint.type == AssemblyJointType::revolute ? units_.angle : units_.length;
            for (const double value : read_numbers(part, "values", where))
                joint.keys.values.push_back(value * unit);
            return;
        }
        if (!part.contains("poses") || !part["poses"].is_array())
            reader_.fail(where + ".poses", "must be a list of poses");
        for (const Json& pose : part["poses"]) {
            const std::string here =
                where + ".poses[" + std::to_string(joint.keys.poses.size()) + "]";
            reader_.require_keys(pose, here, {"move", "turn"});
            joint.keys.poses.push_back(read_pose(pose, here));
        }
    }

    [[nodiscard]] std::uint32_t find(const std::string& name, const std::string& where) const {
        const auto found = numbers_.find(name);
        if (found == numbers_.end())
            reader_.fail(where, "names no part: \"" + name + "\"");
        return found->second;
    }

    void read_loops() {
        if (!root_.contains("loops"))
            return;
        for (const Json& value : reader_.read_list(root_, "loops", "loop")) {
            const std::string where = "loops[" + std::to_string(assembly_.loops.size()) + "]";
            reader_.require_keys(value, where, {"coupler", "closer", "pin"});
            assembly_.loops.push_back(
                {find(reader_.read_text(value, "coupler", where), where + ".coupler"),
                 find(reader_.read_text(value, "closer", where), where + ".closer"),
                 read_vector(value, "pin", where, units_.length)});
        }
    }

    void read_ignored() {
        if (!root_.contains("ignore"))
            return;
        std::size_t number = 0;
        for (const Json& value : reader_.read_list(root_, "ignore", "pair of parts")) {
            const std::string where = "ignore[" + std::to_string(number++) + "]";
            const auto names = reader_.read_texts(value, where, "name of a part");
            if (names.size() != 2)
                reader_.fail(where, "must be a list of two names of parts");
            assembly_.ignored.emplace_back(find(names[0], where), find(names[1], where));
        }
    }

    [[nodiscard]] std::string table_path() const {
        const std::string text = reader_.read_text(root_, "table", "the file");
        try {
            return companion_path(path_, text, options_.allow_outside_files);
        } catch (const Fault& fault) {
            throw Error(fault.code(), path_, std::string("table: it ") + fault.what());
        }
    }

    const std::string& path_;
    const ReadOptions& options_;
    SettingsReader reader_;
    Json root_;
    AssemblyUnits units_;
    Assembly assembly_;
    std::string file_;                                       ///< of the model that was read last
    std::unordered_map<std::string, std::uint32_t> numbers_; ///< of the parts, by name
    std::vector<Reference> hangs_, follows_;
};

} // namespace

Assembly read_assembly(const std::string& path, const ReadOptions& options) {
    return AssemblyReader(path, options).read();
}

} // namespace abut
