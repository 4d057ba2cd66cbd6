// SPDX-License-Identifier: MIT
#include "CommandLine.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <optional>

using Option = CommandLine::Option;

Option& Option::required()
{
    _option->required();
    return *this;
}

template <class Number>
Option& Option::within(Number least, Number most)
{
    _option->check(CLI::Range(least, most));
    return *this;
}
template Option& Option::within(int, int);
template Option& Option::within(unsigned, unsigned);
template Option& Option::within(double, double);

Option& Option::oneOf(const std::vector<std::string>& words)
{
    _option->check(CLI::IsMember(words));
    return *this;
}

Option& Option::separatedBy(char delimiter)
{
    _option->delimiter(delimiter);
    return *this;
}

Option& Option::ofValues(int count)
{
    _option->expected(count);
    return *this;
}

Option& Option::repeatable()
{
    _option->allow_extra_args(false);
    return *this;
}

CommandLine::CommandLine(const std::string& program, const std::string& purpose)
    : _app(std::make_unique<CLI::App>(purpose, program))
{
}

CommandLine::~CommandLine() = default;

template <class Value>
Option CommandLine::add(const std::string& names, Value& value, const std::string& help)
{
    return Option(*_app->add_option(names, value, help));
}
template Option CommandLine::add(const std::string&, std::string&, const std::string&);
template Option CommandLine::add(const std::string&, int&, const std::string&);
template Option CommandLine::add(const std::string&, unsigned&, const std::string&);
template Option CommandLine::add(const std::string&, double&, const std::string&);
template Option CommandLine::add(const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::add(const std::string&, std::vector<std::string>&, const std::string&);
template Option CommandLine::add(const std::string&, std::vector<int>&, const std::string&);
template Option CommandLine::add(const std::string&, std::vector<double>&, const std::string&);

void CommandLine::addFlag(const std::string& name, bool& value, const std::string& help)
{
    _app->add_flag(name, value, help);
}

int CommandLine::run(int argc, char** argv, const std::function<int()>& work)
{
    try {
        _app->parse(argc, argv);
        return work();
    } catch (const CLI::CallForHelp& e) {
        return _app->exit(e);
    } catch (const CLI::ParseError& e) {
        std::cerr << _app->get_name() << ": " << e.what() << "\n";
        return 2;
    } catch (const BadArguments& e) {
        std::cerr << _app->get_name() << ": " << e.what() << "\n";
        return 2;
    } catch (const std::exception& e) {
        std::cerr << _app->get_name() << ": " << e.what() << "\n";
        return 1;
    }
}
