// SPDX-License-Identifier: MIT
#include "Process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace
{

int start(const std::vector<std::string>& command, const std::vector<std::string>& environment, const std::string& out,
          const std::string& err)
{
    std::vector<char*> arguments;
    for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
    arguments.push_back(nullptr);
    const int pid = fork();
    if (pid < 0) throw std::runtime_error("fork failed");
    if (pid > 0) return pid;
    for (const std::string& e : environment) putenv(const_cast<char*>(e.c_str()));
    const int outFile = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int errFile = err == out ? outFile : open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(outFile, 1);
    dup2(errFile, 2);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

}  // namespace

Outcome runProgram(const std::vector<std::string>& command, const std::vector<std::string>& environment)
{
    const TemporaryFolder folder;
    const int pid = start(command, environment, folder.file("out"), folder.file("err"));
    int status = 0;
    waitpid(pid, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readFile(folder.file("out")),
            readFile(folder.file("err"))};
}

BackgroundProgram::BackgroundProgram(const std::vector<std::string>& command, const std::string& log,
                                     const std::vector<std::string>& environment)
    : _pid(start(command, environment, log, log))
{
}

BackgroundProgram::~BackgroundProgram()
{
    kill(_pid, SIGKILL);
    waitpid(_pid, nullptr, 0);
}

bool BackgroundProgram::running()
{
    return waitpid(_pid, nullptr, WNOHANG) == 0;
}

TemporaryFolder::TemporaryFolder()
{
    std::string name = (std::filesystem::temp_directory_path() / "envlight-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    _path = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(_path, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const
{
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
}

std::string readFile(const std::string& path)
{
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}
