#pragma once

// `stepwright translate`: a PDDL plan and a binding to a chart, a ladder diagram, PLCopen XML or Omron
// mnemonics.

#include <filesystem>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::translate_command {

struct Arguments {
  std::filesystem::path plan;
  std::filesystem::path binding;
  std::filesystem::path domain;   // empty: domain.pddl beside the binding
  std::filesystem::path problem;  // empty: problem.pddl beside the binding
  std::filesystem::path output;   // empty: standard output
  std::string to = "sfc";         // sfc, ladder, plcopen, omron
  bool svg = false;               // sfc and ladder as a drawing; also if `output` ends in .svg
  bool lowered = false;           // plcopen: the ladder diagram instead of the chart
  bool sequential = false;
  std::filesystem::path handshake;  // not empty: the program is commanded step by step; its table goes there
};

struct Output {
  std::string document;
  std::string table;    // of the handshake; empty without one
  std::string summary;  // makespans and what is assumed, for the terminal
};

// Reads the files and translates; writes nothing.
[[nodiscard]] result::Result<Output> translate_files(const Arguments& arguments);

// Writes the document as a whole or not at all.
[[nodiscard]] result::Result<void> write_document(const std::filesystem::path& file,
                                                  const std::string& document);

}  // namespace stepwright::translate_command
