# Finds everything that the build needs, or stops with a sentence that says which Debian packages have what is missing.
include(LoopcheckImports)

find_package(nlohmann_json QUIET)
loopcheck_need("${nlohmann_json_FOUND}" nlohmann/json nlohmann-json3-dev)

find_package(CLI11 QUIET)
loopcheck_need("${CLI11_FOUND}" CLI11 libcli11-dev)

if(LOOPCHECK_BUILD_TESTS)
    find_package(GTest QUIET)
    loopcheck_need("${GTest_FOUND}" GoogleTest libgtest-dev)
endif()

# loopcheck_optional(OPTION FOUND WHAT PACKAGE): sets OPTION_FOUND; missing and asked for by ON is missing.
macro(loopcheck_optional option found what package)
    set(${option}_FOUND FALSE)
    if(NOT "${${option}}" STREQUAL "OFF")
        set(${option}_FOUND "${found}")
    endif()
    if("${${option}}" STREQUAL "ON")
        loopcheck_need("${found}" "${what} (${option}=ON)" ${package})
    endif()
endmacro()

loopcheck_import(openmesh OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh OpenMeshCore)
loopcheck_optional(LOOPCHECK_OPENMESH ${openmesh_found} OpenMesh libopenmesh-dev)

find_package(benchmark QUIET)
loopcheck_optional(LOOPCHECK_BENCH "${benchmark_FOUND}" "Google Benchmark" libbenchmark-dev)
if(LOOPCHECK_BENCH STREQUAL "AUTO" AND NOT PROJECT_IS_TOP_LEVEL)
    set(LOOPCHECK_BENCH_FOUND FALSE)
endif()

# A peer in the benchmarks.  What they use of it are headers; its own package would bring GMP and more flags.
find_path(LOOPCHECK_CGAL_INCLUDE CGAL/subdivision_method_3.h)
mark_as_advanced(LOOPCHECK_CGAL_INCLUDE)
set(cgal_found FALSE)
if(LOOPCHECK_CGAL_INCLUDE)
    set(cgal_found TRUE)
endif()
loopcheck_optional(LOOPCHECK_CGAL ${cgal_found} CGAL libcgal-dev)

include(LoopcheckHtml)

if(loopcheck_missing)
    loopcheck_sentence(sentence)
    message(FATAL_ERROR "${sentence}")
endif()
