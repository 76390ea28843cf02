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

# What users of the program read and copy. The cases stand in folders like those of the sources, so that commands of the guide run in a copy.
set(examples ${CMAKE_INSTALL_DOCDIR}/examples)
install(FILES CITATION.cff io/hdf5_format.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(DIRECTORY verification/cases DESTINATION ${examples}/verification COMPONENT documents)
install(DIRECTORY tools/guide/cases DESTINATION ${examples}/tools/guide COMPONENT documents)
install(DIRECTORY tools/python/examples DESTINATION ${examples}/tools/python COMPONENT documents FILES_MATCHING PATTERN "*.py")
install(FILES tools/sweep.slurm tools/sweep_many.slurm DESTINATION ${examples}/tools COMPONENT documents)
install(FILES core/joint/hdem_joint_law.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hdem/core/joint COMPONENT documents)    # for laws in shared libraries
