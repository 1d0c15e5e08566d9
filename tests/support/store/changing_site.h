#pragma once

#include <abut/properties.h>
#include <abut/scene.h>
#include <abut/store.h>

#include "tests/support/clash/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/store/stores.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace abut::test {

/// A store whose model files change from import to import. It knows from the files alone which of
/// their parts have not changed since a certain moment.
class ChangingSite {
public:
    /// In          parts: maximum number of parts in a model file.
    ChangingSite(Random& random, int models, int parts) : random_(random), parts_(parts) {
        for (int i = 0; i < models; ++i)
            add_model();
        import();
    }

    [[nodiscard]] std::string store() const { return folder_ / "site.abut"; }
    /// In the order in which the store has them.
    [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
    [[nodiscard]] bool is_unchanged(std::size_t model, const std::string& part) const {
        return models_.at(model).unchanged.contains(part) &&
               models_.at(model).file_then == scenes_.at(model).file;
    }

    /// Marks all parts as unchanged from now on.
    void begin() {
        for (std::size_t m = 0; m < models_.size(); ++m) {
            models_[m].file_then = scenes_[m].file;
            models_[m].unchanged.clear();
            for (const Part& part : scenes_[m].parts)
                models_[m].unchanged.insert(part.id);
        }
    }

    /// Changes some model files and some of their parts, or reverts changes, and imports them. It
    /// may change nothing.
    void change() {
        if (models_.size() > 1 && random_.chance(0.15))
            remove_model();
        if (models_.size() < 3 && random_.chance(0.2))
            add_model();
        for (Model& model : models_) {
            const Scene last = model.draft;
            if (random_.chance(0.35) && !model.before.parts.empty())
                model.draft = model.before;
            else if (random_.chance(0.7))
                change(model.draft);
            model.before = last;
        }
        import();
    }

private:
    struct Model {
        int serial = 0;
        Scene draft, before; ///< the scene to be written, and the previous one
        std::string file_then;
        std::set<std::string> unchanged; ///< ids of unchanged parts
    };

    void add_model() {
        Model model;
        model.serial = serial_++;
        model.draft = some_scene(random_, random_.integer(parts_ / 2, parts_), 3);
        for (Part& part : model.draft.parts)
            part.id = part.id + "-" + std::to_string(random_.integer(0, 3));
        set_levels(model.draft);
        models_.push_back(model);
    }

    /// Gives every part the property that rules ask for. It follows from the id, so that it stays with
    /// the part when others come and go; now and then it changes.
    void set_levels(Scene& draft) {
        PropertiesBuilder properties;
        for (const Part& part : draft.parts) {
            std::size_t level = random_.chance(0.02) ? 1 : 0;
            for (const char c : part.id)
                level += static_cast<unsigned char>(c);
            properties.add("extras.level", std::to_string(level % 4));
            properties.next_part();
        }
        draft.properties = properties.finish(draft.parts.size());
    }

    void remove_model() {
        const int gone = random_.integer(0, static_cast<int>(models_.size()) - 1);
        const RemovalReport report =
            remove_models({scenes_[static_cast<std::size_t>(gone)].file}, store());
        ASSERT_EQ(report.models.at(0).parts, scenes_[static_cast<std::size_t>(gone)].parts.size());
        models_.erase(models_.begin() + gone);
        scenes_.erase(scenes_.begin() + gone);
    }

    void change(Scene& draft) {
        const double share = random_.chance(0.2) ? 0.5 : 0.04;
        for (Part& part : draft.parts) {
            if (!random_.chance(share))
                continue;
            switch (random_.integer(0, 5)) {
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
            case 4:
                part.colour = Colour{static_cast<std::uint8_t>(random_.integer(0, 3)), 0, 9};
                break;
            default:
                part.id = "part" + std::to_string(random_.integer(1000, 1'000'000));
            }
        }
        if (random_.chance(0.1)) // this mesh may belong to several parts
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
        set_levels(draft);
    }

    void import() {
        std::vector<std::string> files;
        for (const Model& model : models_) {
            const std::string name = "model" + std::to_string(model.serial) + ".glb";
            write_glb(model.draft, folder_ / name);
            // Rules treat the same file under another name as another file.
            files.push_back(folder_ / (random_.chance(0.1) ? "./" + name : name));
        }
        const std::size_t known = scenes_.size();
        if (random_.chance(0.5)) // new model files come after the existing ones
            std::reverse(files.begin(), files.begin() + static_cast<std::ptrdiff_t>(known));
        (void)import_models(files, store());
        const std::vector<Scene> before = std::exchange(scenes_, {});
        for (const StoreSummary::Model& model : summary(open_store(store())).models)
            scenes_.push_back(read_scene(model.file));
        ASSERT_EQ(scenes_.size(), models_.size());
        for (std::size_t m = 0; m < before.size(); ++m)
            compare(models_[m], before[m], scenes_[m]);
    }

    static void compare(Model& model, const Scene& before, const Scene& now) {
        std::map<std::string, const Part*> parts;
        for (const Part& part : now.parts)
            parts[part.id] = &part;
        for (const Part& part : before.parts) {
            const auto found = parts.find(part.id);
            if (found == parts.end() || !is_same(part, before, *found->second, now))
                model.unchanged.erase(part.id);
        }
    }

    static bool is_same(const Part& a, const Scene& in_a, const Part& b, const Scene& in_b) {
        return a.name == b.name && a.type == b.type && a.colour == b.colour &&
               a.world_from_mesh == b.world_from_mesh && level(a, in_a) == level(b, in_b) &&
               same_bits(in_a.meshes.at(a.mesh), in_b.meshes.at(b.mesh));
    }
    static std::string_view level(const Part& part, const Scene& scene) {
        return scene.properties.value(static_cast<std::uint32_t>(&part - scene.parts.data()),
                                      "extras.level");
    }

    Random& random_;
    int parts_;
    Folder folder_;
    std::vector<Model> models_;
    std::vector<Scene> scenes_; ///< as imported
    int serial_ = 0;
};

} // namespace abut::test
