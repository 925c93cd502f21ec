#pragma once

// A plant's file as it was written, its figures checked and in SI, its references still words
// (plant_models/doc/components.md):
//
//   [components.b1]
//   type = "pump"
//   head = "1.8 m"            # a parameter
//   in = "f1"                 # a port, connected to the only fitting port of f1
//   command = "B1"            # a signal from a terminal
//
//   [terminals]
//   B1 = "%QX0.0"
//   S1 = { address = "%IW1", from = "s1.counts" }
//
// Thread-safe: pure.

#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plant_models/components/component_type.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::components {

struct ConnectionText {
  std::size_t port = 0;  // of the type
  std::string to{};      // "f1", "f1.bottom", "B1", "60 percent"
  std::string prefix{};  // of names inside of an assembly: "station."
  result::Location where{};
};

struct ComponentText {
  std::string name{};
  const ComponentType* type = nullptr;
  Parameters parameters;
  std::vector<ConnectionText> connections;
  std::map<std::string, Unit, std::less<>> units;              // of parameters that share it with a port
  std::map<std::string, result::Location, std::less<>> where;  // of parameters
  result::Location place;
};

struct TerminalText {
  std::string name{};
  std::string address{};  // "%QX0.0"
  std::string from{};     // of a terminal that the program reads: "s1.counts"
  result::Location where{};
};

// Another name for a truth or a fault.
struct AliasText {
  std::string name{};
  std::string of{};
  std::string unit{};   // if it is to be another one
  double factor = 1.0;  // the value under this name is so many times the other
  result::Location where{};
};

struct SolverText {
  bool implicit = false;  // for plants with time constants far below a scan
  double relative_tolerance = 1e-6;
  double max_step_s = 0.1;
};

struct ModelText {
  std::string name{};
  std::filesystem::path file;
  std::list<ComponentType> own_types;   // described in the file itself
  std::list<ComponentType> file_types;  // of one component each, whose file describes it
  std::vector<ComponentText> components;
  std::map<std::string, std::string, std::less<>>
      port_names;  // of assemblies: "station.in" is "station.p1.in"
  std::vector<TerminalText> terminals;
  std::vector<AliasText> truths;
  std::vector<AliasText> faults;
  SolverText solver;
  double communication_step_s = 0.01;  // between two exchanges with parts that are processes
};

struct ModelOptions {
  std::uint64_t seed = 1;
  bool uncertainty = true;
  std::filesystem::path processes = {};  // where parts that are processes have a folder each
  std::filesystem::path programs = {};   // where their programs are; empty: beside the program that asks
  std::filesystem::path log = {};        // what they print is appended here; empty: to that of this process
};

// Fails with everything that is wrong in the file: C0001 to C0006, C0341 (unit), C0342 (unknown type).
[[nodiscard]] result::Result<ModelText> read_model(const std::filesystem::path& file, Catalogue catalogue,
                                                   const ModelOptions& options);
// The same of a document that is there already; `file` is its name.
[[nodiscard]] result::Result<ModelText> read_model(settings::TomlDocument& document,
                                                   const std::filesystem::path& file, Catalogue catalogue,
                                                   const ModelOptions& options);

}  // namespace stepwright::components
