# What every target of the project shares.

option(REGRASP_UNITY "Compile several sources of a folder as one translation unit" ON)
# Bytes of source per translation unit. Headers cost 2 to 5 s per unit, so small units are slow to build
# from scratch and large units are slow to rebuild after a change.
set(REGRASP_UNIT_SIZE 100000 CACHE STRING "Bytes of source per translation unit")
# Faster to rebuild while you edit these; the names are those of regrasp_library and regrasp_tests.
set(REGRASP_SEPARATE "" CACHE STRING "Targets to compile file by file, for example gait;gait_test")

add_library(regrasp_options INTERFACE)
# No fused multiply-add: results must be the same bits on every x86-64 machine.
target_compile_options(regrasp_options INTERFACE -ffp-contract=off)
target_compile_options(regrasp_options INTERFACE
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wpedantic>)
# GCC 12 sees overlaps in std::string that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(regrasp_options INTERFACE $<BUILD_INTERFACE:-Wno-restrict>)
endif()
# In a unit of several sources GCC takes a class that is defined in a source for one of a header.
if(REGRASP_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(regrasp_options INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage>)
endif()
if(REGRASP_WARNINGS_AS_ERRORS)
  target_compile_options(regrasp_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
target_compile_features(regrasp_options INTERFACE cxx_std_20)
target_include_directories(regrasp_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/regrasp>)

# regrasp_sources(OUT NAME SOURCE...): what to compile for the absolute paths SOURCE of target NAME. With
# REGRASP_UNITY these are files in the build folder that include about REGRASP_UNIT_SIZE bytes of
# sources each, by paths relative to the project so that all clones share a compiler cache. CMake's own
# UNITY_BUILD counts files instead of bytes and writes absolute paths.
function(regrasp_sources out name)
  if(NOT REGRASP_UNITY OR name IN_LIST REGRASP_SEPARATE)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(units "")
  set(text "")
  set(bytes 0)
  set(number 0)
  list(GET ARGN -1 last)
  foreach(source IN LISTS ARGN)
    file(SIZE ${source} size)
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${source})
    string(APPEND text "#include \"${path}\"\n")
    math(EXPR bytes "${bytes} + ${size}")
    if(bytes GREATER_EQUAL REGRASP_UNIT_SIZE OR source STREQUAL last)
      set(unit ${CMAKE_CURRENT_BINARY_DIR}/${name}_${number}.cc)
      file(CONFIGURE OUTPUT ${unit} CONTENT "${text}" @ONLY)
      list(APPEND units ${unit})
      math(EXPR number "${number} + 1")
      set(text "")
      set(bytes 0)
    endif()
  endforeach()
  set(${out} ${units} PARENT_SCOPE)
endfunction()

# regrasp_library(NAME [PUBLIC lib...] [PRIVATE lib...])
#
# One folder, one static library `regrasp_NAME` (exported as regrasp::NAME) of all its *.cc.
# A folder can only link what it lists, so dependencies point downwards or the link fails.
function(regrasp_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  regrasp_sources(units ${name} ${sources})
  add_library(regrasp_${name} STATIC ${units})
  add_library(regrasp::${name} ALIAS regrasp_${name})
  set_target_properties(regrasp_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(regrasp_${name} PUBLIC regrasp_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY REGRASP_LIBRARIES regrasp_${name})
endfunction()

# regrasp_package(NAME lib...)
#
# The folders of a folder together: an interface library `regrasp_NAME` (exported as regrasp::NAME).
function(regrasp_package name)
  add_library(regrasp_${name} INTERFACE)
  add_library(regrasp::${name} ALIAS regrasp_${name})
  set_target_properties(regrasp_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(regrasp_${name} INTERFACE ${ARGN})
  set_property(GLOBAL APPEND PROPERTY REGRASP_LIBRARIES regrasp_${name})
endfunction()

# regrasp_label(TEST...): each is labelled fast, or slow where tests/slow_tests.cmake names it.
function(regrasp_label)
  foreach(test IN LISTS ARGN)
    set(label fast)
    if(test IN_LIST regrasp_slow_tests)
      set(label slow)
    endif()
    set_property(TEST ${test} APPEND PROPERTY LABELS ${label})
  endforeach()
endfunction()

# regrasp_find_tests(TARGET PACKAGE): the tests of an executable, found by ctest, each with its label.
function(regrasp_find_tests target package)
  list(JOIN regrasp_slow_tests ":" slow)
  gtest_discover_tests(${target} TEST_PREFIX "${package}." DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
                       TEST_FILTER "${slow}" PROPERTIES TIMEOUT 900 LABELS slow)
  gtest_discover_tests(${target} TEST_PREFIX "${package}." DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
                       TEST_FILTER "-${slow}" PROPERTIES TIMEOUT 900 LABELS fast)
endfunction()

# regrasp_tests(NAME [lib...]): one executable of the folder's *_test.cc.
function(regrasp_tests name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  if(NOT sources)
    return()
  endif()
  regrasp_sources(units ${name}_test ${sources})
  add_executable(${name}_test ${units})
  target_link_libraries(${name}_test PRIVATE ${ARGN} regrasp_project_path GTest::gtest_main
                        GTest::gmock)
  regrasp_find_tests(${name}_test ${name})
endfunction()
