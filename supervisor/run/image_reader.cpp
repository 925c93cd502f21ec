#include "supervisor/run/image_reader.h"

namespace stepwright::run {

result::Result<ImageReader> ImageReader::create(std::span<const std::byte> container,
                                                const std::string& chart,
                                                const std::vector<std::string>& variables) {
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  const reader::ChartInfo* found = info->chart(chart);
  if (found == nullptr) return result::fail("X0002", {}, "the program has no chart '" + chart + "'");
  ImageReader reader;
  reader.steps_ = found->steps;
  for (const std::string& name : variables) {
    const reader::Variable* variable = info->find(name);
    if (variable == nullptr) return result::fail("X0002", {}, "the program has no variable '" + name + "'");
    reader.variables_.emplace(name, *variable);
  }
  return reader;
}

std::vector<bool> ImageReader::active_steps(std::span<const std::byte> image) const {
  std::vector<bool> active;
  for (const reader::StepInfo& step : steps_)
    active.push_back(reader::read_number(step.active, image) != 0.0);
  return active;
}

std::map<std::string, double> ImageReader::values(std::span<const std::byte> image) const {
  std::map<std::string, double> values;
  for (const auto& [name, variable] : variables_) values.emplace(name, reader::read_number(variable, image));
  return values;
}

}  // namespace stepwright::run
