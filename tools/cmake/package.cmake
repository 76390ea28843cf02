# The Debian package: `cpack` in a build folder makes hdem_VERSION_ARCHITECTURE.deb there, in the shape of an installation below /usr.
# The C++ library is left out: its archives are static, for one compiler and its options. Who builds programs on it installs it from the sources.
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME hdem)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "discrete element method for jointed rock in two dimensions")
set(CPACK_PACKAGE_DESCRIPTION "hdem computes rock as rigid polygonal blocks that joints cut out of it.
It makes the blocks from joint sets or mapped traces, excavates, loads or
shakes them, and tells which blocks come loose, how far the others move,
what joints, bolts and shotcrete carry, and the factor of safety.
.
At every contact it chooses between springs with friction and impulses
(hybrid discrete element method). A case is one text file. Results have the
same bits on any number of threads.
.
The package holds the program, its pictures and pages, the Python module
hdem, the guide and example cases.")
set(CPACK_COMPONENTS_ALL program python documents)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Who made it, as Debian's own tools ask for it: DEBEMAIL="name@host" DEBFULLNAME="Name".
set(CPACK_PACKAGE_CONTACT "The hdem developers <hdem@localhost>")
if(DEFINED ENV{DEBEMAIL} AND DEFINED ENV{DEBFULLNAME})
    set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/tools/package/postinst;${PROJECT_SOURCE_DIR}/tools/package/prerm")

# Libraries by what the programs are linked to. The module is for the version of Python that it was built with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
string(REPLACE "3." "" minor "${HDEM_PYTHON_VERSION}")
math(EXPR next_minor "0${minor} + 1")
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS
    "python3 (>= 3.${minor})" "python3 (<< 3.${next_minor})" python3-h5py python3-matplotlib python3-numpy)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-ezdxf, python3-scipy")    # drawings; random designs and the limits of shares
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, paraview")                  # hdem view --movie; frames

# What a package for other machines must not be made of, for tools/package/ready.cmake: known here, refused when cpack runs.
set(CPACK_HDEM_PROBLEMS "")
if(HDEM_NATIVE OR "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}" MATCHES "-march=|-mcpu=")
    list(APPEND CPACK_HDEM_PROBLEMS "the build is tuned to this machine (HDEM_NATIVE or -march): its program may not run on another one")
endif()
if(NOT CMAKE_BUILD_TYPE STREQUAL "Release" OR HDEM_SANITIZE OR HDEM_CHECKS)
    list(APPEND CPACK_HDEM_PROBLEMS "the build is one for tests (CMAKE_BUILD_TYPE is not Release, or it has sanitizers or contracts)")
endif()
if(NOT TARGET hdem_python)
    list(APPEND CPACK_HDEM_PROBLEMS "the Python module is not built: it needs pybind11-dev and python3-dev")
endif()
if(NOT HELP2MAN)
    list(APPEND CPACK_HDEM_PROBLEMS "the man page is not built: it needs help2man")
endif()
if(NOT HDEM_OPENMP)
    list(APPEND CPACK_HDEM_PROBLEMS "the program runs on one thread only (HDEM_OPENMP is OFF)")
endif()
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/tools/package/ready.cmake)

# What Debian wants otherwise than cmake --install leaves it, and the guide.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/tools/package/debian_tree.cmake)
set(CPACK_HDEM_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_HDEM_BUILD ${PROJECT_BINARY_DIR})
set(CPACK_HDEM_DOCUMENTS ${CMAKE_INSTALL_DOCDIR})
set(CPACK_HDEM_PYTHON_FOLDER ${HDEM_PYTHON_FOLDER})

include(CPack)
