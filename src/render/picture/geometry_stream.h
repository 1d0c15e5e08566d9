#pragma once

#include <abut/renderer.h>

#include "render/drawn_camera.h"
#include "render/picture/picture_model.h"

#include <functional>
#include <span>
#include <unordered_map>

namespace abut {

/// Hands the geometry of a model to a renderer, a few thousand parts at a time, nearest first.
class GeometryStream {
public:
    /// The model must outlive the stream.
    GeometryStream(const PictureModel& model, const Vec3& origin);

    /// Calls draw(frame) for the parts that a camera may see. Each frame uploads its chunks and
    /// drops those of the frame before.
    ///
    /// In          chosen: by part, whether it is drawn.
    void visit(const DrawnCamera& camera, const std::vector<bool>& chosen,
               const std::function<void(const ViewFrame&)>& draw, const Progress& progress);

private:
    /// Parts that show one mesh.
    struct Group {
        std::int64_t mesh = 0;
        double distance = 0; ///< of its nearest part's box from the eye
        std::vector<std::uint32_t> parts;
    };
    struct Drawn {
        std::vector<ViewChunk> chunks;
        std::vector<ChunkInstance> instances; ///< none: the chunks are placed
    };

    [[nodiscard]] std::vector<Group> groups(const DrawnCamera& camera,
                                            const std::vector<bool>& chosen) const;
    [[nodiscard]] Drawn make(const Group& group) const;
    void draw_batch(std::span<const Group> batch,
                    const std::function<void(const ViewFrame&)>& draw);

    const PictureModel& model_;
    Vec3 origin_;
    std::vector<std::uint32_t> drops_;
};

} // namespace abut
