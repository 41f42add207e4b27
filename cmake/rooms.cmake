# One static library per room. Sources are the folder's .cpp files; what a room may use is what it links.

add_library(coppice_options INTERFACE)
target_compile_options(coppice_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual
    $<$<BOOL:${COPPICE_WARNINGS_AS_ERRORS}>:-Werror>
    # g++ fires falsely on string concatenation: 12 with the first, and with precompiled headers 12 and 14 with all
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
    -ffp-contract=off        # the same bits on every machine
    -fstack-protector-strong)
target_compile_definitions(coppice_options INTERFACE
    _GLIBCXX_ASSERTIONS
    COPPICE_VERSION="${PROJECT_VERSION}")
target_compile_definitions(coppice_options INTERFACE $<$<CONFIG:Release>:_FORTIFY_SOURCE=2>)
if(NOT COPPICE_ASSERTIONS)
    target_compile_definitions(coppice_options INTERFACE NDEBUG)
endif()
target_link_options(coppice_options INTERFACE -pie)
target_include_directories(coppice_options INTERFACE "${CMAKE_SOURCE_DIR}")

# Parsing these takes longer than compiling what most of our files say. Every file still includes what it needs itself:
# clang-tidy looks at each without them.
set(COPPICE_PRECOMPILED <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <set> <span> <stop_token> <string>
    <string_view> <unordered_map> <utility> <variant> <vector> <fmt/format.h>)

# coppice_room(NAME FOLDER LINK public... PRIVATE_LINK private... PRECOMPILE headers...) -> target coppice_NAME
function(coppice_room name folder)
    cmake_parse_arguments(ROOM "" "" "LINK;PRIVATE_LINK;PRECOMPILE" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/${folder}/*.cpp")
    list(FILTER sources EXCLUDE REGEX "/cli/main\\.cpp$")
    if(NOT sources)  # a room that has only headers so far
        add_library(coppice_${name} INTERFACE)
        target_link_libraries(coppice_${name} INTERFACE ${ROOM_LINK})
        return()
    endif()
    add_library(coppice_${name} STATIC ${sources})
    target_link_libraries(coppice_${name} PUBLIC ${ROOM_LINK} PRIVATE coppice_options ${ROOM_PRIVATE_LINK})
    target_precompile_headers(coppice_${name} PRIVATE ${COPPICE_PRECOMPILED} ${ROOM_PRECOMPILE})
endfunction()

# coppice_tests(NAME FOLDER LABEL label LINK rooms...) -> executable NAME_tests, every TEST registered with CTest
function(coppice_tests name folder)
    cmake_parse_arguments(TESTS "" "LABEL" "LINK" ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/${folder}/*.cpp")
    if(NOT sources)
        return()
    endif()
    add_executable(${name}_tests ${sources})
    target_link_libraries(${name}_tests PRIVATE coppice_options ${TESTS_LINK} GTest::gmock GTest::gtest_main)
    target_precompile_headers(${name}_tests PRIVATE ${COPPICE_PRECOMPILED} <gmock/gmock.h> <gtest/gtest.h>)
    gtest_discover_tests(${name}_tests DISCOVERY_MODE PRE_TEST PROPERTIES LABELS "${TESTS_LABEL}")
endfunction()
