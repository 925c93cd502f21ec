#include "ladder/driver/compile.h"

#include <utility>

#include "ladder/codegen/generate.h"
#include "ladder/driver/container_names.h"
#include "ladder/driver/library.h"
#include "ladder/driver/pou_lowering.h"
#include "ladder/semantics/analyze.h"

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

}  // namespace

result::Result<CompileOutput> compile(const CompileInput& input) {
  source::SourceSet sources;
  source::NameTable names;
  syntax::intern_keywords(names);
  source::DiagnosticSink sink(sources);
  syntax::SyntaxContext context{sources, names, sink};
  syntax::Unit unit;
  for (const source::NamedText& each : input.texts)
    syntax::parse_unit(context, sources.add(each.name, each.text), unit);
  PouLowering lowering(context, unit);
  lowering.lower_charts();
  lowering.add_projects(input.projects);
  const std::size_t user_pous = unit.pous.size();
  add_library(context, unit);
  lowering.report_foreign_types();
  const auto model = semantics::analyze(unit, user_pous, names, sink);
  if (sink.has_errors()) return tl::unexpected(sink.take());
  auto container = codegen::generate(*model, chart_origins(lowering, *model), sources,
                                     container_names(sources, input.folder));
  if (!container) return result::forward(container);
  CompileOutput output;
  output.container = std::move(*container);
  lint::check(*model, unit, user_pous, input.lint, sink);
  output.warnings = lint::without_suppressed(sink.take(), sources);
  return output;
}

}  // namespace stepwright::driver
