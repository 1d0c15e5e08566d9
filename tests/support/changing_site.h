#pragma once

#include <abut/scene.h>
#include <abut/store.h>

#include "tests/support/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/stores.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {

/// Models in a store that change from import to import, and which of their parts have not since some
/// moment, by comparison of the files alone.
class ChangingSite {
public:
    /// A part by its model's number in the order of first import, and its id.
    using PartKey = std::pair<std::size_t, std::string>;

    /// In          parts: of a model, at most.
    ChangingSite(Random& random, int models, int parts) : random_(random), parts_(parts) {
        for (int i = 0; i < models; ++i)
            add_model();
        import();
    }

    [[nodiscard]] std::string store() const { return folder_ / "site.abut"; }
    [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
    [[nodiscard]] bool is_unchanged(std::size_t model, const std::string& part) const {
        return unchanged_.contains({model, part}) && files_then_.at(model) == scenes_[model].file;
    }

    /// From now on: all parts are unchanged.
    void begin() {
        unchanged_.clear();
        files_then_.clear();
        for (std::size_t m = 0; m < scenes_.size(); ++m) {
            files_then_.push_back(scenes_[m].file);
            for (const Part& part : scenes_[m].parts)
                unchanged_.insert({m, part.id});
        }
    }

    /// Changes some of the models, some of their parts, or takes changes back, and imports them;
    /// perhaps none.
    void change() {
        if (drafts_.size() < 3 && random_.chance(0.15))
            add_model();
        const std::vector<Scene> last = drafts_;
        for (std::size_t m = 0; m < drafts_.size(); ++m)
            if (random_.chance(0.35) && m < before_last_.size())
                drafts_[m] = before_last_[m];
            else if (random_.chance(0.7))
                change(drafts_[m]);
        before_last_ = last;
        import();
    }

private:
    void add_model() {
        drafts_.push_back(some_scene(random_, random_.integer(parts_ / 2, parts_), 3));
        // All parts that clash across models must be told apart.
        for (Part& part : drafts_.back().parts)
            part.id = part.id + "-" + std::to_string(random_.integer(0, 3));
    }

    void change(Scene& draft) {
        const double share = random_.chance(0.2) ? 0.5 : 0.04;
        for (Part& part : draft.parts) {
            if (!random_.chance(share))
                continue;
            switch (random_.integer(0, 4)) {
            case 0:
                part.world_from_mesh.m[10] += random_.uniform(-0.5, 0.5);
                break;
            case 1:
                part.mesh = static_cast<std::uint32_t>(draft.meshes.size());
                draft.meshes.push_back(some_body(random_));
                break;
            case 2:
                part.name = "name" + std::to_string(random_.integer(0, 9));
                break;
            case 3:
                part.type = "type" + std::to_string(random_.integer(0, 3));
                break;
            default:
                part.id = "part" + std::to_string(random_.integer(1000, 1'000'000));
            }
        }
        if (random_.chance(0.1)) // shown by several parts, perhaps
            draft.meshes.at(0) = some_body(random_);
        if (random_.chance(0.4))
            draft.parts.erase(draft.parts.begin() +
                              random_.integer(0, static_cast<int>(draft.parts.size()) - 1));
        if (random_.chance(0.4)) {
            Part part = draft.parts.front();
            part.id = "new" + std::to_string(random_.integer(0, 1'000'000));
            part.world_from_mesh.m[9] += 0.3;
            draft.parts.insert(draft.parts.begin() +
                                   random_.integer(0, static_cast<int>(draft.parts.size())),
                               part);
        }
        if (random_.chance(0.15))
            std::reverse(draft.parts.begin(), draft.parts.end());
    }

    void import() {
        std::vector<std::string> files;
        for (std::size_t m = 0; m < drafts_.size(); ++m) {
            const std::string name = "model" + std::to_string(m) + ".glb";
            write_glb(drafts_[m], folder_ / name);
            // The same file by another name is another file to rules.
            files.push_back(folder_ / (random_.chance(0.1) ? "./" + name : name));
        }
        const std::size_t known = scenes_.size();
        if (random_.chance(0.5)) // new models come after those that are there
            std::reverse(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(known));
        (void)import_models(files, store());
        const std::vector<Scene> before = std::exchange(scenes_, {});
        for (const StoreSummary::Model& model : summary(open_store(store())).models)
            scenes_.push_back(read_scene(model.file));
        for (std::size_t m = 0; m < before.size(); ++m)
            compare(m, before[m], scenes_.at(m));
    }

    void compare(std::size_t model, const Scene& before, const Scene& now) {
        std::map<std::string, const Part*> parts;
        for (const Part& part : now.parts)
            parts[part.id] = &part;
        for (const Part& part : before.parts) {
            const auto found = parts.find(part.id);
            if (found == parts.end() || !is_same(part, before, *found->second, now))
                unchanged_.erase({model, part.id});
        }
    }

    static bool is_same(const Part& a, const Scene& in_a, const Part& b, const Scene& in_b) {
        return a.name == b.name && a.type == b.type && a.world_from_mesh == b.world_from_mesh &&
               same_bits(in_a.meshes.at(a.mesh), in_b.meshes.at(b.mesh));
    }

    Random& random_;
    int parts_;
    Folder folder_;
    std::vector<Scene> drafts_, before_last_; ///< as they are to be written, and were
    std::vector<Scene> scenes_;               ///< as they were imported
    std::vector<std::string> files_then_;
    std::set<PartKey> unchanged_;
};

} // namespace abut::test
