#include "massive/crew/crew_clashes.h"

#include <abut/error.h>
#include <abut/store_clash.h>

#include "core/progress.h"
#include "massive/crew/crew_lead.h"
#include "massive/crew/crew_messages.h"
#include "massive/work/stored_parts.h"
#include "massive/work/task_worker.h"
#include "store/database/store_file.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>
#include <utility>

namespace abut {

namespace {

/// Thrown to unwind a helper whose leader has left the crew.
struct Dismissed {};

/// The tasks that the leader sends to this helper.
class LeaderSource final : public WorkSource {
public:
    LeaderSource(Crew& crew, const Progress& progress) : crew_(crew), progress_(progress) {}

    Briefing briefing() { return std::get<Briefing>(wait()); }

    std::optional<Task> next() override {
        CrewMessage message = wait();
        if (std::holds_alternative<NoMoreWork>(message))
            return std::nullopt;
        return std::get<Task>(std::move(message));
    }
    void done(TaskResult result) override { crew_.send(0, encode(std::move(result))); }
    void on_pair() override {
        throw_if_over();
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock.owns_lock())
            look(std::chrono::milliseconds(0));
    }

    void give_up() override { dismissed_ = true; }

    [[noreturn]] void wait_until_dismissed() {
        for (;;)
            (void)wait();
    }

private:
    void throw_if_over() const {
        check_stop(progress_);
        if (dismissed_)
            throw Dismissed();
    }
    CrewMessage wait() {
        for (;;) {
            throw_if_over();
            const std::scoped_lock lock(mutex_);
            if (messages_.empty())
                look(std::chrono::milliseconds(50));
            if (messages_.empty())
                continue;
            CrewMessage message = std::move(messages_.front());
            messages_.pop_front();
            return message;
        }
    }
    void look(std::chrono::milliseconds patience) {
        const auto message = crew_.receive(patience);
        if (!message)
            return;
        if (message->bytes.empty()) {
            dismissed_ = true;
            throw Dismissed();
        }
        messages_.push_back(decode(message->bytes));
    }

    Crew& crew_;
    const Progress& progress_;
    std::atomic<bool> dismissed_ = false;
    std::mutex mutex_;
    std::deque<CrewMessage> messages_;
};

} // namespace

void lead(Crew& crew, const JobPlan& plan, JobResult& result, const ClashOptions& options,
          const std::string& store) {
    if (plan.units.empty())
        return;
    // The store is read without locks, because results are recorded while pairs are tested. It is
    // closed after the last transaction, since closing it releases all locks that the process has
    // on the file.
    StoreFile file(store, OpenMode::immutable);
    CrewLead leading(crew, plan, result, options);
    try {
        TaskTester tester(file, plan.stored.models, plan.budget, plan.blocks_budget);
        work(tester, leading);
    } catch (...) {
        leading.fail();
    }
    leading.finish();
}

void help_find_clashes(const std::string& store, Crew& crew, const Progress& progress) {
    LeaderSource source(crew, progress);
    try {
        const Briefing briefing = source.briefing();
        StoreFile file(store, OpenMode::immutable);
        const std::vector<ModelRow> models = file.models();
        if (parts_key(models) != briefing.models)
            throw Error(ErrorCode::bad_argument, store, "is another store than the leader's");
        TaskTester tester(file, models, briefing.budget, briefing.blocks_budget);
        work(tester, source);
        source.wait_until_dismissed();
    } catch (const Dismissed&) {
        return;
    } catch (const std::exception& exception) {
        crew.send(0, encode(Failure::of(exception)));
    }
}

} // namespace abut
