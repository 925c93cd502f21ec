#include "programs/translate/translate_command.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include "ladder/exchange/omron_writer.h"
#include "ladder/exchange/plcopen_writer.h"
#include "ladder/graphic/ladder_drawing.h"
#include "ladder/graphic/sfc_drawing.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "ladder/lowering/step_timers.h"
#include "programs/translate/handshake_table.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/pddl/plan/partial_order.h"
#include "supervisor/pddl/plan/plan_file.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/task/vocabulary.h"
#include "supervisor/translate/handshake.h"
#include "supervisor/translate/schedule.h"
#include "supervisor/translate/translation.h"

namespace stepwright::translate_command {

namespace {

using result::Result;

std::filesystem::path beside(const std::filesystem::path& binding, const std::filesystem::path& given,
                             const char* name) {
  return given.empty() ? binding.parent_path() / name : given;
}

// The plan of the file, proved valid, with its partial order.
Result<model::PlannedRun> read_run(const pddl::Task& task, const std::filesystem::path& file) {
  auto source = pddl::read_source(file.string());
  if (!source) return result::forward(source);
  auto text = pddl::parse_plan(*source);
  if (!text) return result::forward(text);
  pddl::Validation validation = pddl::validate(task, *text, pddl::KeepStates::Last);
  if (!validation.valid) return tl::unexpected(std::move(validation.diagnostics));
  model::Plan plan;
  plan.actions = text->actions;
  auto orderings = pddl::lift_partial_order(task, plan);
  if (!orderings) return result::forward(orderings);
  plan.orderings = std::move(*orderings);
  return pddl::describe_run(task, plan);
}

const graphic::Pou& chart_pou(const translate::Translation& translation) {
  const auto& pous = translation.project.pous;
  return *std::find_if(pous.begin(), pous.end(),
                       [&](const graphic::Pou& pou) { return pou.name == translation.program; });
}

Result<std::string> sfc_document(const translate::Translation& translation, bool svg) {
  return svg ? graphic::draw_sfc_svg(translation.chart()) : graphic::draw_sfc_text(translation.chart());
}

Result<std::string> ladder_document(const translate::Translation& translation, bool svg) {
  auto pou = lowering::lower_sfc(chart_pou(translation));
  if (!pou) return result::forward(pou);
  const auto& ladder = std::get<graphic::LadderProgram>(pou->body);
  return svg ? graphic::draw_ladder_svg(ladder) : graphic::draw_ladder_text(ladder);
}

Result<std::string> plcopen_document(const translate::Translation& translation, bool lowered) {
  if (!lowered) return exchange::write_plcopen(translation.project);
  auto project = lowering::lower_sfc(translation.project);
  if (!project) return result::forward(project);
  return exchange::write_plcopen(*project);
}

// Switches and outputs at their terminals; filtered counts in the memory words that the paper copies its
// analog inputs to (Table 3). CJ controllers filter analog inputs in their input unit.
exchange::OmronOptions omron_options(const translate::Binding& binding) {
  exchange::OmronOptions options;
  for (const translate::Tag& tag : binding.tags) {
    if (tag.type == "BOOL") options.addresses.push_back({tag.name, tag.omron, ""});
  }
  for (const translate::Sensor& sensor : binding.sensors) {
    options.addresses.push_back(
        {translate::filtered_variable(sensor), sensor.omron, binding.tag(sensor.tag)->omron});
  }
  return options;
}

// The registers of the handshake, which a Modbus master reads as D words.
constexpr int kOmronHandshakeWord = 300;

Result<std::string> omron_document(const translate::Translation& translation,
                                   const translate::Binding& binding, bool handshake) {
  auto pou = lowering::lower_sfc(lowering::with_step_timers(chart_pou(translation)));
  if (!pou) return result::forward(pou);
  exchange::OmronOptions options = omron_options(binding);
  for (std::size_t i = 0; handshake && i < translate::kHandshakeVariables.size(); ++i) {
    options.addresses.push_back({translate::kHandshakeVariables[i],
                                 "D" + std::to_string(kOmronHandshakeWord + static_cast<int>(i)), ""});
  }
  auto program = exchange::write_omron(*pou, options);
  if (!program) return result::forward(program);
  return program->to_text();
}

Result<std::string> document_of(const translate::Translation& translation, const translate::Binding& binding,
                                const Arguments& arguments) {
  const bool svg = arguments.svg || arguments.output.extension() == ".svg";
  if (arguments.to == "ladder") return ladder_document(translation, svg);
  if (arguments.to == "plcopen") return plcopen_document(translation, arguments.lowered);
  if (arguments.to == "omron") return omron_document(translation, binding, !arguments.handshake.empty());
  return sfc_document(translation, svg);
}

Result<std::string> summary_of(const model::PlannedRun& run, const translate::Translation& translation,
                               const translate::Binding& binding) {
  auto parallel = translate::schedule(run, binding, false);
  if (!parallel) return result::forward(parallel);
  auto strict = translate::schedule(run, binding, true);
  if (!strict) return result::forward(strict);
  char line[200];
  std::snprintf(line, sizeof line,
                "%s, %s, %s\n"
                "makespan %.1f s with parallel branches, %.1f s strictly sequential (%.0f %%)\n",
                result::counted(run.actions.size(), "action", "actions").c_str(),
                result::counted(translation.chart().steps.size(), "step", "steps").c_str(),
                result::counted(translation.chart().transitions.size(), "transition", "transitions").c_str(),
                parallel->makespan_s, strict->makespan_s, 100.0 * parallel->makespan_s / strict->makespan_s);
  std::string summary = line;
  std::set<std::string> assumed;
  for (const translate::StepInfo& step : translation.steps) {
    assumed.insert(step.assumed.begin(), step.assumed.end());
  }
  if (!assumed.empty()) summary += "not observed by any sensor, assumed as planned:\n";
  for (const std::string& text : assumed) summary += "  " + text + "\n";
  return summary;
}

}  // namespace

Result<Output> translate_files(const Arguments& arguments) {
  auto task = pddl::load_task(beside(arguments.binding, arguments.domain, "domain.pddl").string(),
                              beside(arguments.binding, arguments.problem, "problem.pddl").string());
  if (!task) return result::forward(task);
  const model::Vocabulary vocabulary = pddl::vocabulary(*task);
  auto binding = translate::load_binding(arguments.binding, &vocabulary);
  if (!binding) return result::forward(binding);
  auto run = read_run(*task, arguments.plan);
  if (!run) return result::forward(run);
  translate::TranslateOptions options;
  options.sequential = arguments.sequential;
  auto translation = translate::translate(*run, *binding, options);
  if (!translation) return result::forward(translation);
  if (!arguments.handshake.empty()) {
    if (auto added = translate::add_handshake(*translation); !added) return result::forward(added);
  }
  auto document = document_of(*translation, *binding, arguments);
  if (!document) return result::forward(document);
  auto summary = summary_of(*run, *translation, *binding);
  if (!summary) return result::forward(summary);
  const std::string table = arguments.handshake.empty() ? std::string() : handshake_table(*translation);
  return Output{std::move(*document), table, std::move(*summary)};
}

Result<void> write_document(const std::filesystem::path& file, const std::string& document) {
  return files::write_file(file.string(), document,
                           {"T0020", "check that its folder exists and can be written to"});
}

}  // namespace stepwright::translate_command
