// `stepwright reference [FILE] [--json]`: every key of a cell's file, or of one that it names, from the code
// that reads it.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cell/reference/key_reference.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app{
      "Print every key of a cell's file, or of a file that it names, with values, unit and default, as "
      "Markdown",
      "stepwright reference"};
  std::vector<std::string> names;
  for (const reference::DescribedFile& each : reference::described_files()) names.emplace_back(each.name);
  std::string file = names.front();
  bool json = false;
  app.add_option("FILE", file, "which one (default: cell)")->check(CLI::IsMember(names));
  app.add_flag("--json", json, "as JSON");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  const reference::KeyReference keys = reference::key_reference(*reference::find_described_file(file));
  const std::string text = json ? reference::json_of(keys) : reference::markdown_of(keys);
  const result::Diagnostics unwritten = files::write_file("-", text);
  return unwritten.empty() ? to_int(result::ExitCode::Done)
                           : process::fail(unwritten, result::ExitCode::BadInput);
}
