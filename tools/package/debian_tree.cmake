# Run by cpack on the installed tree, before it is packed: what Debian wants otherwise than cmake --install leaves it, and the guide.
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/ALL_COMPONENTS_IN_ONE/usr)
set(documents ${root}/${CPACK_HDEM_DOCUMENTS})

function(step)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Debian's python3 finds modules of packages here, whatever its version.
set(modules lib/python3/dist-packages)
if(NOT CPACK_HDEM_PYTHON_FOLDER STREQUAL modules)
    file(MAKE_DIRECTORY ${root}/${modules})
    file(RENAME ${root}/${CPACK_HDEM_PYTHON_FOLDER}/hdem ${root}/${modules}/hdem)
    step(rmdir --parents --ignore-fail-on-non-empty ${root}/${CPACK_HDEM_PYTHON_FOLDER})
endif()

step(gzip --best --no-name ${root}/share/man/man1/hdem.1 ${root}/share/man/man1/hdem-sweep.1)

# Why lintian need not warn of the fonts.
file(WRITE ${root}/share/lintian/overrides/hdem
    "# The guide is opened from the disk, also where no other package brings its fonts.\n"
    "hdem: duplicate-font-file *\n")

# HTML where mkdocs is; else its pages as they are written.
set(guide ${CPACK_HDEM_SOURCE}/tools/guide)
find_program(MKDOCS mkdocs)
if(MKDOCS AND EXISTS /usr/share/javascript/katex AND EXISTS /usr/share/mkdocs/themes/material)
    step(${guide}/build ${documents}/guide)
    file(REMOVE ${documents}/guide/sitemap.xml ${documents}/guide/sitemap.xml.gz)    # for search engines, and with the time of packing
    set(of_guide libjs-katex mkdocs-material)
else()
    message(STATUS "the guide is packed as Markdown: tools/setup --guide installs what makes HTML of it")
    file(COPY ${guide}/docs/ DESTINATION ${documents}/guide)
    file(GLOB pages ${documents}/guide/*.md)
    foreach(page ${pages})    # mkdocs would put in the files that they include
        file(READ ${page} text)
        string(REGEX MATCHALL "--8<-- \"[^\"]+\"" lines "${text}")
        foreach(line ${lines})
            string(REGEX REPLACE "^--8<-- \"(.*)\"$" "\\1" included "${line}")
            file(READ ${CPACK_HDEM_SOURCE}/${included} part)
            string(REPLACE "${line}" "${part}" text "${text}")
        endforeach()
        file(WRITE ${page} "${text}")
    endforeach()
endif()

# Licences of what is compiled in, as the packages that it comes from say.
file(COPY ${CPACK_HDEM_SOURCE}/tools/package/copyright DESTINATION ${documents})
foreach(package libboost-dev libcli11-dev libeigen3-dev libfmt-dev libtomlplusplus-dev libxxhash-dev nlohmann-json3-dev pybind11-dev ${of_guide})
    file(READ /usr/share/doc/${package}/copyright text)
    file(APPEND ${documents}/copyright "\n\n---- Debian's ${package} ----\n\n${text}")
endforeach()

# The package's own log points to that of hdem, and has the day of the release from there.
file(READ ${CPACK_HDEM_SOURCE}/CHANGELOG.md changes)
string(REPLACE "." "\\." version_pattern ${CPACK_PACKAGE_VERSION})
set(suite UNRELEASED)
set(day now)
if(changes MATCHES "## \\[${version_pattern}\\] - ([0-9]+-[0-9]+-[0-9]+)")
    set(suite unstable)
    set(day ${CMAKE_MATCH_1})
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C date --utc --rfc-email --date=${day}
    OUTPUT_VARIABLE day OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${documents}/changelog
    "hdem (${CPACK_PACKAGE_VERSION}) ${suite}; urgency=medium\n\n"
    "  * What has changed stands in CHANGELOG.md.gz.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
file(COPY ${CPACK_HDEM_SOURCE}/CHANGELOG.md DESTINATION ${documents})
step(gzip --best --no-name ${documents}/changelog ${documents}/CHANGELOG.md)

# The commands of the guide run in a copy of this folder as they run in the sources.
foreach(name import_dxf.py own_figure.py pull_out_figure.py sweep)
    file(WRITE ${documents}/examples/tools/${name} "#!/bin/sh\nexec /usr/share/hdem/${name} \"$@\"\n")
    file(CHMOD ${documents}/examples/tools/${name} PERMISSIONS
        OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()

execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)    # whatever the umask of who packs
