#include "scenes/deforming/figure.h"

#include "scenes/deforming/frame.h"
#include "scenes/deforming/surfaces.h"

namespace abut::scenes {

namespace {

/// Gap between one limb and the next.
constexpr double kGap = 0.01;

/// A capsule that begins at its joint, with the joint at the centre of its hemisphere. The lower
/// limb of a pair turns about its joint; the upper one ends early enough to leave room for that.
struct Limb {
    double length = 0, radius = 0;
};
constexpr Limb kTorso{0.36, Figure::kTorsoRadius}, kHead{0.06, 0.10};
constexpr double kToKnee = 0.38, kToElbow = 0.28;
constexpr Limb kShank{0.36, 0.05}, kForearm{0.25, 0.038};
constexpr Limb kThigh{kToKnee - 0.075 - kShank.radius - kGap, 0.075};
constexpr Limb kUpperArm{kToElbow - 0.045 - kForearm.radius - kGap, 0.045};
/// The limbs, in the order of limb_frames.
constexpr std::array kLimb{kTorso, kHead,     kThigh,   kShank,    kThigh,
                           kShank, kUpperArm, kForearm, kUpperArm, kForearm};

constexpr Vec3 kTorsoFoot{0, 0.99, 0}, kHeadFoot{0, 1.61, 0};
constexpr Vec3 kHip{0.09, 0.78, 0}, kShoulder{0.24, 1.34, 0}; // of the left side

/// Frames in which a limb along +x hangs down or stands up.
Transform hanging(const Vec3& from) {
    return turned({0, -1, 0}, kZ, from);
}
Transform standing(const Vec3& from) {
    return turned(kY, kZ, from);
}

std::array<Transform, kLimb.size()> limb_frames(const Stance& stance) {
    const Transform& root = stance.world_from_figure;
    std::array<Transform, kLimb.size()> frames;
    frames[0] = after(root, standing(kTorsoFoot));
    frames[1] = after(root, standing(kHeadFoot));
    for (std::size_t side = 0; side < 2; ++side) {
        const Stance::Side& angles = side == 0 ? stance.left : stance.right;
        const double sign = side == 0 ? 1 : -1;
        const auto joint = [&](const Vec3& left) { return at({sign * left.x, left.y, left.z}); };
        const Transform hip = after(root, after(joint(kHip), turned_about_x(-angles.hip)));
        const Transform knee = after(hip, after(at({0, -kToKnee, 0}), turned_about_x(angles.knee)));
        const Transform shoulder =
            after(root, after(joint(kShoulder), after(turned_about_x(-angles.swing),
                                                      turned_about_z(sign * angles.spread))));
        const Transform elbow =
            after(shoulder, after(at({0, -kToElbow, 0}), turned_about_x(-angles.elbow)));
        frames[2 + 2 * side] = after(hip, hanging({}));
        frames[3 + 2 * side] = after(knee, hanging({}));
        frames[6 + 2 * side] = after(shoulder, hanging({}));
        frames[7 + 2 * side] = after(elbow, hanging({}));
    }
    return frames;
}

} // namespace

Figure::Figure(double size) {
    static_assert(kLimb.size() == kLimbs);
    for (std::size_t i = 0; i < kLimbs; ++i) {
        limbs_[i] = capsule(kLimb[i].length, kLimb[i].radius, size);
        append(mesh_, limbs_[i]);
    }
    place({}, mesh_.positions);
}

void Figure::place(const Stance& stance, std::span<Vec3> positions) const {
    const auto frames = limb_frames(stance);
    std::size_t next = 0;
    for (std::size_t i = 0; i < kLimbs; ++i)
        for (const Vec3& p : limbs_[i].positions)
            positions[next++] = apply(frames[i], p);
}

} // namespace abut::scenes
