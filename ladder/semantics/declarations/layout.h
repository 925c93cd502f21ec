#pragma once

// Lays out the variables of one POU: the memory of each and what it starts with (IEC 61131-3, 6.5.2, 6.6).

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

class Layout {
 public:
  Layout(Analysis& analysis, TypeResolver& types, Pou& pou)
      : a_(analysis), types_(types), pou_(pou), expressions_(analysis, &pou) {}

  void run();

 private:
  // layout.cpp
  const Type* type_of(const syntax::VariableDeclaration& line);
  void declare(const syntax::VariableDeclaration& line, const syntax::Name& name, const Type* type);
  void add(Variable variable);
  bool place(const syntax::VariableDeclaration& line, Variable& variable);
  bool external(Variable& variable);
  bool place_in_instance(Variable& variable, const std::vector<std::byte>& bytes);
  std::uint32_t append(const std::vector<std::byte>& bytes);
  void place_reference(Variable& variable);
  void sense_edge(Variable& variable);
  bool place_temporary(Variable& variable, const std::vector<std::byte>& bytes);
  Place new_slot(const Type* type);
  Place slot_place(std::uint32_t slot, const Type* type) const;
  // At the start of each run: the first value.
  void enter(const Variable& variable, const std::vector<std::byte>& bytes);
  void enter_with(const Place& place, const Constant& value, Position where);

  // enable_guard.cpp
  void guard_body();

  // function_layout.cpp
  void number_parameters();
  void declare_result();
  bool place_in_function(Variable& variable, const std::vector<std::byte>& bytes);
  void place_parameter(Variable& variable, const std::vector<std::byte>& bytes);

  // section_rules.cpp: whether a variable of the type may stand in the section; reports why not.
  bool allowed(const syntax::VariableDeclaration& line, const Type& type);
  std::string forbidden_block(const syntax::VariableDeclaration& line) const;
  std::string forbidden_qualifier(const syntax::VariableDeclaration& line, const Type& type) const;
  bool address_allowed(const syntax::VariableDeclaration& line);

  Analysis& a_;
  TypeResolver& types_;
  Pou& pou_;
  ExpressionAnalyzer expressions_;
  std::vector<const Type*> line_types_;  // of the declaration's lines
  std::vector<std::byte> instance_;
  std::uint32_t next_parameter_ = 0;  // slot of the next input or in-out of a function
  std::uint32_t next_output_ = 0;     // slot of the next output of a function
};

// "VAR_INPUT"
const char* section_name(Section section);

}  // namespace stepwright::semantics::internal
