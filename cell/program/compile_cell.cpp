#include "cell/program/compile_cell.h"

#include <iterator>
#include <string>
#include <utility>

#include "cell/monitors/cell_monitors.h"
#include "ladder/source_files/source_files.h"

namespace stepwright::cell_program {
namespace {

void append(result::Diagnostics& problems, const result::Diagnostics& more) {
  problems.insert(problems.end(), more.begin(), more.end());
}

}  // namespace

std::optional<std::vector<std::byte>> compile_cell(const config::CellConfig& config,
                                                   result::Diagnostics& problems) {
  std::vector<std::string> paths;
  for (const std::filesystem::path& each : config.boot.sources) paths.push_back(each.string());
  result::Diagnostics unread;
  const source::Dialect* const dialect = source::find_dialect(config.boot.dialect);
  const sources::SourceFiles files = sources::load(paths, unread, {.dialect = dialect});
  const auto monitors = cell_monitors::cell_monitors(config);
  append(problems, unread);
  if (!unread.empty() || !monitors) return std::nullopt;
  const auto watchers = cell_monitors::watchers_of(*monitors);
  driver::CompileInput input = files.input();
  input.watchers = watchers;
  auto output = driver::compile(input);
  append(problems, output ? output->warnings : output.error());
  if (!output) return std::nullopt;
  return std::move(output->container);
}

}  // namespace stepwright::cell_program
