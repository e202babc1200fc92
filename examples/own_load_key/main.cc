// Optimizes the wheel of a case file whose section [load], or load cases, can have a key of this program,
// `slope`. Run again, it continues a run that was stopped. usage: own_load_key CASE FOLDER

#include <wheelwright/run/checkpoints/case_file.h>
#include <wheelwright/wheelwright.h>

#include <cstdio>
#include <filesystem>

#include "slope.h"

using namespace wheelwright;

int main(int count, char** arguments) {
  restart_with_blas_settings(arguments);
  if (count != 3) return 2;
  Vocabulary words;
  words.load_keys.add(slope());
  const std::filesystem::path folder = arguments[2];
  const bool exists = std::filesystem::exists(folder / case_file);
  const CaseResult wheel =
      read_case(exists ? folder / case_file : std::filesystem::path(arguments[1]), words);
  for (const Diagnostic& problem : wheel.problems) std::fprintf(stderr, "%s\n", problem.text().c_str());
  if (!wheel.value) return 2;

  auto run = exists ? Run<2>::resume(*wheel.value, folder) : Run<2>::begin(*wheel.value, folder);
  if (!run) return 1;
  CommandQueue commands;
  return run->execute(commands).state ? 0 : 1;
}
