#include "core/resources.h"

#include <abut/progress.h>

#include <algorithm>
#include <sys/resource.h>

namespace abut {

double peak_resident_mib() {
    rusage self{}, children{};
    getrusage(RUSAGE_SELF, &self);
    getrusage(RUSAGE_CHILDREN, &children);
    constexpr double kKibiPerMebi = 1024;
    return static_cast<double>(std::max(self.ru_maxrss, children.ru_maxrss)) / kKibiPerMebi;
}

double processor_seconds() {
    rusage self{};
    getrusage(RUSAGE_SELF, &self);
    constexpr double kMicro = 1e-6;
    return static_cast<double>(self.ru_utime.tv_sec + self.ru_stime.tv_sec) +
           kMicro * static_cast<double>(self.ru_utime.tv_usec + self.ru_stime.tv_usec);
}

} // namespace abut
