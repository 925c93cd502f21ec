#include "programs/check/compile_sources.h"

#include <string>
#include <utility>
#include <vector>

#include "cell/monitors/cell_monitors.h"
#include "ladder/source_files/source_files.h"

namespace stepwright::check {

std::optional<CellProgram> compile_sources(const config::CellConfig& config, result::Diagnostics& problems) {
  std::vector<std::string> paths;
  for (const std::filesystem::path& each : config.boot.sources) paths.push_back(each.string());
  result::Diagnostics unread;
  const source::Dialect* const dialect = source::find_dialect(config.boot.dialect);
  const sources::SourceFiles files = sources::load(paths, unread, {.dialect = dialect});
  const auto monitors = cell_monitors::cell_monitors(config);
  add(problems, unread);
  if (!unread.empty() || !monitors) return std::nullopt;  // what is wrong with monitors is told already
  const auto watchers = cell_monitors::watchers_of(*monitors);
  driver::CompileInput input = files.input();
  input.watchers = watchers;
  auto output = driver::compile(input);
  add(problems, output ? output->warnings : output.error());
  if (!output) return std::nullopt;
  return CellProgram{paths.front(), std::move(output->container)};
}

}  // namespace stepwright::check
