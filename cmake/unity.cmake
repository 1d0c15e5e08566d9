# Compiles the sources of a target in batches (CMake's unity builds), if ABUT_UNITY is on.
#
# A build of everything then takes less than half of the processor time, since headers are read once a batch;
# to build one changed source takes longer. A batch is a part of one folder: names in anonymous namespaces
# differ within a folder.
function(abut_compile_in_batches target)
    if(NOT ABUT_UNITY)
        return()
    endif()
    set(batch_size 12)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        if(NOT EXISTS ${source})
            continue() # it is made by the build, and compiled alone
        endif()
        # So are sources that compile themselves once a SIMD target.
        file(STRINGS ${source} alone REGEX "^#include \"simd/foreach_target.h\"")
        if(alone)
            continue()
        endif()
        cmake_path(GET source PARENT_PATH folder)
        string(MAKE_C_IDENTIFIER "${folder}" folder)
        math(EXPR batch "0${count_${folder}}")
        math(EXPR count_${folder} "${batch} + 1")
        math(EXPR batch "${batch} / ${batch_size}")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
    endforeach()
endfunction()
