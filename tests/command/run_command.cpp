#include "tests/command/run_command.h"

#include "tests/support/paths.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <grp.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sstream>
#include <stdexcept>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <time.h>
#include <unistd.h>

namespace abut::test {

namespace {

/// A program that runs this long hangs, whatever the load of the machine.
constexpr std::chrono::seconds kLimit(600);

/// A running program and the reading ends of its two outputs.
struct Running {
    pid_t process = -1;
    std::array<pollfd, 2> outputs{};
};

/// Programs are started as nobody; true while a ReadOnly lives.
bool as_nobody = false;

/// Called in a child of a process of root.
void become_nobody() {
    constexpr uid_t kNobody = 65534;
    if (setgroups(0, nullptr) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0 ||
        setenv("HOME", "/", 1) != 0)
        _exit(126);
}

Running start_program(const std::vector<std::string>& command) {
    std::array<std::array<int, 2>, 2> pipes{};
    for (auto& ends : pipes)
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("pipe2");
    std::vector<char*> argv;
    for (const std::string& argument : command)
        argv.push_back(const_cast<char*>(argument.c_str())); // NOLINT: execvp does not write
    argv.push_back(nullptr);
    Running running;
    running.process = fork();
    if (running.process == 0) {
        dup2(pipes[0][1], STDOUT_FILENO);
        dup2(pipes[1][1], STDERR_FILENO);
        if (as_nobody && geteuid() == 0)
            become_nobody();
        execvp(argv.front(), argv.data());
        _exit(127);
    }
    if (running.process < 0)
        throw std::runtime_error("fork");
    for (std::size_t i = 0; i < 2; ++i) {
        close(pipes.at(i)[1]);
        running.outputs.at(i) = {pipes.at(i)[0], POLLIN, 0};
    }
    return running;
}

/// True if a child has ended. The child is not reaped.
bool has_ended(pid_t child) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == child;
}

Running start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ABUT_COMMAND);
    return start_program(arguments);
}

/// Reads both outputs until they are closed or the deadline passes, and calls on_text() now and
/// then.
template <typename OnText>
bool drain(Running& running, Outcome& outcome, std::chrono::steady_clock::time_point deadline,
           const OnText& on_text) {
    while (running.outputs[0].fd >= 0 || running.outputs[1].fd >= 0) {
        if (std::chrono::steady_clock::now() > deadline)
            return false;
        poll(running.outputs.data(), running.outputs.size(), 100);
        for (std::size_t i = 0; i < 2; ++i) {
            if (running.outputs.at(i).revents == 0)
                continue;
            std::array<char, 65536> buffer{};
            const ssize_t count = read(running.outputs.at(i).fd, buffer.data(), buffer.size());
            if (count > 0) {
                (i == 0 ? outcome.out : outcome.err)
                    .append(buffer.data(), static_cast<std::size_t>(count));
            } else {
                close(running.outputs.at(i).fd);
                running.outputs.at(i).fd = -1; // poll() skips it
                running.outputs.at(i).revents = 0;
            }
        }
        on_text();
    }
    return true;
}

template <typename OnText>
Outcome finish(Running running, const OnText& on_text) {
    Outcome outcome;
    if (!drain(running, outcome, std::chrono::steady_clock::now() + kLimit,
               [&] { on_text(outcome); })) {
        ADD_FAILURE() << "abut did not end within " << kLimit.count() << " s";
        kill(running.process, SIGKILL);
    }
    int status = 0;
    rusage usage{};
    wait4(running.process, &status, 0, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
        outcome.processor_time +=
            std::chrono::seconds(part.tv_sec) + std::chrono::microseconds(part.tv_usec);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

} // namespace

Outcome run_program(const std::vector<std::string>& command, const Watch& watch) {
    const Running running = start_program(command);
    return finish(running, [&](const Outcome& so_far) {
        if (watch)
            watch(running.process, so_far);
    });
}

Outcome run_abut(const std::vector<std::string>& arguments) {
    return finish(start(arguments), [](const Outcome&) {});
}

Outcome run_abut_and_signal(const std::vector<std::string>& arguments, const std::string& sign,
                            int signal) {
    const Running running = start(arguments);
    bool sent = false;
    Outcome outcome = finish(running, [&](const Outcome& so_far) {
        if (!sent && (so_far.out + so_far.err).find(sign) != std::string::npos) {
            sent = true;
            kill(running.process, signal);
        }
    });
    EXPECT_TRUE(sent) << "neither output ever held '" << sign << "': " << outcome.err;
    return outcome;
}

Outcome run_abut_and_kill(const std::vector<std::string>& arguments,
                          std::chrono::duration<double, std::micro> after) {
    const Running running = start(arguments);
    clockid_t clock{};
    if (clock_getcpuclockid(running.process, &clock) != 0)
        throw std::runtime_error("clock_getcpuclockid");
    timespec used{};
    while (!has_ended(running.process) && clock_gettime(clock, &used) == 0 &&
           std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec) < after)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    kill(running.process, SIGKILL);
    return finish(running, [](const Outcome&) {});
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "abut-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("mkdtemp");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::operator/(const std::string& name) const {
    return (path_ / name).string();
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
    std::ofstream file(path_ / name, std::ios::binary);
    file << content;
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + name);
    return *this / name;
}

std::vector<std::string> TemporaryFolder::list() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
        names.push_back(std::filesystem::relative(entry.path(), path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

ReadOnly::ReadOnly(const TemporaryFolder& folder) : folder_(folder / "") {
    using std::filesystem::perms;
    constexpr perms kRead = perms::owner_read | perms::group_read | perms::others_read;
    set_modes(kRead | perms::owner_exec | perms::group_exec | perms::others_exec, kRead);
    as_nobody = true;
}

ReadOnly::~ReadOnly() {
    using std::filesystem::perms;
    set_modes(perms::owner_all, perms::owner_read | perms::owner_write);
    as_nobody = false;
}

bool ReadOnly::can_run_abut() {
    return run_program({"test", "-x", ABUT_COMMAND}).status == 0;
}

void ReadOnly::set_modes(std::filesystem::perms folder, std::filesystem::perms file) const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        if (entry.is_regular_file())
            std::filesystem::permissions(entry, file);
    std::filesystem::permissions(folder_, folder);
}

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

nlohmann::json clashes_of(const Outcome& outcome) {
    nlohmann::json clashes = outcome.json()["clashes"];
    for (auto& clash : clashes)
        for (const char* key : {"status", "note", "group"})
            clash.erase(key);
    return clashes;
}

void expect_refused(const Outcome& outcome, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("abut: ", 0), 0U) << outcome.err;
    for (const std::string& word : words)
        EXPECT_NE(outcome.err.find(word), std::string::npos)
            << "'" << word << "' is missing in: " << outcome.err;
}

} // namespace abut::test
