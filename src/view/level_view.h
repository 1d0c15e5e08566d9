#pragma once

#include <abut/view.h>

#include "view/levels/level_tree.h"
#include "view/loading/chunk_loader.h"
#include "view/loading/chunk_table.h"
#include "view/loading/residency.h"
#include "view/selection/level_cut.h"
#include "view/selection/occluder_set.h"
#include "view/selection/occlusion_buffer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// A View of a tree of levels and a source of its chunks, without a store.
class LevelView {
public:
    /// Which thread reads what is missing.
    enum class Reader : std::uint8_t {
        background, ///< a second thread, if ViewOptions::background; else `frame`
        caller,     ///< for tests: the caller, by ChunkLoader::work
    };
    /// In          name: of the store, for messages.
    /// Errors      Error{bad_argument} if an option is out of range, or if the memory does not hold
    ///             the tables; Error{malformed} if the tree cannot be walked.
    LevelView(LevelTree tree, ChunkSource source, const std::string& name,
              const ViewOptions& options, Reader reader = Reader::background);
    LevelView(const LevelView&) = delete;
    LevelView& operator=(const LevelView&) = delete;

    /// As View::frame.
    const ViewFrame& frame(const CameraMotion& motion);
    void wait();
    void set_occlusion(bool on) { has_occlusion_ = on; }
    void set_budgets(std::uint64_t triangles, std::uint32_t draws) {
        options_.triangle_budget = triangles, options_.draw_budget = draws;
    }
    void set_hidden(std::uint32_t part, bool hidden);

    [[nodiscard]] const LevelTree& tree() const { return tree_; }
    [[nodiscard]] Box3 bounds() const; ///< world
    [[nodiscard]] const ViewStatistics& statistics() const { return statistics_; }
    /// The items that the last frame was chosen from, and which of them it draws.
    [[nodiscard]] const LevelCut& cut() const { return cut_; }
    [[nodiscard]] const DrawnCut& drawn() const { return drawn_; }
    [[nodiscard]] ChunkLoader& loader() { return loader_; }

private:
    /// The room for chunks beside the tables.
    [[nodiscard]] std::uint64_t room(const std::string& name) const;
    void choose(const Camera& camera, const ViewPoint& view);
    void take(ReadChunk chunk);
    void list_chunks();
    void upload(const CameraMotion& motion);
    void upload_at_once();
    void draw(const ViewPoint& view);
    void fit_budgets(const ViewPoint& view);
    void list_draws();
    void finish(double seconds);
    [[nodiscard]] CutLimits limits() const;
    [[nodiscard]] NotDrawn not_drawn() const;
    bool is_over_budget();
    bool mark(std::uint32_t chunk);

    LevelTree tree_;
    ViewOptions options_;
    ChunkTable table_;
    Residency residency_;
    OccluderSet occluders_;
    OcclusionBuffer occlusion_;
    bool has_occlusion_ = true;
    LevelCut cut_;
    DrawnCut drawn_;
    std::vector<bool> hidden_; ///< by part
    std::uint32_t frame_number_ = 0;
    bool has_waited_ = false;         ///< the next frame uploads all
    bool is_request_refused_ = false; ///< the loader does not know yet what the last frame wanted
    bool is_delivered_ = true; ///< the last frame was returned, so that its uploads were made
    std::vector<std::uint32_t> marks_; ///< by chunk: the last pass that marked it
    std::uint32_t pass_ = 0;
    std::vector<std::uint32_t> draw_of_; ///< by chunk: index in draws_ before they are sorted
    LoadRequest request_;
    std::vector<std::uint32_t> wanted_; ///< chunks of the cut
    std::vector<ChunkUpload> uploads_;
    std::vector<std::uint32_t> drops_;
    std::vector<ChunkDraw> draws_;
    std::vector<float> distances_; ///< of draws_
    std::vector<ChunkInstance> instances_;
    LoaderCounters counters_;
    ViewFrame frame_;
    ViewStatistics statistics_;
    std::uint64_t table_bytes_ = 0;
    ChunkLoader loader_; ///< the last member: its thread uses the others
};

} // namespace abut
