#include "suite.h"

#include <algorithm>
#include <string_view>

namespace abut::bench {

Suite::Suite(const char* name, const char* summary, Prepare prepare)
    : name_(name), summary_(summary), prepare_(prepare) {
    const auto before = [](const Suite* suite, const Suite* other) {
        return std::string_view(suite->name_) < other->name_;
    };
    std::vector<const Suite*>& all = registered();
    all.insert(std::upper_bound(all.begin(), all.end(), this, before), this);
}

const std::vector<const Suite*>& Suite::all() {
    return registered();
}

/// Constructed at its first use, since the order in which global objects of several files are
/// constructed is unspecified.
std::vector<const Suite*>& Suite::registered() {
    static std::vector<const Suite*> suites;
    return suites;
}

CLI::App* Suite::add_to(CLI::App& root, Report& report) const {
    CLI::App* suite = root.add_subcommand(name_, summary_);
    suite->callback([run = prepare_(*suite), &report] { report = run(); });
    return suite;
}

void add_rounds(CLI::App& suite, int& rounds) {
    suite.add_option("--rounds", rounds, "Passes; medians are taken")->check(CLI::Range(1, 1000));
}

void add_only(CLI::App& suite, std::string& only) {
    suite.add_option("--only", only, "Cases whose name has this in it");
}

} // namespace abut::bench
