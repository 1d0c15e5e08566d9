/// After any script of operations, a world gives the same answers as queries of all pairs of
/// bodies.
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/byte_choices.h"
#include "tests/support/world_motions.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace abut;
using namespace abut::test;

void require(bool condition, const char* what) {
    if (condition)
        return;
    std::fputs(what, stderr);
    std::abort();
}

class Checks {
public:
    Checks(ByteChoices& choices, const WorldOptions& world, const ScriptOptions& script)
        : choices_(choices), world_(world), script_(choices, world_, script),
          error_(1e-12 * (1 + std::abs(script.offset))) {}

    void run() {
        for (int step = 0; step < kMostSteps && !choices_.is_empty(); ++step) {
            script_.step();
            check_pairs();
            switch (choices_.integer(0, 5)) {
            case 0:
                check_contacts();
                break;
            case 1:
                check_gaps();
                break;
            case 2:
                check_impacts();
                break;
            case 3:
                check_schedule();
                break;
            case 4:
                remove_while_iterating();
                break;
            default:
                break;
            }
        }
        for (const BodyId id : script_.removed())
            require(!world_.is_valid(id), "a removed body is valid");
    }

private:
    static constexpr int kMostSteps = 40;

    void check_pairs() {
        world_.update();
        const BodyPairs now = pairs_of_boxes(script_, world_);
        require(world_.pairs() == now, "pairs");
        require(world_.begun() == without(now, last_), "begun");
        require(world_.ended() == without(last_, now), "ended");
        require(world_.size() == script_.bodies().size(), "size");
        last_ = now;
    }

    /// Pairs whose boxes do not overlap must not touch. The other pairs are asked in two ways.
    void check_contacts() {
        const BodyPairs touching = world_.collide();
        require(without(touching, world_.pairs()).empty(), "touching without a pair of boxes");
        // The depth of surfaces in the same place takes long, and has tests of its own.
        if (std::any_of(touching.begin(), touching.end(),
                        [&](const BodyPair& pair) { return is_model(pair.a) && is_model(pair.b); }))
            return;
        BodyPairs in_contact;
        for (const BodyGap& contact : world_.penetration()) {
            require(std::isfinite(contact.distance) && contact.distance <= error_, "depth");
            in_contact.push_back({contact.a, contact.b});
        }
        require(in_contact == touching, "contacts");
    }

    void check_gaps() {
        const double limit = choices_.uniform(0, 0.5);
        const BodyPairs touching = world_.collide();
        BodyPairs near;
        for (const BodyGap& gap : world_.within(limit)) {
            require(gap.distance <= limit, "gap beyond the limit");
            require(gap.distance >= -error_ || holds(touching, {gap.a, gap.b}),
                    "bodies within each other that do not touch");
            near.push_back({gap.a, gap.b});
        }
        require(std::is_sorted(near.begin(), near.end()), "order of gaps");
        require(without(touching, near).empty(), "touching bodies not near");
    }

    /// Bodies that touch at a time must have had an impact by then.
    void check_impacts() {
        const std::vector<BodyMotion> motions = script_.motions(0.5);
        const std::vector<Surface> surfaces = all_surfaces();
        const std::vector<BodyImpact> impacts = world_.time_of_impact(motions);
        const auto moves = [&](BodyId id) {
            return std::any_of(motions.begin(), motions.end(),
                               [&](const BodyMotion& m) { return m.body == id; }) ||
                   std::any_of(surfaces.begin(), surfaces.end(),
                               [&](const Surface& s) { return s.body == id && s.start != s.end; });
        };
        for (const double time : {0.0, 0.3, 0.6, 1.0}) {
            move_to(world_, motions, surfaces, time);
            for (const BodyPair& pair : world_.collide()) {
                if (!moves(pair.a) && !moves(pair.b))
                    continue;
                const auto impact =
                    std::find_if(impacts.begin(), impacts.end(), [&](const BodyImpact& i) {
                        return i.a == pair.a && i.b == pair.b;
                    });
                require(impact != impacts.end(), "an impact is missed");
                require(impact->impact.time <= time + 1e-6, "an impact is late");
            }
        }
        move_back(world_, motions, surfaces);
        last_ = world_.collide(), last_ = world_.pairs();
    }
    std::vector<Surface> all_surfaces() const {
        std::vector<Surface> surfaces;
        for (const auto& [id, body] : script_.bodies())
            if (const auto* moving = std::get_if<std::shared_ptr<MovingSurface>>(&body.shape))
                surfaces.emplace_back(id, **moving);
        return surfaces;
    }

    /// Checks the schedule with speeds set for none or some of the bodies.
    void check_schedule() {
        for (const auto& [id, body] : script_.bodies())
            if (choices_.chance(0.2))
                world_.set_speed(id, {script_.in_cube(1), script_.in_cube(1),
                                      choices_.uniform(0, 1), choices_.uniform(0, 3)});
        const BodyPairs found = world_.advance(choices_.uniform(0, 0.1));
        require(found == world_.collide(), "schedule");
        require(world_.next_event() >= 0, "next event");
        require(world_.time_to_collision(1) >= 0, "time to collision");
    }
    bool is_model(BodyId id) const {
        return is_surface(id) || std::holds_alternative<Model>(script_.bodies().at(id).shape);
    }
    bool is_surface(BodyId id) const {
        return std::holds_alternative<std::shared_ptr<MovingSurface>>(
            script_.bodies().at(id).shape);
    }

    void remove_while_iterating() {
        for (const BodyPair& pair : world_.pairs())
            if (world_.is_valid(pair.a) && world_.is_valid(pair.b) && choices_.chance(0.3))
                script_.remove(choices_.chance(0.5) ? pair.a : pair.b);
        check_pairs();
    }

    ByteChoices& choices_;
    World world_;
    WorldScript<ByteChoices> script_;
    double error_; ///< of lengths, by rounding
    BodyPairs last_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    set_threads(1);
    ByteChoices choices({data, size});
    WorldOptions options;
    options.broad_phase = static_cast<BroadPhaseMethod>(choices.integer(0, 3));
    if (choices.chance(0.2))
        options.filter = [](BodyId, BodyId) { return true; };
    Checks(choices, options, {choices.chance(0.2) ? 1e7 : 0, true}).run();
    return 0;
}
