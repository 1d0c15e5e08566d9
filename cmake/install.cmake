# `cmake --install`, and find_package(Abut) or pkg-config after it. Each component is a package:
# package.cmake.
include(CMakePackageConfigHelpers)
set(programs ${CMAKE_INSTALL_LIBEXECDIR}/abut)
set(cmake_files ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)

# Libraries. The linker's link to a shared library (libabut.so) is for developers.
install(TARGETS abut abut_render EXPORT AbutStaticTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(EXPORT AbutStaticTargets NAMESPACE Abut:: DESTINATION ${cmake_files} COMPONENT dev)
if(ABUT_SHARED)
    install(TARGETS abut_shared EXPORT AbutSharedTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            COMPONENT lib NAMELINK_COMPONENT dev)
    install(TARGETS abut_render_shared EXPORT AbutSharedTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            COMPONENT render NAMELINK_COMPONENT dev)
    install(EXPORT AbutSharedTargets NAMESPACE Abut:: DESTINATION ${cmake_files} COMPONENT dev)
endif()
install(DIRECTORY include/abut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

# Programs.
install(TARGETS abut_command DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
# The viewer is left out if it was not built.
if(TARGET abut_walk)
    install(TARGETS abut_walk RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT walk OPTIONAL)
endif()
install(DIRECTORY ${PROJECT_BINARY_DIR}/documents/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT command
        PATTERN "abut-walk.1" EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/documents/bash/abut
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT command)
install(FILES ${PROJECT_BINARY_DIR}/documents/zsh/_abut DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
        COMPONENT command)
if(TARGET abut_walk)
    install(FILES ${PROJECT_BINARY_DIR}/documents/man1/abut-walk.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
            COMPONENT walk OPTIONAL)
    install(FILES ${PROJECT_BINARY_DIR}/documents/bash/abut-walk
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT walk OPTIONAL)
    install(FILES ${PROJECT_BINARY_DIR}/documents/zsh/_abut-walk
            DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT walk OPTIONAL)
endif()
install(TARGETS abut_reader DESTINATION ${programs} COMPONENT command)
if(TARGET abut_mpi)
    install(TARGETS abut_mpi LIBRARY DESTINATION ${programs} COMPONENT mpi)
endif()
install(DIRECTORY src/io/ifc/ DESTINATION ${programs}/ifc COMPONENT command
        FILES_MATCHING PATTERN "*.mjs" PATTERN "package*.json" PATTERN "node_modules" EXCLUDE)
# The run-time modules, if tools/install_dependencies has installed them. This is checked when
# installing, not when configuring.
install(DIRECTORY src/io/ifc/node_modules DESTINATION ${programs}/ifc COMPONENT command OPTIONAL)
install(CODE "if(NOT EXISTS \"${PROJECT_SOURCE_DIR}/src/io/ifc/node_modules/web-ifc\")
    message(STATUS \"Without web-ifc: IFC files will be refused. tools/install_dependencies build gets it.\")
endif()" COMPONENT command)

# The licence and the notices of all. Each Debian package has its own: package.cmake.
abut_install_copyright(notices share/doc/abut "lib;render;command;reader;ifc;mpi;walk" ALWAYS)

# find_package(Abut).
configure_package_config_file(cmake/AbutConfig.cmake.in ${PROJECT_BINARY_DIR}/AbutConfig.cmake
                              INSTALL_DESTINATION ${cmake_files})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AbutConfig.cmake ${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/AbutLibraries.cmake
        DESTINATION ${cmake_files} COMPONENT dev)

# pkg-config. The files find their prefix by their own place, so an installed folder may be moved.
file(RELATIVE_PATH ABUT_UP_TO_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
# What the static libraries need is private, for --static, where shared ones are installed beside them. Where
# there are only static ones, whoever links needs it.
set(ABUT_PC_PRIVATE " -ltbb -lfmt -lhwy -lqhull_r -lmeshoptimizer -lsqlite3 -lzstd -lmetis -lzip -lpugixml -lstdc++ -lm -lpthread")
set(ABUT_PC_RENDER_PRIVATE " -lepoxy -lpng")
if(NOT ABUT_SHARED)
    set(ABUT_PC_NEEDED "${ABUT_PC_PRIVATE}")
    set(ABUT_PC_RENDER_NEEDED "${ABUT_PC_RENDER_PRIVATE}")
    set(ABUT_PC_PRIVATE "")
    set(ABUT_PC_RENDER_PRIVATE "")
endif()
configure_file(cmake/abut.pc.in ${PROJECT_BINARY_DIR}/abut.pc @ONLY)
configure_file(cmake/abut-render.pc.in ${PROJECT_BINARY_DIR}/abut-render.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/abut.pc ${PROJECT_BINARY_DIR}/abut-render.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
