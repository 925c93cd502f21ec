// `stepwright reference [--json]`: every key of a cell's file, from the code that reads it.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "cell/reference/key_reference.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app{"Print every key of a cell's file, with its values, unit and default, as Markdown",
               "stepwright reference"};
  bool json = false;
  app.add_flag("--json", json, "as JSON");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  const reference::KeyReference keys = reference::cell_reference();
  const std::string text = json ? reference::json_of(keys) : reference::markdown_of(keys);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return to_int(result::ExitCode::Done);
}
