#pragma once

#include "core/hash.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace abut {

/// Makes the ids of parts unique, as decode_scene does, in 16 bytes an id: it stores hashes in
/// place of texts. First announce() all ids, then call unique() for each, in order.
class UniqueIds {
public:
    void announce(std::string_view id) { given_.push_back(hash_of(id)); }
    void finish() {
        std::sort(given_.begin(), given_.end());
        given_.erase(std::unique(given_.begin(), given_.end()), given_.end());
        used_.resize(given_.size());
    }

    /// The first part of an id keeps it; later ones get "#2", "#3", …
    std::string unique(const std::string& id) {
        const std::size_t place = place_of(hash_of(id));
        if (!used_[place]) {
            used_[place] = true;
            return id;
        }
        std::uint64_t& repeat = repeats_.try_emplace(id, 1).first->second;
        while (true) {
            std::string next = id + "#" + std::to_string(++repeat);
            const Hash128 hash = hash_of(next);
            if (!std::binary_search(given_.begin(), given_.end(), hash) &&
                made_.insert(hash).second)
                return next;
        }
    }

private:
    static Hash128 hash_of(std::string_view id) { return hash_128(std::as_bytes(std::span(id))); }
    [[nodiscard]] std::size_t place_of(const Hash128& hash) const {
        return static_cast<std::size_t>(std::lower_bound(given_.begin(), given_.end(), hash) -
                                        given_.begin());
    }

    std::vector<Hash128> given_; ///< sorted
    std::vector<bool> used_;     ///< for each hash in given_
    std::set<Hash128> made_;
    std::unordered_map<std::string, std::uint64_t> repeats_;
};

} // namespace abut
