# Makes the reference with Doxygen, and finds in it what a reader would look for.
execute_process(COMMAND ${DOXYGEN} ${BUILD_DIR}/Doxyfile.docs WORKING_DIRECTORY ${SOURCE_DIR}
                COMMAND_ERROR_IS_FATAL ANY)
foreach(page_and_text "index.html|public headers" "namespaceregrasp_1_1grasp.html|IsForceClosure"
        "namespaceregrasp_1_1object.html|ReadObject"
        "structregrasp_1_1plan_1_1Plan.html|friction_angle")
  string(REPLACE "|" ";" pair "${page_and_text}")
  list(GET pair 0 page)
  list(GET pair 1 text)
  file(READ ${BUILD_DIR}/reference/html/${page} html)
  if(NOT html MATCHES "${text}")
    message(FATAL_ERROR "${page} does not mention ${text}")
  endif()
endforeach()
