// The tool with some verbs, run inside the test.
#pragma once

#include <app/frame/tool.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace swimtwin
{
  struct Outcome
  {
    int         code = -1;
    std::string output, errors;
  };

  inline Outcome run_in_process(std::vector<std::string> arguments, const std::vector<Verb> &verbs)
  {
    arguments.insert(arguments.begin(), "swimtwin");
    std::vector<char *> argv;
    for (std::string &argument : arguments)
      argv.push_back(argument.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Outcome outcome;
    outcome.code   = run_tool(static_cast<int>(argv.size()), argv.data(), verbs);
    outcome.output = testing::internal::GetCapturedStdout();
    outcome.errors = testing::internal::GetCapturedStderr();
    return outcome;
  }
} // namespace swimtwin
