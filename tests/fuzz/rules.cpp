/// Any text as a rules file gives rules within their domains, or an Error.
#include <abut/clash.h>
#include <abut/error.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int file = memfd_create("rules", MFD_CLOEXEC);
    if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size))
        std::abort();
    try {
        for (const abut::ClashRule& rule :
             abut::read_rules("/proc/self/fd/" + std::to_string(file)))
            if (!(rule.clearance.value_or(0) >= 0) || !(rule.touch_tolerance.value_or(0) >= 0))
                std::abort();
    } catch (const abut::Error&) { // an Error is a valid answer
    }
    close(file);
    return 0;
}
