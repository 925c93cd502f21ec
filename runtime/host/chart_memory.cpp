#include "runtime/host/chart_memory.h"

#include <algorithm>
#include <set>
#include <string>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::host {

using bytecode::ContainerView;
using bytecode::Section;
using bytecode::TypeKind;

class ChartSearch {
 public:
  ChartSearch(const ContainerView& view, ChartMemory& out) : view_(view), out_(out) {
    for (std::uint32_t i = 0; i < view.count<Section::SfcSteps>(); ++i)
      steps_.insert(view.record<Section::SfcSteps>(i).address);
  }

  // A container may nest types without end; real ones stay far below this bound.
  void visit(std::uint32_t type_index, std::uint32_t address) {
    if (++visited_ > kMaxVisits) return;
    const auto type = view_.record<Section::Types>(type_index);
    const auto kind = static_cast<TypeKind>(type.kind);
    if (!holds_steps(address, type.size)) return;
    if (kind == TypeKind::Array) {
      const std::uint32_t stride = view_.record<Section::Types>(type.first).size;
      for (std::uint32_t i = 0; i < type.count; ++i) visit(type.first, address + i * stride);
    } else if (kind == TypeKind::Struct || kind == TypeKind::Instance) {
      visit_members(type, address);
    }
  }

  void mark_functions() {
    out_.owned_.resize(view_.count<Section::Functions>(), false);
    for (std::uint32_t f = 0; f < out_.owned_.size(); ++f) {
      const std::string name = reader::text_of(view_, view_.record<Section::Functions>(f).name);
      for (const std::string& owner : owners_)
        if (naming::same_name(name.substr(0, name.find('.')), owner)) out_.owned_[f] = true;
    }
  }

 private:
  static constexpr std::uint32_t kMaxVisits = 200'000;

  bool holds_steps(std::uint32_t address, std::uint32_t size) const {
    const auto step = steps_.lower_bound(address);
    return step != steps_.end() && *step - address < size;
  }

  void visit_members(const bytecode::TypeRecord& type, std::uint32_t address) {
    std::uint32_t first = type.count;
    for (std::uint32_t i = 0; i < type.count; ++i) {
      const auto member = view_.record<Section::Members>(type.first + i);
      const auto kind = static_cast<TypeKind>(view_.record<Section::Types>(member.type).kind);
      if (kind == TypeKind::Elementary) {
        if (steps_.contains(address + member.offset)) first = std::min(first, i);
      } else {
        visit(member.type, address + member.offset);
      }
    }
    if (first == type.count) return;
    if (first >= 2 && is_clock(type, first - 2)) first -= 2;
    for (std::uint32_t i = first; i < type.count; ++i) {
      const auto member = view_.record<Section::Members>(type.first + i);
      out_.ranges_.push_back({address + member.offset, view_.record<Section::Types>(member.type).size});
    }
    const std::string name = reader::text_of(view_, type.name);
    owners_.insert(name.substr(0, name.find('#')));
  }

  // The timer and the time that it gives.
  bool is_clock(const bytecode::TypeRecord& type, std::uint32_t at) const {
    const auto starts = [&](std::uint32_t index, const char* prefix) {
      const auto member = view_.record<Section::Members>(type.first + index);
      return reader::text_of(view_, member.name).starts_with(prefix);
    };
    return starts(at, "SFC_CLOCK") && starts(at + 1, "SFC_NOW");
  }

  const ContainerView& view_;
  ChartMemory& out_;
  std::set<std::uint32_t> steps_;  // addresses
  std::set<std::string> owners_;   // names of the POUs
  std::uint32_t visited_ = 0;
};

ChartMemory ChartMemory::of(const bytecode::Program& program) {
  const ContainerView& view = program.container();
  ChartMemory memory;
  ChartSearch search(view, memory);
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    const auto symbol = view.record<Section::Symbols>(i);
    search.visit(symbol.type, symbol.address);
  }
  // Charts whose steps are variables of their own, without an instance around them.
  for (std::uint32_t i = 0; i < view.count<Section::SfcSteps>(); ++i) {
    const auto step = view.record<Section::SfcSteps>(i);
    if (step.bit == bytecode::kNoBit) memory.ranges_.push_back({step.address, 1});
  }
  search.mark_functions();
  memory.join();
  return memory;
}

void ChartMemory::join() {
  std::sort(ranges_.begin(), ranges_.end(),
            [](const Range& a, const Range& b) { return a.address < b.address; });
  std::vector<Range> joined;
  for (const Range& each : ranges_) {
    if (!joined.empty() && each.address <= joined.back().address + joined.back().size) {
      const std::uint32_t end =
          std::max(joined.back().address + joined.back().size, each.address + each.size);
      joined.back().size = end - joined.back().address;
    } else {
      joined.push_back(each);
    }
  }
  ranges_ = std::move(joined);
}

}  // namespace stepwright::host
