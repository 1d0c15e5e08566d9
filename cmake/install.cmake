# find_package(Abut) after `cmake --install`.
include(CMakePackageConfigHelpers)
install(TARGETS abut EXPORT AbutTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS abut_command DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS abut_reader DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut)
if(TARGET abut_mpi)
    install(TARGETS abut_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut)
endif()
install(FILES src/io/ifc/convert.mjs src/io/ifc/package.json src/io/ifc/package-lock.json
        DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/abut/ifc)
install(DIRECTORY include/abut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT AbutTargets NAMESPACE Abut:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
configure_package_config_file(cmake/AbutConfig.cmake.in ${PROJECT_BINARY_DIR}/AbutConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AbutConfig.cmake ${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
