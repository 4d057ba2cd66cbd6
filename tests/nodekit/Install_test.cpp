// SPDX-License-Identifier: MIT
// The installed package serves a program of its own through find_package, with the plugins where OSG looks for them.
#include <Process.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace Install_test
{

TEST(Install, AProgramOfItsOwnFindsThePackage)
{
    const TemporaryFolder folder;
    const std::string prefix = folder.file("prefix");
    const Outcome install = runProgram({"cmake", "--install", ENVLIGHT_BINARY_DIR, "--prefix", prefix});
    ASSERT_EQ(0, install.status) << install.err;

    std::filesystem::create_directory(folder.file("program"));
    folder.write("program/CMakeLists.txt",
                 "cmake_minimum_required(VERSION 3.25)\n"
                 "project(program CXX)\n"
                 "find_package(osgEnvLight REQUIRED)\n"
                 "add_executable(minimal " ENVLIGHT_SOURCE_DIR
                 "/samples/minimal/main.cpp)\n"
                 "target_link_libraries(minimal PRIVATE osgEnvLight::osgEnvLight)\n");
    const Outcome configure = runProgram({"cmake", "-S", folder.file("program"), "-B", folder.file("build"), "-G", "Ninja",
                                          "-DCMAKE_PREFIX_PATH=" + prefix, "-DCMAKE_CXX_COMPILER=" ENVLIGHT_COMPILER});
    ASSERT_EQ(0, configure.status) << configure.out << configure.err;
    const Outcome build = runProgram({"cmake", "--build", folder.file("build")});
    ASSERT_EQ(0, build.status) << build.out << build.err;
    const Outcome run = runProgram({folder.file("build/minimal")});
    EXPECT_EQ(2, run.status);  // it starts, and asks for a model
    EXPECT_NE(std::string::npos, run.err.find("usage")) << run.err;

    int plugins = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(prefix))
        if (entry.path().parent_path().filename() == "osgPlugins-3.6.5") ++plugins;
    const bool gltf = std::filesystem::exists(ENVLIGHT_BINARY_DIR "/lib/osgPlugins-3.6.5/osgdb_gltf.so");
    EXPECT_EQ(gltf ? 5 : 3, plugins);  // exr, envlight, serializers; gltf and its second name, glb
    EXPECT_TRUE(std::filesystem::exists(prefix + "/bin/envlight-render"));
    EXPECT_EQ(0, runProgram({prefix + "/bin/envlight-lights", "studio", "-o", folder.file("lights.json")}).status);
}

}  // namespace Install_test
