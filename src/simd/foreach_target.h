// Compiles the including file once for each SIMD target. It has no include guard for that reason.
//
// x86 builds have three targets: AVX-512, AVX2, and portable code for machines with neither. More
// targets would cost build time and help few machines: x86 processors since 2013 have AVX2.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
