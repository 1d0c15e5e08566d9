# Supports find_package(Abut) after `cmake --install`.
include(CMakePackageConfigHelpers)
install(TARGETS abut abut_render EXPORT AbutTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS abut_command DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET abut_walk)
    install(TARGETS abut_walk DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${PROJECT_BINARY_DIR}/documents/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${PROJECT_BINARY_DIR}/documents/bash/abut
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${PROJECT_BINARY_DIR}/documents/zsh/_abut DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(TARGETS abut_reader DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut)
if(TARGET abut_mpi)
    install(TARGETS abut_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut)
endif()
install(DIRECTORY src/io/ifc/ DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut/ifc
        FILES_MATCHING PATTERN "*.mjs" PATTERN "package*.json" PATTERN "node_modules" EXCLUDE)
# The run-time modules, if tools/install_dependencies has installed them. This is checked when
# installing, not when configuring.
install(DIRECTORY src/io/ifc/node_modules DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut/ifc OPTIONAL)
install(CODE "if(NOT EXISTS \"${PROJECT_SOURCE_DIR}/src/io/ifc/node_modules/web-ifc\")
    message(STATUS \"Without web-ifc: IFC files will be refused. tools/install_dependencies build gets it.\")
endif()")
install(DIRECTORY include/abut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT AbutTargets NAMESPACE Abut:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
configure_package_config_file(cmake/AbutConfig.cmake.in ${PROJECT_BINARY_DIR}/AbutConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AbutConfig.cmake ${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
