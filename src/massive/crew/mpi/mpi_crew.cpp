// A crew whose processes communicate by MPI. One thread makes all MPI calls. It sleeps between
// polls, so that a process that waits for a message does not occupy a core.

#include <abut/crew.h>

#include <algorithm>
#include <climits>
#include <condition_variable>
#include <deque>
#include <future>
#include <list>
#include <mpi.h>
#include <mutex>
#include <sched.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <utility>

namespace abut {

namespace {

using std::chrono::microseconds;

/// Returns this process's fair share of cores: each core that it may use counts 1 / n, where n
/// processes of this machine may use that core. At least 1.
int fair_threads() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    sched_getaffinity(getpid(), sizeof mine, &mine);
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    int processes = 0;
    MPI_Comm_size(here, &processes);
    std::vector<cpu_set_t> all(static_cast<std::size_t>(processes));
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, here);
    MPI_Comm_free(&here);
    double share = 0;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
        if (CPU_ISSET(cpu, &mine))
            share += 1.0 / static_cast<double>(std::ranges::count_if(
                               all, [cpu](const cpu_set_t& set) { return CPU_ISSET(cpu, &set); }));
    constexpr double kRounding = 1e-6;
    return std::max(1, static_cast<int>(share + kRounding));
}

class MpiCrew final : public Crew {
public:
    MpiCrew() {
        std::promise<void> joined;
        communicator_ = std::thread([this, &joined] { communicate(joined); });
        joined.get_future().wait();
    }

    ~MpiCrew() override {
        {
            const std::scoped_lock lock(mutex_);
            leaving_ = true;
            for (std::size_t peer = rank_ == 0 ? 1 : 0; peer < (rank_ == 0 ? size_ : 1); ++peer)
                outgoing_.push_back({peer, {}});
        }
        to_send_.notify_one();
        communicator_.join();
    }

    [[nodiscard]] std::size_t rank() const override { return rank_; }
    [[nodiscard]] std::size_t size() const override { return size_; }
    [[nodiscard]] int threads() const override { return threads_; }

    void send(std::size_t to, std::vector<std::byte> bytes) override {
        if (bytes.size() > INT_MAX)
            throw std::length_error("a message of more than 2 GB");
        {
            const std::scoped_lock lock(mutex_);
            outgoing_.push_back({to, std::move(bytes)});
        }
        to_send_.notify_one();
    }

    std::optional<Message> receive(std::chrono::milliseconds patience) override {
        std::unique_lock lock(mutex_);
        // Even a wait with a timeout of zero sleeps for some 60 us, and helpers poll after each
        // pair.
        if (patience.count() > 0)
            received_.wait_for(lock, patience, [this] { return !incoming_.empty(); });
        if (incoming_.empty())
            return std::nullopt;
        Message message = std::move(incoming_.front());
        incoming_.pop_front();
        return message;
    }

private:
    struct Outgoing {
        std::size_t to = 0;
        std::vector<std::byte> bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    /// The communicator thread: initializes MPI, exchanges messages until the crew is left,
    /// finalizes MPI.
    void communicate(std::promise<void>& joined) {
        int level = 0, rank = 0, size = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &size);
        rank_ = static_cast<std::size_t>(rank);
        size_ = static_cast<std::size_t>(size);
        threads_ = fair_threads();
        peers_left_ = rank_ == 0 ? size_ - 1 : 1;
        joined.set_value();

        constexpr microseconds kShortest{50}, kLongest{4000};
        for (microseconds pause = kShortest; !has_left();) {
            const bool sent = send_some(), got = receive_some();
            pause = sent || got ? kShortest : std::min(2 * pause, kLongest);
            std::unique_lock lock(mutex_);
            if (!got)
                to_send_.wait_for(lock, pause, [this] { return !outgoing_.empty(); });
        }
        MPI_Finalize();
    }

    bool has_left() {
        const std::scoped_lock lock(mutex_);
        return leaving_ && outgoing_.empty() && sending_.empty() && peers_left_ == 0;
    }

    bool send_some() {
        std::deque<Outgoing> fresh;
        {
            const std::scoped_lock lock(mutex_);
            fresh.swap(outgoing_);
        }
        for (Outgoing& message : fresh) {
            Outgoing& kept = sending_.emplace_back(std::move(message)); // the address is stable
            MPI_Isend(kept.bytes.data(), static_cast<int>(kept.bytes.size()), MPI_BYTE,
                      static_cast<int>(kept.to), 0, MPI_COMM_WORLD, &kept.request);
        }
        sending_.remove_if([](Outgoing& message) {
            int done = 0;
            MPI_Test(&message.request, &done, MPI_STATUS_IGNORE);
            return done != 0;
        });
        return !fresh.empty();
    }

    bool receive_some() {
        bool any = false;
        for (int there = 1; there != 0;) {
            MPI_Status status;
            MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &status);
            if (there == 0)
                break;
            any = true;
            int bytes = 0;
            MPI_Get_count(&status, MPI_BYTE, &bytes);
            Message message{static_cast<std::size_t>(status.MPI_SOURCE),
                            std::vector<std::byte>(static_cast<std::size_t>(bytes))};
            MPI_Recv(message.bytes.data(), bytes, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE);
            const std::scoped_lock lock(mutex_);
            peers_left_ -= message.bytes.empty() ? 1 : 0;
            incoming_.push_back(std::move(message));
            received_.notify_one();
        }
        return any;
    }

    std::thread communicator_;
    std::size_t rank_ = 0, size_ = 0;
    int threads_ = 1;

    std::mutex mutex_; // guards the next five members
    std::condition_variable to_send_, received_;
    std::deque<Outgoing> outgoing_;
    std::deque<Message> incoming_;
    bool leaving_ = false;

    std::list<Outgoing> sending_; ///< used by the communicator thread only
    std::size_t peers_left_ = 0;  ///< peers that have not left; communicator thread only
};

} // namespace

} // namespace abut

/// The entry point that join_crew looks up in this module.
extern "C" abut::Crew* abut_join_mpi() {
    return new abut::MpiCrew;
}
