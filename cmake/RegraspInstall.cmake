# Installs libraries, the public headers, programs and models, so that find_package(regrasp) and
# pkg-config find them. The component `programs` is what its users need, `dev` what links the
# libraries: each is a package (RegraspPackages.cmake).
include(CMakePackageConfigHelpers)

get_property(regrasp_libraries GLOBAL PROPERTY REGRASP_LIBRARIES)
list(TRANSFORM regrasp_private_libraries PREPEND regrasp_)
list(REMOVE_ITEM regrasp_libraries ${regrasp_private_libraries})
install(TARGETS regrasp_options ${regrasp_libraries} EXPORT regraspTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
foreach(header IN LISTS regrasp_public_headers)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/regrasp/${folder}
          COMPONENT dev)
endforeach()
install(DIRECTORY models scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/regrasp COMPONENT programs)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
install(EXPORT regraspTargets NAMESPACE regrasp::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp COMPONENT dev)
configure_package_config_file(cmake/regraspConfig.cmake.in regraspConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp)
write_basic_package_version_file(regraspConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/regraspConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/regraspConfigVersion.cmake
              cmake/FindGlpk.cmake cmake/FindOde.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/regrasp COMPONENT dev)

# The libraries for pkg-config: a linker takes them from above to below.
set(REGRASP_LINK "")
foreach(library IN LISTS regrasp_libraries)
  get_target_property(type ${library} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    string(PREPEND REGRASP_LINK "-l${library} ")
  endif()
endforeach()
file(RELATIVE_PATH REGRASP_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" REGRASP_PREFIX "${REGRASP_PREFIX}")
configure_file(cmake/regrasp.pc.in regrasp.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/regrasp.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
