#include "runtime/bytecode/reader/program_info.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "runtime/bytecode/member_bit.h"
#include "runtime/bytecode/program.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::reader {
namespace {

using bytecode::ContainerView;
using bytecode::Section;

// Lists the elementary variables inside symbols. Bounded in depth and size, as a hostile container may nest
// types without end; the bounds are beyond any program of a runtime, whose images end at 1 MiB.
class Flattener {
 public:
  Flattener(const ContainerView& view, std::vector<Tag>& tags, std::vector<InstanceInfo>& instances)
      : view_(view), tags_(tags), instances_(instances) {}

  void add(const std::string& name, std::uint32_t type_index, Variable place, std::uint16_t flags,
           std::uint32_t depth = 0) {
    text_bytes_ += name.size();
    if (++visited_ > kMaxVisits || text_bytes_ > kMaxTextBytes) ended_ = true;
    if (ended_ || depth > kMaxDepth) {
      complete_ = false;
      return;
    }
    const auto type = view_.record<Section::Types>(type_index);
    switch (static_cast<bytecode::TypeKind>(type.kind)) {
      case bytecode::TypeKind::Enumeration:
        place.enumerators = enumerators(type_index, type);
        [[fallthrough]];
      case bytecode::TypeKind::Elementary:
      case bytecode::TypeKind::String:
      case bytecode::TypeKind::Subrange:
        place.type = static_cast<bytecode::ElementaryType>(type.elementary);
        if (bytecode::is_string(place.type)) place.capacity = static_cast<std::uint16_t>(type.count);
        ended_ = tags_.size() == kMaxTags;
        complete_ = complete_ && !ended_;
        if (!ended_) tags_.push_back({name, place, flags});
        return;
      case bytecode::TypeKind::Reference:
        return;
      case bytecode::TypeKind::Array: {
        const std::uint32_t stride = view_.record<Section::Types>(type.first).size;
        if (stride == 0) return;  // structs without members
        for (std::uint32_t i = 0; i < type.count && !ended_; ++i) {
          const std::string element = name + "[" + std::to_string(std::int64_t{type.lower} + i) + "]";
          add(element, type.first, {place.type, place.address + i * stride, bytecode::kNoBit}, flags,
              depth + 1);
        }
        return;
      }
      case bytecode::TypeKind::Instance:
        instances_.push_back({name, text_of(view_, type.name)});
        [[fallthrough]];
      case bytecode::TypeKind::Struct:
        for (std::uint32_t i = 0; i < type.count && !ended_; ++i) {
          const auto member = view_.record<Section::Members>(type.first + i);
          if ((member.flags & bytecode::kMemberHidden) != 0) continue;
          const Variable inside{place.type, place.address + member.offset,
                                bytecode::member_bit(member.flags)};
          const bool constant = (member.flags & bytecode::kMemberConstant) != 0;
          const auto own = static_cast<std::uint16_t>(flags | (constant ? bytecode::kSymbolConstant : 0));
          add(name + "." + text_of(view_, member.name), member.type, inside, own, depth + 1);
        }
        return;
    }
  }

  // False if something of the program is not in the list.
  bool complete() const { return complete_; }

 private:
  // Of one type, read once.
  std::shared_ptr<const Enumerators> enumerators(std::uint32_t index, const bytecode::TypeRecord& type) {
    std::shared_ptr<const Enumerators>& known = enumerators_[index];
    if (known != nullptr) return known;
    const bool is_unsigned = bytecode::is_unsigned(static_cast<bytecode::ElementaryType>(type.elementary));
    Enumerators names;
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const auto member = view_.record<Section::Members>(type.first + i);
      const std::int64_t value =
          is_unsigned ? std::int64_t{member.offset} : std::int64_t{static_cast<std::int32_t>(member.offset)};
      names.try_emplace(value, text_of(view_, member.name));
    }
    known = std::make_shared<const Enumerators>(std::move(names));
    return known;
  }

  static constexpr std::size_t kMaxTags = 1u << 20;
  static constexpr std::uint32_t kMaxVisits = 4u << 20;
  static constexpr std::uint32_t kMaxDepth = 256;
  static constexpr std::size_t kMaxTextBytes = 256u << 20;  // of all paths

  const ContainerView& view_;
  std::vector<Tag>& tags_;
  std::vector<InstanceInfo>& instances_;
  std::map<std::uint32_t, std::shared_ptr<const Enumerators>> enumerators_;  // by type
  std::uint32_t visited_ = 0;
  std::size_t text_bytes_ = 0;
  bool ended_ = false;  // nothing more is listed
  bool complete_ = true;
};

// As naming::upper(a) < naming::upper(b).
bool before(std::string_view a, std::string_view b) {
  return std::ranges::lexicographical_compare(a, b, {}, naming::to_upper, naming::to_upper);
}

// The tags by their names; of equal names the first one of the container comes first.
std::vector<std::uint32_t> sorted_by_name(const std::vector<Tag>& tags) {
  std::vector<std::uint32_t> order(tags.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, before, [&](std::uint32_t i) -> std::string_view { return tags[i].name; });
  return order;
}

std::vector<std::uint32_t> links(const ContainerView& view, std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> steps;
  for (std::uint32_t i = 0; i < count; ++i) steps.push_back(view.record<Section::SfcLinks>(first + i));
  return steps;
}

ChartInfo chart_info(const ContainerView& view, const bytecode::SfcChartRecord& record) {
  ChartInfo chart;
  chart.name = text_of(view, record.name);
  for (std::uint32_t i = 0; i < record.step_count; ++i) {
    const auto step = view.record<Section::SfcSteps>(record.first_step + i);
    chart.steps.push_back({text_of(view, step.name),
                           text_of(view, step.comment),
                           (step.flags & bytecode::kStepInitial) != 0,
                           {bytecode::ElementaryType::Bool, step.address, step.bit}});
  }
  for (std::uint32_t i = 0; i < record.transition_count; ++i) {
    const auto transition = view.record<Section::SfcTransitions>(record.first_transition + i);
    TransitionInfo info{text_of(view, transition.name), text_of(view, transition.condition),
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

std::vector<TaskInfo> task_infos(const ContainerView& view) {
  std::vector<TaskInfo> tasks;
  for (std::uint32_t i = 0; i < view.count<Section::Tasks>(); ++i) {
    const auto task = view.record<Section::Tasks>(i);
    tasks.push_back({text_of(view, task.name), task.interval_us, task.priority, {}});
    if (task.trigger == bytecode::kNoIndex) continue;
    tasks.back().trigger = text_of(view, view.record<Section::Symbols>(task.trigger).name);
  }
  return tasks;
}

result::Result<ProgramInfo> ProgramInfo::read(std::span<const std::byte> container) {
  bytecode::Program program;
  std::vector<std::uint32_t> scratch(bytecode::verify_scratch_words(container));
  const bytecode::VerifyResult verified = bytecode::verify(container, scratch, program);
  if (!verified.ok()) return tl::unexpected(result::Diagnostics{refusal(container, verified, {})});
  const ContainerView& view = program.container();
  ProgramInfo info;
  info.sizes_ = program.sizes();
  Flattener flattener(view, info.tags_, info.instances_);
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    const auto symbol = view.record<Section::Symbols>(i);
    flattener.add(text_of(view, symbol.name), symbol.type,
                  {bytecode::ElementaryType::Bool, symbol.address, symbol.bit}, symbol.flags);
  }
  info.complete_ = flattener.complete();
  info.by_name_ = sorted_by_name(info.tags_);
  for (std::uint32_t i = 0; i < view.count<Section::SfcCharts>(); ++i) {
    info.charts_.push_back(chart_info(view, view.record<Section::SfcCharts>(i)));
  }
  info.tasks_ = task_infos(view);
  return info;
}

const Variable* ProgramInfo::find(std::string_view name) const {
  const Tag* tag = find_tag(name);
  return tag == nullptr ? nullptr : &tag->variable;
}

const Tag* ProgramInfo::find_tag(std::string_view name) const {
  const auto name_of = [this](std::uint32_t i) -> std::string_view { return tags_[i].name; };
  const auto found = std::ranges::lower_bound(by_name_, name, before, name_of);
  if (found == by_name_.end() || !naming::same_name(name_of(*found), name)) return nullptr;
  return &tags_[*found];
}

const ChartInfo* ProgramInfo::chart(std::string_view name) const {
  for (const ChartInfo& chart : charts_) {
    if (naming::same_name(chart.name, name)) return &chart;
  }
  return nullptr;
}

}  // namespace stepwright::reader
