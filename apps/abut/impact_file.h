#pragma once

#include <abut/deformable.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <string>

namespace abut::command {

/// Every impact of a sequence, in a file that grows step by step. docs/deformable.md says what it
/// holds: comma-separated text, or fixed records where its name ends in .bin.
///
/// Written in place: however the work ends, the file has the impacts of all steps that were added,
/// and no part of another.
class ImpactFile {
public:
    /// Creates the file, or empties it. No other process can open it so until it is closed.
    ///
    /// Errors      Error{cannot_write}, naming the file; Error{interrupted}.
    explicit ImpactFile(std::string path);

    /// Adds what met in a step. A signal during it is answered after it.
    ///
    /// Errors      Error{cannot_write}, naming the file; Error{interrupted}.
    void add(std::size_t step, std::span<const FeatureImpact> impacts);

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void write();
    void finish_step();

    std::string path_;
    bool binary_;
    std::unique_ptr<std::FILE, Close> file_;
    fmt::memory_buffer buffer_;
    std::int64_t bytes_ = 0; ///< of the header and the steps that were added
};

} // namespace abut::command
