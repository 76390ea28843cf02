# Asked by cpack before it begins: refuses a package that other machines cannot use or that lacks a part.
set(problems ${CPACK_HDEM_PROBLEMS})
if(NOT EXISTS ${CPACK_HDEM_BUILD}/share/hdem/view/viewer.html)
    list(APPEND problems "the page of hdem view is not built: it needs Node.js and npm")
endif()
if(problems)
    list(JOIN problems "\n  - " problems)
    message(FATAL_ERROR "no package of ${CPACK_HDEM_BUILD}:\n  - ${problems}\n"
        "Run tools/setup, then: cmake --preset package && cmake --build --preset package && cpack --preset package")
endif()
