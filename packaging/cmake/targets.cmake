# One target per folder, in the list of its layer: its links say whom the folder may use.
# trapwright_library(core_base SOURCES base/a.cpp PUBLIC core_x PRIVATE Foreign::lib)
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
# build. A layer's list names in TRAPWRIGHT_PRECOMPILED the set that the targets after it use. Foreign headers alone: ours
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

# A test on an X server of its own, with OpenGL in software.
# trapwright_x_server_test(x_test COMMAND x_program an_argument SCREEN 2560x1600 ENVIRONMENT QT_SCALE_FACTOR=2)
function(trapwright_x_server_test name)
    cmake_parse_arguments(ARG "" "SCREEN" "COMMAND;ENVIRONMENT" ${ARGN})
    list(POP_FRONT ARG_COMMAND program)
    add_test(NAME ${name}
        COMMAND xvfb-run -a -s "-screen 0 ${ARG_SCREEN}x24 +extension GLX" $<TARGET_FILE:${program}> ${ARG_COMMAND})
    set(environment QT_QPA_PLATFORM=xcb LIBGL_ALWAYS_SOFTWARE=1 ${ARG_ENVIRONMENT})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${TRAPWRIGHT_TEST_TIMEOUT} ENVIRONMENT "${environment}")
endfunction()

# A program that tests start, or that is run by hand. trapwright_test_program(soak SOURCE window/soak.cpp LIBS ui_window)
function(trapwright_test_program name)
    cmake_parse_arguments(ARG "" "SOURCE" "LIBS" ${ARGN})
    add_executable(${name} ${ARG_SOURCE})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE ${ARG_LIBS} trapwright_options)
    target_compile_definitions(${name} PRIVATE TRAPWRIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()

# Has moc write SOURCE's .moc, which SOURCE includes at its end. For each of two hundred tests CMake's AUTOMOC would start a
# process that looks for what is known here, and compile one more file, empty but for that: a fifth of the steps of a build.
function(trapwright_moc name source)
    cmake_path(GET source STEM stem)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name}_moc)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    file(MAKE_DIRECTORY ${folder})
    qt6_generate_moc(${path} ${folder}/${stem}.moc)
    target_sources(${name} PRIVATE ${folder}/${stem}.moc)
    target_include_directories(${name} PRIVATE ${folder})
endfunction()

# trapwright_test(peers_test SOURCE peers_test.cpp LIBS tests_peers). X_SERVER: it shows windows.
function(trapwright_test name)
    cmake_parse_arguments(ARG "X_SERVER" "SOURCE" "LIBS" ${ARGN})
    trapwright_test_program(${name} SOURCE ${ARG_SOURCE} LIBS ${ARG_LIBS} Qt6::Test)
    trapwright_moc(${name} ${ARG_SOURCE})
    trapwright_use_precompiled(${name})
    if(ARG_X_SERVER)
        trapwright_x_server_test(${name} COMMAND ${name} SCREEN 2560x1600)
    else()
        add_test(NAME ${name} COMMAND ${name})
        set_tests_properties(${name} PROPERTIES TIMEOUT ${TRAPWRIGHT_TEST_TIMEOUT})
    endif()
endfunction()

# Tests of one folder that link the same: core_base_random_test is tests/core/base/random_test.cpp, and so on.
# trapwright_tests(core/base LIBS core_base TESTS random_test csv_test). X_SERVER: as above.
function(trapwright_tests folder)
    cmake_parse_arguments(ARG "X_SERVER" "" "LIBS;TESTS" ${ARGN})
    string(REPLACE "/" "_" subject ${folder})
    set(x_server)
    if(ARG_X_SERVER)
        set(x_server X_SERVER)
    endif()
    foreach(test ${ARG_TESTS})
        cmake_path(GET test FILENAME name)
        trapwright_test(${subject}_${name} ${x_server}
            SOURCE ${PROJECT_SOURCE_DIR}/tests/${folder}/${test}.cpp LIBS ${ARG_LIBS})
    endforeach()
endfunction()
