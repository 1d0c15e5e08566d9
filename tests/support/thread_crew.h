#pragma once

#include <abut/crew.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace abut::test {

/// A crew whose processes are simulated by threads.
class ThreadCrew final : public Crew {
public:
    static std::vector<std::unique_ptr<Crew>> of(std::size_t size) {
        const auto boxes = std::make_shared<std::vector<Box>>(size);
        std::vector<std::unique_ptr<Crew>> crew;
        for (std::size_t rank = 0; rank < size; ++rank)
            crew.push_back(std::make_unique<ThreadCrew>(boxes, rank));
        return crew;
    }

    ~ThreadCrew() override {
        if (rank_ > 0)
            deliver(0, {});
        else
            for (std::size_t helper = 1; helper < boxes_->size(); ++helper)
                deliver(helper, {});
    }

    [[nodiscard]] std::size_t rank() const override { return rank_; }
    [[nodiscard]] std::size_t size() const override { return boxes_->size(); }
    [[nodiscard]] int threads() const override { return 1; }
    void send(std::size_t to, std::vector<std::byte> bytes) override {
        deliver(to, std::move(bytes));
    }
    std::optional<Message> receive(std::chrono::milliseconds patience) override {
        Box& box = (*boxes_)[rank_];
        std::unique_lock lock(box.mutex);
        if (!box.filled.wait_for(lock, patience, [&] { return !box.messages.empty(); }))
            return std::nullopt;
        Message message = std::move(box.messages.front());
        box.messages.pop_front();
        return message;
    }

    struct Box {
        std::mutex mutex;
        std::condition_variable filled;
        std::deque<Message> messages;
    };
    ThreadCrew(std::shared_ptr<std::vector<Box>> boxes, std::size_t rank)
        : boxes_(std::move(boxes)), rank_(rank) {}

private:
    void deliver(std::size_t to, std::vector<std::byte> bytes) {
        Box& box = (*boxes_)[to];
        const std::scoped_lock lock(box.mutex);
        box.messages.push_back({rank_, std::move(bytes)});
        box.filled.notify_one();
    }

    std::shared_ptr<std::vector<Box>> boxes_;
    std::size_t rank_;
};

} // namespace abut::test
