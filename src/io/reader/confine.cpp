#include "io/reader/confine.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace abut {

namespace {

namespace fs = std::filesystem;

/// The number or the result of a system call.
using Call = long; // NOLINT(google-runtime-int): as the C library has it

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0; // without a filter
#endif

constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t kReadBelow = kRead | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kExecute = kRead | LANDLOCK_ACCESS_FS_EXECUTE;

/// The files that can be opened, enforced by Landlock.
class FileRules {
public:
    FileRules() {
        const Call version =
            syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
        if (version < 1)
            return;
        // The number of access bits that each version of Landlock defines.
        constexpr std::array<int, 5> kBits{13, 14, 15, 15, 16};
        const int bits = kBits.at(static_cast<std::size_t>(std::min<Call>(version, 5) - 1));
        handled_ = (std::uint64_t{1} << bits) - 1;
        landlock_ruleset_attr attributes{};
        attributes.handled_access_fs = handled_;
        rules_ = static_cast<int>(
            syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
    }
    ~FileRules() {
        if (rules_ >= 0)
            close(rules_);
    }
    FileRules(const FileRules&) = delete;
    FileRules& operator=(const FileRules&) = delete;

    /// Allows a path. A path that does not exist is ignored.
    void allow(const std::string& path, std::uint64_t access) const {
        if (rules_ < 0)
            return;
        const int place = open(path.c_str(), O_PATH | O_CLOEXEC);
        if (place < 0)
            return;
        struct stat status {};
        // Landlock refuses folder rights for a file.
        if (fstat(place, &status) == 0 && !S_ISDIR(status.st_mode))
            access &= kExecute;
        landlock_path_beneath_attr rule{};
        rule.allowed_access = access & handled_;
        rule.parent_fd = place;
        syscall(SYS_landlock_add_rule, rules_, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
        close(place);
    }

    [[nodiscard]] bool enforce() const {
        return rules_ >= 0 && syscall(SYS_landlock_restrict_self, rules_, 0) == 0;
    }

private:
    std::uint64_t handled_ = 0;
    int rules_ = -1;
};

/// A filter of system calls. Its rules are checked in order; the first that matches decides.
class CallFilter {
public:
    CallFilter() {
        load(offsetof(seccomp_data, arch));
        code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0));
        finish(SECCOMP_RET_KILL_PROCESS);
        load(offsetof(seccomp_data, nr));
    }

    void allow(Call call) { on(call, SECCOMP_RET_ALLOW); }
    void refuse(Call call, int error = EPERM) {
        on(call, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error));
    }
    /// Allows a call only with this value in an argument's lower half; otherwise it is refused.
    void allow_if_equal(Call call, std::size_t argument, std::uint32_t value) {
        conditional(call, argument, BPF_JEQ, value, SECCOMP_RET_ALLOW, kRefuse);
    }
    /// Allows a call only without any of these bits in an argument; otherwise it is refused.
    void allow_without(Call call, std::size_t argument, std::uint32_t bits) {
        conditional(call, argument, BPF_JSET, bits, kRefuse, SECCOMP_RET_ALLOW);
    }
    void allow_with(Call call, std::size_t argument, std::uint32_t bits) {
        conditional(call, argument, BPF_JSET, bits, SECCOMP_RET_ALLOW, kRefuse);
    }

    [[nodiscard]] bool enforce(bool allow_others) {
        if (kArchitecture == 0)
            return false;
        finish(allow_others ? SECCOMP_RET_ALLOW : kRefuse);
        const sock_fprog program{static_cast<std::uint16_t>(code_.size()), code_.data()};
        return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
    }

private:
    static constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;

    void load(std::size_t offset) {
        code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
    }
    void finish(std::uint32_t action) { code_.push_back(BPF_STMT(BPF_RET | BPF_K, action)); }
    void on(Call call, std::uint32_t action) {
        code_.push_back(
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
        finish(action);
    }
    void conditional(Call call, std::size_t argument, std::uint16_t test, std::uint32_t value,
                     std::uint32_t if_true, std::uint32_t if_false) {
        code_.push_back(
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4));
        load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t));
        code_.push_back(BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, 0, 1));
        finish(if_true);
        finish(if_false);
    }

    std::vector<sock_filter> code_;
};

/// Allows what a reader needs with one thread, its memory and its open descriptors.
void allow_computing(CallFilter& filter) {
    for (const Call call : {
             SYS_read, SYS_readv, SYS_pread64, SYS_write, SYS_writev, SYS_pwrite64, SYS_lseek,
                 SYS_close, SYS_fstat, SYS_newfstatat, SYS_statx, SYS_ftruncate, SYS_fcntl, SYS_brk,
                 SYS_munmap, SYS_mremap, SYS_madvise, SYS_futex, SYS_exit, SYS_exit_group,
                 SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_restart_syscall,
                 SYS_clock_gettime, SYS_gettimeofday, SYS_getrandom, SYS_sched_yield,
                 SYS_sched_getaffinity, SYS_getpid, SYS_gettid, SYS_getrusage, SYS_sysinfo,
                 SYS_uname, SYS_readlinkat, SYS_faccessat, SYS_getcwd,
#if defined(__x86_64__)
                 SYS_stat, SYS_lstat, SYS_access, SYS_readlink, SYS_time,
#endif
#if defined(SYS_faccessat2)
                 SYS_faccessat2,
#endif
         })
        filter.allow(call);
    // No new code may become executable.
    filter.allow_without(SYS_mmap, 2, PROT_EXEC);
    filter.allow_without(SYS_mprotect, 2, PROT_EXEC);
    filter.allow_if_equal(SYS_tgkill, 0, static_cast<std::uint32_t>(getpid())); // abort()
    filter.allow_if_equal(SYS_prlimit64, 0, 0);
}

/// Refuses what no reader needs, not even one that runs threads and generates code.
void refuse_escapes(CallFilter& filter) {
    for (const Call call : {
             SYS_socket, SYS_socketpair, SYS_connect, SYS_bind, SYS_listen, SYS_accept, SYS_accept4,
                 SYS_sendto, SYS_sendmsg, SYS_tkill, SYS_rt_sigqueueinfo, SYS_rt_tgsigqueueinfo,
                 SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev, SYS_bpf,
                 SYS_perf_event_open, SYS_keyctl, SYS_add_key, SYS_request_key, SYS_mount,
                 SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_unshare, SYS_setns, SYS_userfaultfd,
                 SYS_init_module, SYS_finit_module, SYS_kexec_load, SYS_mknodat,
#if defined(__x86_64__)
                 SYS_fork, SYS_vfork, SYS_mknod,
#endif
#if defined(SYS_pidfd_send_signal)
                 SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal,
#endif
         })
        filter.refuse(call);
    // Their arguments lie in memory, which a filter cannot inspect. The C library falls back on
    // other calls.
    filter.refuse(SYS_clone3, ENOSYS);
    filter.refuse(SYS_io_uring_setup, ENOSYS);
    filter.allow_with(SYS_clone, 0, CLONE_THREAD);
    for (const Call call : {SYS_kill, SYS_tgkill})
        filter.allow_if_equal(call, 0, static_cast<std::uint32_t>(getpid()));
}

bool give_up_new_rights() {
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

} // namespace

Confinement confine_reader(const std::string& file) {
    if (!give_up_new_rights())
        return {};
    Confinement result;
    const FileRules rules;
    if (!file.empty())
        rules.allow(file, kRead);
    result.files = rules.enforce();
    CallFilter filter;
    allow_computing(filter);
    constexpr std::uint32_t kChanges =
        O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);
    if (!file.empty()) {
        filter.allow_without(SYS_openat, 2, kChanges);
#if defined(__x86_64__)
        filter.allow_without(SYS_open, 1, kChanges);
#endif
    }
    result.calls = filter.enforce(false);
    return result;
}

Confinement confine_program(const std::string& program, const std::vector<std::string>& readable) {
    if (!give_up_new_rights())
        return {};
    Confinement result;
    const FileRules rules;
    // The dynamic linker, the C library and the program's own libraries read these folders. A
    // script may stand for the program; the program that it executes is confined, too.
    for (const char* const system : {"/usr", "/lib", "/lib64", "/bin", "/opt"})
        rules.allow(system, kReadBelow | kExecute);
    for (const char* const system :
         {"/etc/ld.so.cache", "/etc/ld.so.preload", "/etc/ssl", "/etc/localtime", "/proc/self",
          "/proc/meminfo", "/proc/cpuinfo", "/proc/stat", "/proc/version_signature",
          "/proc/sys/vm/overcommit_memory", "/sys/devices/system/cpu", "/sys/fs/cgroup",
          "/sys/kernel/mm", "/dev/null", "/dev/urandom", "/dev/random"})
        rules.allow(system, kReadBelow);
    std::error_code error;
    const fs::path binary = fs::canonical(program, error);
    if (!error)
        rules.allow(binary.parent_path().parent_path() / "lib", kReadBelow);
    for (const std::string& path : readable)
        rules.allow(path, kReadBelow);
    rules.allow(program, kExecute);
    result.files = rules.enforce();
    CallFilter filter;
    refuse_escapes(filter);
    result.calls = filter.enforce(true);
    return result;
}

} // namespace abut
