#include "programs/hmi/compile_sources.h"

#include <deque>
#include <utility>

#include "ladder/driver/compile.h"
#include "ladder/exchange/plcopen_reader.h"
#include "programs/process/files.h"

namespace stepwright::hmi {

result::Result<api::Compiled> compile_sources(const api::SourceTexts& sources) {
  driver::CompileInput input;
  input.document = true;
  input.lint = lint::Level::Default;
  std::deque<graphic::Project> projects;
  result::Diagnostics problems;
  for (const auto& [name, text] : sources) {
    if (!process::is_xml(name)) {
      input.texts.push_back({name, text});
      continue;
    }
    auto project = exchange::read_plcopen(name, text);
    if (project) {
      projects.push_back(std::move(*project));
      input.projects.push_back(&projects.back());
    } else {
      problems.insert(problems.end(), project.error().begin(), project.error().end());
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  auto output = driver::compile(input);
  if (!output) return tl::unexpected(std::move(output.error()));
  return api::Compiled{std::move(output->container), std::move(output->warnings)};
}

}  // namespace stepwright::hmi
