// Outputs that several places drive: the last one of a scan wins, which no one sees in any of them.

#include <algorithm>

#include "ladder/lint/internal/rules.h"
#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using semantics::Pou;

namespace {

void reach(const Pou& pou, const std::string& instance, Reached& out) {
  if (!out.by[&pou].insert(instance).second) return;
  for (const Pou* each : pou.callees) reach(*each, instance, out);
}

// All that drives one output.
struct Output {
  std::string name;
  BitRange range;
  std::vector<WriteSite> sites;
};

std::string place_of(Position where, const source::SourceSet& sources) {
  const result::Location location = sources.location(where);
  return location.file + ":" + std::to_string(location.line) + ":" + std::to_string(location.column);
}

void check_coils(const VariableUse& use, const source::SourceSet& sources, source::DiagnosticSink& sink) {
  std::unordered_map<const Pou*, const WriteSite*> first;
  for (const WriteSite& each : use.sites) {
    if (!each.coil || each.keeps) continue;
    const auto [earlier, is_new] = first.try_emplace(each.pou, &each);
    if (is_new) continue;
    sink.warning(code::kWrittenTwice, each.where, quote(use.variable->spelling) + " has several coils",
                 "the last one decides; the first is at " + place_of(earlier->second->where, sources));
  }
}

class OutputRule {
 public:
  OutputRule(const Reached& reached, const source::SourceSet& sources, source::DiagnosticSink& sink)
      : reached_(reached), sources_(sources), sink_(sink) {}

  // Sites of outputs that share bits.
  void check(const std::vector<const Output*>& outputs) {
    const WriteSite* first = nullptr;
    for (const Output* output : outputs) {
      for (const WriteSite& site : output->sites) {
        const auto instances = reached_.by.find(site.pou);
        if (site.keeps || instances == reached_.by.end()) continue;
        if (first == nullptr) {
          first = &site;
          if (instances->second.size() > 1) return several_instances(*output, site, instances->second);
        } else if (first->pou != site.pou) {
          sink_.warning(code::kWrittenTwice, site.where,
                        quote(output->name) + " is written in " + quote(first->pou->spelling) + " too",
                        "the last one decides; the other place is " + place_of(first->where, sources_));
          return;
        }
      }
    }
  }

 private:
  void several_instances(const Output& output, const WriteSite& site, const std::set<std::string>& names) {
    sink_.warning(code::kWrittenTwice, site.where,
                  quote(output.name) + " is written by several programs: " + quote(*names.begin()) + " and " +
                      quote(*std::next(names.begin())),
                  "give each instance an output of its own");
  }

  const Reached& reached_;
  const source::SourceSet& sources_;
  source::DiagnosticSink& sink_;
};

void collect(const VariableUse& use, std::vector<Output>& out) {
  if (use.sites.empty() || !use.variable->address || use.variable->type == nullptr) return;
  out.push_back({use.variable->spelling, range_of(*use.variable), use.sites});
}

}  // namespace

Reached reached_of(const semantics::Model& model) {
  Reached reached;
  for (const semantics::ProgramInstance& each : model.instances) reach(*each.program, each.name, reached);
  return reached;
}

void check_outputs(const Uses& uses, const Reached& reached, const source::SourceSet& sources,
                   source::DiagnosticSink& sink) {
  std::vector<Output> outputs;
  for (const auto& [range, direct] : uses.directs) outputs.push_back({direct.text, range, direct.sites});
  for (const VariableUse& each : uses.of_globals) {
    check_coils(each, sources, sink);
    collect(each, outputs);
  }
  for (std::size_t i = 0; i < uses.user_pous; ++i) {
    for (const VariableUse& each : uses.of_pous[i]) {
      check_coils(each, sources, sink);
      collect(each, outputs);
    }
  }
  std::stable_sort(outputs.begin(), outputs.end(),
                   [](const Output& a, const Output& b) { return a.range < b.range; });
  OutputRule rule(reached, sources, sink);
  std::vector<const Output*> group;
  std::uint32_t end = 0;
  for (const Output& each : outputs) {
    const auto [area, begin, bits] = each.range;
    if (!group.empty() && (std::get<0>(group.front()->range) != area || begin >= end)) {
      rule.check(group);
      group.clear();
    }
    end = group.empty() ? begin + bits : std::max(end, begin + bits);
    group.push_back(&each);
  }
  rule.check(group);
}

}  // namespace stepwright::lint::internal
