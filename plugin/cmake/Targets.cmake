# SPDX-License-Identifier: MIT
# What every target of the project shares: warnings, sanitizers, and a build tree laid out as OSG_LIBRARY_PATH expects it.
set(ENVLIGHT_OSG_PLUGINS osgPlugins-${OPENSCENEGRAPH_VERSION})
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

add_compile_options(-Wall -Wextra -Wconversion -Werror)
if(ENVLIGHT_UNITE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Files compiled together may name a local thing as another's own global one; and the compiler takes their nameless
    # namespaces for those of headers.
    add_compile_options(-Wshadow=local -Wno-subobject-linkage)
else()
    add_compile_options(-Wshadow)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 drops the initialisation of structures that are passed on by value (tests/maths/visibility_test.cpp at -O1).
    add_compile_options(-fno-ipa-modref)
endif()
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

# Files of one folder, compiled sixteen at a time: the templates of the host's headers take three quarters of the time of a file
# alone, precompiled or not. So no two files of a folder may define one name, in a nameless namespace either. The clang preset
# compiles each file alone.
function(envlight_unite name)
    get_target_property(sources ${name} SOURCES)
    set(files 0)
    foreach(source IN LISTS sources)
        get_filename_component(path ${source} ABSOLUTE)
        get_filename_component(folder ${path} DIRECTORY)
        if(NOT folder STREQUAL last)
            set(files 0)
        endif()
        set(last ${folder})
        math(EXPR group "${files} / 16")
        math(EXPR files "${files} + 1")
        get_filename_component(folder ${folder} NAME)
        set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${folder}${group})
    endforeach()
    set_target_properties(${name} PROPERTIES UNITY_BUILD ${ENVLIGHT_UNITE} UNITY_BUILD_MODE GROUP)
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
