# How every target of this project is compiled.  Interface targets, so that nothing leaks to those who link us.

# Includes are written from the root of the repository: "core/loop/weights.h".
add_library(loopcheck_build INTERFACE)
target_compile_features(loopcheck_build INTERFACE cxx_std_20)

# Same input, same bits: no contraction into fused multiply-add, no fast-math.  The numbers are wrong otherwise.
target_compile_options(loopcheck_build INTERFACE -ffp-contract=off)

# GCC 12 takes (double)(float)x for x where it vectorises two neighbouring coordinates (seen in 12.2 from -O2 on, by the
# test that every control vertex in float is within its bound): not with this.
target_compile_options(loopcheck_build INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

option(LOOPCHECK_WERROR "Treat warnings as errors" OFF)
target_compile_options(loopcheck_build INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wdouble-promotion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 warns of its own std::string operator+ (GCC bug 105651)
    $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>     # of vectors of 32 bytes, which only inlined functions pass
    $<$<BOOL:${LOOPCHECK_WERROR}>:-Werror>)

set(LOOPCHECK_SANITIZE "" CACHE STRING "Sanitizers to build with, for instance address,undefined")
if(LOOPCHECK_SANITIZE)
    target_compile_options(loopcheck_build INTERFACE
        -fsanitize=${LOOPCHECK_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
        -Wno-maybe-uninitialized)  # the checks confuse the warning
    target_link_options(loopcheck_build INTERFACE -fsanitize=${LOOPCHECK_SANITIZE})
endif()

# Most of the time to compile from nothing goes into the same headers and the same instances of Boost.Multiprecision.
# The preset `release` does without this, so that a missing include still shows where scripts/validate builds.
option(LOOPCHECK_PRECOMPILE "Precompile the large headers, and compile some sources together: for builds from nothing" OFF)
if(LOOPCHECK_PRECOMPILE)
    # The three that char_traits.h turns off for itself: GCC forgets such pragmas in a precompiled header.
    target_compile_options(loopcheck_build INTERFACE
        "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>")
endif()

# loopcheck_precompile(NAME OWNER HEADER...): precompiles the headers for the target OWNER, and lets NAME use them too.
function(loopcheck_precompile name owner)
    if(NOT LOOPCHECK_PRECOMPILE)
        return()
    elseif(name STREQUAL owner)
        target_precompile_headers(${name} PRIVATE ${ARGN})
    else()
        target_precompile_headers(${name} REUSE_FROM ${owner})
    endif()
endfunction()

# loopcheck_library(NAME SOURCE...) makes the static library loopcheck_NAME, alias loopcheck::NAME, to be installed.
function(loopcheck_library name)
    add_library(loopcheck_${name} STATIC ${ARGN})
    add_library(loopcheck::${name} ALIAS loopcheck_${name})
    set_target_properties(loopcheck_${name} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF)
    set_property(GLOBAL APPEND PROPERTY loopcheck_libraries loopcheck_${name})
    target_compile_features(loopcheck_${name} PUBLIC cxx_std_20)
    target_link_libraries(loopcheck_${name} PRIVATE $<BUILD_INTERFACE:loopcheck_build>)
    target_include_directories(loopcheck_${name} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/loopcheck>)
    loopcheck_precompile(loopcheck_${name} loopcheck_mesh
        <boost/multiprecision/cpp_bin_float.hpp> <boost/multiprecision/cpp_int.hpp> <fmt/format.h>
        <algorithm> <filesystem> <functional> <map> <vector>)
endfunction()
