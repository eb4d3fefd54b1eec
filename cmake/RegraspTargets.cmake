# What every target of the project shares.

add_library(regrasp_options INTERFACE)
# No fused multiply-add: results must be the same bits on every x86-64 machine.
target_compile_options(regrasp_options INTERFACE -ffp-contract=off)
target_compile_options(regrasp_options INTERFACE
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wpedantic>)
# GCC 12 sees overlaps in std::string that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(regrasp_options INTERFACE $<BUILD_INTERFACE:-Wno-restrict>)
endif()
if(REGRASP_WARNINGS_AS_ERRORS)
  target_compile_options(regrasp_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
target_compile_features(regrasp_options INTERFACE cxx_std_20)
target_include_directories(regrasp_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/regrasp>)

# regrasp_library(NAME [PUBLIC lib...] [PRIVATE lib...])
#
# One folder, one static library `regrasp_NAME` (exported as regrasp::NAME) of all its *.cc.
# A folder can only link what it lists, so dependencies point downwards or the link fails.
function(regrasp_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  add_library(regrasp_${name} STATIC ${sources})
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
  add_executable(${name}_test ${sources})
  target_link_libraries(${name}_test PRIVATE ${ARGN} regrasp_project_path GTest::gtest_main
                        GTest::gmock)
  regrasp_find_tests(${name}_test ${name})
endfunction()
