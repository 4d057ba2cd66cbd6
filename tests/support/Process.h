// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <string>
#include <vector>

/** What a program said and how it ended. */
struct Outcome {
    int status = -1;  // exit status; 128 + n if signal n ended it
    std::string out;
    std::string err;
};

/** Run a program with its arguments, nothing between them and it, and wait for its end. */
Outcome runProgram(const std::vector<std::string>& command, const std::vector<std::string>& environment = {});

/**
 * Run a program in a terminal, send it a signal once it has shown what a regular expression finds, and wait for its end. SIGINT
 * is sent as Ctrl-C. err is all that was shown.
 */
Outcome interruptProgram(const std::vector<std::string>& command, const std::string& shown, int signal = SIGINT);

/** A program that runs until it is told to end. */
class BackgroundProgram
{
  public:
    /** Its output goes to the file log. */
    BackgroundProgram(const std::vector<std::string>& command, const std::string& log,
                      const std::vector<std::string>& environment = {});
    /** Ends it. */
    ~BackgroundProgram();
    BackgroundProgram(const BackgroundProgram&) = delete;
    BackgroundProgram& operator=(const BackgroundProgram&) = delete;
    bool running();

  private:
    int _pid;
};

/** A folder of one's own, removed with its files at the end. */
class TemporaryFolder
{
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::string file(const std::string& name) const { return _path + "/" + name; }
    /** Write a file and give its path. */
    std::string write(const std::string& name, const std::string& content) const;

  private:
    std::string _path;
};

/** A file's content, or "". */
std::string readFile(const std::string& path);
