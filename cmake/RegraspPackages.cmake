# Debian packages, which `cpack` makes in the build folder: regrasp (programs, manual pages,
# completions, models, documents), libregrasp-dev, and python3-regrasp where the Python module is
# built. Shared libraries that programs link are found by dpkg-shlibdeps.
set(packages_programs regrasp)
set(packages_dev libregrasp-dev)
set(packages_python python3-regrasp)
set(CPACK_COMPONENTS_ALL programs dev)
if(TARGET regrasp_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

# What Debian asks of every package: who may copy it, and what changed.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/package)
configure_file(cmake/copyright.in ${folder}/copyright @ONLY)
configure_file(cmake/changelog.in ${folder}/changelog @ONLY)
execute_process(COMMAND ${GZIP} -9nf ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  install(FILES ${folder}/copyright ${folder}/changelog.gz COMPONENT ${component} EXCLUDE_FROM_ALL
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${packages_${component}})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${packages_${component}})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The regrasp developers <regrasp@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "planner and validator of regrasps by a hand's fingertips")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "Programs that find sequences of finger placements and releases from one grasp of an object
to another, with force closure held at every instant, and validate them: analytically, by a
replay in MuJoCo or the Open Dynamics Engine, and with pictures.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
# Libraries that are loaded at their first use (planner/base/shared_library.h).
set(loaded "libosmesa6, libavcodec59, libavformat59, libavutil57")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS ${loaded})
# plotutils has a program `graph`, too, and rcs a program `merge`.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONFLICTS "plotutils, rcs")

set(CPACK_COMPONENT_DEV_DESCRIPTION
    "Static libraries, headers, and files for CMake and pkg-config.")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# What regraspConfig.cmake and regrasp.pc ask for; MuJoCo's CMake files ask for OpenGL, and its
# package does not.
set(used libassimp-dev libcgal-dev libeigen3-dev libexpat1-dev libgl-dev libglpk-dev libgmp-dev libminizip-dev
    libmpfr-dev libmujoco-dev libode-dev libopengl-dev libqhull-dev libssl-dev nlohmann-json3-dev)
list(JOIN used ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)

set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The Python module regrasp, for NumPy arrays and notebooks.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-yaml, ${loaded}")
# Its byte code is made when it is installed and removed with it.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${folder}/postinst ${folder}/prerm)
configure_file(cmake/python-postinst ${folder}/postinst COPYONLY FILE_PERMISSIONS
               OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
configure_file(cmake/python-prerm ${folder}/prerm COPYONLY FILE_PERMISSIONS
               OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
