#include "render/picture/picture_model.h"

#include <abut/error.h>

#include "math/vector.h"
#include "mesh/used_positions.h"
#include "store/database/store_file.h"

#include <algorithm>
#include <numeric>

namespace abut {

namespace {

void take_bounds(PictureModel& model) {
    for (const PicturePart& part : model.parts)
        if (!is_empty(part.view.box)) {
            extend(model.bounds, part.view.box.lower);
            extend(model.bounds, part.view.box.upper);
        }
}

class ScenesModel : public PictureModel {
public:
    explicit ScenesModel(const std::vector<Scene>& models) : models_(models) {
        if (!models.empty())
            up = models.front().up;
        for (const Scene& scene : models)
            add(scene);
        take_bounds(*this);
    }
    [[nodiscard]] std::shared_ptr<const Mesh> mesh(std::int64_t number) const override {
        return {std::shared_ptr<const Mesh>(), meshes_[static_cast<std::size_t>(number)]};
    }
    [[nodiscard]] std::vector<Colour> colours(ColourBy by) const override {
        return part_colours(models_, by);
    }

private:
    void add(const Scene& scene) {
        const std::size_t first = meshes_.size();
        std::vector<UsedPositions> used;
        used.reserve(scene.meshes.size());
        for (const Mesh& each : scene.meshes) {
            meshes_.push_back(&each);
            used.emplace_back(each);
        }
        Scene placed{scene.file, {}, scene.parts, scene.unit, scene.up};
        turn_up(placed, up);
        for (const Part& part : placed.parts) {
            const Box3 box = world_box(used[part.mesh].get(), part.world_from_mesh);
            parts.push_back({{static_cast<std::int64_t>(parts.size()), scene.file, part.id,
                              part.name, part.type, box, part.colour},
                             static_cast<std::int64_t>(first + part.mesh),
                             part.world_from_mesh});
        }
    }

    const std::vector<Scene>& models_; ///< which live longer than their picture takes
    std::vector<const Mesh*> meshes_;
};

class StoreModel : public PictureModel {
public:
    explicit StoreModel(const Store& store) : store_(store) {
        for (const ModelRow& model : store_.file().models()) {
            up = model.world_up;
            store_.file().for_each_part(model, [&](const PartRow& part) {
                parts.push_back(
                    {{part.part, model.file, part.id, part.name, part.type, part.box, part.colour},
                     part.mesh,
                     part.world_from_mesh});
            });
        }
        take_bounds(*this);
    }
    [[nodiscard]] std::shared_ptr<const Mesh> mesh(std::int64_t number) const override {
        return std::make_shared<Mesh>(store_.file().read_mesh(number));
    }
    [[nodiscard]] std::vector<Colour> colours(ColourBy by) const override {
        const std::vector<Colour> sorted = part_colours(store_, by);
        std::vector<std::uint32_t> order(parts.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return parts[i].view.number; });
        std::vector<Colour> colours(sorted.size());
        for (std::size_t i = 0; i < sorted.size(); ++i)
            colours[order[i]] = sorted[i];
        return colours;
    }

private:
    Store store_;
};

} // namespace

std::unique_ptr<PictureModel> picture_model(const std::vector<Scene>& models) {
    return std::make_unique<ScenesModel>(models);
}
std::unique_ptr<PictureModel> picture_model(const Store& store) {
    return std::make_unique<StoreModel>(store);
}

std::uint32_t find_part(const PictureModel& model, const std::string& file,
                        const std::string& part) {
    const auto find = [&](std::string ViewPart::*word) {
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < model.parts.size(); ++i) {
            const ViewPart& each = model.parts[i].view;
            if (each.*word == part && (file.empty() || each.file == file))
                found.push_back(i);
        }
        return found;
    };
    std::vector<std::uint32_t> found = find(&ViewPart::id);
    if (found.empty())
        found = find(&ViewPart::name);
    if (found.size() == 1)
        return found.front();
    throw Error(ErrorCode::bad_argument,
                found.empty() ? "no part has the id or the name '" + part + "'"
                              : std::to_string(found.size()) + " parts are called '" + part +
                                    "': give an id that only one of them has");
}

} // namespace abut
