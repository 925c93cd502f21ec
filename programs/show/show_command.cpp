#include "programs/show/show_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "ladder/driver/sheets.h"
#include "ladder/graphic/identifier.h"
#include "ladder/print/print.h"
#include "ladder/source/suggestion.h"
#include "ladder/source_files/source_files.h"
#include "ladder/source_files/source_options.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::show {

namespace {

using result::ExitCode;

struct Arguments {
  std::vector<std::string> files;
  std::string pou;
  std::string format = "text";
  std::string paper = "a4";
  std::string output;
  sources::SourceOptions options;
};

ExitCode fail(const result::Diagnostics& diagnostics, const sources::SourceFiles& sources) {
  sources::print(diagnostics, sources.files);
  return ExitCode::BadInput;
}

// The sheet of one POU.
result::Result<std::vector<graphic::Sheet>> only(const std::string& pou, std::vector<graphic::Sheet> sheets) {
  std::vector<std::string_view> names;
  for (graphic::Sheet& each : sheets) {
    if (graphic::same_name(each.name, pou)) return std::vector<graphic::Sheet>{std::move(each)};
    names.push_back(each.name);
  }
  return result::fail("E0003", {}, "there is no POU '" + pou + "'", source::did_you_mean(pou, names));
}

std::string project_name(const Arguments& arguments, const sources::SourceFiles& sources) {
  if (!sources.projects.empty() && !sources.projects.front().name.empty())
    return sources.projects.front().name;
  return std::filesystem::path(arguments.files.front()).stem().string();
}

ExitCode show(const Arguments& arguments) {
  result::Diagnostics unread;
  const sources::SourceFiles sources = sources::load(arguments.files, unread, arguments.options);
  if (!unread.empty()) return fail(unread, sources);
  auto sheets = driver::sheets_of(sources.input());
  if (sheets && !arguments.pou.empty()) sheets = only(arguments.pou, std::move(*sheets));
  if (!sheets) return fail(sheets.error(), sources);
  print::PrintOptions options{.project = project_name(arguments, sources)};
  if (arguments.paper == "a3") options.paper = print::Paper::A3;
  const std::string text =
      arguments.format == "svg" ? print_svg(*sheets, options) : print_text(*sheets, options);
  if (arguments.output.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return ExitCode::Done;
  }
  const result::Diagnostics unwritten = files::write_file(arguments.output, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten, sources);
}

}  // namespace

int run_show(int argc, char** argv) {
  CLI::App app("Prints programs: declarations, rungs, charts, listings and cross references",
               "stepwright show");
  Arguments arguments;
  app.add_option("files", arguments.files, "ST files (.st) and PLCopen projects (.xml)")->required();
  sources::add_source_options(app, arguments.options);
  app.add_option("--pou", arguments.pou, "print this POU only");
  app.add_option("--to", arguments.format, "text for a terminal, svg for pages")
      ->check(CLI::IsMember({"text", "svg"}));
  app.add_option("--paper", arguments.paper, "a4 (upright) or a3 (on its side)")
      ->check(CLI::IsMember({"a4", "a3"}));
  app.add_option("-o,--output", arguments.output, "file to write; without it standard output");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(show(arguments));
}

}  // namespace stepwright::show
