# hdem_flags: how every target of this project is compiled. Targets link it privately, so users of the library do not inherit it.
add_library(hdem_flags INTERFACE)
target_compile_features(hdem_flags INTERFACE cxx_std_20)

# A result must not depend on which additions the compiler fuses or reorders: no contraction, never -ffast-math.
# Nothing reads errno after a math function or traps floating-point exceptions, so these two change no result.
set(HDEM_NUMERIC_FLAGS -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(HDEM_NATIVE)
    list(APPEND HDEM_NUMERIC_FLAGS -march=native -mtune=native)
endif()

# g++ 12 fuses pairs like (a c - b s, a s + b c) into fmaddsub when it vectorises, in spite of -ffp-contract=off, and the bits then
# differ from a portable build. Without FMA (and AVX-512, which brings its own) there is nothing to fuse into (two files of core have AVX-512 all the same and no vectorisation). This holds for the -march of
# HDEM_NATIVE and for one that the user gives alike, and is asked anew each time, for that may have changed.
include(CheckCXXSourceCompiles)
string(TOUPPER "${CMAKE_BUILD_TYPE}" upper_build_type)
string(JOIN " " CMAKE_REQUIRED_FLAGS ${CMAKE_CXX_FLAGS_${upper_build_type}} ${HDEM_NUMERIC_FLAGS})
foreach(extension FMA FMA4 AVX512F)
    string(TOLOWER ${extension} option)
    unset(HDEM_HAS_${extension} CACHE)
    check_cxx_source_compiles("
        #if !defined(__${extension}__)
        #error
        #endif
        int main() {}" HDEM_HAS_${extension})
    if(HDEM_HAS_${extension})
        list(APPEND HDEM_NUMERIC_FLAGS -mno-${option})
    endif()
endforeach()
unset(CMAKE_REQUIRED_FLAGS)
string(JOIN " " HDEM_NUMERIC_FLAGS_TEXT ${CMAKE_CXX_FLAGS_${upper_build_type}} ${HDEM_NUMERIC_FLAGS})

set(HDEM_SANITIZE_FLAGS "")
if(HDEM_SANITIZE STREQUAL "address")
    set(HDEM_SANITIZE_FLAGS -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(HDEM_SANITIZE STREQUAL "thread")
    set(HDEM_SANITIZE_FLAGS -fsanitize=thread -fno-omit-frame-pointer)
elseif(HDEM_SANITIZE STREQUAL "fuzz")    # clang only
    set(HDEM_SANITIZE_FLAGS -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=all -fno-omit-frame-pointer)
elseif(HDEM_SANITIZE)
    message(FATAL_ERROR "HDEM_SANITIZE = \"${HDEM_SANITIZE}\" (unknown). Give \"\", \"address\", \"thread\" or \"fuzz\".")
endif()

target_compile_options(hdem_flags INTERFACE
    ${HDEM_NUMERIC_FLAGS} ${HDEM_SANITIZE_FLAGS}
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wno-missing-field-initializers -Wno-psabi    # {.density = 2700.0} leaves the rest at its defaults, which is what they are for
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>    # g++ 12 finds overlaps in std::string's operator+ that cannot be
    $<$<BOOL:${HDEM_WERROR}>:-Werror>)
target_link_options(hdem_flags INTERFACE ${HDEM_SANITIZE_FLAGS} $<$<BOOL:${HDEM_COVERAGE}>:--coverage>)

# One line for the provenance of results; see core/version.h.
string(JOIN " " HDEM_FLAGS_TEXT
    ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${upper_build_type}} ${HDEM_NUMERIC_FLAGS} ${HDEM_SANITIZE_FLAGS})
string(REGEX REPLACE "  +" " " HDEM_FLAGS_TEXT "${HDEM_FLAGS_TEXT}")
