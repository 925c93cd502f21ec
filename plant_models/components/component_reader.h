#pragma once

// One table of [components]: its parameters by its type, and what its ports are connected to.

#include <set>
#include <string>

#include "plant_models/components/model_text.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::components {

// The figure of a parameter, or its default; what is wrong is reported to the document. `replaced` is what a
// value "$name" stands for.
Quantity read_figure(const settings::TomlTable& table, const ParameterSpec& spec, const Replaced& replaced);

// What does not exist and could have been meant.
std::string meant_or(const std::string& word, const std::vector<std::string>& known);

class ComponentReader {
 public:
  ComponentReader(Catalogue catalogue, const Parameters& of_plant, const settings::TomlTable& root,
                  const ModelOptions& options, ModelText& model);

  // Adds the component of that name, or all parts of one that is an assembly.
  void read(const settings::TomlTable& table, const std::string& name);
  // Checks what stands in assemblies that no component is made of. Call it last.
  void read_unused();

 private:
  struct Around {
    std::string prefix;  // "station." of what is inside of an assembly
    Replaced replaced{};
    std::size_t depth = 0;
    bool unused = false;  // it is only checked: what its parameters would be is not known
  };
  bool read_in(const settings::TomlTable& table, const std::string& name, const Around& around);
  bool read_assembly(const settings::TomlTable& table, const std::string& type, const std::string& name,
                     const Around& around);
  bool read_part(const settings::TomlTable& table, const ComponentType& type, const std::string& name,
                 const Around& around);
  void read_unused(const std::string& type);
  bool read_unused_part(const settings::TomlTable& table, const std::string& name, const Around& around);
  bool is_port_of(const settings::TomlTable& parts, const std::string& port) const;
  bool is_too_many(const settings::TomlTable& table);
  void report_no_type(const settings::TomlTable& table, const std::string& type) const;
  static bool is_name(const settings::TomlTable& table, const std::string& name);
  std::string part_port(const std::string& name) const;
  bool connect(const std::string& port, std::size_t first, ConnectionText connection);
  const ComponentType* find_type(const std::string& name) const;
  const ComponentType* read_file_type(const settings::TomlTable& table, const ComponentType& type,
                                      const std::string& name, const Around& around);

  Catalogue catalogue_;
  Parameters of_plant_;
  const ModelOptions& options_;
  settings::TomlTable assemblies_;
  std::set<std::string, std::less<>> used_assemblies_;
  ModelText& model_;
  std::set<std::string, std::less<>> wrong_types_;  // of the file's own
  std::size_t read_ = 0;                            // components and assemblies, those inside of others, too
};

}  // namespace stepwright::components
