// SPDX-License-Identifier: MIT
// Shaders of a test's own.
#pragma once

#include <Process.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/** Fragment shaders of passes, where the library looks for those that replace its own as long as this lives. */
class ShaderFolder
{
  public:
    ShaderFolder()
    {
        std::filesystem::create_directory(_folder.file("pass"));
        setenv("ENVLIGHT_SHADER_PATH", _folder.file("").c_str(), 1);
    }
    ~ShaderFolder() { unsetenv("ENVLIGHT_SHADER_PATH"); }

    /** Of the pass of that name. `body` follows the line of the version. */
    void add(const std::string& pass, const std::string& body)
    {
        _folder.write("pass/" + pass + ".frag", "#version 330 compatibility\n" + body);
    }

  private:
    TemporaryFolder _folder;
};
