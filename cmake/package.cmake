# `cpack` in a build folder makes Debian packages of the components of install.cmake. tools/packages
# configures such a build, and tools/try_packages tries the packages in a bare Debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME abut)
set(CPACK_PACKAGE_VENDOR Abut)
set(CPACK_PACKAGE_CONTACT "The Abut developers <abut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL dev command)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# A component's package: its name, section, dependencies beside those that dpkg-shlibdeps finds, and
# description. Packages of one build need each other in the same version.
function(abut_package component name section depends summary)
    string(TOUPPER ${component} upper)
    foreach(pair PACKAGE_NAME=${name} FILE_NAME=DEB-DEFAULT PACKAGE_SECTION=${section} "PACKAGE_DEPENDS=${depends}")
        string(REGEX MATCH "^([A-Z_]+)=(.*)$" _ "${pair}")
        set(CPACK_DEBIAN_${upper}_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" PARENT_SCOPE)
    endforeach()
    set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}" PARENT_SCOPE)
endfunction()

set(same "(= ${PROJECT_VERSION})")
set(library libabut${ABUT_SOVERSION})
set(render libabut-render${ABUT_SOVERSION})
set(needs "${library} ${same}")
set(needs_render "${library} ${same}, ${render} ${same}")
if(NOT ABUT_SHARED)
    set(needs)
    set(needs_render)
endif()
abut_package(lib ${library} libs "" "Proximity queries on triangle models: shared library
Collision, distance, penetration depth and times of impact of triangle models,
and clash detection of whole buildings and plants.")
abut_package(render ${render} libs "${needs}" "Proximity queries on triangle models: pictures
Draws models, parts and clashes with OpenGL, without a window.")
abut_package(dev libabut-dev libdevel "${needs_render}" "Proximity queries on triangle models: development files
Headers for C++20 and C, static libraries, and files for CMake and pkg-config.
To link the static libraries, install the recommended packages.")
abut_package(command abut science "${needs_render}" "Finds out where models of buildings, plants and machines clash
The command abut, its manual pages and shell completion, and the programs that
read FBX, COLLADA, 3MF and IFC files. IFC needs Node.js.")
abut_package(mpi abut-mpi science "abut ${same}" "Clash detection by several machines
The module with which abut joins the processes of mpirun.")
abut_package(walk abut-walk science "${needs_render}" "Viewer to walk through models, measure and find clashes
A window in which plants of any size are walked through.")
abut_package(python python3-abut python "${needs_render}, python3 (>= @python@), python3 (<< @next@), python3-numpy"
             "Proximity queries on triangle models: Python module
The functions of libabut on numpy's arrays.")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libtbb-dev, libfmt-dev, libhwy-dev, libqhull-dev, libmeshoptimizer-dev, libsqlite3-dev, libzstd-dev, libmetis-dev, libzip-dev, libpugixml-dev, libepoxy-dev, libpng-dev")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "nodejs (>= 18), libgl1-mesa-dri, libegl1, libopengl0")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "abut-walk, abut-mpi")
set(CPACK_DEBIAN_WALK_PACKAGE_RECOMMENDS "abut ${same}, libgl1-mesa-dri, libgl1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "abut ${same}, libgl1-mesa-dri, libegl1, libopengl0")
# They compile the module's Python files, and remove what was compiled.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/python/packaging/debian/postinst
                                              ${PROJECT_SOURCE_DIR}/python/packaging/debian/prerm)
set(CPACK_DEBIAN_LIB_PACKAGE_SUGGESTS "abut ${same}")
set(CPACK_DEBIAN_RENDER_PACKAGE_RECOMMENDS "libgl1-mesa-dri, libegl1, libopengl0")

if(ABUT_SHARED)
    list(APPEND CPACK_COMPONENTS_ALL lib render)
    # ldconfig's trigger and the shlibs file.
    set(CPACK_DEBIAN_LIB_PACKAGE_GENERATE_SHLIBS ON)
    set(CPACK_DEBIAN_RENDER_PACKAGE_GENERATE_SHLIBS ON)
    set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
endif()
if(TARGET abut_walk)
    list(APPEND CPACK_COMPONENTS_ALL walk)
endif()
if(TARGET abut_mpi)
    list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
if(ABUT_PYTHON)
    list(APPEND CPACK_COMPONENTS_ALL python)
    math(EXPR next "${Python_VERSION_MINOR} + 1")
    string(REPLACE "@python@" "3.${Python_VERSION_MINOR}" CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS}")
    string(REPLACE "@next@" "3.${next}~" CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS}")
endif()
# The licence and the notices, where Debian has them. Programs hold the libraries where these are not shared.
set(linked)
if(NOT ABUT_SHARED)
    set(linked lib render)
endif()
function(abut_package_copyright component name)
    if(component IN_LIST CPACK_COMPONENTS_ALL)
        abut_install_copyright(${component} share/doc/${name} "${ARGN}")
    endif()
endfunction()
abut_package_copyright(lib ${library} lib)
abut_package_copyright(render ${render} render)
abut_package_copyright(dev libabut-dev lib render)
abut_package_copyright(command abut command reader ifc ${linked})
abut_package_copyright(mpi abut-mpi mpi)
abut_package_copyright(walk abut-walk walk ${linked})
abut_package_copyright(python python3-abut python ${linked})
include(CPack)
