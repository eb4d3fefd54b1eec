# Compiles through ccache where it is installed and nobody chose a launcher. Paths below the project
# are cached as relative ones, so that every clone on a machine finds what another one compiled.
find_program(REGRASP_CCACHE ccache)
if(PROJECT_IS_TOP_LEVEL AND REGRASP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${REGRASP_CCACHE})
endif()
