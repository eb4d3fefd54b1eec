# ODE, the second engine of replays, comes without CMake files: the target ODE::ODE. Forces are compared to a
# millionth, so that it has to be built for doubles, as Debian's is.
if(NOT TARGET ODE::ODE)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(ode IMPORTED_TARGET ode>=0.16)
  if(NOT ode_FOUND)
    message(FATAL_ERROR "ODE 0.16 or later is missing, the second physics engine of validate (--engine ode): "
                        "install Debian's libode-dev (scripts/setup does)")
  endif()
  add_library(ODE::ODE ALIAS PkgConfig::ode)
endif()
