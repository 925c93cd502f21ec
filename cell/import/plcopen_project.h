#pragma once

// A PLCopen project of another system (Beremiz, OpenPLC Editor, CODESYS) as what a cell needs of it: its
// programs with addresses of a cell's image, its tasks, its inputs and outputs, and what could not be taken.
//
//   auto project = read_project("plc.xml", {.dialect = "matiec"});
//
// Not thread-safe; reads the files that it is given and the names beside them.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cell/import/beremiz_devices.h"
#include "ladder/graphic/project.h"
#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_import {

struct Signal {
  std::string name;     // as the program calls it: "instance0.lamp"
  std::string address;  // in the cell's image
  std::string before;   // in the other system
  std::string type;     // of IEC 61131-3, as it is written
  std::string comment;
};

struct TakenProject {
  std::string name;               // of the project
  std::string dialect;            // of its sources (ladder/doc/dialects.md)
  std::string xml;                // the file, with the addresses of the cell
  graphic::Project model;         // the same, read
  std::vector<Signal> signals;    // in the order of their addresses
  std::uint32_t input_bytes = 0;  // of the image that they need
  std::uint32_t output_bytes = 0;
  std::vector<std::pair<std::string, std::string>> moved;  // addresses: there, here
  ForeignDevices devices;                                  // over Modbus, that the editor knows
  std::vector<std::string> left;                           // what could not be taken, a line for each
  result::Diagnostics problems;                            // why the program of the cell does not compile
};

struct ProjectOptions {
  std::string dialect = "matiec";
  std::string configuration{};  // of those that the file has; empty: it has one
};

// `path`: the file, or the folder of a project of Beremiz or OpenPLC Editor with its plc.xml. Fails with
// M0020 where that is no PLCopen file, and as ladder/exchange/plcopen_reader.h says.
[[nodiscard]] result::Result<TakenProject> read_project(const std::filesystem::path& path,
                                                        const ProjectOptions& options);

// "main.xml:7:3: E0302: ...".
std::string line_of(const result::Diagnostic& problem);

}  // namespace stepwright::cell_import
