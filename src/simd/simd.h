// The one door to Highway. A kernel file that dispatches at run time begins with
//
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "folder/file.cpp"
//     #include "simd/foreach_target.h"
//     #include "simd/simd.h"
//
// and keeps its kernels in HWY_NAMESPACE; nothing of Highway appears in a header that others
// include.

// No include guard: Highway sets its macros anew for each target.
#include <hwy/cache_control.h>
#include <hwy/highway.h>
