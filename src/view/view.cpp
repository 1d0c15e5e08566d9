#include <abut/view.h>

#include "view/level_view.h"
#include "view/part_list.h"
#include "view/turn_estimate.h"

#include <utility>

namespace abut {

class ViewData {
public:
    ViewData(const Store& store, const ViewOptions& options)
        : store_(store),
          view_(read_level_tree(store.file()), source(), store.file().path(), options),
          parts_(store.file(), view_.tree().parts), up_(up_of(store.file())) {}

    LevelView& view() { return view_; }
    [[nodiscard]] const LevelView& view() const { return view_; }
    [[nodiscard]] const PartList& parts() const { return parts_; }
    [[nodiscard]] UpAxis up() const { return up_; }
    TurnEstimate& turn() { return turn_; }

private:
    /// The thread that loads calls it after view_ is made.
    ChunkSource source() {
        return [this](std::uint32_t chunk) {
            return read_level_chunk(store_.file(), view_.tree(), chunk);
        };
    }
    static UpAxis up_of(StoreFile& store) {
        const std::vector<ModelRow> models = store.models();
        return models.empty() ? UpAxis::y : models.front().world_up;
    }

    Store store_; ///< keeps the file open
    LevelView view_;
    PartList parts_;
    UpAxis up_;
    TurnEstimate turn_;
};

View::View(const Store& store, const ViewOptions& options)
    : data_(std::make_unique<ViewData>(store, options)) {}
View::~View() = default;
View::View(View&&) noexcept = default;
View& View::operator=(View&&) noexcept = default;

const ViewFrame& View::frame(const Camera& camera, const Vec3& velocity) {
    return data_->view().frame({camera, velocity, data_->turn().update(camera.forward)});
}

void View::wait() {
    data_->view().wait();
}

Vec3 View::origin() const {
    return data_->view().tree().origin;
}

Box3 View::bounds() const {
    return data_->view().bounds();
}

UpAxis View::up() const {
    return data_->up();
}

std::span<const std::int64_t> View::parts() const {
    return data_->view().tree().parts;
}

std::optional<std::uint32_t> View::index_of(std::int64_t number) const {
    return data_->parts().index_of(number);
}

ViewPart View::part(std::uint32_t index) const {
    return data_->parts().part(index);
}

FoundParts View::find_parts(const std::string& text, std::size_t most, std::uint32_t from,
                            double seconds) const {
    return data_->parts().find(text, most, from, seconds);
}

void View::set_hidden(std::uint32_t part, bool hidden) {
    data_->view().set_hidden(part, hidden);
}

void View::set_budgets(std::uint64_t triangles, std::uint32_t draws) {
    data_->view().set_budgets(triangles, draws);
}
void View::set_occlusion(bool on) {
    data_->view().set_occlusion(on);
}

const ViewStatistics& View::statistics() const {
    return data_->view().statistics();
}

} // namespace abut
