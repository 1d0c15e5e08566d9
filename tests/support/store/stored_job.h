#pragma once

#include <abut/clash.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "tests/support/clash/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"

#include <string>
#include <vector>

namespace abut::test {

/// A store of some model files, a question, and the answer computed in core.
struct StoredJob {
    StoredJob(const std::vector<Scene>& models, ClashOptions asked) : options(std::move(asked)) {
        for (std::size_t m = 0; m < models.size(); ++m) {
            files.push_back(folder / ("model" + std::to_string(m) + ".glb"));
            write_glb(models[m], files.back());
        }
        (void)import_models(files, store);
        scenes = read_scenes(files);
        truth = find_clashes(scenes, options);
    }
    /// One or two model files with `parts` parts each, or with 60 to 200 if `parts` is 0. Pairs
    /// within one file always count if `parts` is given, and else in half of the cases.
    explicit StoredJob(Random& random, int parts = 0)
        : StoredJob{some_models(random, parts), some_question(random, parts > 0)} {}

    void expect(const StoreClashReport& found) const {
        expect_equal(found.report, found.models, truth, scenes);
    }

    Folder folder;
    std::vector<std::string> files;
    std::string store = folder / "models.abut";
    std::vector<Scene> scenes;
    ClashOptions options;
    ClashReport truth;

private:
    static std::vector<Scene> some_models(Random& random, int parts) {
        std::vector<Scene> models(static_cast<std::size_t>(random.integer(1, 2)));
        for (Scene& model : models)
            model = some_scene(random, parts > 0 ? parts : random.integer(60, 200), 4);
        return models;
    }
    static ClashOptions some_question(Random& random, bool self) {
        ClashOptions options;
        options.clearance = random.chance(0.3) ? 0 : random.uniform(0, 0.1);
        options.touch_tolerance = random.chance(0.5) ? 0 : 1e-3;
        options.self = self || random.chance(0.5);
        options.rules = some_rules(random);
        return options;
    }
};

} // namespace abut::test
