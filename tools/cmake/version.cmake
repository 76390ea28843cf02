# Run at every build: writes OUTPUT from INPUT with the state of the git checkout in SOURCE_DIR. The file is touched only when
# its text changes. Without git, without a commit, or inside somebody else's repository the commit is "unknown".
set(HDEM_COMMIT "unknown")
set(HDEM_DIRTY "false")

find_program(GIT git)
if(GIT)
    execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --show-toplevel
        OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    file(REAL_PATH "${SOURCE_DIR}" source)
    if(NOT failed AND top STREQUAL source)
        execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --verify HEAD
            OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
        if(NOT failed)
            set(HDEM_COMMIT ${commit})
            execute_process(COMMAND ${GIT} --no-optional-locks -C ${SOURCE_DIR} status --porcelain --untracked-files=no
                OUTPUT_VARIABLE changes ERROR_QUIET)
            if(changes)
                set(HDEM_DIRTY "true")
            endif()
        endif()
    endif()
endif()

configure_file(${INPUT} ${OUTPUT} @ONLY)
