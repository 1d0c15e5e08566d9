#include "peers/peer_boxes.h"

#ifdef ABUT_BENCH_CGAL
#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_CGAL

namespace {

/// Streamed segment trees [Zomorodian, Edelsbrunner 2000]. Nothing is kept between steps.
class CgalBoxes : public BoxPeer {
public:
    [[nodiscard]] std::string name() const override { return "CGAL box_self_intersection_d"; }
    std::size_t step(std::span<const Box3> boxes) override {
        boxes_.clear();
        pairs_.clear();
        for (const Box3& box : boxes)
            boxes_.push_back(CGAL::Bbox_3(box.lower.x, box.lower.y, box.lower.z, box.upper.x,
                                          box.upper.y, box.upper.z));
        CGAL::box_self_intersection_d(
            boxes_.begin(), boxes_.end(),
            [&](const Box& a, const Box& b) { pairs_.emplace_back(a.id(), b.id()); });
        return pairs_.size();
    }

private:
    using Box = CGAL::Box_intersection_d::Box_d<double, 3>;
    std::vector<Box> boxes_;
    std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

} // namespace

std::vector<MakeBoxPeer> cgal_box_peers() {
    return {[](std::span<const Box3> /*boxes*/) -> std::unique_ptr<BoxPeer> {
        return std::make_unique<CgalBoxes>();
    }};
}

#else

std::vector<MakeBoxPeer> cgal_box_peers() {
    return {};
}

#endif

} // namespace abut::bench
