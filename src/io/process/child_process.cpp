#include "io/process/child_process.h"

#include <abut/error.h>

#include "io/process/scene_stream.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace abut {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMilliseconds = 20;
/// The child's end of a pipe that closes when the child has ended.
constexpr int kAliveFile = scene_stream::kResultFile + 1;
/// Descriptors handed to a child are first moved above those that it will use, so that dup2
/// overwrites none of them.
constexpr int kFirstFreeFile = kAliveFile + 1;

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() { reset(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int get() const noexcept { return value_; }
    void reset() {
        if (value_ >= 0)
            close(value_);
        value_ = -1;
    }

private:
    int value_;
};

int moved_up(int descriptor) {
    if (descriptor < 0)
        return descriptor;
    const int moved = fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstFreeFile);
    close(descriptor);
    return moved;
}

class SpawnSettings {
public:
    SpawnSettings(int result, int alive) {
        posix_spawn_file_actions_init(&files_);
        for (int standard = 0; standard < 3; ++standard)
            posix_spawn_file_actions_addopen(&files_, standard, "/dev/null",
                                             standard == 0 ? O_RDONLY : O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&files_, result, scene_stream::kResultFile);
        posix_spawn_file_actions_adddup2(&files_, alive, kAliveFile);
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setpgroup(&attributes_, 0);
        sigset_t signals;
        sigemptyset(&signals);
        posix_spawnattr_setsigmask(&attributes_, &signals);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT})
            sigaddset(&signals, signal);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                   POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    [[nodiscard]] const posix_spawn_file_actions_t* files() const { return &files_; }
    [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t files_{};
    posix_spawnattr_t attributes_{};
};

/// Returns this process's environment, with large pages for the child's heap unless the user tunes
/// glibc. A reader allocates much memory once, and page faults would take a third of its time.
std::vector<char*> child_environment() {
    static char large_pages[] = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";
    std::vector<char*> variables;
    bool tuned = false;
    for (char** variable = environ; *variable != nullptr; ++variable) {
        tuned = tuned || std::strncmp(*variable, "GLIBC_TUNABLES=", 15) == 0;
        variables.push_back(*variable);
    }
    if (!tuned)
        variables.push_back(large_pages);
    variables.push_back(nullptr);
    return variables;
}

std::uint64_t resident_bytes(pid_t child) {
    std::ifstream statm("/proc/" + std::to_string(child) + "/statm");
    std::uint64_t total = 0;
    std::uint64_t resident = 0;
    statm >> total >> resident;
    return statm ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Returns whether the child has ended. It stays unreaped until wait4, so that no other process can
/// get the number of its process group.
bool has_ended(pid_t child) {
    siginfo_t info{};
    const int answer = waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
    return answer == 0 && info.si_pid == child;
}

/// Waits; returns why a running child must end, or `exited` if it has ended.
ChildEnd wait_for_end(pid_t child, int alive, const ChildLimits& limits,
                      const std::function<bool()>& should_stop) {
    const Clock::time_point start = Clock::now();
    const timespec moment{0, 200'000};
    pollfd watched{alive, 0, 0};
    bool hung_up = false;
    while (true) {
        // The pipe hangs up when the last process that holds it has ended. The child can then be
        // reaped within moments. A descendant may hold the pipe after the child's end, hence
        // has_ended.
        if (hung_up)
            nanosleep(&moment, nullptr);
        else
            hung_up = poll(&watched, 1, kPollMilliseconds) > 0;
        if (has_ended(child))
            return ChildEnd::exited;
        if (should_stop())
            return ChildEnd::stopped;
        if (limits.seconds > 0 &&
            std::chrono::duration<double>(Clock::now() - start).count() > limits.seconds)
            return ChildEnd::time_limit;
        if (limits.bytes > 0 && resident_bytes(child) > limits.bytes)
            return ChildEnd::memory_limit;
    }
}

} // namespace

ResultMemory::ResultMemory()
    : descriptor_(moved_up(memfd_create("abut-scene", MFD_CLOEXEC | MFD_ALLOW_SEALING))) {
    if (descriptor_ < 0)
        throw Error(ErrorCode::reader_failed,
                    std::string("no shared memory for a reader: ") + std::strerror(errno));
}

ResultMemory::~ResultMemory() {
    if (mapped_ != nullptr)
        munmap(mapped_, size_);
    close(descriptor_);
}

std::span<const std::byte> ResultMemory::bytes() {
    if (mapped_ == nullptr) {
        struct stat status {};
        if (fcntl(descriptor_, F_ADD_SEALS,
                  F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL) != 0 ||
            fstat(descriptor_, &status) != 0)
            throw Error(ErrorCode::reader_failed, "the reader's result cannot be sealed");
        if (status.st_size == 0)
            return {};
        size_ = static_cast<std::size_t>(status.st_size);
        void* const address =
            mmap(nullptr, size_, PROT_READ, MAP_SHARED | MAP_POPULATE, descriptor_, 0);
        if (address == MAP_FAILED)
            throw Error(ErrorCode::reader_failed, "the reader's result cannot be mapped");
        mapped_ = address;
    }
    return {static_cast<const std::byte*>(mapped_), size_};
}

ChildReport run_child(const std::vector<std::string>& arguments, const ChildLimits& limits,
                      const std::function<bool()>& should_stop, int result) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error(ErrorCode::reader_failed,
                    std::string("no pipe for a reader: ") + std::strerror(errno));
    const Descriptor alive(ends[0]);
    Descriptor child_alive(moved_up(ends[1]));

    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments)
        pointers.push_back(const_cast<char*>(argument.c_str())); // NOLINT: posix_spawn writes none
    pointers.push_back(nullptr);

    pid_t child = -1;
    {
        const Descriptor handed(fcntl(result, F_DUPFD_CLOEXEC, kFirstFreeFile));
        const SpawnSettings settings(handed.get(), child_alive.get());
        const int fault =
            posix_spawn(&child, arguments.front().c_str(), settings.files(), settings.attributes(),
                        pointers.data(), child_environment().data());
        if (fault != 0)
            throw Error(ErrorCode::unsupported, "the reader " + arguments.front() +
                                                    " cannot be started: " + std::strerror(fault));
    }
    child_alive.reset();

    ChildReport report;
    report.end = wait_for_end(child, alive.get(), limits, should_stop);
    kill(-child, SIGKILL);
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    if (report.end == ChildEnd::exited && WIFSIGNALED(status))
        report.end = ChildEnd::killed;
    report.status = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    return report;
}

} // namespace abut
