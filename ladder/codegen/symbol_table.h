#pragma once

// Types, symbols, retain map and charts of the container. Internal to this folder.

#include <string>
#include <unordered_map>
#include <vector>

#include "ladder/codegen/expression_emitter.h"
#include "ladder/codegen/generate.h"
#include "runtime/bytecode/writer/container_model.h"

namespace stepwright::codegen {

class SymbolTable {
 public:
  SymbolTable(const semantics::Model& model, const ProgramLayout& layout, writer::ContainerModel& out)
      : model_(model), layout_(layout), out_(out) {}

  void globals();
  // Symbols of the variables to which VAR_CONFIG gives an address.
  void configured();
  // The symbol of a trigger.
  std::uint32_t trigger(const semantics::Trigger& trigger);
  // A program instance: itself, its located variables, what it retains, the charts in it.
  void instance(const semantics::ProgramInstance& instance, const std::vector<ChartOrigin>& charts);
  // Completes the types of references, joins neighbouring pieces of the retain map.
  void finish();

 private:
  std::uint32_t type(const semantics::Type& type);
  std::uint32_t array_type(const semantics::Type& type, std::size_t dimension);
  std::uint32_t member_type(const semantics::Type& type);
  void add_member(const semantics::Variable& variable, std::vector<writer::Member>& out);
  std::uint32_t enumeration_type(const semantics::Type& type);
  std::uint32_t subrange_type(const semantics::Type& type);
  std::uint32_t reference_type(const semantics::Type& type);
  std::uint32_t add(writer::Type type);
  void variable(const semantics::Variable& variable, const std::string& path,
                bytecode::SymbolSection section);
  // It or a block in it is a chart; a variable in it says RETAIN or NON_RETAIN.
  bool holds_charts(const semantics::Pou& pou, const std::vector<ChartOrigin>& charts);
  bool speaks_of_retain(const semantics::Pou& pou);
  void walk(const std::string& path, const semantics::Pou& pou, std::uint32_t address,
            const std::vector<ChartOrigin>& charts);
  void retain(const semantics::Variable& variable, std::uint32_t address, semantics::Retention retention);
  void retain(const semantics::Type& type, std::uint32_t address, semantics::Retention retention);
  void chart(const std::string& path, const ChartOrigin& origin, std::uint32_t address);

  const semantics::Model& model_;
  const ProgramLayout& layout_;
  writer::ContainerModel& out_;
  std::unordered_map<const semantics::Type*, std::uint32_t> types_;
  std::unordered_map<std::string, std::uint32_t> names_;
  std::unordered_map<const semantics::Pou*, bool> holds_charts_;
  std::unordered_map<const semantics::Pou*, bool> speaks_of_retain_;
  // References whose targets get their types at the end: structures may refer to their own kind.
  std::vector<std::pair<std::uint32_t, const semantics::Type*>> references_;
};

}  // namespace stepwright::codegen
