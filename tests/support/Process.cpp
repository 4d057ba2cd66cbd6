// SPDX-License-Identifier: MIT
#include "Process.h"

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace
{

// In place of this process.
[[noreturn]] void become(const std::vector<std::string>& command)
{
    std::vector<char*> arguments;
    for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

int start(const std::vector<std::string>& command, const std::vector<std::string>& environment, const std::string& out,
          const std::string& err)
{
    const int pid = fork();
    if (pid < 0) throw std::runtime_error("fork failed");
    if (pid > 0) return pid;
    for (const std::string& e : environment) putenv(const_cast<char*>(e.c_str()));
    const int outFile = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int errFile = err == out ? outFile : open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(outFile, 1);
    dup2(errFile, 2);
    become(command);
}

// Of one that has ended or will.
int statusOf(int pid)
{
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Outcome runProgram(const std::vector<std::string>& command, const std::vector<std::string>& environment)
{
    const TemporaryFolder folder;
    const int pid = start(command, environment, folder.file("out"), folder.file("err"));
    return {statusOf(pid), readFile(folder.file("out")), readFile(folder.file("err"))};  // in this order
}

Outcome interruptProgram(const std::vector<std::string>& command, const std::string& shown, int signal)
{
    int terminal = -1;
    const int pid = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (pid < 0) throw std::runtime_error("no terminal");
    if (pid == 0) become(command);
    const std::regex awaited(shown);
    Outcome o;
    bool pressed = false;
    char part[4096];
    for (ssize_t n; (n = read(terminal, part, sizeof part)) > 0;) {
        o.err.append(part, size_t(n));
        if (pressed || !std::regex_search(o.err, awaited)) continue;
        pressed = signal == SIGINT ? write(terminal, "\x03", 1) == 1 : kill(pid, signal) == 0;
    }
    close(terminal);
    o.status = statusOf(pid);
    return o;
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
