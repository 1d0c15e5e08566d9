// Compiles the including file once for each target. No include guard: that is its purpose.
// Targets that no machine of interest lacks a better sibling of are left out: they cost only build
// time.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
