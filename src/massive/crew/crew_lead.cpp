#include "massive/crew/crew_lead.h"

#include <abut/error.h>

#include "massive/crew/crew_messages.h"
#include "massive/work/stored_parts.h"

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

namespace abut {

namespace {

/// Thrown to unwind the leader's own work when the job has ended or failed elsewhere.
struct Abandoned {};

/// How long to wait before checking whether to stop.
constexpr std::chrono::milliseconds kPatience{20};

/// Tasks that a helper has at a time. One is tested while the meshes of the other are read.
constexpr int kPiecesAtOnce = 2;

} // namespace

CrewLead::CrewLead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options)
    : crew_(crew), plan_(plan), options_(options),
      progress_(options.progress, "narrow phase", plan.candidates), result_(result),
      schedule_(plan.stored, plan.units, crew.size(), plan.rules.get()) {
    progress_.advance(result.counters().recalled_pairs);
    server_ = std::thread([this] { serve(); });
    recorder_ = std::thread([this] { record(); });
}

CrewLead::~CrewLead() {
    ended_ = true;
    for (std::thread* const thread : {&server_, &recorder_})
        if (thread->joinable())
            thread->join();
}

std::optional<Task> CrewLead::next() {
    helpers_have_work_.wait();
    return task_for(0);
}

void CrewLead::brief_helpers() {
    struct CountDown {
        std::latch& latch;
        ~CountDown() { latch.count_down(); }
    } const count_down{helpers_have_work_};
    const std::vector<std::byte> briefing =
        encode(Briefing{plan_.budget, plan_.blocks_budget, parts_key(plan_.stored.models)});
    for (std::size_t helper = 1; helper < crew_.size(); ++helper)
        crew_.send(helper, briefing);
    for (int i = 0; i < kPiecesAtOnce; ++i)
        for (std::size_t helper = 1; helper < crew_.size(); ++helper)
            hand_out(helper);
}

void CrewLead::serve() {
    try {
        brief_helpers();
        while (!ended_) {
            check_stop(options_.progress);
            if (const auto message = crew_.receive(kPatience))
                handle(*message);
        }
    } catch (...) {
        fail();
    }
}

void CrewLead::handle(const Crew::Message& message) {
    if (message.bytes.empty())
        throw std::runtime_error("process " + std::to_string(message.from) + " has left the job");
    CrewMessage content = decode(message.bytes);
    if (const auto* const failure = std::get_if<Failure>(&content))
        failure->rethrow();
    auto& result = std::get<TaskResult>(content);
    hand_out(message.from);
    progress_.advance(result.pairs);
    result.from = static_cast<std::uint32_t>(message.from);
    done(std::move(result));
}

void CrewLead::hand_out(std::size_t worker) {
    if (auto task = task_for(worker))
        crew_.send(worker, encode(std::move(*task)));
    else
        crew_.send(worker, encode(NoMoreWork()));
}

std::optional<Task> CrewLead::task_for(std::size_t worker) {
    const std::scoped_lock lock(mutex_);
    return schedule_.next(worker);
}

void CrewLead::done(TaskResult result) {
    const std::scoped_lock lock(mutex_);
    done_.push_back(std::move(result));
    to_record_.notify_one();
}

void CrewLead::record() {
    try {
        for (std::size_t left = plan_.units.size(); left > 0 && !ended_;) {
            std::vector<TaskResult> results;
            {
                std::unique_lock lock(mutex_);
                to_record_.wait_for(lock, kPatience, [this] { return !done_.empty(); });
                results.swap(done_);
            }
            left -= results.size();
            if (!results.empty())
                result_.take(std::move(results));
        }
        ended_ = true;
    } catch (...) {
        fail();
    }
}

void CrewLead::on_pair() {
    if (ended_)
        throw Abandoned();
    progress_.advance();
}

void CrewLead::fail() {
    const std::scoped_lock lock(mutex_);
    if (failure_ == nullptr)
        failure_ = std::current_exception();
    ended_ = true;
}

void CrewLead::finish() {
    server_.join();
    recorder_.join();
    if (failure_ != nullptr)
        std::rethrow_exception(failure_);
}

} // namespace abut
