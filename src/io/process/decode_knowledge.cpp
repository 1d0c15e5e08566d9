#include "io/process/decode_knowledge.h"

#include "io/process/scene_stream.h"
#include "io/scene/part_checks.h"
#include "io/scene/property_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

constexpr std::uint64_t kRelationBytes = 12;
static_assert(sizeof(Properties::Entry) == 8);

std::vector<std::string> decode_texts(StreamCursor& cursor, std::uint32_t count) {
    if (count > cursor.left() / sizeof count)
        cursor.fail();
    std::vector<std::string> texts;
    texts.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto size = cursor.value<std::uint32_t>();
        texts.push_back(cursor.text(size));
    }
    return texts;
}

Properties decode_properties(StreamCursor& cursor, const scene_stream::Known& known,
                             std::size_t parts) {
    Properties properties;
    properties.names = decode_texts(cursor, known.names);
    properties.values = decode_texts(cursor, known.values);
    if (known.entries == 0)
        return {};
    if (known.entries > cursor.left() / sizeof(Properties::Entry) ||
        parts > cursor.left() / sizeof(std::uint32_t))
        cursor.fail();
    properties.first.reserve(parts + 1);
    properties.first.push_back(0);
    for (std::size_t i = 0; i < parts; ++i)
        properties.first.push_back(properties.first.back() + cursor.value<std::uint32_t>());
    properties.entries.resize(known.entries);
    const auto bytes = cursor.take(known.entries * sizeof(Properties::Entry));
    std::memcpy(properties.entries.data(), bytes.data(), bytes.size());
    if (!is_consistent(properties, parts))
        cursor.fail();
    sort_properties(properties);
    return properties;
}

std::vector<PartRelation> decode_relations(StreamCursor& cursor, std::uint32_t count,
                                           std::size_t parts) {
    if (count > cursor.left() / kRelationBytes)
        cursor.fail();
    std::vector<PartRelation> relations;
    relations.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto [a, b, kind] = cursor.value<std::array<std::uint32_t, 3>>();
        if (a >= parts || b >= parts || kind > static_cast<std::uint32_t>(RelationKind::part_of))
            cursor.fail();
        relations.push_back({a, b, static_cast<RelationKind>(kind)});
    }
    sort_relations(relations);
    return relations;
}

} // namespace

void decode_knowledge(StreamCursor& cursor, Scene& scene) {
    const auto known = cursor.value<scene_stream::Known>();
    std::copy_n(known.map_from_project, scene.map_from_project.m.size(),
                scene.map_from_project.m.begin());
    if (!stays_finite(scene.map_from_project))
        cursor.fail();
    if (!(known.precision >= 0) || !std::isfinite(known.precision) ||
        (known.rounded & ~scene_stream::kRoundedAll) != 0)
        cursor.fail();
    scene.precision = {known.precision, (known.rounded & scene_stream::kRoundedPositions) != 0,
                       known.rounded == scene_stream::kRoundedAll};
    scene.project = cursor.text(known.project_size);
    scene.properties = decode_properties(cursor, known, scene.parts.size());
    scene.relations = decode_relations(cursor, known.relations, scene.parts.size());
}

} // namespace abut
