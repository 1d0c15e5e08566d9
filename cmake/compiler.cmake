# Compile options of every target of this project.
find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
find_package(Threads REQUIRED)

add_library(abut_compile INTERFACE)
target_compile_features(abut_compile INTERFACE cxx_std_20)
# Exactness: no fused operations except explicit ones (docs/rules.md, numerics).
target_compile_options(abut_compile INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wno-psabi)
if(ABUT_WERROR)
    target_compile_options(abut_compile INTERFACE -Werror)
endif()
if(ABUT_SANITIZE)
    # -g1 tells functions and lines, which is what reports show; compiling with -g takes 1.7 times as long.
    # Tests, whose targets have the property ABUT_TEST, compile in two thirds of the time with -Og.
    target_compile_options(abut_compile INTERFACE $<IF:$<BOOL:$<TARGET_PROPERTY:ABUT_TEST>>,-Og,-O1> -g1 -fsanitize=${ABUT_SANITIZE}
                           -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(ABUT_SANITIZE MATCHES "address.*undefined")
        # A wrong pointer is reported by the address sanitizer when it is used. x86 reads what is not aligned.
        # Without these checks, compiling takes half of the time.
        target_compile_options(abut_compile INTERFACE -fno-sanitize=null,object-size,pointer-overflow,alignment)
    endif()
    # g++ 12 warns falsely about instrumented code; builds without sanitizers have the warning.
    target_compile_options(abut_compile INTERFACE -Wno-maybe-uninitialized)
    target_link_options(abut_compile INTERFACE -fsanitize=${ABUT_SANITIZE})
endif()
if(ABUT_FUZZ)
    target_compile_options(abut_compile INTERFACE -fsanitize=fuzzer-no-link)
    target_link_options(abut_compile INTERFACE -fsanitize=fuzzer-no-link)
endif()
