/// Any text as a condition is refused with a place, or has a canonical text that parses to the same
/// condition. A parsed condition is true or false for every part and clash; `not` turns it around.
/// The first line of the input is the condition, the others are values of the part.
#include <abut/clash.h>
#include <abut/error.h>
#include <abut/part_query.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

void require(bool holds) {
    if (!holds)
        std::abort();
}

/// A scene of two parts. The lines of a text are the values of properties of the first one.
abut::Scene scene_of(std::string_view lines) {
    abut::Scene scene;
    scene.file = "folder/model.ifc";
    scene.parts.resize(2);
    scene.parts[0].id = "0";
    scene.parts[0].name = lines.substr(0, lines.find('\n'));
    scene.parts[0].type = "IfcWall";
    abut::PropertiesBuilder properties;
    for (int i = 0; i < 9 && !lines.empty(); ++i) {
        const std::size_t end = lines.find('\n');
        properties.add(i % 3 == 0 ? "storey" : i % 3 == 1 ? "a" : "Set.X", lines.substr(0, end));
        lines.remove_prefix(end == std::string_view::npos ? lines.size() : end + 1);
    }
    scene.properties = properties.finish(2);
    return scene;
}

template <typename Query, typename Matches>
void check(std::string_view text, const Matches& matches) {
    Query query;
    try {
        query = Query::parse(text);
    } catch (const abut::Error& error) {
        require(error.code() == abut::ErrorCode::bad_argument);
        return;
    }
    const Query again = Query::parse(query.text());
    require(again.text() == query.text() && again.names() == query.names());
    const bool is_true = matches(query);
    require(matches(again) == is_true);
    if (query.text().size() + 6 > abut::kLongestQuery)
        return;
    try {
        require(matches(Query::parse("not (" + query.text() + ")")) != is_true);
    } catch (const abut::Error&) { // nests too deep
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    const std::string_view text = input.substr(0, input.find('\n'));
    const abut::Scene scene =
        scene_of(input.size() > text.size() ? input.substr(text.size() + 1) : std::string_view());
    check<abut::PartQuery>(text, [&](const abut::PartQuery& query) {
        (void)query.matches(scene, 1);
        return query.matches(scene, 0);
    });
    abut::ClashReport report;
    abut::Clash& clash = report.clashes.emplace_back();
    clash.part = {0, 1};
    clash.status = abut::ClashStatus::fresh;
    clash.severity = scene.parts[0].name;
    clash.distance = -0.25;
    abut::ClashGroup& group = report.groups.emplace_back();
    group.name = scene.parts[0].name;
    group.clashes = {0};
    group.counts = {1};
    report.topics.emplace_back().clashes = {clash.id};
    check<abut::ClashQuery>(text, [&](const abut::ClashQuery& query) {
        (void)query.matches(clash, {scene});
        return !query.find(report, {scene}).empty();
    });
    return 0;
}
