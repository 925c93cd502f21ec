#include "hmi_web/server/program_layout.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "hmi_web/server/array_selection.h"
#include "hmi_web/tags/declared_notes.h"
#include "runtime/bytecode/reader/document_text.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::server {
namespace {

using naming::same_name;
using Place = std::pair<std::uint32_t, std::uint8_t>;  // byte and bit

Place place_of(const reader::Variable& variable) {
  return {variable.address, variable.bit};
}

std::string_view last_part(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

void add_chart(const reader::ChartInfo& chart, ProgramLayout& layout) {
  const auto first_step = static_cast<std::uint32_t>(layout.steps.size());
  layout.program.charts.push_back({chart.name, static_cast<std::uint32_t>(chart.steps.size()),
                                   static_cast<std::uint32_t>(chart.transitions.size())});
  for (const auto& step : chart.steps) {
    layout.program.steps.push_back({step.name, step.comment, step.initial});
    layout.steps.push_back(step.active);
  }
  const auto shifted = [&](std::vector<std::uint32_t> steps) {
    for (std::uint32_t& step : steps) step += first_step;
    return steps;
  };
  for (const auto& transition : chart.transitions) {
    layout.program.transitions.push_back(
        {transition.name, shifted(transition.sources), shifted(transition.targets), transition.condition});
    layout.transitions.push_back(transition.fires);
  }
}

// Where the names of a variable's values stand in the program; nothing if it is no enumeration.
std::optional<std::uint32_t> enumeration_of(const reader::Variable& variable, protocol::Program& program) {
  if (!variable.enumerators) return std::nullopt;
  auto& known = program.enumerations;
  const auto found = std::find(known.begin(), known.end(), *variable.enumerators);
  const auto index = static_cast<std::uint32_t>(found - known.begin());
  if (found == known.end()) known.push_back(*variable.enumerators);
  return index;
}

// "%QX0.3" of a variable in an I/O area; empty for any other.
std::string address_of(const reader::Variable& variable, const bytecode::SizesRecord& sizes) {
  const bool input = variable.address < sizes.input_bytes;
  if (!input && variable.address >= sizes.input_bytes + sizes.output_bytes) return {};
  const std::uint32_t byte = input ? variable.address : variable.address - sizes.input_bytes;
  const std::string area = input ? "%I" : "%Q";
  if (variable.bit != bytecode::kNoBit) {
    return area + "X" + std::to_string(byte) + "." + std::to_string(variable.bit);
  }
  switch (bytecode::size_of(bytecode::mem_type(variable.type))) {
    case 1:
      return area + "B" + std::to_string(byte);
    case 2:
      return area + "W" + std::to_string(byte / 2);
    case 4:
      return area + "D" + std::to_string(byte / 4);
    default:
      return area + "L" + std::to_string(byte / 8);
  }
}

}  // namespace

result::Result<ProgramLayout> read_layout(std::span<const std::byte> container, const std::string& digest) {
  auto info = reader::ProgramInfo::read(container);
  if (!info) return result::forward(info);
  ProgramLayout layout;
  layout.program.digest = digest;
  layout.document = reader::document_text(container);
  layout.output_offset = info->sizes().input_bytes;
  for (const auto& chart : info->charts()) add_chart(chart, layout);

  std::set<Place> drawn;  // shown by the chart already
  for (const auto& step : layout.steps) drawn.insert(place_of(step));
  for (const auto& transition : layout.transitions) {
    if (transition) drawn.insert(place_of(*transition));
  }
  const tags::DeclaredNotes notes(info->instances(), layout.document);
  const ArraySelection arrays(info->tags(), info->instances());
  layout.program.left_out = arrays.left_out();
  for (const auto& tag : info->tags()) {
    if (drawn.contains(place_of(tag.variable)) || !arrays.shows(tag.name)) continue;
    protocol::TagNote note = notes.of(tag.name);
    const std::string comment = std::exchange(note.description, {});
    layout.program.tags.push_back({tag.name, bytecode::name_of(tag.variable.type),
                                   address_of(tag.variable, info->sizes()), comment,
                                   enumeration_of(tag.variable, layout.program), std::move(note)});
    layout.tags.push_back(tag.variable);
  }
  return layout;
}

std::optional<std::size_t> find_tag_index(const ProgramLayout& layout, std::string_view name) {
  std::optional<std::size_t> partial;
  bool ambiguous = false;
  const auto& tags = layout.program.tags;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (same_name(tags[i].name, name)) return i;
    if (!same_name(last_part(tags[i].name), name)) continue;
    ambiguous = partial.has_value();
    partial = i;
  }
  return ambiguous ? std::nullopt : partial;
}

std::optional<reader::Variable> find_tag(const ProgramLayout& layout, std::string_view name) {
  const auto index = find_tag_index(layout, name);
  return index ? std::optional(layout.tags[*index]) : std::nullopt;
}

}  // namespace stepwright::server
