#pragma once

#include <abut/properties.h>
#include <abut/scene.h>

#include "clash/query/condition.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace abut {

/// The facts about a part that conditions and rules can refer to. All texts must outlive it.
struct PartFacts {
    std::uint32_t model = 0; ///< equal for parts of one model file
    std::string_view file;   ///< of the model
    std::string_view id, name, type;
    const Properties* properties = nullptr; ///< null if there are none
    std::uint32_t part = 0;                 ///< index of the part in `properties`
};

inline PartFacts facts_of(const Scene& scene, std::uint32_t part) {
    const Part& p = scene.parts[part];
    return {0, scene.file, p.id, p.name, p.type, &scene.properties, part};
}

/// The names that every part has a value of.
inline constexpr std::array<std::string_view, 4> kFixedNames{"type", "name", "id", "file"};

/// Returns the name of a file without its folders.
inline std::string_view name_of_file(std::string_view path) {
    return path.substr(path.find_last_of('/') + 1);
}

/// A part as the subject of a condition.
class PartSubject final : public ConditionSubject {
public:
    explicit PartSubject(const PartFacts& facts) : facts_(facts) {}

    [[nodiscard]] bool any_value(std::string_view name,
                                 const std::function<bool(std::string_view)>& take) const override;

private:
    const PartFacts& facts_;
};

} // namespace abut
