#pragma once

// POUs of every language as POU declarations of the syntax tree. Internal to this folder.

#include <deque>
#include <vector>

#include "ladder/driver/declaration_text.h"
#include "ladder/driver/project_scope.h"
#include "ladder/graphic/project.h"
#include "ladder/syntax/parser.h"

namespace stepwright::driver {

// A chart that a POU was lowered from.
struct LoweredChart {
  std::size_t pou = 0;  // index into Unit::pous
  graphic::SfcChart chart;
  std::vector<std::string> step_variables;
  std::vector<std::string> transition_variables;
};

// Brings charts and graphic POUs into a unit. Texts that the tree views live in this object.
class PouLowering {
 public:
  // All must outlive the lowering and the unit.
  PouLowering(syntax::SyntaxContext& context, syntax::Unit& unit) : context_(context), unit_(unit) {}

  // Every POU of the unit that holds a chart (textual SFC).
  void lower_charts();
  // Everything of the projects: POUs, globals, tasks, instances. Each may use the types and POUs of all.
  void add_projects(const std::vector<const graphic::Project*>& projects);

  // Reports types that the projects use and nothing declares. Requires that the library was added.
  void report_foreign_types();

  const std::vector<LoweredChart>& charts() const { return charts_; }

 private:
  void add_project(const graphic::Project& project);
  void add_pou(const graphic::Pou& pou, source::FileId file);
  // The body of a POU that was drawn, into the last POU of the unit.
  void add_drawn(const graphic::Pou& pou, source::FileId file);
  void add_chart(const graphic::Pou& pou, source::FileId file);
  void add_declarations(const std::string& file, const std::string& text, syntax::PouDeclaration& pou);
  // The variables from `first` on are none of the user's.
  static void mark_generated(syntax::PouDeclaration& pou, std::size_t first);
  void set_ladder(const graphic::LadderProgram& ladder, const std::string& file, syntax::PouDeclaration& pou);
  void set_lowered(const graphic::Pou& lowered, std::size_t known_variables, graphic::SfcChart origin,
                   std::size_t index);
  void add_notes(const graphic::Project& project, source::FileId file);
  // The mark of a byte of a file; nothing for 0.
  static std::string mark_text(source::FileId file, std::uint32_t where);
  void report(result::Diagnostics diagnostics, source::Position where);

  syntax::SyntaxContext& context_;
  syntax::Unit& unit_;
  std::vector<LoweredChart> charts_;
  std::deque<std::string> texts_;
  // Declarations from projects: indexes into the unit.
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  Range project_pous_;
  Range project_configurations_;
  Range project_globals_;
  ProgramInterfaces interfaces_;
  DeclarationText declarations_{interfaces_};
};

}  // namespace stepwright::driver
