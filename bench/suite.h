#pragma once

#include "report.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace abut::bench {

using RunSuite = std::function<Report()>;

/// A suite of abut-bench, which is a subcommand. Each suites/NAME_suite.cpp defines one as a global
/// object, and the object registers itself.
class Suite {
public:
    /// Adds the options of the suite to its subcommand. Returns the function that runs the suite
    /// with the options that were parsed.
    using Prepare = RunSuite (*)(CLI::App& suite);

    Suite(const char* name, const char* summary, Prepare prepare);
    Suite(const Suite&) = delete;
    Suite& operator=(const Suite&) = delete;

    /// All suites, by name.
    static const std::vector<const Suite*>& all();

    /// Adds the suite's subcommand. Parsing it runs the suite and stores its report.
    CLI::App* add_to(CLI::App& root, Report& report) const;

private:
    static std::vector<const Suite*>& registered();

    const char* name_;
    const char* summary_;
    Prepare prepare_;
};

/// Adds the option that takes the medians of more or fewer passes.
void add_rounds(CLI::App& suite, int& rounds);
/// Adds the option that runs only the cases whose name contains a text.
void add_only(CLI::App& suite, std::string& only);

} // namespace abut::bench
