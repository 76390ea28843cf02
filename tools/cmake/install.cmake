# find_package(hdem CONFIG) for other projects: hdem::core, hdem::parallel, hdem::io. Headers keep their folders, so a consumer
# writes #include "core/types.h" as the sources here do.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hdem)

install(TARGETS hdem_core hdem_parallel hdem_io EXPORT hdemTargets)
install(DIRECTORY core parallel io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hdem FILES_MATCHING PATTERN "*.h")
install(EXPORT hdemTargets NAMESPACE hdem:: DESTINATION ${package_dir})

configure_package_config_file(tools/cmake/hdemConfig.cmake.in ${PROJECT_BINARY_DIR}/hdemConfig.cmake
    INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hdemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hdemConfig.cmake ${PROJECT_BINARY_DIR}/hdemConfigVersion.cmake DESTINATION ${package_dir})
install(FILES LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
