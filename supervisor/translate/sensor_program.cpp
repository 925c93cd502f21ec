#include "supervisor/translate/sensor_program.h"

#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "supervisor/translate/guard.h"

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

std::string filter_text(const Binding& binding, const SensorProgramOptions& options) {
  std::string first;
  std::string every;
  for (const Sensor& sensor : binding.sensors) {
    const std::string& type = binding.tag(sensor.tag)->type;
    const std::string counts = type + "_TO_REAL(" + sensor.tag + ")";
    const std::string state = state_variable(sensor);
    const double interval_s = static_cast<double>(options.interval_us) * 1e-6;
    const double filter_s = static_cast<double>(sensor.filter.count()) * 1e-3;
    const double weight = 1.0 - std::exp(-interval_s / filter_s);
    first += "  " + state + " := " + counts + ";\n";
    every += state + " := " + state + " + " + real_literal(weight) + " * (" + counts + " - " + state + ");\n";
    every += filtered_variable(sensor) + " := REAL_TO_" + type + "(" + state + ");\n";
    if (!options.values.contains(sensor.name)) continue;
    every += value_statements(sensor, type, tare_of(options.tare, sensor));
  }
  return "IF first THEN\n" + first + "  first := FALSE;\nEND_IF;\n" + every;
}

std::string mean_text(const Binding& binding, const SensorProgramOptions& options) {
  std::string text = std::string("IF ") + kAveragingVariable + " THEN\n  samples := samples + 1;\n";
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

std::vector<std::string> generated_variables(const Sensor& sensor) {
  return {filtered_variable(sensor), half_variable(sensor), value_variable(sensor), state_variable(sensor),
          sum_variable(sensor)};
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
  if (mean) {
    pou.variables.push_back(variable("samples", "DINT", VariableSection::Local));
  } else {
    pou.variables.push_back(variable("first", "BOOL", VariableSection::Local, "TRUE"));
  }
  for (const Sensor& sensor : binding.sensors) {
    pou.variables.push_back(mean ? variable(sum_variable(sensor), "DINT", VariableSection::Local)
                                 : variable(state_variable(sensor), "REAL", VariableSection::Local));
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
