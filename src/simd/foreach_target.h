// Compiles the including file once for each target. No include guard: that is its purpose.
// Three targets are built for x86: AVX-512, AVX2, and portable code for machines that have neither. Others
// cost build time on every machine and serve few: x86 processors since 2013 have AVX2.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
