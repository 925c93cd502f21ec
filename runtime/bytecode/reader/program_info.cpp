#include "runtime/bytecode/reader/program_info.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "runtime/bytecode/program.h"

namespace stepwright::reader {
namespace {

using bytecode::ContainerView;
using bytecode::Section;

// A variable of a huge array does not need a name for each element.
constexpr std::size_t kMaxTags = 200'000;

std::string text(const ContainerView& view, bytecode::StringRef ref) {
  const auto characters = view.string(ref);
  return {characters.data(), characters.size()};
}

std::string upper(std::string_view name) {
  std::string result(name);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

// Appends the elementary variables inside a symbol.
void flatten(const ContainerView& view, const std::string& name, std::uint32_t type_index, Variable place,
             std::uint16_t flags, std::vector<Tag>& tags) {
  if (tags.size() >= kMaxTags) return;
  const auto type = view.record<Section::Types>(type_index);
  switch (static_cast<bytecode::TypeKind>(type.kind)) {
    case bytecode::TypeKind::Elementary:
      place.type = static_cast<bytecode::ElementaryType>(type.elementary);
      tags.push_back({name, place, flags});
      return;
    case bytecode::TypeKind::Array: {
      const std::uint32_t stride = view.record<Section::Types>(type.first).size;
      for (std::uint32_t i = 0; i < type.count && tags.size() < kMaxTags; ++i) {
        const std::string element = name + "[" + std::to_string(std::int64_t{type.lower} + i) + "]";
        flatten(view, element, type.first, {place.type, place.address + i * stride, bytecode::kNoBit}, flags,
                tags);
      }
      return;
    }
    case bytecode::TypeKind::Struct:
    case bytecode::TypeKind::Instance:
      for (std::uint32_t i = 0; i < type.count; ++i) {
        const auto member = view.record<Section::Members>(type.first + i);
        const Variable inside{place.type, place.address + member.offset, bytecode::kNoBit};
        flatten(view, name + "." + text(view, member.name), member.type, inside, flags, tags);
      }
      return;
  }
}

std::vector<std::uint32_t> links(const ContainerView& view, std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> steps;
  for (std::uint32_t i = 0; i < count; ++i) steps.push_back(view.record<Section::SfcLinks>(first + i));
  return steps;
}

ChartInfo chart_info(const ContainerView& view, const bytecode::SfcChartRecord& record) {
  ChartInfo chart;
  chart.name = text(view, record.name);
  for (std::uint32_t i = 0; i < record.step_count; ++i) {
    const auto step = view.record<Section::SfcSteps>(record.first_step + i);
    chart.steps.push_back({text(view, step.name),
                           text(view, step.comment),
                           (step.flags & bytecode::kStepInitial) != 0,
                           {bytecode::ElementaryType::Bool, step.address, step.bit}});
  }
  for (std::uint32_t i = 0; i < record.transition_count; ++i) {
    const auto transition = view.record<Section::SfcTransitions>(record.first_transition + i);
    TransitionInfo info{text(view, transition.name), text(view, transition.condition),
                        links(view, transition.first_source, transition.source_count),
                        links(view, transition.first_target, transition.target_count), std::nullopt};
    if (transition.address != bytecode::kNoIndex) {
      info.fires = Variable{bytecode::ElementaryType::Bool, transition.address, transition.bit};
    }
    chart.transitions.push_back(std::move(info));
  }
  return chart;
}

}  // namespace

result::Result<ProgramInfo> ProgramInfo::read(std::span<const std::byte> container) {
  bytecode::Program program;
  std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(container));
  const bytecode::VerifyResult verified = bytecode::verify(container, scratch, program);
  if (!verified.ok()) {
    return result::fail("B0200", {},
                        std::string("not a valid container: ") + bytecode::explain(verified.status),
                        "compile the program again");
  }
  const ContainerView& view = program.container();
  ProgramInfo info;
  info.sizes_ = program.sizes();
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    const auto symbol = view.record<Section::Symbols>(i);
    flatten(view, text(view, symbol.name), symbol.type,
            {bytecode::ElementaryType::Bool, symbol.address, symbol.bit}, symbol.flags, info.tags_);
  }
  for (std::size_t i = 0; i < info.tags_.size(); ++i) info.by_name_.emplace(upper(info.tags_[i].name), i);
  for (std::uint32_t i = 0; i < view.count<Section::SfcCharts>(); ++i) {
    info.charts_.push_back(chart_info(view, view.record<Section::SfcCharts>(i)));
  }
  for (std::uint32_t i = 0; i < view.count<Section::Tasks>(); ++i) {
    const auto task = view.record<Section::Tasks>(i);
    info.tasks_.push_back({text(view, task.name), task.interval_us, task.priority});
  }
  return info;
}

const Variable* ProgramInfo::find(std::string_view name) const {
  const auto found = by_name_.find(upper(name));
  return found == by_name_.end() ? nullptr : &tags_[found->second].variable;
}

const ChartInfo* ProgramInfo::chart(std::string_view name) const {
  for (const ChartInfo& chart : charts_) {
    if (upper(chart.name) == upper(name)) return &chart;
  }
  return nullptr;
}

}  // namespace stepwright::reader
