# One target per folder. trapwright_library(core_base SOURCES a.cpp PUBLIC core_x PRIVATE Foreign::lib)
add_library(trapwright_options INTERFACE)
target_compile_options(trapwright_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
# GCC 12 sees overlapping and overlong copies in `"text" + std::string` that are not there (GCC bugs 105651, 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(trapwright_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
endif()
# Results must not depend on which instructions a compiler chose to fuse: the same seed gives the same bits.
target_compile_options(trapwright_options INTERFACE -ffp-contract=off)
if(TRAPWRIGHT_WERROR)
    target_compile_options(trapwright_options INTERFACE -Werror)
endif()
if(TRAPWRIGHT_SANITIZE)
    # Every finding ends the program. Our own and the standard library's assertions are on; CGAL's are expensive and off,
    # as in what people use.
    target_compile_options(trapwright_options INTERFACE
        -fsanitize=${TRAPWRIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_compile_definitions(trapwright_options INTERFACE _GLIBCXX_ASSERTIONS CGAL_NDEBUG)
    target_link_options(trapwright_options INTERFACE -fsanitize=${TRAPWRIGHT_SANITIZE})
endif()
if(TRAPWRIGHT_FUZZ)
    target_compile_options(trapwright_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Foreign headers that nearly every file reads are compiled once for all targets of a layer, which halves the time of a
# build. A folder's list file names the set that its targets use in TRAPWRIGHT_PRECOMPILED. Foreign headers alone: ours
# change. check_tidy.sh looks at every file without them, so none can lean on what it does not include itself.
# trapwright_precompiled(core_headers HEADERS <vector> LIBS Eigen3::Eigen)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "// Nothing but precompiled headers.\n")
function(trapwright_precompiled name)
    cmake_parse_arguments(ARG "" "" "HEADERS;LIBS" ${ARGN})
    add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(${name} PRIVATE trapwright_options ${ARG_LIBS})
    target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
    trapwright_precompiled_options(${name})
endfunction()

# ccache keeps what was compiled with precompiled headers only if the preprocessor names them.
function(trapwright_precompiled_options name)
    if(CCACHE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${name} PRIVATE -fpch-preprocess)
    elseif(CCACHE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        target_compile_options(${name} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
    endif()
endfunction()

function(trapwright_use_precompiled name)
    if(TRAPWRIGHT_PRECOMPILED)
        target_precompile_headers(${name} REUSE_FROM ${TRAPWRIGHT_PRECOMPILED})
        trapwright_precompiled_options(${name})
    endif()
endfunction()

# OWN_FLAGS: compiled with flags that the precompiled headers do not have.
function(trapwright_library name)
    cmake_parse_arguments(ARG "OWN_FLAGS" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE trapwright_options ${ARG_PRIVATE})
    if(NOT ARG_OWN_FLAGS)
        trapwright_use_precompiled(${name})
    endif()
endfunction()

# [s] for a whole test; with sanitizers several times as long.
set(TRAPWRIGHT_TEST_TIMEOUT 600)
if(TRAPWRIGHT_SANITIZE)
    set(TRAPWRIGHT_TEST_TIMEOUT 3600)
endif()

# trapwright_test(core_base_random_test LIBS core_base): built from random_test.cpp beside the calling list file.
function(trapwright_test name)
    cmake_parse_arguments(ARG "" "SOURCE" "LIBS" ${ARGN})
    add_executable(${name} ${ARG_SOURCE})
    set_target_properties(${name} PROPERTIES AUTOMOC ON)
    target_link_libraries(${name} PRIVATE ${ARG_LIBS} Qt6::Test trapwright_options)
    trapwright_use_precompiled(${name})
    target_compile_definitions(${name} PRIVATE TRAPWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${TRAPWRIGHT_TEST_TIMEOUT})
endfunction()

# The same for a test that shows windows: it gets an X server of its own, with OpenGL in software.
function(trapwright_gui_test name)
    cmake_parse_arguments(ARG "" "SOURCE" "LIBS" ${ARGN})
    add_executable(${name} ${ARG_SOURCE})
    set_target_properties(${name} PROPERTIES AUTOMOC ON)
    target_link_libraries(${name} PRIVATE ${ARG_LIBS} Qt6::Test trapwright_options)
    trapwright_use_precompiled(${name})
    target_compile_definitions(${name} PRIVATE TRAPWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    add_test(NAME ${name} COMMAND xvfb-run -a -s "-screen 0 2560x1600x24 +extension GLX" $<TARGET_FILE:${name}>)
    set_tests_properties(${name} PROPERTIES TIMEOUT ${TRAPWRIGHT_TEST_TIMEOUT} ENVIRONMENT "QT_QPA_PLATFORM=xcb;LIBGL_ALWAYS_SOFTWARE=1")
endfunction()
