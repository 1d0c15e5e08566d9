#include <abut/error.h>
#include <abut/tour.h>

#include "core/atomic_file.h"
#include "io/file/text_stream.h"
#include "view/camera/camera_frame.h"
#include "view/camera/tour_point.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace abut {

namespace {

using TourJson = nlohmann::json;

constexpr int kTourVersion = 1;
constexpr const char* kTourKey = "abut_tour";

std::string point_name(std::size_t index) {
    return "points[" + std::to_string(index) + "]";
}

/// Returns what is wrong with a point; empty if nothing is.
std::string fault_of(const Tour& tour, std::size_t index) {
    const TourPoint& point = tour.points[index];
    if (!std::isfinite(point.seconds))
        return "its time is not finite";
    if (index > 0 && point.seconds < tour.points[index - 1].seconds)
        return "its time is before that of the point before it";
    try {
        const CameraFrame checks(camera_of(point, {}));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

class TourReader {
public:
    explicit TourReader(const std::string& path) : path_(path) {}

    Tour read() {
        const TourJson root = parse();
        if (!root.is_object() || !root.contains(kTourKey))
            throw Error(ErrorCode::malformed, path_, "is not a tour");
        if (root[kTourKey] != kTourVersion)
            throw Error(ErrorCode::unsupported, path_, "is a tour of another version");
        if (!root.contains("points") || !root["points"].is_array())
            throw Error(ErrorCode::malformed, path_, "points must be a list");
        Tour tour;
        for (const TourJson& value : root["points"]) {
            const std::size_t index = tour.points.size();
            tour.points.push_back(read_point(value, point_name(index)));
            if (const std::string fault = fault_of(tour, index); !fault.empty())
                fail(point_name(index), fault);
        }
        return tour;
    }

private:
    [[noreturn]] void fail(const std::string& where, const std::string& fault) const {
        throw Error(ErrorCode::malformed, path_, where + ": " + fault);
    }

    [[nodiscard]] TourJson parse() const {
        std::ifstream in = open_text(path_);
        std::ostringstream text;
        text << in.rdbuf();
        if (in.bad())
            throw Error(ErrorCode::unreadable, path_, "cannot be read");
        try {
            return TourJson::parse(text.str());
        } catch (const TourJson::parse_error& error) {
            throw Error(ErrorCode::malformed, path_,
                        "is not JSON (near byte " + std::to_string(error.byte) + ")");
        } catch (const TourJson::out_of_range&) {
            throw Error(ErrorCode::malformed, path_, "has a number that no double holds");
        }
    }

    [[nodiscard]] TourPoint read_point(const TourJson& value, const std::string& where) const {
        if (!value.is_object())
            fail(where, "must be an object");
        TourPoint point;
        if (!value.contains("seconds") || !value["seconds"].is_number())
            fail(where, "seconds must be a number");
        point.seconds = value["seconds"].get<double>();
        point.eye = read_vector(value, "eye", where);
        point.forward = read_vector(value, "forward", where);
        point.up = read_vector(value, "up", where);
        if (value.contains("name") && !value["name"].is_string())
            fail(where, "name must be a text");
        point.name = value.value("name", "");
        return point;
    }

    [[nodiscard]] Vec3 read_vector(const TourJson& point, const char* key,
                                   const std::string& where) const {
        std::array<double, 3> values{};
        const bool is_list = point.contains(key) && point[key].is_array() && point[key].size() == 3;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!is_list || !point[key][i].is_number())
                fail(where, std::string(key) + " must be a list of three numbers");
            values.at(i) = point[key][i].get<double>();
        }
        return {values[0], values[1], values[2]};
    }

    const std::string& path_;
};

TourJson list_of(const Vec3& v) {
    return TourJson::array({v.x, v.y, v.z});
}

} // namespace

Tour read_tour(const std::string& path) {
    return TourReader(path).read();
}

void write_tour(const Tour& tour, const std::string& path) {
    TourJson points = TourJson::array();
    for (std::size_t i = 0; i < tour.points.size(); ++i) {
        if (const std::string fault = fault_of(tour, i); !fault.empty())
            throw Error(ErrorCode::bad_argument, path, point_name(i) + ": " + fault);
        const TourPoint& point = tour.points[i];
        points.push_back({{"seconds", point.seconds},
                          {"eye", list_of(point.eye)},
                          {"forward", list_of(point.forward)},
                          {"up", list_of(point.up)}});
        if (!point.name.empty())
            points.back()["name"] = point.name;
    }
    std::string text;
    try {
        text = TourJson{{kTourKey, kTourVersion}, {"points", std::move(points)}}.dump(1);
    } catch (const TourJson::type_error&) {
        throw Error(ErrorCode::bad_argument, path, "the name of a point is not UTF-8");
    }
    write_file_atomically(path, text + "\n");
}

} // namespace abut
