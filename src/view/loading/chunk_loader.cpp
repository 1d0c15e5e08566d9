#include "view/loading/chunk_loader.h"

#include <abut/error.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>

namespace abut {

ChunkLoader::ChunkLoader(const LevelTree& tree, ChunkTable& table, ChunkSource source,
                         const LoaderOptions& options)
    : tree_(tree), table_(table), source_(std::move(source)), options_(options),
      is_exact_(tree.chunks.size()) {
    for (const LevelNode& node : tree.nodes)
        if (node.chunk != kNoChunk && node.error == 0 && node.children == 0)
            is_exact_[node.chunk] = true;
    if (options_.threaded)
        thread_ = std::thread([this] { run(); });
}

ChunkLoader::~ChunkLoader() {
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
    }
    news_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

std::optional<TakenChunks> ChunkLoader::exchange(std::span<const std::uint32_t> first,
                                                 std::uint64_t more_bytes, LoadRequest& request,
                                                 bool wait_for_lock) {
    Lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) {
        if (!wait_for_lock)
            return std::nullopt;
        lock.lock();
    }
    counters_.bytes -= std::exchange(taken_bytes_, 0);
    TakenChunks taken;
    for (const std::uint32_t chunk : first)
        if (staged_.contains(chunk))
            take_one(chunk, taken.chunks);
    while (!order_.empty()) {
        const std::uint32_t chunk = order_.front();
        if (staged_.contains(chunk)) {
            if (size_of(chunk) > more_bytes)
                break;
            more_bytes -= size_of(chunk);
            take_one(chunk, taken.chunks);
        }
        order_.pop_front();
    }
    set_request(request);
    taken.counters = counters_;
    lock.unlock();
    news_.notify_one();
    return taken;
}

void ChunkLoader::ask(LoadRequest& request) {
    {
        const std::scoped_lock lock(mutex_);
        set_request(request);
    }
    news_.notify_one();
}

/// The lock is held.
void ChunkLoader::set_request(LoadRequest& request) {
    std::swap(request_, request);
    for (const std::uint32_t chunk : request_.wanted)
        if (const auto found = staged_.find(chunk); found != staged_.end())
            found->second.is_wanted = true;
    next_wanted_ = 0;
    has_request_ = has_news_ = true;
    wanted_done_ = false;
    is_idle_ = false;
}

void ChunkLoader::take_one(std::uint32_t chunk, std::vector<ReadChunk>& taken) {
    const auto found = staged_.find(chunk);
    taken.push_back(std::move(found->second.loaded));
    staged_.erase(found);
    staged_bytes_ -= size_of(chunk);
    taken_bytes_ += size_of(chunk);
    table_.set(chunk, ChunkState::resident);
}

void ChunkLoader::throw_error() {
    if (!has_error_)
        return;
    const std::scoped_lock lock(mutex_);
    has_error_ = false;
    std::rethrow_exception(std::exchange(error_, nullptr));
}

void ChunkLoader::wait() {
    if (!options_.threaded)
        return;
    Lock lock(mutex_);
    idle_.wait(lock, [&] { return wanted_done_ || error_ != nullptr; });
}

void ChunkLoader::wait_until_idle() {
    if (!options_.threaded)
        return;
    Lock lock(mutex_);
    idle_.wait(lock, [&] { return is_idle_; });
}

LoaderCounters ChunkLoader::counters() const {
    const std::scoped_lock lock(mutex_);
    return counters_;
}

void ChunkLoader::run() {
    Lock lock(mutex_);
    while (!stop_) {
        if (try_step(lock) != Step::idle)
            continue;
        is_idle_ = wanted_done_ = true;
        idle_.notify_all();
        news_.wait(lock, [&] { return stop_ || has_news_; });
    }
}

void ChunkLoader::work(std::uint32_t chunks) {
    Lock lock(mutex_);
    while (chunks > 0) {
        const Step done = step(lock);
        if (done == Step::idle)
            return;
        chunks -= done == Step::loaded ? 1 : 0;
    }
}

/// As step(). An error of a plan, for example a lack of memory, is kept for the caller.
ChunkLoader::Step ChunkLoader::try_step(Lock& lock) {
    try {
        return step(lock);
    } catch (...) {
        if (!lock.owns_lock())
            lock.lock();
        plan_.reset();
        error_ = std::current_exception();
        has_error_ = true;
        return Step::idle;
    }
}

/// Does one piece of work: loads a chunk, or makes a new plan.
ChunkLoader::Step ChunkLoader::step(Lock& lock) {
    has_news_ = false;
    if (const auto wanted = next_wanted()) {
        const Job job{*wanted, true};
        if (!make_room(job))
            return Step::idle;
        load(lock, job);
        return Step::loaded;
    }
    if (!wanted_done_) {
        wanted_done_ = true;
        idle_.notify_all();
    }
    if (has_request_) {
        has_request_ = false;
        update_plan(lock);
        return Step::replanned;
    }
    const auto planned = next_planned(lock);
    if (has_news_)
        return Step::replanned;
    if (!planned || !make_room({*planned, false}))
        return Step::idle;
    candidate_.reset();
    load(lock, {*planned, false});
    return Step::loaded;
}

std::optional<std::uint32_t> ChunkLoader::next_wanted() {
    for (; next_wanted_ < request_.wanted.size(); ++next_wanted_)
        if (table_.state(request_.wanted[next_wanted_]) == ChunkState::absent)
            return request_.wanted[next_wanted_];
    return std::nullopt;
}

void ChunkLoader::update_plan(Lock& lock) {
    const bool is_outdated = !plan_ || request_.motion.differs(planned_, options_.look_ahead) ||
                             !(request_.pixel_error > planned_error_ * 0.75 &&
                               request_.pixel_error < planned_error_ * 1.5);
    if (!is_outdated)
        return;
    planned_ = request_.motion;
    planned_error_ = request_.pixel_error;
    plan_frame_ = request_.frame;
    lock.unlock();
    plan_.emplace(tree_, planned_, options_.look_ahead, planned_error_, options_.plan_bytes);
    candidate_.reset();
    lock.lock();
}

/// Returns the next chunk of the plan that is not in memory. Returns early when there are news.
std::optional<std::uint32_t> ChunkLoader::next_planned(Lock& lock) {
    lock.unlock();
    while (plan_ && !has_news_) {
        if (candidate_ && table_.state(*candidate_) == ChunkState::absent)
            break;
        candidate_ = plan_->next();
        if (!candidate_)
            break;
        table_.touch(*candidate_, std::max(plan_frame_.load(), table_.touched(*candidate_)));
    }
    lock.lock();
    return candidate_;
}

/// Whether there is room for a chunk, twice: while it is decoded, its stored bytes are there too.
bool ChunkLoader::make_room(const Job& job) {
    const std::uint64_t bytes = 2 * size_of(job.chunk);
    if (counters_.bytes + bytes > options_.memory)
        discard(job.is_wanted, bytes);
    return counters_.bytes + bytes <= options_.memory;
}

/// Discards staged chunks until there is room. A wanted chunk may replace planned ones, a planned
/// one only those that are no longer planned.
void ChunkLoader::discard(bool even_planned, std::uint64_t bytes) {
    std::deque<std::uint32_t> kept;
    for (const std::uint32_t chunk : order_) {
        const auto found = staged_.find(chunk);
        if (found == staged_.end())
            continue;
        const bool is_needed =
            found->second.is_wanted || (!even_planned && table_.touched(chunk) >= plan_frame_);
        if (is_needed || counters_.bytes + bytes <= options_.memory) {
            kept.push_back(chunk);
            continue;
        }
        counters_.bytes -= size_of(chunk);
        staged_bytes_ -= size_of(chunk);
        staged_.erase(found);
        table_.set(chunk, ChunkState::absent);
    }
    order_ = std::move(kept);
}

ReadChunk ChunkLoader::read(std::uint32_t chunk) const {
    ReadChunk loaded;
    loaded.chunk = chunk;
    loaded.data = std::make_shared<const ViewChunk>(source_(chunk));
    const ChunkSize& size = tree_.chunks[chunk];
    if (loaded.data->vertices.size() != size.vertices ||
        loaded.data->indices.size() != std::size_t{3} * size.triangles)
        throw Error(ErrorCode::malformed, options_.name,
                    "chunk " + std::to_string(chunk) +
                        " of the levels is damaged: it has another size than stated");
    if (is_exact_[chunk])
        loaded.occluders = find_occluders(*loaded.data);
    return loaded;
}

void ChunkLoader::load(Lock& lock, const Job& job) {
    const std::uint64_t bytes = size_of(job.chunk);
    table_.set(job.chunk, ChunkState::loading);
    add_bytes(2 * bytes);
    lock.unlock();
    ReadChunk loaded;
    std::exception_ptr error;
    try {
        loaded = read(job.chunk);
    } catch (...) {
        error = std::current_exception();
    }
    lock.lock();
    counters_.bytes -= bytes;
    if (error) {
        counters_.bytes -= bytes;
        table_.set(job.chunk, ChunkState::failed);
        error_ = error_ ? error_ : error;
        has_error_ = true;
        idle_.notify_all();
        return;
    }
    counters_.bytes_loaded += bytes;
    staged_[job.chunk] = {std::move(loaded), job.is_wanted};
    staged_bytes_ += bytes;
    order_.push_back(job.chunk);
    table_.set(job.chunk, ChunkState::staged);
}

void ChunkLoader::add_bytes(std::uint64_t bytes) {
    counters_.bytes += bytes;
    counters_.peak_bytes = std::max(counters_.peak_bytes, counters_.bytes);
}

std::optional<ReadChunk> ChunkLoader::read_now(std::uint32_t chunk) {
    Lock lock(mutex_);
    if (!make_room({chunk, true}))
        return std::nullopt;
    load(lock, {chunk, true});
    if (has_error_) {
        lock.unlock();
        throw_error();
    }
    std::vector<ReadChunk> taken;
    take_one(chunk, taken);
    return std::move(taken.front());
}

void ChunkLoader::forget_taken() {
    const std::scoped_lock lock(mutex_);
    counters_.bytes -= std::exchange(taken_bytes_, 0);
    order_.clear();
}

} // namespace abut
