#include "programs/hmi/compile_sources.h"

#include <utility>

#include "ladder/source_files/source_files.h"

namespace stepwright::hmi {

result::Result<api::Compiled> compile_sources(const api::SourceTexts& texts, const source::Dialect& dialect,
                                              std::span<const driver::Watcher> watchers) {
  sources::SourceFiles files;
  files.options.dialect = &dialect;
  result::Diagnostics problems;
  for (const auto& [name, text] : texts) files.add(name, text, problems);
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  driver::CompileInput input = files.input();
  input.folder.clear();  // they come from a page, not from here
  input.document = true;
  input.watchers = watchers;
  input.lint = lint::Level::Default;
  auto output = driver::compile(input);
  if (!output) return tl::unexpected(std::move(output.error()));
  return api::Compiled{std::move(output->container), std::move(output->warnings)};
}

}  // namespace stepwright::hmi
