#include "runtime/record/variable_transfer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <map>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::record {
namespace {

using bytecode::kNoBit;
using bytecode::TypeKind;

bool is_carried_at_all(const StateVariable& variable) {
  return (variable.flags & (kStateConstant | kStateInput)) == 0;
}

bool is_bool(const StateType& type) {
  return type.kind == TypeKind::Elementary && type.elementary == bytecode::ElementaryType::Bool;
}

StepPlace place_of(const StateVariable& step) {
  return {step.path, step.address, step.bit, (step.flags & kStateInitialStep) != 0};
}

// What holds the variable: of a step the instance of its chart.
std::string owner_of(const std::string& path) {
  return naming::upper(path.substr(0, path.rfind('.')));
}

bool get(std::span<const std::byte> image, std::uint32_t address, std::uint8_t bit) {
  const auto byte = std::to_integer<unsigned>(image[address]);
  return bit == kNoBit ? byte != 0 : ((byte >> bit) & 1u) != 0;
}

void set(std::span<std::byte> image, std::uint32_t address, std::uint8_t bit, bool value) {
  if (bit == kNoBit) {
    image[address] = std::byte{value};
    return;
  }
  const std::byte mask = std::byte{1} << bit;
  image[address] = (image[address] & ~mask) | (std::byte{value} << bit);
}

}  // namespace

template <std::size_t kBytes, typename Singles>
void copy_singles(const Singles& singles, std::span<const std::byte> from, std::span<std::byte> to) {
  for (const auto& each : singles) std::memcpy(to.data() + each.to, from.data() + each.from, kBytes);
}

class TransferBuilder {
 public:
  TransferBuilder(const StateLayout& from, const StateLayout& to, VariableTransfer& out)
      : from_(from), to_(to), out_(out), same_layout_(from == to) {}

  void build() {
    copy_areas();
    for (const StateVariable& variable : to_.variables()) {
      if (is_carried_at_all(variable)) carry(variable);
    }
    for (const StateVariable& variable : from_.variables()) {
      if (is_carried_at_all(variable) && to_.find(variable.path) == nullptr) {
        out_.report_.dropped.push_back(variable.path);
        lose_step(variable);
      }
    }
    join(out_.runs_);
    take_out_singles();
    for (auto& [owner, chart] : charts_) {
      const bool changed = !chart.fresh.empty() || !chart.lost.empty();
      if (!chart.carried.empty() && changed) out_.charts_.push_back(std::move(chart));
    }
  }

 private:
  using Run = VariableTransfer::Run;

  void copy_areas() {
    const StateAreas& from = from_.areas();
    const StateAreas& to = to_.areas();
    const std::uint32_t outputs = std::min(from.outputs, to.outputs);
    const std::uint32_t markers = std::min(from.markers, to.markers);
    if (outputs > 0) out_.areas_.push_back({from.inputs, to.inputs, outputs});
    if (markers > 0) out_.areas_.push_back({from.inputs + from.outputs, to.inputs + to.outputs, markers});
  }

  void carry(const StateVariable& to) {
    TransferReport& report = out_.report_;
    const StateVariable* from = from_.find(to.path);
    if (from == nullptr || !is_carried_at_all(*from)) {
      report.initialised.push_back(to.path);
      add_step(to);
      return;
    }
    const StateType& old_type = from_.type_of(*from);
    const StateType& new_type = to_.type_of(to);
    if (from->is_array != to.is_array || !takes(new_type, old_type)) {
      report.retyped.push_back(to.path);
      lose_step(*from);
      add_step(to);
      return;
    }
    if (new_type.kind == TypeKind::Reference && !same_layout_) {
      report.references.push_back(to.path);
      return;
    }
    copy(*from, old_type, to, new_type);
    const bool step = (from->flags & to.flags & kStateStep) != 0;
    if (!step) return;
    VariableTransfer::Chart& chart = charts_[owner_of(to.path)];
    chart.carried.push_back(place_of(*from));
    if ((to.flags & kStateInitialStep) != 0) chart.initial.push_back(place_of(to));
  }

  // A step that only the new program has.
  void add_step(const StateVariable& to) {
    if ((to.flags & kStateStep) == 0) return;
    out_.report_.new_steps.push_back(place_of(to));
    VariableTransfer::Chart& chart = charts_[owner_of(to.path)];
    chart.fresh.push_back(place_of(to));
    if ((to.flags & kStateInitialStep) != 0) chart.initial.push_back(place_of(to));
  }

  void lose_step(const StateVariable& from) {
    if ((from.flags & kStateStep) == 0) return;
    out_.report_.lost_steps.push_back(place_of(from));
    charts_[owner_of(from.path)].lost.push_back(place_of(from));
  }

  // The elements that both have.
  void copy(const StateVariable& from, const StateType& old_type, const StateVariable& to,
            const StateType& new_type) {
    TransferReport& report = out_.report_;
    const std::int64_t first = std::max(from.lower, to.lower);
    const std::int64_t end =
        std::min(std::int64_t{from.lower} + from.count, std::int64_t{to.lower} + to.count);
    if (first >= end) {
      report.retyped.push_back(to.path);
      return;
    }
    ++report.carried;
    const auto count = static_cast<std::uint32_t>(end - first);
    if (count < from.count || new_type.capacity < old_type.capacity) report.shortened.push_back(to.path);
    const std::uint32_t source =
        from.address + static_cast<std::uint32_t>(first - from.lower) * old_type.size;
    const std::uint32_t target = to.address + static_cast<std::uint32_t>(first - to.lower) * new_type.size;
    if (old_type.size != new_type.size) {
      const auto capacity = static_cast<std::uint16_t>(std::min(old_type.capacity, new_type.capacity));
      const auto bytes = static_cast<std::uint8_t>(bytecode::character_bytes(new_type.elementary));
      for (std::uint32_t i = 0; i < count; ++i)
        out_.texts_.push_back({source + i * old_type.size, target + i * new_type.size, capacity, bytes});
    } else if (is_bool(new_type) && (from.bit != kNoBit || to.bit != kNoBit)) {
      out_.bits_.push_back({source, target, from.bit, to.bit});
    } else {
      out_.runs_.push_back({source, target, count * new_type.size});
    }
  }

  // A change between programs whose variables lie in another order is thousands of copies of single values:
  // those of one size go behind each other, so that a copy is two moves and no decision.
  void take_out_singles() {
    const auto single = [](std::uint32_t size) { return size == 1 || size == 2 || size == 4 || size == 8; };
    for (const Run& run : out_.runs_)
      if (single(run.size)) out_.singles_[std::countr_zero(run.size)].push_back({run.from, run.to});
    std::erase_if(out_.runs_, [&](const Run& run) { return single(run.size); });
  }

  // Neighbours in both images become one copy.
  static void join(std::vector<Run>& runs) {
    std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.to < b.to; });
    std::size_t last = 0;
    for (std::size_t i = 1; i < runs.size(); ++i) {
      Run& before = runs[last];
      const bool follows = runs[i].to == before.to + before.size && runs[i].from == before.from + before.size;
      if (follows) {
        before.size += runs[i].size;
      } else {
        runs[++last] = runs[i];
      }
    }
    if (!runs.empty()) runs.resize(last + 1);
    runs.shrink_to_fit();
  }

  const StateLayout& from_;
  const StateLayout& to_;
  VariableTransfer& out_;
  bool same_layout_;
  std::map<std::string, VariableTransfer::Chart> charts_;  // by what holds them
};

VariableTransfer VariableTransfer::between(const StateLayout& from, const StateLayout& to) {
  VariableTransfer transfer;
  TransferBuilder(from, to, transfer).build();
  return transfer;
}

void VariableTransfer::apply(std::span<const std::byte> from, std::span<std::byte> to) const {
  for (const Run& run : areas_) std::memcpy(to.data() + run.to, from.data() + run.from, run.size);
  for (const Run& run : runs_) {
    assert(run.from + std::size_t{run.size} <= from.size() && run.to + std::size_t{run.size} <= to.size());
    std::memcpy(to.data() + run.to, from.data() + run.from, run.size);
  }
  copy_singles<1>(singles_[0], from, to);
  copy_singles<2>(singles_[1], from, to);
  copy_singles<4>(singles_[2], from, to);
  copy_singles<8>(singles_[3], from, to);
  for (const Bit& bit : bits_) set(to, bit.to, bit.to_bit, get(from, bit.from, bit.from_bit));
  for (const Text& text : texts_) {
    std::uint16_t length = 0;
    std::uint16_t capacity = 0;
    std::memcpy(&capacity, from.data() + text.from, sizeof capacity);
    std::memcpy(&length, from.data() + text.from + sizeof capacity, sizeof length);
    length = std::min({length, capacity, text.capacity});
    const std::byte* const source = from.data() + text.from + bytecode::kStringHeaderBytes;
    // Half of a pair of UTF-16 is no character.
    if (text.character_bytes == 2 && length > 0) {
      std::uint16_t end = 0;
      std::memcpy(&end, source + (std::size_t{length} - 1) * 2, sizeof end);
      if (end >= 0xD800 && end < 0xDC00) --length;
    }
    std::byte* const target = to.data() + text.to;
    std::memcpy(target + sizeof capacity, &length, sizeof length);
    std::memcpy(target + bytecode::kStringHeaderBytes, source, std::size_t{length} * text.character_bytes);
  }
  for (const Chart& chart : charts_) {
    const auto active = [&](const StepPlace& step) { return get(from, step.address, step.bit); };
    if (std::any_of(chart.carried.begin(), chart.carried.end(), active)) {
      for (const StepPlace& step : chart.fresh) set(to, step.address, step.bit, false);
    } else if (std::any_of(chart.lost.begin(), chart.lost.end(), active)) {
      for (const StepPlace& step : chart.initial) set(to, step.address, step.bit, true);
    }
  }
}

std::uint32_t VariableTransfer::touch() const {
  std::uint32_t sum = 0;
  for (const Run& run : runs_) sum += run.from;
  for (const std::vector<Single>& singles : singles_)
    for (const Single& each : singles) sum += each.from;
  for (const Bit& bit : bits_) sum += bit.from;
  for (const Text& text : texts_) sum += text.from;
  return sum;
}

std::vector<StepPlace> VariableTransfer::lost_active_steps(std::span<const std::byte> from) const {
  std::vector<StepPlace> active;
  for (const StepPlace& step : report_.lost_steps) {
    if (get(from, step.address, step.bit)) active.push_back(step);
  }
  return active;
}

}  // namespace stepwright::record
