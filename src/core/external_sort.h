#pragma once

#include "core/parallel.h"
#include "core/temporary_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace abut {

/// Sorts any number of records in bounded memory: writes sorted runs to the disk, then merges all
/// of them at once. Records that fit into memory never touch the disk.
///
/// In          records with operator<, a strict order without equal records. The order of equal
///             records would depend on the memory limit.
/// Cost        each record is written and read once.
template <typename Record>
class ExternalSort {
    static_assert(std::is_trivially_copyable_v<Record>);

public:
    ExternalSort(std::string folder, std::size_t memory)
        : folder_(std::move(folder)),
          capacity_(std::max<std::size_t>(memory / sizeof(Record), kLeastRecords)) {}

    /// Errors      Error{cannot_write} if the disk is full.
    void push(const Record& record) {
        if (records_.size() == capacity_)
            spill();
        if (records_.size() == records_.capacity())
            records_.reserve(std::min(capacity_, std::max<std::size_t>(2 * records_.size(), 1024)));
        records_.push_back(record);
    }

    /// Calls take(record) for all records in ascending order. Call it once, after the last push.
    template <typename Take>
    void drain(const Take& take) {
        if (runs_.empty()) {
            parallel_sort(records_.begin(), records_.end());
            for (const Record& record : records_)
                take(record);
        } else {
            spill();
            merge(take);
        }
        records_ = {};
    }

private:
    static constexpr std::size_t kLeastRecords = 1024;

    /// A sorted run: the records of the file from `next` to `end` are still unread, `buffer` holds
    /// those read.
    struct Run {
        std::uint64_t next = 0, end = 0;
        std::vector<Record> buffer;
        std::size_t at = 0;
    };

    void spill() {
        parallel_sort(records_.begin(), records_.end());
        if (!file_)
            file_.emplace(folder_);
        const std::uint64_t start = runs_.empty() ? 0 : runs_.back().end;
        file_->write(start * sizeof(Record), std::as_bytes(std::span(records_)));
        runs_.push_back({start, start + records_.size(), {}, 0});
        records_.clear();
    }

    /// Reads the next records of a run. Returns false at its end.
    bool refill(Run& run, std::size_t most) {
        const std::size_t count = std::min<std::uint64_t>(most, run.end - run.next);
        run.buffer.resize(count);
        run.at = 0;
        file_->read(run.next * sizeof(Record), std::as_writable_bytes(std::span(run.buffer)));
        run.next += count;
        return count > 0;
    }

    template <typename Take>
    void merge(const Take& take) {
        records_ = {};
        const std::size_t most = std::max<std::size_t>(capacity_ / runs_.size(), 64);
        const auto later = [&](std::size_t a, std::size_t b) {
            return runs_[b].buffer[runs_[b].at] < runs_[a].buffer[runs_[a].at];
        };
        std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(later)> heads(later);
        for (std::size_t i = 0; i < runs_.size(); ++i)
            if (refill(runs_[i], most))
                heads.push(i);
        while (!heads.empty()) {
            const std::size_t i = heads.top();
            heads.pop();
            Run& run = runs_[i];
            take(run.buffer[run.at++]);
            if (run.at < run.buffer.size() || refill(run, most))
                heads.push(i);
        }
        runs_.clear();
        file_.reset();
    }

    std::string folder_;
    std::size_t capacity_;
    std::vector<Record> records_;
    std::vector<Run> runs_;
    std::optional<TemporaryFile> file_;
};

} // namespace abut
