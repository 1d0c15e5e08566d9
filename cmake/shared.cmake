# Shared libraries, made from the objects of the static ones: nothing is compiled twice.
#
# Only what include/abut declares is exported. The list is made from the headers by exports.cmake when
# a library is linked, so a new header needs no marks. docs/packages.md has the policy of versions.
set(ABUT_SOVERSION ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0) # each minor version may change the binary interface
    set(ABUT_SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()
# The libraries that programs link.
set(ABUT_LIBRARY abut)
set(ABUT_RENDER_LIBRARY abut_render)
if(ABUT_SHARED)
    set(ABUT_LIBRARY abut_shared)
    set(ABUT_RENDER_LIBRARY abut_render_shared)
    # Installed programs, helpers and the Python module find the libraries by their own place, so that the folder
    # may be moved. In /usr the linker knows the place.
    if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
        set(CMAKE_INSTALL_RPATH $ORIGIN $ORIGIN/../${CMAKE_INSTALL_LIBDIR} $ORIGIN/../../${CMAKE_INSTALL_LIBDIR}
                                $ORIGIN/../../..)
    endif()
endif()

# The libraries of components by name: Abut::NAME, which is one of Abut::NAME_static and Abut::NAME_shared.
function(abut_make_shared static name)
    set_target_properties(${static} PROPERTIES EXPORT_NAME ${name}_static)
    add_library(Abut::${name}_static ALIAS ${static})
    if(NOT ABUT_SHARED)
        add_library(Abut::${name} ALIAS ${static})
        return()
    endif()
    set(shared ${static}_shared)
    add_library(${shared} SHARED $<TARGET_OBJECTS:${static}>)
    get_target_property(file ${static} OUTPUT_NAME)
    if(NOT file)
        set(file ${static})
    endif()
    set_target_properties(${shared} PROPERTIES OUTPUT_NAME ${file} EXPORT_NAME ${name}_shared LINKER_LANGUAGE CXX
                          VERSION ${PROJECT_VERSION} SOVERSION ${ABUT_SOVERSION})
    target_include_directories(${shared}
        PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(${shared} PUBLIC cxx_std_20)
    # What the static library needs, without what it passes on to its users.
    get_target_property(needed ${static} LINK_LIBRARIES)
    list(FILTER needed EXCLUDE REGEX "^abut$|abut_compile")
    target_link_libraries(${shared} PRIVATE ${needed})
    if(static STREQUAL "abut")
        target_link_libraries(${shared} PUBLIC $<BUILD_INTERFACE:abut_compile>)
    else()
        target_link_libraries(${shared} PUBLIC abut_shared $<BUILD_INTERFACE:abut_compile>)
    endif()
    add_library(Abut::${name} ALIAS ${shared})
    add_library(Abut::${name}_shared ALIAS ${shared})

    set(map ${PROJECT_BINARY_DIR}/${file}.map)
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/abut/*.h)
    set(script ${PROJECT_SOURCE_DIR}/cmake/exports.cmake)
    # Abut::render uses some of the library's inner functions. The library exports these too.
    add_custom_command(OUTPUT ${map}
        COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR}/include/abut -DOUTPUT=${map} -DNM=${CMAKE_NM}
                -DVERSION=${ABUT_SOVERSION} "-DUSER=$<$<STREQUAL:${static},abut>:$<TARGET_FILE:abut_render>>" -P ${script}
        DEPENDS ${headers} ${script} $<$<STREQUAL:${static},abut>:abut_render> VERBATIM
        COMMENT "Exports of ${file}")
    add_custom_target(${shared}_exports DEPENDS ${map})
    add_dependencies(${shared} ${shared}_exports)
    set_target_properties(${shared} PROPERTIES LINK_DEPENDS ${map})
    target_link_options(${shared} PRIVATE -Wl,--version-script=${map} -Wl,--no-undefined)
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
        target_link_options(${shared} PRIVATE -s)
    endif()
endfunction()
