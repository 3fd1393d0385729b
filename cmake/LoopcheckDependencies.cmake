# Finds everything the project needs, and says which Debian package has what is missing.

# loopcheck_require(WHAT PACKAGE FOUND): stops with one sentence unless FOUND is true.
function(loopcheck_require what package found)
    if(NOT found)
        message(FATAL_ERROR "loopcheck needs ${what}; on Debian: apt-get install ${package}")
    endif()
endfunction()

find_package(glm QUIET)
if(NOT TARGET glm::glm)
    loopcheck_require("GLM" libglm-dev FALSE)
endif()

find_package(tl-expected QUIET)
loopcheck_require("tl::expected" libexpected-dev "${tl-expected_FOUND}")

find_package(fmt QUIET)
loopcheck_require("{fmt}" libfmt-dev "${fmt_FOUND}")

find_package(Boost 1.74 QUIET)
loopcheck_require("the Boost headers (Multiprecision)" libboost-dev "${Boost_FOUND}")

find_package(nlohmann_json QUIET)
loopcheck_require("nlohmann/json" nlohmann-json3-dev "${nlohmann_json_FOUND}")

find_package(CLI11 QUIET)
loopcheck_require("CLI11" libcli11-dev "${CLI11_FOUND}")

find_package(Threads REQUIRED)

# OpenSubdiv.  Debian's CMake package names a static library that Debian does not ship, so loading it is an error
# that cannot be caught: look for the header and the one library we need instead.
find_path(LOOPCHECK_OPENSUBDIV_INCLUDE opensubdiv/version.h)
find_library(LOOPCHECK_OPENSUBDIV_LIBRARY NAMES osdCPU)
mark_as_advanced(LOOPCHECK_OPENSUBDIV_INCLUDE LOOPCHECK_OPENSUBDIV_LIBRARY)
if(LOOPCHECK_OPENSUBDIV_INCLUDE AND LOOPCHECK_OPENSUBDIV_LIBRARY)
    add_library(loopcheck_opensubdiv_import INTERFACE)
    target_include_directories(loopcheck_opensubdiv_import SYSTEM INTERFACE ${LOOPCHECK_OPENSUBDIV_INCLUDE})
    target_link_libraries(loopcheck_opensubdiv_import INTERFACE ${LOOPCHECK_OPENSUBDIV_LIBRARY})
else()
    loopcheck_require("OpenSubdiv 3.5" libosd-dev FALSE)
endif()

# loopcheck_optional(OPTION FOUND WHAT PACKAGE): sets OPTION_FOUND from AUTO, ON or OFF.
macro(loopcheck_optional option found what package)
    set(${option}_FOUND ${found})
    if("${${option}}" STREQUAL "OFF")
        set(${option}_FOUND FALSE)
    elseif("${${option}}" STREQUAL "ON")
        loopcheck_require("${what}, asked for by ${option}=ON," ${package} "${found}")
    endif()
endmacro()

find_path(LOOPCHECK_OPENMESH_INCLUDE OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh)
find_library(LOOPCHECK_OPENMESH_LIBRARY NAMES OpenMeshCore)
mark_as_advanced(LOOPCHECK_OPENMESH_INCLUDE LOOPCHECK_OPENMESH_LIBRARY)
if(LOOPCHECK_OPENMESH_INCLUDE AND LOOPCHECK_OPENMESH_LIBRARY)
    loopcheck_optional(LOOPCHECK_OPENMESH TRUE "OpenMesh" libopenmesh-dev)
else()
    loopcheck_optional(LOOPCHECK_OPENMESH FALSE "OpenMesh" libopenmesh-dev)
endif()
if(LOOPCHECK_OPENMESH_FOUND)
    add_library(loopcheck_openmesh_import INTERFACE)
    target_include_directories(loopcheck_openmesh_import SYSTEM INTERFACE ${LOOPCHECK_OPENMESH_INCLUDE})
    target_link_libraries(loopcheck_openmesh_import INTERFACE ${LOOPCHECK_OPENMESH_LIBRARY})
endif()

find_package(benchmark QUIET)
if(benchmark_FOUND AND (PROJECT_IS_TOP_LEVEL OR "${LOOPCHECK_BENCH}" STREQUAL "ON"))
    loopcheck_optional(LOOPCHECK_BENCH TRUE "Google Benchmark" libbenchmark-dev)
else()
    loopcheck_optional(LOOPCHECK_BENCH FALSE "Google Benchmark" libbenchmark-dev)
endif()

if(LOOPCHECK_BUILD_TESTS)
    find_package(GTest QUIET)
    loopcheck_require("GoogleTest" libgtest-dev "${GTest_FOUND}")
endif()
