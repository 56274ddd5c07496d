# What the Python module needs: decides whether EMMY_WITH_PYTHON is on.
#
# EMMY_BUILD_PYTHON=AUTO builds the module if all is there, and else says what
# is missing and goes on; ON stops instead. NumPy is needed when the module runs, not
# to build it: pip hides it while it builds.
set(EMMY_WITH_PYTHON OFF)
if(NOT EMMY_BUILD_PYTHON)
  return()
endif()

# Debian's packages belong to Debian's interpreter, which another one may hide
# on PATH. A virtual environment or -DPython_EXECUTABLE says which one is meant.
if(NOT Python_EXECUTABLE AND NOT DEFINED ENV{VIRTUAL_ENV}
   AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
set(_emmy_missing "")
if(NOT Python_FOUND)
  list(APPEND _emmy_missing "Python with headers (python3-dev)")
else()
  if(EMMY_BUILD_PYTHON STREQUAL "AUTO")
    execute_process(COMMAND "${Python_EXECUTABLE}" -c "import numpy"
      RESULT_VARIABLE _emmy_status OUTPUT_QUIET ERROR_QUIET)
    if(NOT _emmy_status EQUAL 0)
      list(APPEND _emmy_missing
        "NumPy for ${Python_EXECUTABLE} (python3-numpy)")
    endif()
  endif()
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(APPEND _emmy_missing "a Python that is built with ${CMAKE_CXX_FLAGS}")
  endif()
  find_package(pybind11 2.10 QUIET)
  if(NOT pybind11_FOUND)
    list(APPEND _emmy_missing "pybind11 (pybind11-dev)")
  endif()
endif()
if(NOT _emmy_missing)
  set(EMMY_WITH_PYTHON ON)
elseif(EMMY_BUILD_PYTHON STREQUAL "AUTO")
  list(JOIN _emmy_missing ", " _emmy_missing)
  message(STATUS "Without the Python module; missing: ${_emmy_missing}")
else()
  list(JOIN _emmy_missing ", " _emmy_missing)
  message(FATAL_ERROR "The Python module cannot be built; missing: ${_emmy_missing}")
endif()
