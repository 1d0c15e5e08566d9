#pragma once

#include <utility>

namespace abut {

/// Memory that a thread uses again, taken for the time of a call. A call that begins on the same thread
/// meanwhile, because the first one waits for other threads, finds the memory empty and makes its own.
template <typename Memory>
class Borrowed {
public:
    explicit Borrowed(Memory& kept) : kept_(kept), memory_(std::exchange(kept, Memory())) {}
    ~Borrowed() { kept_ = std::move(memory_); }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;

    Memory& operator*() { return memory_; }

private:
    Memory& kept_;
    Memory memory_;
};

} // namespace abut
