// Globals and the configuration (IEC 61131-3, 6.8).

#include <algorithm>
#include <utility>

#include "ladder/semantics/configuration/configurer.h"
#include "ladder/semantics/declarations/constant_order.h"

namespace stepwright::semantics::internal {

namespace {

// Whether a global may be declared so; reports why not.
bool is_global_line(Analysis& a, const syntax::VariableDeclaration& line, const Type& type) {
  const Position where = line.names.empty() ? line.address_where : line.names.front().where;
  if (line.open_address) {
    a.error(code::kAddressNotHere, line.address_where,
            "an open address stands in VAR of a program or a function block");
  } else if (line.edge != syntax::Edge::None) {
    a.error(code::kBadSection, where,
            "R_EDGE and F_EDGE stand in VAR_INPUT of a function block or a program");
  } else if (line.constant && type.kind == TypeKind::Instance) {
    a.error(code::kBadSection, where, "a function block cannot be CONSTANT");
  } else if (line.constant && line.retain) {
    a.error(code::kBadSection, where, "a CONSTANT needs no RETAIN");
  } else {
    return true;
  }
  return false;
}

void declare_global(Analysis& a, TypeResolver& types, const syntax::VariableDeclaration& line,
                    const syntax::Name& name, const Type* type) {
  Variable variable;
  variable.name = name.id;
  variable.spelling = std::string(name.text);
  variable.type = type;
  variable.section = Section::Global;
  variable.constant = line.constant;
  variable.retain = line.retain;
  variable.where = name.where;
  variable.place.type = type;
  if (type != nullptr) {
    ExpressionAnalyzer expressions(a, nullptr);
    std::vector<std::byte> bytes = types.initial_of(*line.type, *type);
    bool sound = !line.initial || initialise(a, expressions, *line.initial, *type, bytes);
    if (sound && line.constant) variable.value = a.folded_value(*type, bytes);
    if (sound && line.address) {
      sound = locate(a, line, variable, bytes);
    } else if (sound) {
      variable.place = a.allocate_place(type, bytes, name.where);
    }
    if (!sound) variable.type = nullptr;
  }
  const auto index = static_cast<std::uint32_t>(a.model.globals.size());
  if (!a.globals.try_emplace(name.id.value, index).second) {
    a.error(code::kDuplicate, name.where, "there is another global variable " + quote(name.text));
    return;
  }
  a.model.globals.push_back(std::move(variable));
}

// Without a configuration the only program runs every 10 ms.
void configure_default(Analysis& a, TypeResolver& types, std::size_t user_pous) {
  // A POU that could not be read may be the missing one, a second one of a name the one too many.
  if (a.sink.has_errors()) return;
  const Pou* only = nullptr;
  for (std::size_t i = 0; i < user_pous; ++i) {
    const Pou& each = *a.model.pous[i];
    if (each.kind != PouKind::Program) continue;
    if (only != nullptr) {
      a.error(code::kNoProgram, each.where, "several programs and no configuration that says when each runs",
              "add a CONFIGURATION with a TASK and PROGRAM ... WITH ...");
      return;
    }
    only = &each;
  }
  if (only == nullptr) {
    a.error(code::kNoProgram, Position(), "there is no PROGRAM to run");
    return;
  }
  const syntax::Configuration none;
  Configurer(a, types, none).run_only(*only);
}

}  // namespace

void declare_globals(Analysis& a, TypeResolver& types, const syntax::Unit& unit, bool constants) {
  std::vector<const syntax::VariableDeclaration*> lines;
  const auto collect = [&](const std::vector<syntax::VariableDeclaration>& more) {
    for (const syntax::VariableDeclaration& line : more)
      if (line.constant == constants) lines.push_back(&line);
  };
  collect(unit.globals);
  for (const syntax::Configuration& each : unit.configurations) {
    collect(each.globals);
    for (const syntax::Resource& resource : each.resources) collect(resource.globals);
  }
  // The variables of a function block may name globals, so that these come first.
  std::stable_partition(lines.begin(), lines.end(),
                        [&](const auto* line) { return !types.names_block(*line->type); });
  const ConstantOrder ordered = constant_order(a, lines, unit.types);
  for (const std::size_t i : ordered.order) {
    const syntax::VariableDeclaration* line = lines[i];
    const Type* type = ordered.broken[i] ? nullptr : types.resolve(*line->type);
    if (type != nullptr && !is_global_line(a, *line, *type)) type = nullptr;
    ExpressionAnalyzer expressions(a, nullptr);
    if (line->names.empty() && type != nullptr) declare_direct(a, types, expressions, *line, *type);
    for (const syntax::Name& name : line->names) declare_global(a, types, *line, name, type);
  }
}

void configure(Analysis& a, TypeResolver& types, const syntax::Unit& unit, std::size_t user_pous) {
  if (unit.configurations.empty()) return configure_default(a, types, user_pous);
  if (unit.configurations.size() > 1) {
    a.error(code::kSeveralConfigurations, unit.configurations[1].name.where,
            "there is more than one configuration");
    return;
  }
  const syntax::Configuration& configuration = unit.configurations.front();
  Configurer(a, types, configuration).run();
  const auto& resources = configuration.resources;
  const bool has_programs = std::any_of(resources.begin(), resources.end(),
                                        [](const auto& each) { return !each.programs.empty(); });
  if (!has_programs)
    a.error(code::kNoProgram, configuration.name.where, "the configuration runs no program",
            "write PROGRAM name WITH task : type;");
}

}  // namespace stepwright::semantics::internal
