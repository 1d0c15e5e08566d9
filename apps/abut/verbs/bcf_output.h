#pragma once

#include <abut/clash_bcf.h>
#include <abut/store_clash.h>

#include "arguments/common.h"
#include "arguments/output_files.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::command {

/// The options of a BCF file that is written.
struct BcfArguments {
    std::string out; ///< path; empty: none is written
    std::string version = "2.1", project;
    std::string author = "Abut";
    bool no_snapshots = false, no_clipping = false;
};

/// In          option: "--bcf" or "--bcf-out".
void add_bcf_options(CLI::App& app, const char* option, BcfArguments& arguments);

/// A BCF file that is written after a job. If it exists, its topics are updated.
class BcfOutput {
public:
    /// Checks, before the job, that the file can be written and that an earlier one can be read.
    explicit BcfOutput(const BcfArguments& arguments);

    /// In          store: of the job; none for models in memory, which `found` then has.
    /// Out         warnings: one line each.
    void write(const StoreClashReport& found, const std::optional<Store>& store,
               const Progress& progress, std::vector<std::string>& warnings);

    [[nodiscard]] std::string path() const { return arguments_.out; }
    [[nodiscard]] std::size_t topics() const { return topics_; }

private:
    const BcfArguments& arguments_;
    BcfVersion version_;
    std::string name_;
    std::unique_ptr<OutputFiles> outputs_;
    std::optional<BcfFile> earlier_;
    std::size_t topics_ = 0;
};

} // namespace abut::command
