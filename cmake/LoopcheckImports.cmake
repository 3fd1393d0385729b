# The libraries that ours are linked with, found alike by the build and by the installed package.

# loopcheck_need(FOUND WHAT PACKAGE): unless FOUND is true, notes WHAT and the Debian PACKAGE that has it as missing.
macro(loopcheck_need found what package)
    if(NOT "${found}")
        list(APPEND loopcheck_missing "${what}")
        list(APPEND loopcheck_missing_packages "${package}")
    endif()
endmacro()

# loopcheck_sentence(OUT): what is missing and how to get it.
function(loopcheck_sentence out)
    list(JOIN loopcheck_missing ", " what)
    list(JOIN loopcheck_missing_packages " " packages)
    set(${out} "loopcheck needs ${what}; on Debian: apt-get install ${packages}" PARENT_SCOPE)
endfunction()

# loopcheck_import(NAME HEADER LIBRARY): looks for one header and one library, sets NAME_found and makes the
# target loopcheck_NAME_import of them.
macro(loopcheck_import name header library)
    string(TOUPPER LOOPCHECK_${name} loopcheck_prefix)
    find_path(${loopcheck_prefix}_INCLUDE ${header})
    find_library(${loopcheck_prefix}_LIBRARY NAMES ${library})
    mark_as_advanced(${loopcheck_prefix}_INCLUDE ${loopcheck_prefix}_LIBRARY)
    set(${name}_found FALSE)
    if(${loopcheck_prefix}_INCLUDE AND ${loopcheck_prefix}_LIBRARY)
        set(${name}_found TRUE)
        if(NOT TARGET loopcheck_${name}_import)
            add_library(loopcheck_${name}_import INTERFACE IMPORTED)
            target_include_directories(loopcheck_${name}_import INTERFACE ${${loopcheck_prefix}_INCLUDE})
            target_link_libraries(loopcheck_${name}_import INTERFACE ${${loopcheck_prefix}_LIBRARY})
        endif()
    endif()
endmacro()

set(loopcheck_missing "")
set(loopcheck_missing_packages "")

find_package(glm QUIET)
loopcheck_need("${glm_FOUND}" GLM libglm-dev)

find_package(tl-expected QUIET)
loopcheck_need("${tl-expected_FOUND}" tl::expected libexpected-dev)

find_package(fmt QUIET)
loopcheck_need("${fmt_FOUND}" {fmt} libfmt-dev)

find_package(Boost 1.74 QUIET)
loopcheck_need("${Boost_FOUND}" "Boost's headers" libboost-dev)

find_package(ZLIB QUIET)
loopcheck_need("${ZLIB_FOUND}" zlib zlib1g-dev)

find_package(TBB QUIET)
loopcheck_need("${TBB_FOUND}" oneTBB libtbb-dev)

find_package(Threads QUIET)
loopcheck_need("${Threads_FOUND}" "a threads library" libc6-dev)

# Debian's CMake package of OpenSubdiv names a static library that Debian does not ship, so that loading it is an error
# that cannot be caught.
loopcheck_import(opensubdiv opensubdiv/version.h osdCPU)
loopcheck_need(${opensubdiv_found} "OpenSubdiv 3.5" libosd-dev)
