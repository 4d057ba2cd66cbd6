# SPDX-License-Identifier: MIT
# Required: OpenSceneGraph, GLM, OpenEXR, nlohmann-json. Everything else is optional and reported by Summary.cmake.
find_package(OpenSceneGraph 3.6.5 REQUIRED COMPONENTS osgViewer osgGA osgText osgDB osgUtil)
find_package(OpenGL REQUIRED)
find_package(glm REQUIRED)
find_package(OpenEXR 3.1 REQUIRED CONFIG)
find_package(nlohmann_json 3.11 REQUIRED CONFIG)

find_package(OpenGL QUIET COMPONENTS EGL)
find_package(CLI11 2.1 QUIET CONFIG)
find_package(GTest QUIET CONFIG)
find_package(embree 3.13 QUIET CONFIG)
find_package(TBB 2021 QUIET CONFIG)
find_package(benchmark QUIET CONFIG)
# Headers only: plugin/osgdb_gltf compiles tinygltf without its access to files, which Debian's library has.
find_path(ENVLIGHT_TINYGLTF_INCLUDE_DIR tiny_gltf.h)
find_path(ENVLIGHT_STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb)
if(ENVLIGHT_TINYGLTF_INCLUDE_DIR AND ENVLIGHT_STB_INCLUDE_DIR)
    set(ENVLIGHT_GLTF_FOUND ON)
endif()
# envlight-viewer; Debian's archive of Dear ImGui has the backends for GLFW and OpenGL, and leaves stb to the linker.
find_package(glfw3 3.3 QUIET CONFIG)
find_path(ENVLIGHT_IMGUI_INCLUDE_DIR backends/imgui_impl_opengl3.h PATH_SUFFIXES imgui)
find_library(ENVLIGHT_IMGUI_LIBRARY imgui)
find_library(ENVLIGHT_STB_LIBRARY stb)
if(glfw3_FOUND AND ENVLIGHT_IMGUI_INCLUDE_DIR AND ENVLIGHT_IMGUI_LIBRARY AND ENVLIGHT_STB_LIBRARY)
    set(ENVLIGHT_VIEWER_FOUND ON)
endif()
find_program(GLSLANG_VALIDATOR glslangValidator)

# The host's libraries by a name that the installed package can define again (Install.cmake).
add_library(osgEnvLight_OpenSceneGraph INTERFACE)
target_include_directories(osgEnvLight_OpenSceneGraph SYSTEM INTERFACE ${OPENSCENEGRAPH_INCLUDE_DIRS})
target_link_libraries(osgEnvLight_OpenSceneGraph INTERFACE ${OPENSCENEGRAPH_LIBRARIES} OpenGL::GL)
