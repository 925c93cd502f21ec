#include "hmi_web/monitor/scope.h"

#include <algorithm>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::monitor {
namespace {

// "level" of "level.x[3]".
std::string_view first_name(std::string_view path) {
  return path.substr(0, std::min(path.find_first_of(".[^"), path.size()));
}

Value read(const reader::Variable& variable, const semantics::TypeTable& types,
           std::span<const std::byte> image) {
  if (bytecode::is_string(variable.type)) return std::nullopt;
  const semantics::Type* type = types.elementary(variable.type);
  if (variable.address >= image.size() || image.size() - variable.address < type->size) return std::nullopt;
  if (variable.bit == bytecode::kNoBit)
    return Known{type, semantics::load(*type, image.subspan(variable.address, type->size))};
  return Known{type, {std::to_integer<int>(image[variable.address]) >> variable.bit & 1}};
}

}  // namespace

std::string folded(std::string_view name) {
  return naming::upper(name);
}

ProgramNames::ProgramNames(const server::ProgramLayout& layout) : layout_(layout) {
  const protocol::Program& program = layout.program;
  for (std::size_t i = 0; i < program.tags.size(); ++i) {
    tags_.try_emplace(folded(program.tags[i].name), i);
    if (!program.tags[i].address.empty()) tags_.try_emplace(folded(program.tags[i].address), i);
  }
  std::size_t step = 0;
  for (const protocol::ProgramChart& chart : program.charts)
    for (std::uint32_t i = 0; i < chart.steps; ++i, ++step)
      steps_.try_emplace(folded(chart.name + '.' + program.steps[step].name), step);
}

const reader::Variable* ProgramNames::tag(std::string_view name) const {
  const auto found = tags_.find(folded(name));
  return found == tags_.end() ? nullptr : &layout_.tags[found->second];
}

const reader::Variable* ProgramNames::step(std::string_view chart, std::string_view name) const {
  const auto found = steps_.find(folded(std::string(chart) + '.' + std::string(name)));
  return found == steps_.end() ? nullptr : &layout_.steps[found->second];
}

bool Scope::declares(std::string_view name) const {
  return sections_.contains(folded(first_name(name)));
}

const reader::Variable* Scope::find(const std::string& path) const {
  if (path.starts_with('%')) return names_.tag(path);
  const std::string_view name = first_name(path);
  const auto own = sections_.find(folded(name));
  const std::string_view section = own == sections_.end() ? "" : std::string_view(own->second);
  const std::string in_instance = instance_ + '.' + path;
  if (const reader::Variable* step = names_.step(instance_, name); section.empty() && step != nullptr) {
    if (const reader::Variable* tag = names_.tag(in_instance)) return tag;
    return folded(path.substr(name.size())) == ".X" ? step : nullptr;
  }
  if (section.empty() || section == "VAR_EXTERNAL" || section == "VAR_GLOBAL") return names_.tag(path);
  if (section == "VAR_TEMP" || section == "VAR_IN_OUT" || instance_.empty()) return nullptr;
  return names_.tag(in_instance);
}

Value Scope::value(const std::string& path, const semantics::TypeTable& types,
                   std::span<const std::byte> image) const {
  const reader::Variable* variable = find(path);
  return variable == nullptr ? std::nullopt : read(*variable, types, image);
}

}  // namespace stepwright::monitor
