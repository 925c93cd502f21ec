#include "runtime/native/internal/program_facts.h"

#include <algorithm>
#include <cassert>

#include "runtime/native/internal/context.h"

namespace stepwright::native {

using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::Section;

namespace {

// Slots beside locals and operands: the caller's instance, while a call runs.
constexpr std::uint32_t kSavedSlots = 1;

std::uint32_t slot_bytes(const bytecode::FunctionRecord& function) {
  return (function.local_count + function.max_stack + kSavedSlots) * kSlotBytes;
}

// Instances of one function block beyond which only the range that they lie in is kept.
constexpr std::size_t kMostBases = 1 << 14;

}  // namespace

ProgramFacts::ProgramFacts(const bytecode::Program& program)
    : program_(program), functions_(view().count<Section::Functions>()), context_bytes_(kFirstSlot) {
  for (std::uint32_t i = 0; i < function_count(); ++i) codes_.push_back(decode_function(view(), i));
  for (std::uint32_t i = 0; i < view().count<Section::ProgramCalls>(); ++i) {
    const auto call = view().record<Section::ProgramCalls>(i);
    add_instance(call.function, call.instance);
  }
  for (std::uint32_t i = 0; i < view().count<Section::Tasks>(); ++i) {
    const auto task = view().record<Section::Tasks>(i);
    const std::uint64_t frames = program.frames_of(i);
    for (std::uint32_t call = 0; call < task.call_count; ++call) {
      const auto function = view().record<Section::ProgramCalls>(task.first_call + call).function;
      const std::uint64_t own = frames + codes_[function].record.frame_offset;
      functions_[function].places.frames.add(own, own);
    }
  }
  const std::vector<std::uint32_t> order = callers_first();
  for (FunctionFacts& facts : functions_) facts.places.first_slot = kFirstSlot;
  for (const std::uint32_t function : order) {
    find_instances(function);
    place_slots(function);
  }
  find_spoilers(order);
  for (std::uint32_t i = 0; i < function_count(); ++i) {
    effects_.push_back(memory_effects(program_, codes_[i], functions_[i].places));
  }
  mark_bytes();
}

// Every function behind all that call it. There is no recursion, so counting callers ends at all of them.
std::vector<std::uint32_t> ProgramFacts::callers_first() const {
  std::vector<std::uint32_t> calls(function_count(), 0);
  const auto each_call = [&](std::uint32_t function, auto visit) {
    for (const FunctionCode::Item& item : codes_[function].items) {
      if (is_call(item.instruction.opcode)) visit(item.instruction.a);
    }
  };
  for (std::uint32_t i = 0; i < function_count(); ++i) {
    each_call(i, [&](std::uint32_t callee) { ++calls[callee]; });
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < function_count(); ++i) {
    if (calls[i] == 0) order.push_back(i);
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    each_call(order[next], [&](std::uint32_t callee) {
      if (--calls[callee] == 0) order.push_back(callee);
    });
  }
  return order;
}

void ProgramFacts::add_instance(std::uint32_t function, std::uint64_t base) {
  FunctionFacts& facts = functions_[function];
  facts.places.instances.add(base, base);
  facts.listed = facts.listed && facts.bases.size() < kMostBases;
  if (facts.listed) facts.bases.push_back(static_cast<std::uint32_t>(base));
}

void ProgramFacts::find_instances(std::uint32_t function) {
  FunctionFacts& own = functions_[function];
  own.uses_self = !own.places.instances.empty() && !own.places.instances.single();
  std::sort(own.bases.begin(), own.bases.end());
  own.bases.erase(std::unique(own.bases.begin(), own.bases.end()), own.bases.end());
  for (const FunctionCode::Item& item : codes_[function].items) {
    const Instruction& in = item.instruction;
    if (in.opcode == Opcode::CallInstanceAbs) add_instance(in.a, in.b);
    if (in.opcode == Opcode::CallInstanceThis) {
      FunctionFacts& callee = functions_[in.a];
      for (const std::uint32_t base : own.bases) add_instance(in.a, std::uint64_t{base} + in.b);
      callee.listed = callee.listed && own.listed;
      if (!own.places.instances.empty()) {
        callee.places.instances.add(own.places.instances.lowest + in.b, own.places.instances.highest + in.b);
      }
    }
    if (in.opcode == Opcode::CallInstanceInd) {
      functions_[in.a].places.instances.add(0, program_.memory_size());
      functions_[in.a].listed = false;
    }
  }
}

void ProgramFacts::place_slots(std::uint32_t function) {
  const std::uint32_t behind = functions_[function].places.first_slot + slot_bytes(codes_[function].record);
  context_bytes_ = std::max(context_bytes_, behind);
  for (const FunctionCode::Item& item : codes_[function].items) {
    if (!is_call(item.instruction.opcode)) continue;
    FunctionFacts& callee = functions_[item.instruction.a];
    callee.places.first_slot = std::max(callee.places.first_slot, behind);
    const InstanceRange& frames = functions_[function].places.frames;
    if (frames.empty()) continue;
    const std::uint64_t distance =
        std::uint64_t{codes_[item.instruction.a].record.frame_offset} - codes_[function].record.frame_offset;
    callee.places.frames.add(frames.lowest + distance, frames.highest + distance);
  }
}

void ProgramFacts::find_spoilers(const std::vector<std::uint32_t>& order) {
  for (auto function = order.rbegin(); function != order.rend(); ++function) {
    FunctionFacts& own = functions_[*function];
    if (own.uses_self) continue;  // it restores the register behind every call
    for (const FunctionCode::Item& item : codes_[*function].items) {
      if (!is_call(item.instruction.opcode)) continue;
      const FunctionFacts& callee = functions_[item.instruction.a];
      own.spoils_self = own.spoils_self || callee.spoils_self || callee.uses_self;
    }
  }
}

// Visits the parts of the image that an access of this function can lie in.
template <typename Visit>
void ProgramFacts::each_place(std::uint32_t function, const Extent& extent, Visit visit) const {
  const std::uint64_t size = program_.memory_size();
  const auto visit_part = [&](std::uint64_t first, std::uint64_t end) {
    end = std::min(end, size);
    visit(std::min(first, end), end);
  };
  const FunctionFacts& facts = functions_[function];
  if (extent.space == Space::Unknown) return visit_part(0, size);
  if (extent.space == Space::Image) return visit_part(extent.first, extent.end);
  if (extent.space != Space::Instance || facts.places.instances.empty()) return;
  if (!facts.listed) {
    return visit_part(facts.places.instances.lowest + extent.first,
                      facts.places.instances.highest + extent.end);
  }
  for (const std::uint32_t base : facts.bases) visit_part(base + extent.first, base + extent.end);
}

void ProgramFacts::mark_bytes() {
  const bytecode::SizesRecord& sizes = program_.sizes();
  std::vector<std::uint8_t> other(program_.memory_size(), 0);
  const auto mark = [&](std::uint64_t first, std::uint64_t end) {
    std::fill(other.begin() + static_cast<std::ptrdiff_t>(first),
              other.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{1});
  };
  // Devices write inputs, and outputs are set to safe states, byte by byte.
  mark(0, std::uint64_t{sizes.input_bytes} + sizes.output_bytes);
  const auto initial = view().section(Section::InitialData);  // nothing else is anything but zero
  for (std::size_t i = 0; i < initial.size(); ++i) {
    if (static_cast<std::uint8_t>(initial[i]) > 1) other[i] = 1;
  }
  for (std::uint32_t i = 0; i < function_count(); ++i) {
    for (const MemoryEffect& effect : effects_[i]) {
      if (effect.store && effect.type != MemType::Bool) each_place(i, effect.extent, mark);
    }
  }
  others_before_.assign(1, 0);
  for (const std::uint8_t byte : other) others_before_.push_back(others_before_.back() + byte);
}

const MemoryEffect& ProgramFacts::effect(std::uint32_t function, std::uint32_t item, bool store) const {
  const std::vector<MemoryEffect>& all = effects_[function];
  const auto before = [](const MemoryEffect& effect, std::uint32_t number) { return effect.item < number; };
  auto found = std::lower_bound(all.begin(), all.end(), item, before);
  while (found->store != store) ++found;
  assert(found->item == item);
  return *found;
}

bool ProgramFacts::plain_bool(std::uint32_t function, const Extent& extent) const {
  bool plain = true;
  each_place(function, extent, [&](std::uint64_t first, std::uint64_t end) {
    plain = plain && others_before_[end] == others_before_[first];
  });
  return plain;
}

}  // namespace stepwright::native
