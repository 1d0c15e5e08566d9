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

} // namespace abut
