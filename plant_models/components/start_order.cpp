#include "plant_models/components/start_order.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace stepwright::components {
namespace {

using Starts = std::set<std::uint32_t>;  // by their place in the list

class StartTracer {
 public:
  StartTracer(const std::vector<StartOfState>& starts, const Model& model)
      : starts_(starts), model_(model), of_value_(model.values.size()) {
    for (std::uint32_t i = 0; i < starts.size(); ++i)
      of_state_[{starts[i].component, starts[i].follows.state}] = i;
  }

  // For each start those that it needs.
  std::vector<Starts> trace() {
    run(model_.order);
    std::vector<Starts> needs;
    for (const StartOfState& start : starts_) needs.push_back(needed(start.component, start.follows.reads));
    return needs;
  }

 private:
  Starts needed(std::uint32_t component, const StartReads& reads) const {
    Starts all;
    for (const std::size_t state : reads.states)
      if (const auto found = of_state_.find({component, state}); found != of_state_.end())
        all.insert(found->second);
    for (const std::size_t port : reads.ports) add_read(component, port, all);
    return all;
  }
  // What comes in at a port.
  void add_read(std::uint32_t component, std::size_t port, Starts& to) const {
    const PortSpec& spec = model_.types[component]->ports[port];
    const PortSlots& slots = model_.components[component]->ports()[port];
    const bool branch = spec.role == Role::Branch;
    const std::uint32_t first = branch ? slots.across : slots.through;
    const std::uint32_t count = branch ? across_size(spec.kind) : through_size(spec.kind);
    for (std::uint32_t k = 0; k < count; ++k)
      to.insert(of_value_[first + k].begin(), of_value_[first + k].end());
  }
  void run(const std::vector<Step>& steps) {
    for (const Step& step : steps) {
      switch (step.kind) {
        case StepKind::Evaluate:
          evaluate(step);
          break;
        case StepKind::Gather:
          gather(model_.gatherings[step.index]);
          break;
        case StepKind::Solve:
          solve(model_.loops[step.index]);
          break;
      }
    }
  }
  void gather(const Gathering& gathering) {
    for (const std::uint32_t from : gathering.from)
      of_value_[gathering.to].insert(of_value_[from].begin(), of_value_[from].end());
  }
  // All that is in a loop depends on all that comes into it.
  void solve(const Loop& loop) {
    run(loop.steps);
    Starts all;
    for (const std::uint32_t residual : loop.residuals)
      all.insert(of_value_[residual].begin(), of_value_[residual].end());
    for (const std::uint32_t unknown : loop.unknowns) of_value_[unknown].insert(all.begin(), all.end());
    run(loop.steps);
  }
  void evaluate(const Step& step) {
    const std::vector<PortSpec>& ports = model_.types[step.index]->ports;
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (ports[i].stage != step.stage) continue;
      const auto said = model_.components[step.index]->output_reads(i);
      const Starts read = needed(step.index, said ? *said : all_of(step));
      const PortSlots& slots = model_.components[step.index]->ports()[i];
      const bool node = ports[i].role == Role::Node;
      const std::uint32_t first = node ? slots.across : slots.through;
      const std::uint32_t count = node ? across_size(ports[i].kind) : through_size(ports[i].kind);
      for (std::uint32_t k = 0; k < count; ++k) of_value_[first + k].insert(read.begin(), read.end());
    }
  }
  // All that an output of that step may come from.
  StartReads all_of(const Step& step) const {
    StartReads reads;
    for (std::size_t s = 0; s < model_.components[step.index]->state_count(); ++s) reads.states.push_back(s);
    const std::vector<PortSpec>& ports = model_.types[step.index]->ports;
    for (std::size_t i = 0; i < ports.size(); ++i)
      if (ports[i].reads <= step.stage) reads.ports.push_back(i);
    return reads;
  }

  const std::vector<StartOfState>& starts_;
  const Model& model_;
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> of_state_;  // component and state
  std::vector<Starts> of_value_;
};

std::string name_of(const StartOfState& start, const Model& model) {
  return model.names[start.component] + "." + start.follows.name;
}

// Of starts each of which needs another one of them.
result::Diagnostics circle_among(const Starts& left, const std::vector<Starts>& needs,
                                 const std::vector<StartOfState>& starts, const Model& model) {
  std::vector<std::uint32_t> path;
  std::uint32_t at = *left.begin();
  while (std::find(path.begin(), path.end(), at) == path.end()) {
    path.push_back(at);
    at = *std::find_if(needs[at].begin(), needs[at].end(), [&](std::uint32_t i) { return left.contains(i); });
  }
  path.erase(path.begin(), std::find(path.begin(), path.end(), at));
  std::string names;
  for (const std::uint32_t i : path) names += (names.empty() ? "" : ", ") + name_of(starts[i], model);
  const StartOfState& first = starts[*std::min_element(path.begin(), path.end())];
  return {{"C0346", result::Severity::Error,
           first.follows.where.line > 0 ? first.follows.where : model.text.components[first.component].place,
           path.size() == 1 ? "the start of " + names + " needs itself"
                            : "each of these starts needs another one: " + names,
           "give one of them a figure, or an expression of parameters"}};
}

}  // namespace

std::vector<StartOfState> following_starts_of(const Model& model) {
  std::vector<StartOfState> starts;
  for (const std::uint32_t c : model.with_states)
    for (FollowingStart& start : model.components[c]->following_starts()) starts.push_back({c, start});
  return starts;
}

result::Result<std::size_t> depth_of(const std::vector<StartOfState>& starts, const Model& model) {
  const std::vector<Starts> needs = StartTracer(starts, model).trace();
  std::vector<std::vector<std::uint32_t>> needed_by(starts.size());
  std::vector<std::size_t> waits(starts.size()), depth(starts.size(), 1);
  std::vector<std::uint32_t> ready;
  Starts left;
  for (std::uint32_t i = 0; i < starts.size(); ++i) {
    left.insert(i);
    waits[i] = needs[i].size();
    if (needs[i].empty()) ready.push_back(i);
    for (const std::uint32_t from : needs[i]) needed_by[from].push_back(i);
  }
  std::size_t most = 0;
  while (!ready.empty()) {
    const std::uint32_t i = ready.back();
    ready.pop_back();
    left.erase(i);
    most = std::max(most, depth[i]);
    for (const std::uint32_t next : needed_by[i]) {
      depth[next] = std::max(depth[next], depth[i] + 1);
      if (--waits[next] == 0) ready.push_back(next);
    }
  }
  if (!left.empty()) return tl::unexpected(circle_among(left, needs, starts, model));
  return most;
}

}  // namespace stepwright::components
