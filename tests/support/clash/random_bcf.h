#pragma once

#include <abut/bcf.h>

#include "core/uuid.h"
#include "tests/support/random.h"

#include <string>
#include <vector>

/// Random BCF files with hostile text.
namespace abut::test {

class RandomBcf {
public:
    explicit RandomBcf(Random& random) : random_(random) {}

    BcfFile file(int topics) {
        BcfFile file;
        file.project_name = text();
        file.project_id = "project " + std::to_string(random_.integer(0, 9));
        file.extensions.types = words();
        file.extensions.users = words();
        for (int i = 0; i < topics; ++i)
            file.topics.push_back(topic());
        return file;
    }

    /// Not blank, since XML Schema refuses blanks in 3.0.
    std::string text() {
        static const std::vector<std::string> kPieces{"wall",
                                                      " ",
                                                      "\n",
                                                      "\t",
                                                      "\r\n",
                                                      "<script>alert(1)</script>",
                                                      "&amp;",
                                                      "]]>",
                                                      "\"",
                                                      "'",
                                                      "=cmd|'/c calc'!A1",
                                                      "../../etc/passwd",
                                                      "\xC3\xA9",
                                                      "\xF0\x9F\x8F\x97",
                                                      "%s%n",
                                                      "&#0;",
                                                      "<!DOCTYPE a>",
                                                      "\xE2\x80\xAE",
                                                      "{{7*7}}",
                                                      "<!--",
                                                      "-->",
                                                      "<![CDATA["};
        std::string text = "t";
        for (int i = random_.integer(0, 6); i > 0; --i)
            text += kPieces.at(
                static_cast<std::size_t>(random_.integer(0, static_cast<int>(kPieces.size()) - 1)));
        return text + "x";
    }

private:
    std::string maybe(const std::string& text) { return random_.chance(0.5) ? text : ""; }
    std::vector<std::string> words() {
        std::vector<std::string> list;
        for (int i = random_.integer(0, 3); i > 0; --i)
            list.push_back(text());
        return list;
    }
    std::string guid() {
        return uuid_of_name("6ba7b810-9dad-11d1-80b4-00c04fd430c8", std::to_string(random_.bits()));
    }
    std::string date() {
        return "20" + std::to_string(random_.integer(10, 40)) + "-0" +
               std::to_string(random_.integer(1, 9)) + "-11T08:30:00Z";
    }
    std::string ifc_guid() {
        std::string guid;
        for (int i = 0; i < 22; ++i)
            guid += "0123456789ABCXYZabcxyz_$"[random_.integer(0, 23)];
        return guid;
    }
    std::vector<BcfComponent> components(int least) {
        std::vector<BcfComponent> list;
        for (int i = random_.integer(least, 4); i > 0; --i)
            list.push_back({ifc_guid(), maybe(text()), maybe(text())});
        return list;
    }
    BcfCamera camera() {
        return {random_.in_cube(1e6),
                random_.direction(),
                random_.direction(),
                random_.uniform(45, 60),
                {}};
    }

    BcfViewpoint viewpoint(int number) {
        BcfViewpoint view;
        view.guid = view.content_guid = guid();
        view.file = "viewpoint" + std::to_string(number) + ".bcfv";
        if (random_.chance(0.5)) {
            view.snapshot_file = "snapshot" + std::to_string(number) + ".png";
            view.snapshot = text();
        }
        if (random_.chance(0.5))
            view.index = number;
        view.has_components = true;
        view.selection = components(0);
        view.exceptions = components(0);
        view.default_visibility = random_.chance(0.5);
        if (random_.chance(0.5))
            view.spaces_visible = view.space_boundaries_visible = view.openings_visible = true;
        for (int i = random_.integer(0, 2); i > 0; --i)
            view.colouring.push_back({random_.chance(0.5) ? "DE3E30" : "FF346ED6", components(1)});
        (random_.chance(0.7) ? view.perspective : view.orthogonal) = camera();
        for (int i = random_.integer(0, 2); i > 0; --i)
            view.lines.push_back({random_.in_cube(), random_.in_cube()});
        for (int i = random_.integer(0, 6); i > 0; --i)
            view.clipping_planes.push_back({random_.in_cube(), random_.direction()});
        for (int i = random_.integer(0, 1); i > 0; --i)
            view.bitmaps.push_back({"png", "bitmap.png", random_.in_cube(), random_.direction(),
                                    random_.direction(), random_.uniform(0.1, 9)});
        return view;
    }

    BcfTopic topic() {
        BcfTopic topic;
        topic.guid = topic.folder = guid();
        topic.type = text(), topic.status = text(), topic.title = text();
        for (int i = random_.integer(0, 2); i > 0; --i)
            topic.files.push_back({maybe(ifc_guid()),
                                   maybe(ifc_guid()),
                                   random_.chance(0.5),
                                   text(),
                                   maybe(date()),
                                   maybe(text()),
                                   {}});
        topic.reference_links = words(), topic.labels = words();
        topic.priority = maybe(text());
        if (random_.chance(0.5))
            topic.index = random_.integer(-5, 5);
        topic.creation_date = date(), topic.creation_author = text();
        topic.modified_date = maybe(date()), topic.modified_author = maybe(text());
        topic.due_date = maybe(date()), topic.assigned_to = maybe(text());
        topic.stage = maybe(text()), topic.description = maybe(text());
        if (random_.chance(0.3))
            topic.snippet = BcfSnippet{text(), random_.chance(0.5), text(), text()};
        for (int i = random_.integer(0, 2); i > 0; --i)
            topic.documents.push_back({guid(), true, "https://" + text(), maybe(text())});
        for (int i = random_.integer(0, 2); i > 0; --i)
            topic.related_topics.push_back(guid());
        for (int i = random_.integer(0, 2); i > 0; --i)
            topic.viewpoints.push_back(viewpoint(i));
        for (int i = random_.integer(0, 3); i > 0; --i)
            topic.comments.push_back({guid(),
                                      date(),
                                      text(),
                                      text(),
                                      topic.viewpoints.empty() ? "" : topic.viewpoints.front().guid,
                                      maybe(date()),
                                      maybe(text()),
                                      {}});
        return topic;
    }

    Random& random_;
};

} // namespace abut::test
