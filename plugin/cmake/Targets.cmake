# SPDX-License-Identifier: MIT
# What every target of the project shares: warnings, sanitizers, and a build tree laid out as OSG_LIBRARY_PATH expects it.
set(ENVLIGHT_OSG_PLUGINS osgPlugins-${OPENSCENEGRAPH_VERSION})
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # osg/Array overloads virtual functions by hiding; its headers are not ours to change.
    add_compile_options(-Wno-overloaded-virtual)
endif()
if(ENVLIGHT_SANITIZE)
    add_compile_options(-fsanitize=${ENVLIGHT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${ENVLIGHT_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # A false alarm in <regex> as soon as it is instrumented (GCC bug 105562).
        add_compile_options(-Wno-maybe-uninitialized)
    endif()
endif()

# Headers that most files of a target parse, compiled once; the clang preset compiles them without, so each file still includes
# what it uses.
function(envlight_precompile name)
    target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# For what takes longer to compile than to run.
set(ENVLIGHT_COMPILE_FAST $<$<NOT:$<CONFIG:Debug>>:-O1>)

# Parsers of command lines and of JSON, all templates.
function(envlight_compile_fast)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS ${ENVLIGHT_COMPILE_FAST})
endfunction()

# An osgDB plugin: osgdb_<name>.so beside the host's own.
function(envlight_add_osg_plugin name)
    add_library(${name} MODULE ${ARGN})
    set_target_properties(${name} PROPERTIES PREFIX "" INSTALL_RPATH "$ORIGIN/.."
        LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/${ENVLIGHT_OSG_PLUGINS})
    target_link_libraries(${name} PRIVATE osgEnvLight)
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${ENVLIGHT_OSG_PLUGINS})
endfunction()

# A program: envlight-<name>, installed.
function(envlight_add_program name)
    add_executable(${name} ${ARGN})
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    target_link_libraries(${name} PRIVATE osgEnvLight)
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# A program that needs Embree where there is none: it says so.
function(envlight_add_program_without_embree name)
    add_executable(${name} ${PROJECT_SOURCE_DIR}/samples/support/without_embree.cpp)
    target_compile_definitions(${name} PRIVATE "ENVLIGHT_PROGRAM=\"${name}\"")
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
