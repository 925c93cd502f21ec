#include "ladder/source_files/source_files.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/source/codes.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::sources {

namespace {

using result::kByteOrderMark;

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

source::RenderStyle style_of(int descriptor) {
  source::RenderStyle style;
  if (isatty(descriptor) == 0) return style;
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  style.colour = (no_colour == nullptr || *no_colour == '\0') &&
                 (terminal == nullptr || std::string_view(terminal) != "dumb");
  winsize size{};
  // Room for the number of the line and the dots of a cut.
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 40) style.width = size.ws_col - 20u;
  return style;
}

driver::CompileInput SourceFiles::input() const {
  driver::CompileInput input;
  input.texts = texts;
  input.dialect = options.dialect;
  std::error_code unknown;  // a folder that is gone: names stay as they are given
  input.folder = std::filesystem::current_path(unknown).string();
  for (const graphic::Project& each : projects) input.projects.push_back(&each);
  return input;
}

void SourceFiles::add(const std::string& name, std::string text, result::Diagnostics& diagnostics) {
  const bool xml = files::is_xml(name);
  if (!xml && text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  files.push_back({name, text});
  if (!xml) {
    texts.push_back({name, std::move(text)});
    return;
  }
  auto project = exchange::read_plcopen(name, std::move(text), *options.dialect, options.configuration);
  if (project) {
    projects.push_back(std::move(*project));
  } else {
    diagnostics.insert(diagnostics.end(), project.error().begin(), project.error().end());
  }
}

SourceFiles load(const std::vector<std::string>& paths, result::Diagnostics& diagnostics,
                 const SourceOptions& options) {
  SourceFiles sources;
  sources.options = options;
  for (const std::string& path : paths) {
    auto text = files::read_file(path);
    if (text) {
      sources.add(path, std::move(*text), diagnostics);
    } else {
      diagnostics.insert(diagnostics.end(), text.error().begin(), text.error().end());
    }
  }
  if (!options.configuration.empty() && std::ranges::none_of(paths, files::is_xml))
    diagnostics.push_back({source::code::kExchangeUnsupported,
                           result::Severity::Error,
                           {},
                           "there is no configuration '" + options.configuration + "' to choose",
                           "--configuration chooses one of a PLCopen file (.xml)"});
  return sources;
}

void print(const result::Diagnostics& diagnostics, std::span<const source::NamedText> files) {
  const source::RenderStyle style = style_of(STDERR_FILENO);
  std::size_t errors = 0;
  std::size_t warnings = 0;
  for (const result::Diagnostic& each : diagnostics) {
    errors += each.severity == result::Severity::Error ? 1 : 0;
    warnings += each.severity == result::Severity::Warning ? 1 : 0;
    std::cerr << source::render(each, files, style);
  }
  if (errors + warnings == 0) return;
  std::string summary = errors > 0 ? counted(errors, "error") : "";
  if (warnings > 0) summary += (summary.empty() ? "" : ", ") + counted(warnings, "warning");
  std::cerr << summary;
  const auto coded = std::ranges::find_if(diagnostics, [](const auto& each) { return !each.code.empty(); });
  if (coded != diagnostics.end())
    std::cerr << "; `stepwright explain " << coded->code << "` describes a code";
  std::cerr << "\n";
}

}  // namespace stepwright::sources
