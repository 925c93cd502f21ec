#include "ladder/driver/front_end.h"

#include <map>
#include <string>
#include <utility>

#include "ladder/codegen/generate.h"
#include "ladder/driver/container_names.h"
#include "ladder/driver/extension_types.h"
#include "ladder/driver/library.h"
#include "ladder/syntax/namespaces.h"

namespace stepwright::driver {

namespace {

codegen::ChartOrigin chart_origin(const LoweredChart& lowered, const semantics::Model& model) {
  codegen::ChartOrigin origin;
  origin.pou = model.pous[lowered.pou].get();
  const auto variable = [](const std::vector<std::string>& names, std::size_t i) {
    return i < names.size() ? names[i] : std::string();
  };
  const auto indexes = [](const std::vector<graphic::StepId>& steps) {
    std::vector<std::uint32_t> list;
    for (const graphic::StepId each : steps) list.push_back(each.value);
    return list;
  };
  for (const graphic::Step& each : lowered.chart.steps)
    origin.steps.push_back(
        {each.name, each.comment, each.initial, variable(lowered.step_variables, origin.steps.size())});
  for (const graphic::Transition& each : lowered.chart.transitions)
    origin.transitions.push_back({each.name, to_st(each.condition), indexes(each.sources),
                                  indexes(each.targets),
                                  variable(lowered.transition_variables, origin.transitions.size())});
  return origin;
}

std::vector<codegen::ChartOrigin> chart_origins(const PouLowering& lowering, const semantics::Model& model) {
  std::vector<codegen::ChartOrigin> origins;
  for (const LoweredChart& each : lowering.charts()) origins.push_back(chart_origin(each, model));
  return origins;
}

// Its states as steps, each of which may follow the first one.
codegen::ChartOrigin chart_of(const Watcher& watcher, const semantics::Pou* pou) {
  codegen::ChartOrigin origin;
  origin.pou = pou;
  for (const WatcherState& each : watcher.states)
    origin.steps.push_back({each.shown, each.comment, origin.steps.empty(), each.variable});
  for (std::uint32_t k = 1; k < origin.steps.size(); ++k)
    origin.transitions.push_back({{}, watcher.states[k].variable, {0}, {k}, {}});
  return origin;
}

}  // namespace

FrontEnd::FrontEnd(const CompileInput& input)
    : folder_(input.folder),
      dialect_(input.dialect),
      library_(input.library),
      sink_(sources_),
      context_{sources_, names_, sink_, input.dialect},
      lowering_(context_, unit_),
      watchers_(input.watchers) {
  syntax::intern_keywords(names_);
  for (const source::NamedText& each : input.texts)
    syntax::parse_unit(context_, sources_.add(each.name, each.text), unit_);
  lowering_.lower_charts();
  lowering_.add_projects(input.projects);
  user_pous_ = unit_.pous.size();
  for (const Watcher& each : watchers_)
    syntax::parse_unit(context_, sources_.add(each.name, each.text), unit_);
  add_library(context_, unit_);
  if (dialect_->extension_types) add_extension_types(context_, unit_);
  lowering_.report_foreign_types();
  syntax::resolve_namespaces(context_, unit_);
}

std::unique_ptr<semantics::Model> FrontEnd::analyze(const semantics::TestGroup* tests) {
  std::vector<std::uint32_t> watchers;
  for (const Watcher& each : watchers_) watchers.push_back(each.outside_reads);
  return semantics::analyze(unit_, user_pous_, names_, sink_,
                            {.tests = tests,
                             .library = library_,
                             .first_watcher = user_pous_,
                             .watchers = std::move(watchers),
                             .dialect = dialect_});
}

result::Result<std::vector<std::byte>> FrontEnd::container(const semantics::Model& model) const {
  auto charts = chart_origins(lowering_, model);
  for (std::size_t k = 0; k < watchers_.size(); ++k)
    if (!watchers_[k].states.empty())
      charts.push_back(chart_of(watchers_[k], model.pous[user_pous_ + k].get()));
  return codegen::generate(model, charts, sources_, container_names(sources_, folder_));
}

result::Result<std::vector<std::byte>> FrontEnd::test_container(const semantics::Model& model) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sources_.size(); ++i)
    names.push_back(sources_.name(source::FileId(static_cast<std::uint32_t>(i))));
  return codegen::generate(model, chart_origins(lowering_, model), sources_, names);
}

std::vector<semantics::TestGroup> FrontEnd::test_groups() {
  std::map<std::uint32_t, semantics::TestGroup> of_files;
  for (const syntax::PouDeclaration& each : unit_.mocks)
    of_files[each.name.where.file.value].mocks.push_back(&each);
  semantics::TestGroup others;
  std::map<std::string, source::Position> known;
  for (const syntax::TestDeclaration& each : unit_.tests) {
    const source::Position where = each.body.name.where;
    if (const auto [first, is_new] = known.try_emplace(each.name, where); !is_new) {
      const result::Location at = sources_.location(first->second);
      sink_.error(source::code::kDuplicate, where, "there is another test '" + each.name + "'",
                  "the first one is at " + at.file + ":" + std::to_string(at.line));
    }
    const auto group = of_files.find(where.file.value);
    (group != of_files.end() ? group->second : others).tests.push_back(&each);
  }
  std::vector<semantics::TestGroup> groups;
  if (!others.tests.empty()) groups.push_back(std::move(others));
  for (auto& [file, group] : of_files) groups.push_back(std::move(group));
  return groups;
}

}  // namespace stepwright::driver
