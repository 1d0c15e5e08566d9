#pragma once

#include "view/loading/chunk_table.h"
#include "view/loading/load_plan.h"
#include "view/selection/occluder.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

namespace abut {

/// What a frame asks for.
struct LoadRequest {
    std::vector<std::uint32_t> wanted; ///< missing chunks, in the order to load them
    CameraMotion motion;
    double pixel_error = 1;
    std::uint32_t frame = 0; ///< number of the frame
};

struct LoaderOptions {
    std::string name;             ///< of the store, for messages
    std::uint64_t memory = 0;     ///< bytes for chunks that are read or staged
    std::uint64_t plan_bytes = 0; ///< bytes of the renderer to be filled
    double look_ahead = 1;
    bool threaded = true;
};

struct LoaderCounters {
    std::uint64_t bytes = 0, peak_bytes = 0;
    std::uint64_t bytes_loaded = 0;
};

/// A chunk that was read.
struct ReadChunk {
    std::uint32_t chunk = 0;
    std::shared_ptr<const ViewChunk> data;
    std::vector<Occluder> occluders; ///< of a chunk of full detail
};

/// What a frame takes.
struct TakenChunks {
    std::vector<ReadChunk> chunks;
    LoaderCounters counters;
};

/// Reads chunks in the order of need: what the last frame wanted, then what a plan for the predicted
/// path says. A chunk that was read is staged until a frame takes it.
///
/// Two threads: one calls the members, the other one reads. The lock is held for some microseconds
/// at most, never during a read. States of the table: this class changes absent → loading → staged
/// or failed, and back to absent what it discards; `take` changes staged → resident. The caller may
/// change resident → absent.
class ChunkLoader {
public:
    /// In          tree, table: must outlive this object.
    ChunkLoader(const LevelTree& tree, ChunkTable& table, ChunkSource source,
                const LoaderOptions& options);
    ~ChunkLoader();
    ChunkLoader(const ChunkLoader&) = delete;
    ChunkLoader& operator=(const ChunkLoader&) = delete;

    /// Makes staged chunks resident: those of `first` that are staged, and then others as long as
    /// they have at most `more_bytes` together. Frees what was taken before, and asks for more.
    ///
    /// It returns nothing, and does nothing, if the other thread has the lock, unless it is told to
    /// wait for it.
    std::optional<TakenChunks> exchange(std::span<const std::uint32_t> first,
                                        std::uint64_t more_bytes, LoadRequest& request,
                                        bool wait_for_lock);
    /// Asks for more, as exchange() does, and waits for the lock.
    void ask(LoadRequest& request);
    /// Throws the first error of the other thread that was not thrown yet.
    void throw_error();
    /// Waits until the wanted chunks are staged, or there is no room for the next one.
    void wait();
    /// Waits until there is nothing to do for the thread.
    void wait_until_idle();

    /// Reads a chunk in the calling thread and makes it resident. Returns nothing if there is no
    /// room. Only without a thread.
    ///
    /// Errors      those of the source; the chunk has failed then.
    std::optional<ReadChunk> read_now(std::uint32_t chunk);
    /// Frees what was read by read_now() before.
    void forget_taken();
    /// Without a thread: reads up to `chunks` chunks, as the thread would.
    void work(std::uint32_t chunks);

    /// The frame for which the present plan was made. What was touched since then is needed.
    [[nodiscard]] std::uint32_t plan_frame() const { return plan_frame_; }
    [[nodiscard]] std::uint64_t staged_bytes() const { return staged_bytes_; }
    [[nodiscard]] LoaderCounters counters() const;

private:
    using Lock = std::unique_lock<std::mutex>;
    struct Staged {
        ReadChunk loaded;
        bool is_wanted = false;
    };
    struct Job {
        std::uint32_t chunk = 0;
        bool is_wanted = false;
    };
    /// What ended a step of the thread.
    enum class Step : std::uint8_t { loaded, replanned, idle };

    void set_request(LoadRequest& request);
    void run();
    Step try_step(Lock& lock);
    Step step(Lock& lock);
    std::optional<std::uint32_t> next_wanted();
    std::optional<std::uint32_t> next_planned(Lock& lock);
    void update_plan(Lock& lock);
    bool make_room(const Job& job);
    void discard(bool even_planned, std::uint64_t bytes);
    void load(Lock& lock, const Job& job);
    [[nodiscard]] ReadChunk read(std::uint32_t chunk) const;
    void take_one(std::uint32_t chunk, std::vector<ReadChunk>& taken);
    void add_bytes(std::uint64_t bytes);
    [[nodiscard]] std::uint64_t size_of(std::uint32_t chunk) const {
        return tree_.chunks[chunk].bytes() + (is_exact_[chunk] ? kMostOccluderBytes : 0);
    }

    const LevelTree& tree_;
    ChunkTable& table_;
    ChunkSource source_;
    LoaderOptions options_;
    std::vector<bool> is_exact_; ///< by chunk: shows world geometry at full detail

    mutable std::mutex mutex_;
    std::condition_variable news_, idle_;
    LoadRequest request_;
    std::size_t next_wanted_ = 0; ///< in request_.wanted
    bool has_request_ = false;    ///< the plan may be outdated
    bool is_idle_ = false, wanted_done_ = true;
    std::unordered_map<std::uint32_t, Staged> staged_;
    std::deque<std::uint32_t> order_; ///< of staging; may hold chunks that are no longer staged
    std::uint64_t taken_bytes_ = 0;   ///< of the chunks that the last frame took
    LoaderCounters counters_;
    std::exception_ptr error_;
    std::atomic<bool> stop_{false}, has_error_{false};
    std::atomic<bool> has_news_{false}; ///< a request came while the thread worked
    std::atomic<std::uint32_t> plan_frame_{0};
    std::atomic<std::uint64_t> staged_bytes_{0};

    // Used by the loading thread only:
    std::optional<LoadPlan> plan_;
    CameraMotion planned_;
    double planned_error_ = 0;
    std::optional<std::uint32_t> candidate_; ///< planned, and not in memory
    std::thread thread_;
};

} // namespace abut
