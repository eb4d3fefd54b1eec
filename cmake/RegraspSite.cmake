# The target `site`: all documents as pages, in site/ of the build folder. mkdocs is among the packages
# of scripts/setup --dev; without it there is no such target.
find_program(MKDOCS mkdocs)
if(NOT MKDOCS)
  return()
endif()
add_custom_target(site
  COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${MKDOCS} build --quiet --strict --clean
    --config-file ${PROJECT_SOURCE_DIR}/mkdocs.yml --site-dir ${PROJECT_BINARY_DIR}/site
  COMMENT "Documents as pages in ${PROJECT_BINARY_DIR}/site" VERBATIM)
