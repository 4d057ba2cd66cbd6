// SPDX-License-Identifier: MIT
// What the mains of the programs have in common: 0 done, 1 the work failed, 2 bad arguments; one message on stderr.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}  // namespace CLI

struct BadArguments : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/** The options of a program. CLI11 parses them; its header takes seconds to compile, so CommandLine.cpp alone has it. */
class CommandLine
{
  public:
    /** What one option takes. */
    class Option
    {
      public:
        explicit Option(CLI::Option& option) : _option(&option) {}
        Option& required();
        /** Of the option's own type. */
        template <class Number>
        Option& within(Number least, Number most);
        Option& oneOf(const std::vector<std::string>& words);
        /** So many values in one word. */
        Option& separatedBy(char delimiter);
        Option& ofValues(int count);
        /** One value each time it is given, many times. */
        Option& repeatable();

      private:
        CLI::Option* _option;
    };

    CommandLine(const std::string& program, const std::string& purpose);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /** names: "-o,--output", or "SCENE" for what is given by its place. The types are those that CommandLine.cpp lists. */
    template <class Value>
    Option add(const std::string& names, Value& value, const std::string& help);
    void addFlag(const std::string& name, bool& value, const std::string& help);

    /** Parse, run, and turn what is thrown into a message and the exit status. */
    int run(int argc, char** argv, const std::function<int()>& work);

  private:
    std::unique_ptr<CLI::App> _app;
};
