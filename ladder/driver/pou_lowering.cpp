#include "ladder/driver/pou_lowering.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "ladder/driver/chart_conversion.h"
#include "ladder/driver/declaration_text.h"
#include "ladder/driver/foreign_types.h"
#include "ladder/graphic/sfc_hazards.h"
#include "ladder/lowering/diagram_to_chart.h"
#include "ladder/lowering/diagram_to_ladder.h"
#include "ladder/lowering/ladder_to_syntax.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "ladder/source/codes.h"
#include "ladder/syntax/namespace_lookup.h"

namespace stepwright::driver {

namespace {

using TypesByName = std::unordered_map<std::uint32_t, const syntax::TypeDeclaration*>;  // by NameId

syntax::PouKind kind_of(graphic::PouKind kind) {
  switch (kind) {
    case graphic::PouKind::Program:
      return syntax::PouKind::Program;
    case graphic::PouKind::FunctionBlock:
      return syntax::PouKind::FunctionBlock;
    default:
      return syntax::PouKind::Function;
  }
}

graphic::PouKind kind_of(syntax::PouKind kind) {
  switch (kind) {
    case syntax::PouKind::Program:
      return graphic::PouKind::Program;
    case syntax::PouKind::FunctionBlock:
      return graphic::PouKind::FunctionBlock;
    default:
      return graphic::PouKind::Function;
  }
}

TypesByName types_by_name(const syntax::Unit& unit) {
  TypesByName types;
  for (const syntax::TypeDeclaration& each : unit.types)
    if (each.type) types.try_emplace(each.name.id.value, &each);
  return types;
}

// What the chart's lowering needs to know of POUs: names and types.
class ChartPous {
 public:
  ChartPous(const source::NameTable& names, const syntax::Unit& unit)
      : names_(names), lookup_(names, unit), types_(types_by_name(unit)) {}

  graphic::Pou with_chart(const syntax::PouDeclaration& pou) const {
    graphic::Pou result;
    result.name = std::string(pou.name.text);
    result.kind = kind_of(pou.kind);
    for (const syntax::VariableDeclaration& line : pou.variables) {
      const bool named = line.type->kind == syntax::TypeKind::Named;
      const std::string type = named ? type_name(line.type->name, pou.scope) : "STRUCT";
      for (const syntax::Name& name : line.names) {
        graphic::Variable variable;
        variable.name = std::string(name.text);
        variable.type = type;
        result.variables.push_back(std::move(variable));
      }
    }
    return result;
  }

 private:
  // The name behind an alias: BOOL where TYPE Flag : BOOL; END_TYPE.
  std::string type_name(syntax::Name name, const syntax::NameScope* scope) const {
    for (std::size_t depth = 0; depth <= types_.size(); ++depth) {
      const auto meant = lookup_.find(names_.folded(name.id), scope);
      const auto found = meant ? types_.find(meant->id.value) : types_.end();
      if (found == types_.end() || found->second->type->kind != syntax::TypeKind::Named) break;
      name = found->second->type->name;
      scope = found->second->scope;
    }
    return std::string(name.text);
  }

  const source::NameTable& names_;
  syntax::NamespaceLookup lookup_;
  TypesByName types_;
};

}  // namespace

// Diagnostics of the chart modules have no place of their own: they speak of the POU.
void PouLowering::report(result::Diagnostics diagnostics, source::Position where) {
  for (result::Diagnostic& each : diagnostics)
    if (each.where.file.empty()) each.where = context_.sources.location(where);
  context_.sink.add(std::move(diagnostics));
}

void PouLowering::add_declarations(const std::string& file, const std::string& text,
                                   syntax::PouDeclaration& pou) {
  const source::FileId id = context_.sources.add(file, text);
  auto lines = syntax::parse_variables(context_, id, syntax::TextKind::Generated);
  for (auto& each : lines) pou.variables.push_back(std::move(each));
}

void PouLowering::mark_generated(syntax::PouDeclaration& pou, std::size_t first) {
  for (std::size_t i = first; i < pou.variables.size(); ++i) pou.variables[i].generated = true;
}

void PouLowering::set_ladder(const graphic::LadderProgram& ladder, const std::string& file,
                             syntax::PouDeclaration& pou) {
  const bool keeps_state = pou.kind != syntax::PouKind::Function;
  auto lowered = lowering::ladder_to_syntax(ladder, file, keeps_state, context_);
  pou.body = std::move(lowered.body);
  pou.origin = syntax::BodyOrigin::Ladder;
  const std::size_t written = pou.variables.size();
  for (auto& each : lowered.variables) pou.variables.push_back(std::move(each));
  mark_generated(pou, written);
}

void PouLowering::set_lowered(const graphic::Pou& lowered, std::size_t known_variables,
                              graphic::SfcChart origin, std::size_t index) {
  syntax::PouDeclaration& pou = unit_.pous[index];
  std::string added;
  for (std::size_t i = known_variables; i < lowered.variables.size(); ++i)
    added += declarations_.variable(lowered.variables[i]) + "\n";
  const std::size_t written = pou.variables.size();
  add_declarations(lowered.name + ".sfc", added, pou);
  mark_generated(pou, written);
  set_ladder(std::get<graphic::LadderProgram>(lowered.body), lowered.name + ".sfc", pou);
  pou.origin = syntax::BodyOrigin::Chart;
  charts_.push_back({index, std::move(origin), lowered.step_variables, lowered.transition_variables});
}

void PouLowering::lower_charts() {
  const ChartPous pous(context_.names, unit_);
  for (std::size_t i = 0; i < unit_.pous.size(); ++i) {
    if (!unit_.pous[i].chart) continue;
    const source::Position where = unit_.pous[i].name.where;
    if (unit_.pous[i].kind == syntax::PouKind::Function) {
      context_.sink.error(source::code::kBadChart, where, "a function keeps no state and cannot be a chart",
                          "use a function block");
      continue;
    }
    const std::size_t errors = context_.sink.error_count();
    graphic::Pou pou = pous.with_chart(unit_.pous[i]);
    const syntax::Chart& chart = *unit_.pous[i].chart;
    pou.body = to_graphic(chart, Marks::Source, context_.sources, context_.sink);
    if (context_.sink.error_count() != errors) continue;
    // A POU sees what it declares: its globals are among them as VAR_EXTERNAL.
    auto lowered = lowering::lower_sfc(pou, {});
    if (!lowered) {
      report(std::move(lowered.error()), where);
      continue;
    }
    report(graphic::find_hazards(lowered->origin), where);
    set_lowered(*lowered, pou.variables.size(),
                to_graphic(chart, Marks::None, context_.sources, context_.sink), i);
  }
}

void PouLowering::add_pou(const graphic::Pou& pou, source::FileId file) {
  const std::string& name = texts_.emplace_back(pou.name);
  source::Position where{file, pou.where};
  if (pou.where == 0) where = {context_.sources.add(name, name + "\n"), 0};
  syntax::PouDeclaration declaration;
  declaration.kind = kind_of(pou.kind);
  declaration.name = {context_.names.intern(name), name, where};
  declaration.end = where;
  if (declaration.kind == syntax::PouKind::Function) {
    const std::string& result = texts_.emplace_back(pou.result_type);
    declaration.result = std::make_unique<syntax::TypeSpec>();
    declaration.result->kind = syntax::TypeKind::Named;
    declaration.result->where = where;
    declaration.result->name = {context_.names.intern(result), result, where};
  }
  std::string variables;
  for (const graphic::Variable& each : pou.variables)
    variables += mark_text(file, each.where) + declarations_.variable(each) + "\n";
  add_declarations(name + ".var", variables, declaration);
  if (const auto* text = std::get_if<graphic::StBody>(&pou.body)) {
    const source::FileId body = context_.sources.add(name + ".st", text->text);
    declaration.body = syntax::parse_statements(context_, body, syntax::TextKind::Written);
  } else if (const auto* ladder = std::get_if<graphic::LadderProgram>(&pou.body)) {
    set_ladder(*ladder, name + ".ld", declaration);
    if (!pou.origin.steps.empty())
      charts_.push_back({unit_.pous.size(), pou.origin, pou.step_variables, pou.transition_variables});
  }
  unit_.pous.push_back(std::move(declaration));
  if (std::holds_alternative<graphic::DrawnBody>(pou.body)) return add_drawn(pou, file);
  if (!std::holds_alternative<graphic::SfcChart>(pou.body)) return;
  auto lowered = lowering::lower_sfc(pou);
  if (!lowered) return report(std::move(lowered.error()), where);
  report(graphic::find_hazards(lowered->origin), where);
  set_lowered(*lowered, pou.variables.size(), std::get<graphic::SfcChart>(pou.body), unit_.pous.size() - 1);
}

void PouLowering::add_drawn(const graphic::Pou& pou, source::FileId file) {
  const graphic::DiagramBody& body = std::get<graphic::DrawnBody>(pou.body).body;
  syntax::PouDeclaration& declaration = unit_.pous.back();
  if (body.language == graphic::BodyLanguage::StructuredText) {
    const source::FileId text = add_text(context_.sources, file, pou.name + ".st", body.text);
    declaration.body = syntax::parse_statements(context_, text, syntax::TextKind::Written);
    return;
  }
  if (body.language == graphic::BodyLanguage::InstructionList) {
    context_.sink.error(source::code::kExchangeUnsupported, {file, body.where},
                        "instruction lists are not supported", "write the body in ST");
    return;
  }
  if (body.diagram.language == graphic::DiagramLanguage::Chart) return add_chart(pou, file);
  ProjectScope scope(pou, interfaces_, file, context_);
  const std::size_t errors = context_.sink.error_count();
  const graphic::LadderProgram ladder = lowering::diagram_to_ladder(body.diagram, scope);
  if (context_.sink.error_count() == errors) set_ladder(ladder, pou.name + ".ld", declaration);
}

void PouLowering::add_chart(const graphic::Pou& pou, source::FileId file) {
  const std::size_t index = unit_.pous.size() - 1;
  const std::size_t errors = context_.sink.error_count();
  const auto& body = std::get<graphic::DrawnBody>(pou.body);
  ProjectScope scope(pou, interfaces_, file, context_);
  lowering::DrawnChart drawn = lowering::diagram_to_chart(body, scope);
  if (context_.sink.error_count() != errors) return;
  ProjectScope plain(pou, interfaces_, file, context_);
  plain.hide_marks();
  graphic::SfcChart origin = lowering::shown_chart(body, plain);
  graphic::Pou chart = pou;
  chart.body = std::move(drawn.chart);
  std::vector<graphic::Wire>& wires = drawn.networks.every_scan.wires;
  wires.insert(wires.end(), drawn.edges.begin(), drawn.edges.end());
  const source::Position where{file, pou.where};
  auto lowered = lowering::lower_sfc_beside(chart, std::move(drawn.networks));
  if (!lowered) return report(std::move(lowered.error()), where);
  report(graphic::find_hazards(origin), where);
  set_lowered(*lowered, pou.variables.size(), std::move(origin), index);
}

std::string PouLowering::mark_text(source::FileId file, std::uint32_t where) {
  if (where == 0) return {};
  return "{@" + std::to_string(file.value) + ":" + std::to_string(where) + "!}";
}

// Where POUs begin, and where something else does.
void PouLowering::add_notes(const graphic::Project& project, source::FileId file) {
  const auto note = [&](std::uint32_t where, std::string text) {
    if (where != 0) context_.sources.add_note({file, where}, std::move(text));
  };
  for (const graphic::Pou& each : project.pous) note(each.where, "POU '" + each.name + "'");
  for (const graphic::Task& each : project.tasks) note(each.where, {});
  for (const graphic::ProgramInstance& each : project.instances) note(each.where, {});
  for (const graphic::Variable& each : project.globals) note(each.where, {});
  for (const graphic::Resource& resource : project.resources)
    for (const graphic::Variable& each : resource.globals) note(each.where, {});
}

void PouLowering::add_projects(const std::vector<const graphic::Project*>& projects) {
  interfaces_.add(unit_, context_.names);
  const std::size_t written_globals = unit_.globals.size();
  const std::size_t written_pous = unit_.pous.size();
  const std::size_t written_configurations = unit_.configurations.size();
  for (const graphic::Project* each : projects) interfaces_.add(*each);
  for (const graphic::Project* each : projects) add_project(*each);
  project_pous_ = {written_pous, unit_.pous.size()};
  project_configurations_ = {written_configurations, unit_.configurations.size()};
  project_globals_ = {written_globals, unit_.globals.size()};
}

void PouLowering::report_foreign_types() {
  const ForeignTypes types(unit_, context_);
  for (std::size_t i = project_pous_.begin; i < project_pous_.end; ++i) types.report(unit_.pous[i].variables);
  types.report(std::span(unit_.globals)
                   .subspan(project_globals_.begin, project_globals_.end - project_globals_.begin));
  for (std::size_t i = project_configurations_.begin; i < project_configurations_.end; ++i) {
    types.report(unit_.configurations[i].globals);
    for (syntax::Resource& each : unit_.configurations[i].resources) types.report(each.globals);
  }
}

void PouLowering::add_project(const graphic::Project& project) {
  const source::FileId origin =
      context_.sources.add(project.file_name.empty() ? "project" : project.file_name, project.file_text);
  add_notes(project, origin);
  const std::string name = project.name.empty() ? "project" : project.name;
  const auto mark = [&](std::uint32_t where) { return mark_text(origin, where); };
  const std::string types = declarations_.types(project, mark);
  if (!types.empty())
    syntax::parse_unit(context_, context_.sources.add(name + ".types", types), unit_,
                       syntax::TextKind::Generated);
  for (const graphic::Pou& each : project.pous) add_pou(each, origin);
  const std::string text = declarations_.configuration(project, mark);
  if (!text.empty())
    syntax::parse_unit(context_, context_.sources.add(name + ".cfg", text), unit_,
                       syntax::TextKind::Generated);
}

}  // namespace stepwright::driver
