#include "clash/clash_identity.h"

#include <abut/error.h>

#include <algorithm>
#include <limits>
#include <string>

namespace abut {

namespace {

class StableHash {
public:
    void add(std::string_view text) {
        for (const char c : text)
            step(static_cast<unsigned char>(c));
        step(0xff); // occurs in no UTF-8 text, so that "ab", "c" differs from "a", "bc"
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    void step(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::string_view file_name(std::string_view path) {
    return path.substr(path.find_last_of('/') + 1);
}

void require_length(double value, const char* what) {
    if (!(value >= 0) || value == std::numeric_limits<double>::infinity())
        throw Error(ErrorCode::bad_argument, std::string(what) + " must be a length, not negative");
}

} // namespace

std::uint64_t clash_identity(std::string_view file_a, std::string_view part_a,
                             std::string_view file_b, std::string_view part_b, ClashKind kind) {
    const std::string_view name_a = file_name(file_a), name_b = file_name(file_b);
    if (name_a != name_b ? name_b < name_a : file_a == file_b && part_b < part_a)
        return clash_identity(file_b, part_b, file_a, part_a, kind);
    StableHash hash;
    hash.add(name_a);
    hash.add(part_a);
    hash.add(name_b);
    hash.add(part_b);
    hash.add(to_string(kind));
    return hash.value();
}

void require_tolerances(const ClashOptions& options) {
    require_length(options.clearance, "clearance");
    require_length(options.touch_tolerance.value_or(0), "touch tolerance");
    const auto require_rule = [](const ClashRule& rule) {
        require_length(rule.clearance.value_or(0), "a rule's clearance");
        require_length(rule.touch_tolerance.value_or(0), "a rule's touch tolerance");
        require_length(rule.tolerated_depth.value_or(0), "a rule's tolerated depth");
    };
    std::ranges::for_each(options.rules, require_rule);
    for (const ClashMatrix::Cell& cell : options.matrix.cells) {
        require_rule(cell.terms);
        if (std::max(cell.a, cell.b) >= options.matrix.groups.size())
            throw Error(ErrorCode::bad_argument,
                        "a cell of the matrix has a group that is not there");
    }
}

double largest_clearance(const ClashOptions& options) {
    double largest = options.clearance;
    for (const ClashRule& rule : options.rules)
        largest = std::max(largest, rule.clearance.value_or(0));
    for (const ClashMatrix::Cell& cell : options.matrix.cells)
        if (cell.examined)
            largest = std::max(largest, cell.terms.clearance.value_or(0));
    return largest;
}

} // namespace abut
