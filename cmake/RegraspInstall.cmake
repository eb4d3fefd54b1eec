# Installs libraries, headers, programs and models, so that find_package(regrasp) works.
include(CMakePackageConfigHelpers)

get_property(regrasp_libraries GLOBAL PROPERTY REGRASP_LIBRARIES)
install(TARGETS regrasp_options ${regrasp_libraries} EXPORT regraspTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY planner sim render report DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regrasp
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY apps/batch DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regrasp/apps
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY models scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/regrasp)
install(EXPORT regraspTargets NAMESPACE regrasp::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp)
configure_package_config_file(cmake/regraspConfig.cmake.in regraspConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp)
write_basic_package_version_file(regraspConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/regraspConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/regraspConfigVersion.cmake
              cmake/FindGlpk.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp)
