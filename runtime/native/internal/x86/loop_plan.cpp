#include "runtime/native/internal/x86/loop_plan.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>

namespace stepwright::native {

using bytecode::MemType;
using bytecode::Opcode;

namespace {

// Candidates that are looked at closely, of one loop.
constexpr std::size_t kMostCandidates = 64;
// How many times more an access in an inner loop counts.
constexpr std::uint64_t kInnerWeight = 8;
constexpr std::uint64_t kMostWeight = 1 << 24;

struct Candidate {
  Pinned variable;
  std::uint64_t weight = 0;
};

class LoopPlanner {
 public:
  LoopPlanner(const ProgramFacts& program, std::uint32_t function)
      : program_(program), function_(function), items_(program.code(function).items) {}

  std::vector<Loop> run() {
    find_loops();
    std::vector<Loop> chosen;
    for (Loop& loop : loops_) {
      if (!chosen.empty() && chosen.back().last >= loop.first) continue;
      if (!closed(loop)) continue;
      loop.variables = choose(loop);
      if (!loop.variables.empty()) chosen.push_back(std::move(loop));
    }
    return chosen;
  }

 private:
  // From the first on, the longer before the shorter; and the jumps that lead to each instruction.
  void find_loops() {
    std::map<std::uint32_t, std::uint32_t> last_of;
    sources_.resize(items_.size(), {kNoInstruction, 0});
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      const std::uint32_t target = items_[i].target;
      if (target == kNoInstruction) continue;
      sources_[target].first = std::min(sources_[target].first, i);
      sources_[target].second = std::max(sources_[target].second, i);
      if (target <= i) last_of[target] = i;
    }
    for (const auto& [first, last] : last_of) loops_.push_back({first, last, {}});
  }

  // Entered at its start only, and without anything that spoils registers.
  bool closed(const Loop& loop) const {
    for (std::uint32_t i = loop.first; i <= loop.last; ++i) {
      const bytecode::Instruction& in = items_[i].instruction;
      if (is_call(in.opcode) || calls_library(in)) return false;
      if (in.opcode == Opcode::MemCopy && in.a > kLargestInlineCopy) return false;
      const bool entered =
          items_[i].is_target && (sources_[i].first < loop.first || sources_[i].second > loop.last);
      if (i > loop.first && entered) return false;
    }
    return true;
  }

  std::span<const MemoryEffect> effects_of(const Loop& loop) const {
    const auto& all = program_.effects(function_);
    const auto before = [](const MemoryEffect& effect, std::uint32_t item) { return effect.item < item; };
    const auto first = std::lower_bound(all.begin(), all.end(), loop.first, before);
    const auto end = std::lower_bound(first, all.end(), loop.last + 1, before);
    return {first, end};
  }

  std::vector<std::uint64_t> weights(const Loop& loop) const {
    std::vector<std::uint64_t> weights(loop.last - loop.first + 1, 1);
    const auto behind = [](std::uint32_t first, const Loop& other) { return first < other.first; };
    auto inner = std::upper_bound(loops_.begin(), loops_.end(), loop.first, behind);
    for (; inner != loops_.end() && inner->last <= loop.last; ++inner) {
      for (std::uint32_t i = inner->first; i <= inner->last; ++i) {
        std::uint64_t& weight = weights[i - loop.first];
        weight = std::min(weight * kInnerWeight, kMostWeight);
      }
    }
    return weights;
  }

  std::vector<Pinned> choose(const Loop& loop) const {
    const auto effects = effects_of(loop);
    const auto weight = weights(loop);
    std::map<std::pair<Space, std::uint64_t>, Candidate> found;
    for (const MemoryEffect& effect : effects) {
      if (!effect.is_scalar()) continue;
      Candidate& candidate = found[{effect.extent.space, effect.extent.first}];
      candidate.variable.where = effect.extent;
      candidate.variable.type = effect.type;
      candidate.variable.written = candidate.variable.written || effect.store;
      candidate.weight += weight[effect.item - loop.first];
    }
    std::vector<Candidate> sorted;
    for (const auto& entry : found) sorted.push_back(entry.second);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
    sorted.resize(std::min(sorted.size(), kMostCandidates));
    return assign(sorted, effects);
  }

  std::vector<Pinned> assign(const std::vector<Candidate>& candidates,
                             std::span<const MemoryEffect> effects) const {
    std::vector<Pinned> variables;
    std::uint32_t general = 0;
    std::uint32_t floating = 0;
    for (const Candidate& candidate : candidates) {
      Pinned variable = candidate.variable;
      const bool is_float = variable.type == MemType::F32 || variable.type == MemType::F64;
      std::uint32_t& used = is_float ? floating : general;
      if (used == (is_float ? kLoopXmm : kLoopGeneral) || !alone(variable, effects)) continue;
      ++used;
      variable.reg =
          is_float ? static_cast<RegisterId>(kRegisterCount - used) : kGeneral[std::size(kGeneral) - used];
      variables.push_back(variable);
    }
    return variables;
  }

  // True if the loop touches these bytes as this variable only.
  bool alone(const Pinned& variable, std::span<const MemoryEffect> effects) const {
    if (variable.type == MemType::Ref && variable.written) return false;
    if (variable.type == MemType::Bool && !program_.plain_bool(function_, variable.where)) return false;
    const InstanceRange& instances = program_.facts(function_).places.instances;
    return std::all_of(effects.begin(), effects.end(), [&](const MemoryEffect& effect) {
      if (effect.is_scalar() && effect.type == variable.type && effect.extent == variable.where) return true;
      if (!effect.store && !variable.written) return true;
      return !may_overlap(effect.extent, variable.where, instances);
    });
  }

  const ProgramFacts& program_;
  std::uint32_t function_;
  const std::vector<FunctionCode::Item>& items_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sources_;  // first and last jump to an instruction
  std::vector<Loop> loops_;
};

}  // namespace

std::vector<Loop> plan_loops(const ProgramFacts& program, std::uint32_t function) {
  return LoopPlanner(program, function).run();
}

}  // namespace stepwright::native
