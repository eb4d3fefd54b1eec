# The target `docs`: the reference of the public headers, as pages in reference/html of the build
# folder. Doxygen is among the packages of scripts/setup --dev; without it there is no such target.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/reference)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
# Docstrings name only the parameters that the types do not tell all about.
set(DOXYGEN_WARNINGS NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_STRIP_FROM_INC_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE docs/reference.md)
doxygen_add_docs(docs docs/reference.md ${regrasp_public_headers})
