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

/// A file of all impacts of a sequence, which grows step by step. It holds comma-separated text, or
/// binary records of fixed size if its name ends in .bin; docs/deformable.md describes both.
///
/// It is written in place. However the work ends, the file has the impacts of all steps that were
/// added, and no part of another step.
class ImpactFile {
public:
    /// Creates the file, or empties it. Until it is closed, no other process can open it in this
    /// way.
    ///
    /// Errors      Error{cannot_write}, naming the file; Error{interrupted}.
    explicit ImpactFile(std::string path);

    /// Adds the impacts of a step. A signal that arrives meanwhile is handled afterwards.
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
    std::int64_t bytes_ = 0; ///< size of the header and the steps added so far
};

} // namespace abut::command
