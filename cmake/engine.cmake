# Tells the engine its commit and compiler (core/optimize/engine.h). A build without git, like the container's, can say
# -DCOPPICE_COMMIT=...; otherwise it is "unknown".
set(COPPICE_COMMIT "" CACHE STRING "Commit that the engine reports; empty: git's")

set(COPPICE_COMMIT_OR_UNKNOWN "${COPPICE_COMMIT}")
if(NOT COPPICE_COMMIT_OR_UNKNOWN)
    find_package(Git QUIET)
    if(GIT_FOUND)
        execute_process(COMMAND "${GIT_EXECUTABLE}" rev-parse --short=12 HEAD WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}"
                        OUTPUT_VARIABLE COPPICE_COMMIT_OR_UNKNOWN OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        execute_process(COMMAND "${GIT_EXECUTABLE}" rev-parse --git-path logs/HEAD WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}"
                        OUTPUT_VARIABLE git_log OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
        if(git_log)
            get_filename_component(git_log "${git_log}" ABSOLUTE BASE_DIR "${CMAKE_SOURCE_DIR}")
            if(EXISTS "${git_log}")  # changes with every commit and checkout
                set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${git_log}")
            endif()
        endif()
    endif()
endif()
if(NOT COPPICE_COMMIT_OR_UNKNOWN)
    set(COPPICE_COMMIT_OR_UNKNOWN "unknown")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(COPPICE_COMPILER "g++ ${CMAKE_CXX_COMPILER_VERSION}")
else()
    set(COPPICE_COMPILER "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
endif()
configure_file(cmake/engine.cpp.in engine.cpp @ONLY)
target_sources(coppice_optimize PRIVATE "${CMAKE_BINARY_DIR}/engine.cpp")
