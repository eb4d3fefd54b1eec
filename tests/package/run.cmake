# Installs the build into a scratch prefix, then builds and runs the consumer from it, by find_package
# and by pkg-config.

# run(COMMAND...): it must succeed; what it prints is left in `output`.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Debug
    -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_PREFIX_PATH=${prefix}
    -DREGRASP_INCLUDE=${prefix}/include/regrasp)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer ${MODEL})
# The examples, each with a result that is known.
foreach(example cpp planner)
  run(${CMAKE_COMMAND} -S ${EXAMPLES_DIR}/${example} -B ${WORK_DIR}/${example} -G Ninja -DCMAKE_BUILD_TYPE=Debug
      -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_PREFIX_PATH=${prefix})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${example})
endforeach()
run(${WORK_DIR}/cpp/plan_and_validate ${MODEL})
run(${WORK_DIR}/cpp/force_closure 2000)
if(NOT output MATCHES "friction angle 30 deg: [1-9][0-9]* of 2000")
  message(FATAL_ERROR "examples/cpp/force_closure: ${output}")
endif()
cmake_path(GET MODEL PARENT_PATH models)
run(${WORK_DIR}/cpp/rotate_in_hand ${models}/hands/ring4.json ${MODEL} 0.8 30)
run(${WORK_DIR}/planner/exchange_planner ${MODEL} 1)
foreach(program regrasp plan validate graph figure repair hand)
  run(${prefix}/bin/${program} --version)
  foreach(text man/man1/${program}.1.gz bash-completion/completions/${program}
          zsh/site-functions/_${program} fish/vendor_completions.d/${program}.fish)
    if(NOT EXISTS ${prefix}/share/${text})
      message(FATAL_ERROR "share/${text} is not installed")
    endif()
  endforeach()
endforeach()

# What the headers and the consumer include, down to the system's headers.
run(ninja -C ${WORK_DIR}/build -t deps)
if(NOT output MATCHES "/Eigen/Core" OR NOT output MATCHES "alone/planner/grasp/force_closure.h.cc")
  message(FATAL_ERROR "not all includes are known:\n${output}")
endif()
string(REGEX MATCHALL "[^\n]*/(CGAL|gmp|gmpxx|mpfr|mujoco|GL|nlohmann)[/.][^\n]*" private "${output}")
if(private)
  message(FATAL_ERROR "public headers include those of other libraries: ${private}")
endif()

file(GLOB_RECURSE package_files ${prefix}/*/regrasp.pc)
cmake_path(GET package_files PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})
run(pkg-config --cflags --libs regrasp)
separate_arguments(flags UNIX_COMMAND "${CXX_FLAGS} ${output}")
list(PREPEND flags -std=c++20 ${CONSUMER_DIR}/main.cc -o ${WORK_DIR}/by_pkg_config)
run(${CXX} ${flags})
run(${WORK_DIR}/by_pkg_config ${MODEL})
