// The only place that includes Highway. A kernel file that dispatches at run time begins with
//
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "folder/file.cpp"
//     #include "simd/foreach_target.h"
//     #include "simd/simd.h"
//
// and keeps its kernels in HWY_NAMESPACE. No header that other files include mentions Highway.

// No include guard: Highway redefines its macros for each target.
#include <hwy/cache_control.h>
#include <hwy/highway.h>
