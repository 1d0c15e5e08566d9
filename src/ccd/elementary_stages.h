#pragma once

#include <abut/elementary_impact.h>

#include "ccd/elementary_batch.h"
#include "ccd/elementary_crossing.h"
#include "ccd/elementary_filter.h"
#include "core/set_bits.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// Throws Error{bad_argument} if the options are not valid, as `elementary_impact` does.
void require_valid(const ElementaryOptions& options);

/// The result for a lane that `decide_crossings` has decided.
ElementaryImpact impact_of_crossing(const ElementaryPair& pair, const CrossingBatch& crossings,
                                    std::size_t lane);

/// The result for a pair that the filter and, if there is no thickness, decide_crossings have left
/// undecided.
ElementaryImpact decide_singly(const ElementaryPair& pair, const ElementaryOptions& options);

/// Takes pairs of one kind through the stages, in batches of eight. The pairs that a stage leaves
/// undecided wait for the next stage until they fill a batch.
///
/// In          Source identifies a pair by an Item of its own type and has
///                 void write(const Item&, ElementaryBatch&, std::size_t lane) const;
///                 ElementaryPair pair(const Item&) const;
///                 void take(const Item&, const ElementaryImpact&);
///             take() is not called for pairs that the filter rejects.
template <typename Item, typename Source>
class ElementaryStages {
public:
    ElementaryStages(ElementaryKind kind, const ElementaryOptions& options, Source& source)
        : kind_(kind), options_(options), source_(source) {}

    /// Adds a pair, unless `wanted` is false. The code has no branch on `wanted`, which is often
    /// hard to predict.
    void add(const Item& item, bool wanted = true) {
        if (candidates_.add(item, wanted))
            filter();
    }
    void finish() {
        if (candidates_.count > 0)
            filter();
        if (possible_.count > 0)
            cross();
    }

private:
    struct Gathered {
        ElementaryBatch batch;
        std::array<Item, ElementaryBatch::kLanes> items{};
        std::size_t count = 0;

        /// Returns true if the batch is full now.
        bool add(const Item& item, bool wanted) {
            items[count] = item;
            count += wanted ? 1 : 0;
            return count == ElementaryBatch::kLanes;
        }
        /// Writes the vertices of all items. They are written together because pairs that are not
        /// wanted, often half of all, then cost nothing here.
        void write(const Source& source) {
            for (std::size_t lane = 0; lane < count; ++lane)
                source.write(items[lane], batch, lane);
        }
        /// A mask of the lanes in use. The others hold pairs of earlier passes.
        [[nodiscard]] std::uint32_t used() const { return (1U << count) - 1; }
    };

    void filter() {
        candidates_.write(source_);
        for (const std::size_t lane :
             SetBits(possible_impacts(candidates_.batch, kind_, options_.thickness) &
                     candidates_.used()))
            pass(candidates_.items[lane]);
        candidates_.count = 0;
    }
    /// Takes a pair that the filter has left undecided to the next stage.
    void pass(const Item& item) {
        if (options_.thickness > 0)
            source_.take(item, decide_singly(source_.pair(item), options_));
        else if (possible_.add(item, true))
            cross();
    }
    void cross() {
        possible_.write(source_);
        decide_crossings(possible_.batch, kind_, crossings_);
        const std::uint32_t decided = crossings_.apart | crossings_.meet;
        for (const std::size_t lane : SetBits(possible_.used())) {
            const Item& item = possible_.items[lane];
            const ElementaryPair& pair = source_.pair(item);
            source_.take(item, (decided >> lane & 1) != 0
                                   ? impact_of_crossing(pair, crossings_, lane)
                                   : decide_singly(pair, options_));
        }
        possible_.count = 0;
    }

    ElementaryKind kind_;
    const ElementaryOptions& options_;
    Source& source_;
    Gathered candidates_, possible_;
    CrossingBatch crossings_;
};

} // namespace abut
