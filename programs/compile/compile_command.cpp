#include "programs/compile/compile_command.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/source/render.h"
#include "programs/process/command_line.h"
#include "programs/process/diagnostics_json.h"
#include "runtime/result/exit_code.h"

namespace stepwright::compile_program {

namespace {

using result::ExitCode;

struct Arguments {
  std::vector<std::string> sources;
  std::string image;
  std::string json_file;
};

result::Result<source::NamedText> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    return result::fail("E0001", {path, 0, 0}, "cannot read the file");
  return source::NamedText{path, {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}};
}

bool is_xml(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".xml";
}

// Written beside its place and moved there, so that nobody meets half an image.
bool write(const std::string& path, const char* bytes, std::size_t size) {
  const std::string partial = path + ".part";
  {
    std::ofstream file(partial, std::ios::binary | std::ios::trunc);
    file.write(bytes, static_cast<std::streamsize>(size));
    if (!file.flush()) {
      std::remove(partial.c_str());
      return false;
    }
  }
  std::error_code failed;
  std::filesystem::rename(partial, path, failed);
  return !failed;
}

ExitCode compile(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  driver::CompileInput input;
  std::vector<source::NamedText> files;  // as they were written, for the lines of diagnostics
  std::deque<graphic::Project> projects;
  result::Diagnostics diagnostics;
  const auto fail = [&](const result::Diagnostics& errors) {
    diagnostics.insert(diagnostics.end(), errors.begin(), errors.end());
  };
  for (const std::string& path : arguments.sources) {
    auto text = read(path);
    if (!text) {
      fail(text.error());
      continue;
    }
    files.push_back(*text);
    if (!is_xml(path)) {
      input.texts.push_back(std::move(*text));
      continue;
    }
    auto project = exchange::read_plcopen(text->name, std::move(text->text));
    if (project) {
      input.projects.push_back(&projects.emplace_back(std::move(*project)));
    } else {
      fail(project.error());
    }
  }
  std::size_t bytes = 0;
  if (diagnostics.empty()) {
    const auto output = driver::compile(input);
    diagnostics = output ? output->warnings : output.error();
    if (output) {
      bytes = output->container.size();
      if (!write(arguments.image, reinterpret_cast<const char*>(output->container.data()), bytes)) {
        result::Diagnostic& failure = diagnostics.emplace_back();
        failure.code = "E0002";
        failure.where.file = arguments.image;
        failure.message = "cannot write the file";
      }
    }
  }
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  for (const result::Diagnostic& each : diagnostics) std::cerr << source::render(each, files);
  const bool failed = result::has_errors(diagnostics);
  if (!arguments.json_file.empty()) {
    const nlohmann::json report = {{"diagnostics", process::diagnostics_json(diagnostics)},
                                   {"bytes", failed ? 0 : bytes},
                                   {"wall_ms", wall.count()}};
    const std::string text = report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (!write(arguments.json_file, text.data(), text.size())) {
      std::cerr << arguments.json_file << ": error E0002: cannot write the file\n";
      return ExitCode::BadInput;
    }
  }
  return failed ? ExitCode::BadInput : ExitCode::Done;
}

}  // namespace

int run_compile(int argc, char** argv) {
  CLI::App app("Compiles IEC 61131-3 sources to a bytecode image", "stepwright compile");
  Arguments arguments;
  app.add_option("sources", arguments.sources, "ST files (.st) and PLCopen projects (.xml)")->required();
  app.add_option("-o,--output", arguments.image, "image file to write (.swb)")->required();
  app.add_option("--json", arguments.json_file, "file for the report");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(compile(arguments));
}

}  // namespace stepwright::compile_program
