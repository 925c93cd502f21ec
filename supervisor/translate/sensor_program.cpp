#include "supervisor/translate/sensor_program.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "supervisor/translate/guard.h"
#include "supervisor/translate/internal/rate.h"

namespace stepwright::translate {

namespace {

using graphic::Variable;
using graphic::VariableSection;

Variable variable(std::string name, std::string type, VariableSection section, std::string initial = {}) {
  Variable declared;
  declared.name = std::move(name);
  declared.type = std::move(type);
  declared.section = section;
  declared.initial = std::move(initial);
  return declared;
}

std::string state_variable(const Sensor& sensor) {
  return sensor.name + "_state";
}

std::string sum_variable(const Sensor& sensor) {
  return sensor.name + "_sum";
}

// One straight line of the calibration, from counts (with tare) to the value.
std::string line_statement(const Sensor& sensor, const std::string& type, double tare,
                           const CalibrationPoint& a, const CalibrationPoint& b) {
  const double slope = (b.value - a.value) / (b.counts - a.counts);
  return value_variable(sensor) + " := " + real_literal(a.value) + " + (" + type + "_TO_REAL(" +
         filtered_variable(sensor) + ") - " + real_literal(a.counts + tare) + ") * " + real_literal(slope) +
         ";\n";
}

std::string value_statements(const Sensor& sensor, const std::string& type, double tare) {
  const auto& points = sensor.calibration.points();
  const std::string op = sensor.calibration.rising() ? " < " : " > ";
  std::string text;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    text += (i == 1 ? "IF " : "ELSIF ") + type + "_TO_REAL(" + filtered_variable(sensor) + ")" + op +
            real_literal(points[i].counts + tare) + " THEN\n  " +
            line_statement(sensor, type, tare, points[i - 1], points[i]);
  }
  const std::string last =
      line_statement(sensor, type, tare, points[points.size() - 2], points[points.size() - 1]);
  return points.size() == 2 ? last : text + "ELSE\n  " + last + "END_IF;\n";
}

std::string counts_of(const Binding& binding, const Sensor& sensor) {
  return binding.tag(sensor.tag)->type + "_TO_REAL(" + sensor.tag + ")";
}

// Every filter starts at its first sample.
std::string start_text(const Binding& binding) {
  std::string text = "IF first THEN\n";
  for (const Sensor& sensor : binding.sensors)
    text += "  " + state_variable(sensor) + " := " + counts_of(binding, sensor) + ";\n";
  return text + "  first := FALSE;\nEND_IF;\n";
}

std::string state_statement(const Binding& binding, const Sensor& sensor, std::int64_t interval_us) {
  const std::string state = state_variable(sensor);
  const double interval_s = static_cast<double>(interval_us) * 1e-6;
  const double filter_s = static_cast<double>(sensor.filter.count()) * 1e-3;
  const double weight = 1.0 - std::exp(-interval_s / filter_s);
  return state + " := " + state + " + " + real_literal(weight) + " * (" + counts_of(binding, sensor) + " - " +
         state + ");\n";
}

// A count that has reached its end stays there: whoever looks later must know, too.
std::string rate_statements(const Binding& binding, const Sensor& sensor) {
  if (sensor.max_rate == 0.0) return {};
  const std::string leaping = leaping_variable(sensor);
  return "IF " + leaping + " < " + std::to_string(kLeapingScans) + " THEN\n  IF ABS(" +
         counts_of(binding, sensor) + " - " + state_variable(sensor) + ") > " +
         real_literal(internal::most_counts_from_filtered(sensor)) + " THEN\n    " + leaping +
         " := " + leaping + " + 1;\n  ELSE\n    " + leaping + " := 0;\n  END_IF;\nEND_IF;\n";
}

std::string filter_text(const Binding& binding, const SensorProgramOptions& options) {
  std::string text = start_text(binding);
  for (const Sensor& sensor : binding.sensors) {
    const std::string& type = binding.tag(sensor.tag)->type;
    text += state_statement(binding, sensor, options.interval_us);
    text += filtered_variable(sensor) + " := REAL_TO_" + type + "(" + state_variable(sensor) + ");\n";
    text += rate_statements(binding, sensor);
    if (!options.values.contains(sensor.name)) continue;
    text += value_statements(sensor, type, tare_of(options.tare, sensor));
  }
  return text;
}

bool watches_rates(const Binding& binding) {
  return std::ranges::any_of(binding.sensors, [](const Sensor& each) { return each.max_rate > 0.0; });
}

// Filters of all sensors, so that the program that takes over goes on with each of them. Nothing but zeros
// since the first scan is no reading yet: a device that has not answered begins with its first answer,
// without a leap.
std::string watch_text(const Binding& binding, const SensorProgramOptions& options) {
  if (!watches_rates(binding)) return {};
  std::string text = start_text(binding);
  for (const Sensor& sensor : binding.sensors) {
    const std::string state = state_variable(sensor);
    text += "IF " + state + " = 0.0 THEN " + state + " := " + counts_of(binding, sensor) + "; END_IF;\n";
    text += state_statement(binding, sensor, options.interval_us);
    text += rate_statements(binding, sensor);
  }
  return text;
}

std::string mean_text(const Binding& binding, const SensorProgramOptions& options) {
  std::string text = watch_text(binding, options);
  text += std::string("IF ") + kAveragingVariable + " THEN\n  samples := samples + 1;\n";
  for (const Sensor& sensor : binding.sensors) {
    const std::string& type = binding.tag(sensor.tag)->type;
    const std::string sum = sum_variable(sensor);
    text += "  " + sum + " := " + sum + " + " + type + "_TO_DINT(" + sensor.tag + ");\n";
    text += "  " + filtered_variable(sensor) + " := REAL_TO_" + type + "(DINT_TO_REAL(" + sum +
            ") / DINT_TO_REAL(samples));\n";
  }
  text += "  IF samples = " + std::to_string(options.half_samples) + " THEN\n";
  for (const Sensor& sensor : binding.sensors) {
    text += "    " + half_variable(sensor) + " := " + filtered_variable(sensor) + ";\n";
  }
  // Sums begin anew with every window, also where one such program takes over from another.
  text += "  END_IF;\nELSE\n  samples := 0;\n";
  for (const Sensor& sensor : binding.sensors) text += "  " + sum_variable(sensor) + " := 0;\n";
  return text + "END_IF;\n";
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Everything that a chart reads and drives, as text.
std::string text_of(const graphic::SfcChart& chart) {
  std::string text;
  for (const graphic::Step& step : chart.steps) {
    for (const graphic::ActionBlock& block : step.actions) text += block.target + "\n";
  }
  for (const graphic::Transition& transition : chart.transitions) {
    text += graphic::to_st(transition.condition) + "\n";
  }
  return text;
}

// The globals that `text` mentions, as VAR_EXTERNAL.
std::vector<Variable> externals(const std::vector<Variable>& globals, const std::string& text) {
  std::vector<Variable> declared;
  for (Variable shared : globals) {
    if (!mentions(text, shared.name)) continue;
    shared.section = VariableSection::External;
    shared.address.clear();
    shared.initial.clear();
    declared.push_back(std::move(shared));
  }
  return declared;
}

}  // namespace

bool mentions(const std::string& text, const std::string& name) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool starts = at == 0 || !is_name_character(text[at - 1]);
    if (starts && (end == text.size() || !is_name_character(text[end]))) return true;
  }
  return false;
}

std::vector<Variable> cell_globals(const Binding& binding, const SensorProgramOptions& options) {
  std::vector<Variable> globals;
  for (const Tag& tag : binding.tags) {
    Variable located = variable(tag.name, tag.type, VariableSection::Global);
    located.address = tag.address;
    located.comment = tag.comment;
    globals.push_back(std::move(located));
  }
  for (const Sensor& sensor : binding.sensors) {
    const std::string& type = binding.tag(sensor.tag)->type;
    Variable filtered = variable(filtered_variable(sensor), type, VariableSection::Global);
    filtered.comment = sensor.label + ", filtered counts";
    globals.push_back(std::move(filtered));
    if (sensor.max_rate > 0.0) {
      Variable leaping = variable(leaping_variable(sensor), "DINT", VariableSection::Global);
      leaping.comment = "scans for which " + sensor.tag + " has changed faster than it can";
      globals.push_back(std::move(leaping));
    }
    if (options.mode == SensorMode::Mean) {
      Variable half = variable(half_variable(sensor), type, VariableSection::Global);
      half.comment = sensor.label + ", mean counts of the first half";
      globals.push_back(std::move(half));
    }
    if (!options.values.contains(sensor.name)) continue;
    Variable value = variable(value_variable(sensor), "REAL", VariableSection::Global);
    value.comment = sensor.label + ", calibrated";
    globals.push_back(std::move(value));
  }
  if (options.mode == SensorMode::Mean) {
    globals.push_back(variable(kAveragingVariable, "BOOL", VariableSection::Global));
  }
  return globals;
}

std::string leaping_variable(const Sensor& sensor) {
  return sensor.name + "_leaping";
}

std::vector<std::string> generated_variables(const Sensor& sensor) {
  return {filtered_variable(sensor), half_variable(sensor), value_variable(sensor),
          state_variable(sensor),    sum_variable(sensor),  leaping_variable(sensor)};
}

std::vector<std::string> declared_variables(const Binding& binding) {
  std::vector<std::string> names = {kAveragingVariable, "first", "samples"};
  for (const Tag& tag : binding.tags) names.push_back(tag.name);
  for (const Sensor& sensor : binding.sensors) {
    for (std::string& name : generated_variables(sensor)) names.push_back(std::move(name));
  }
  return names;
}

graphic::Pou sensor_program(const Binding& binding, const SensorProgramOptions& options) {
  graphic::Pou pou;
  pou.name = kSensorProgram;
  const bool mean = options.mode == SensorMode::Mean;
  const std::string text = mean ? mean_text(binding, options) : filter_text(binding, options);
  pou.variables = externals(cell_globals(binding, options), text);
  const bool filters = !mean || watches_rates(binding);
  if (mean) pou.variables.push_back(variable("samples", "DINT", VariableSection::Local));
  if (filters) pou.variables.push_back(variable("first", "BOOL", VariableSection::Local, "TRUE"));
  for (const Sensor& sensor : binding.sensors) {
    if (mean) pou.variables.push_back(variable(sum_variable(sensor), "DINT", VariableSection::Local));
    if (filters) pou.variables.push_back(variable(state_variable(sensor), "REAL", VariableSection::Local));
  }
  pou.body = graphic::StBody{text};
  return pou;
}

graphic::Project make_project(const Binding& binding, const SensorProgramOptions& options,
                              graphic::SfcChart chart) {
  graphic::Project project;
  project.name = kPlanProgram;
  project.globals = cell_globals(binding, options);
  graphic::Pou plan;
  plan.name = kPlanProgram;
  plan.variables = externals(project.globals, text_of(chart));
  plan.body = std::move(chart);
  project.pous = {sensor_program(binding, options), std::move(plan)};
  project.tasks = {{"main", options.interval_us, 0}};
  // Instances of one task run in this order: the chart sees the counts of its own scan.
  project.instances = {{"sensing", kSensorProgram, "main"}, {kPlanInstance, kPlanProgram, "main"}};
  return project;
}

}  // namespace stepwright::translate
