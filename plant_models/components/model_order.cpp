#include "plant_models/components/model_order.h"

#include <algorithm>
#include <set>

namespace stepwright::components {
namespace {

using Edges = std::vector<std::vector<std::uint32_t>>;

// From each node to those that read what it sets.
Edges edges_of(const std::vector<OrderNode>& nodes, std::size_t values) {
  std::vector<std::vector<std::uint32_t>> readers(values);
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    for (const std::uint32_t value : nodes[i].reads) readers[value].push_back(i);
  Edges edges(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t value : nodes[i].writes)
      edges[i].insert(edges[i].end(), readers[value].begin(), readers[value].end());
    std::sort(edges[i].begin(), edges[i].end());
    edges[i].erase(std::unique(edges[i].begin(), edges[i].end()), edges[i].end());
  }
  return edges;
}

// Tarjan's strongly connected components, "Depth-first search and linear graph algorithms" (1972), without
// recursion: a plant may be a chain of thousands. The last one found is worked out first.
std::vector<std::vector<std::uint32_t>> circles_of(const Edges& edges) {
  constexpr std::uint32_t kNew = 0xFFFFFFFF;
  const std::size_t count = edges.size();
  std::vector<std::uint32_t> number(count, kNew), low(count, 0), at(count, 0), stack, path;
  std::vector<bool> on_stack(count, false);
  std::vector<std::vector<std::uint32_t>> found;
  std::uint32_t next = 0;
  for (std::uint32_t root = 0; root < count; ++root) {
    if (number[root] != kNew) continue;
    path.push_back(root);
    while (!path.empty()) {
      const std::uint32_t node = path.back();
      if (number[node] == kNew) {
        number[node] = low[node] = next++;
        stack.push_back(node);
        on_stack[node] = true;
      }
      if (at[node] < edges[node].size()) {
        const std::uint32_t to = edges[node][at[node]++];
        if (number[to] == kNew)
          path.push_back(to);
        else if (on_stack[to])
          low[node] = std::min(low[node], number[to]);
        continue;
      }
      path.pop_back();
      if (!path.empty()) low[path.back()] = std::min(low[path.back()], low[node]);
      if (low[node] != number[node]) continue;
      found.emplace_back();
      std::uint32_t member = 0;
      do {
        member = stack.back();
        stack.pop_back();
        on_stack[member] = false;
        found.back().push_back(member);
      } while (member != node);
    }
  }
  std::reverse(found.begin(), found.end());
  return found;
}

std::string names_of(const std::vector<std::uint32_t>& circle, const std::vector<OrderNode>& nodes,
                     const Model& model) {
  std::set<std::uint32_t> components;
  for (const std::uint32_t i : circle)
    if (nodes[i].step.kind == StepKind::Evaluate) components.insert(nodes[i].component);
  std::string names;
  for (const std::uint32_t component : components)
    names += (names.empty() ? "" : ", ") + model.names[component];
  return names;
}

// The members of a circle in an order that begins at its unknowns; false if there is none.
bool order_circle(const std::vector<std::uint32_t>& circle, const std::vector<OrderNode>& nodes,
                  const Edges& edges, std::vector<Step>& steps) {
  std::set<std::uint32_t> inside(circle.begin(), circle.end());
  std::map<std::uint32_t, std::size_t> waits;
  for (const std::uint32_t i : inside) waits[i];
  for (const std::uint32_t i : inside) {
    for (const std::uint32_t to : edges[i])
      if (inside.contains(to) && !nodes[to].unknown) ++waits[to];
  }
  std::set<std::uint32_t> ready;
  for (const auto& [i, count] : waits)
    if (count == 0) ready.insert(i);
  std::size_t done = 0;
  while (!ready.empty()) {
    const std::uint32_t i = *ready.begin();
    ready.erase(ready.begin());
    ++done;
    if (!nodes[i].unknown) steps.push_back(nodes[i].step);
    for (const std::uint32_t to : edges[i])
      if (inside.contains(to) && !nodes[to].unknown && --waits[to] == 0) ready.insert(to);
  }
  return done == circle.size();
}

// The steps of the order that set something which is needed, or which one of those steps reads.
std::vector<Step> steps_for(std::vector<bool> needed, const std::vector<OrderNode>& nodes,
                            const std::vector<std::vector<std::uint32_t>>& members, const Model& model) {
  std::vector<Step> steps;
  for (std::size_t i = model.order.size(); i-- > 0;) {
    const bool sets = std::any_of(members[i].begin(), members[i].end(), [&](std::uint32_t node) {
      const auto& writes = nodes[node].writes;
      return std::any_of(writes.begin(), writes.end(), [&](std::uint32_t value) { return needed[value]; });
    });
    if (!sets) continue;
    steps.push_back(model.order[i]);
    for (const std::uint32_t node : members[i])
      for (const std::uint32_t value : nodes[node].reads) needed[value] = true;
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

std::vector<bool> shown_values(const Model& model) {
  std::vector<bool> needed(model.values.size(), false);
  for (const ModelTerminal& terminal : model.sensor_at) needed[terminal.slot] = true;
  return needed;
}

// Everything at the ports of components whose root functions look there.
std::vector<bool> watched_values(const Model& model) {
  std::vector<bool> needed(model.values.size(), false);
  for (const std::uint32_t c : model.with_roots) {
    const Component& component = *model.components[c];
    if (!component.roots_read_values()) continue;
    for (std::size_t i = 0; i < component.ports().size(); ++i) {
      const PortSlots& port = component.ports()[i];
      const bool liquid = model.types[c]->ports[i].kind == PortKind::Fluid;
      for (std::uint32_t k = 0; k < (liquid ? kFluidAcross : 1); ++k) needed[port.across + k] = true;
      for (std::uint32_t k = 0; k < (liquid ? kFluidThrough : 1); ++k) needed[port.through + k] = true;
    }
  }
  return needed;
}

}  // namespace

result::Result<void> put_in_order(const std::vector<OrderNode>& nodes, Model& model) {
  const Edges edges = edges_of(nodes, model.values.size());
  result::Diagnostics problems;
  std::vector<std::vector<std::uint32_t>> members;  // of each step of the order
  for (std::vector<std::uint32_t> circle : circles_of(edges)) {
    const std::uint32_t first = circle.front();
    const bool alone =
        circle.size() == 1 && !std::binary_search(edges[first].begin(), edges[first].end(), first);
    if (alone && !nodes[first].unknown) {
      model.order.push_back(nodes[first].step);
      members.push_back({first});
      continue;
    }
    if (alone) {
      const std::uint32_t component = nodes[first].component;
      problems.push_back(
          {"C0346", result::Severity::Error, model.text.components[component].place,
           "nothing gives way where the ports of " + model.names[component] + " and others meet",
           "what flows there depends on no pressure; put a tank between them"});
      continue;
    }
    std::sort(circle.begin(), circle.end());
    Loop loop;
    loop.names = names_of(circle, nodes, model);
    for (const std::uint32_t i : circle) {
      if (!nodes[i].unknown) continue;
      loop.unknowns.insert(loop.unknowns.end(), nodes[i].writes.begin(), nodes[i].writes.end());
      loop.residuals.insert(loop.residuals.end(), nodes[i].reads.begin(), nodes[i].reads.end());
      loop.typical.insert(loop.typical.end(), nodes[i].typical.begin(), nodes[i].typical.end());
      const std::vector<double>& residual = nodes[i].typical_residual;
      loop.typical_residual.insert(loop.typical_residual.end(), residual.begin(), residual.end());
      // A junction of liquid has its pressure first, then its temperature.
      const auto pressure = static_cast<std::int32_t>(loop.start.size());
      for (const std::uint32_t value : nodes[i].writes) {
        loop.pressure_of.push_back(value == nodes[i].writes.front() ? -1 : pressure);
        loop.start.push_back(model.values[value]);
      }
    }
    if (loop.unknowns.empty() || !order_circle(circle, nodes, edges, loop.steps)) {
      const std::uint32_t component = nodes[circle.front()].component;
      problems.push_back(
          {"C0346", result::Severity::Error, model.text.components[component].place,
           "a circle without a state: " + loop.names,
           "each needs what another one says in the same instant; put something that takes time "
           "between them, such as a first_order"});
      continue;
    }
    model.order.push_back({StepKind::Solve, static_cast<std::uint32_t>(model.loops.size()), 0});
    model.loops.push_back(std::move(loop));
    members.push_back(std::move(circle));
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  model.shown = steps_for(shown_values(model), nodes, members, model);
  model.watched = steps_for(watched_values(model), nodes, members, model);
  return {};
}

}  // namespace stepwright::components
