# Installs the program, the libraries and their headers, so that find_package(loopcheck) works.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY loopcheck_libraries)
install(TARGETS loopcheck_cli loopcheck_core ${libraries} EXPORT loopcheckTargets)

# command.h, refiner.h and control.h are internal: they need CLI11, OpenSubdiv and OpenMesh.
install(DIRECTORY core reference compare DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/loopcheck
        FILES_MATCHING PATTERN *.h
        PATTERN compare/cli/command.h EXCLUDE
        PATTERN reference/cgal EXCLUDE
        PATTERN reference/openmesh/control.h EXCLUDE
        PATTERN reference/opensubdiv/refiner.h EXCLUDE)

set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/loopcheck)
install(EXPORT loopcheckTargets NAMESPACE loopcheck:: DESTINATION ${destination})
configure_package_config_file(cmake/loopcheckConfig.cmake.in loopcheckConfig.cmake INSTALL_DESTINATION ${destination})
write_basic_package_version_file(loopcheckConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/LoopcheckImports.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/loopcheckConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/loopcheckConfigVersion.cmake
        DESTINATION ${destination})
