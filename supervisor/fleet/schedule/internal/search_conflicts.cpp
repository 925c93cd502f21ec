// The search's propagation and what it learns from conflicts.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "supervisor/fleet/schedule/internal/search.h"

namespace stepwright::fleet::internal {

// Propagation

bool Search::propagate() {
  for (;;) {
    if (!propagate_clauses()) return false;
    if (theory_head_ == trail_.size()) return within_objective();
    if (!post(trail_[theory_head_++])) return false;
  }
}

bool Search::propagate_clauses() {
  while (clause_head_ < trail_.size()) {
    const ClauseId broken = clauses_.visit(
        ~trail_[clause_head_++], [this](Literal l) { return value(l); },
        [this](Literal l, ClauseId clause) {
          assign(l, {Reason::Kind::Clause, clause, 0});
        });
    if (broken == Clauses::kNone) continue;
    conflict_.clear();
    for (const Literal l : clauses_[broken]) conflict_.push_back(~l);
    return false;
  }
  return true;
}

bool Search::post(Literal l) {
  const Network::Mark before = network_.mark();
  for (const Constraint& c : model_.edges_of(l)) {
    if (network_.post(c)) continue;
    labels_.assign(network_.conflict().begin(), network_.conflict().end());
    conflict_.clear();
    literals_of(labels_, conflict_);
    return false;
  }
  return !network_.tracks_latest() || imply_by_times(before);
}

// The literals behind labels, each once.
void Search::literals_of(std::vector<std::uint32_t>& labels, std::vector<Literal>& literals) {
  std::erase_if(labels, [this](std::uint32_t label) { return !model_.is_literal(label); });
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  for (const std::uint32_t label : labels) literals.push_back(model_.literal_of(label));
}

bool Search::imply_by_times(const Network::Mark& since) {
  bool consistent = true;
  const auto look = [&](Timepoint t, const auto& list, const auto& begin) {
    for (std::uint32_t k = begin[t.value]; k < begin[t.value + 1]; ++k) {
      consistent = consistent && exclude_if_late(list[k]);
    }
  };
  network_.each_later(since, [&](Timepoint t) { look(t, leaving_, leaving_begin_); });
  network_.each_sooner(since, [&](Timepoint t) { look(t, arriving_, arriving_begin_); });
  return consistent;
}

bool Search::imply_all() {
  for (std::uint32_t edge = 0; edge < model_.edges.size(); ++edge) {
    if (!exclude_if_late(edge)) return false;
  }
  return true;
}

// An order whose constraint cannot hold between earliest and latest times leaves the other one.
bool Search::exclude_if_late(std::uint32_t edge) {
  const Constraint& c = model_.edges[edge];
  if (network_.earliest_ms(c.from) + c.least_ms <= network_.latest_ms(c.to)) return true;
  const Literal excluded = model_.literal_of(c.label);
  if (value(excluded) < 0) return true;
  labels_.clear();
  network_.explain_earliest(c.from, labels_);
  network_.explain_latest(c.to, labels_);
  if (value(excluded) > 0) {
    conflict_.assign(1, excluded);
    literals_of(labels_, conflict_);
    return false;
  }
  const std::size_t first = reasons_.size();
  literals_of(labels_, reasons_);
  assign(~excluded, {Reason::Kind::Literals, static_cast<std::uint32_t>(first),
                     static_cast<std::uint32_t>(reasons_.size() - first)});
  return true;
}

std::int64_t Search::objective_now() const {
  std::int64_t total = 0;
  for (const auto& end : objective_.ends) {
    const std::int64_t at = network_.earliest_ms(end.timepoint);
    if (objective_.measure == Measure::Makespan) total = std::max(total, at);
    if (objective_.measure == Measure::TotalTardiness) {
      total += std::max<std::int64_t>(0, at - end.due_ms);
    }
  }
  return total;
}

// Earliest times only grow below this node: it is closed once they are no better than the best known.
bool Search::within_objective() {
  if (objective_.measure == Measure::None || objective_now() < best_ms_) return true;
  labels_.clear();
  for (const auto& end : objective_.ends) {
    const std::int64_t at = network_.earliest_ms(end.timepoint);
    const bool counts = objective_.measure == Measure::Makespan ? at >= best_ms_ : at > end.due_ms;
    if (!counts) continue;
    network_.explain_earliest(end.timepoint, labels_);
    if (objective_.measure == Measure::Makespan) break;
  }
  conflict_.clear();
  literals_of(labels_, conflict_);
  return false;
}

// Conflicts

// The true literals that implied the order of `section`.
template <typename Visitor>
void Search::each_reason(std::uint32_t section, Visitor&& visit) const {
  const Reason& reason = reason_[section];
  if (reason.kind == Reason::Kind::Clause) {
    for (const Literal l : clauses_[reason.first]) {
      if (l.section() != section) visit(~l);
    }
  }
  if (reason.kind == Reason::Kind::Literals) {
    for (std::uint32_t k = 0; k < reason.count; ++k) visit(reasons_[reason.first + k]);
  }
}

// Learns from conflict_ and assigns what follows. False: it holds without any decision.
bool Search::learn() {
  std::size_t level = 0;
  for (const Literal l : conflict_) level = std::max<std::size_t>(level, level_of_[l.section()]);
  if (level == 0) return false;
  back_to(level);
  std::vector<Literal> clause = first_implication_point(level);
  activity_.decay();
  if (clause.size() == 1) {
    back_to(0);
    assign(clause.front(), {});
    return true;
  }
  std::ranges::sort(clause.begin() + 1, clause.end(),
                    [&](Literal a, Literal b) { return level_of_[a.section()] > level_of_[b.section()]; });
  std::uint32_t levels = 2;
  for (std::size_t k = 2; k < clause.size(); ++k) {
    if (level_of_[clause[k].section()] != level_of_[clause[k - 1].section()]) ++levels;
  }
  back_to(level_of_[clause[1].section()]);
  const Literal asserted = clause.front();
  const ClauseId id = clauses_.add(std::move(clause), levels);
  assign(asserted, {Reason::Kind::Clause, id, 0});
  return true;
}

// Resolves conflict_ with reasons, last assigned first, until one literal of the level is left; the clause
// says that this one or another literal is false.
std::vector<Literal> Search::first_implication_point(std::size_t level) {
  std::vector<Literal> clause(1);
  std::size_t open = 0;
  const auto take = [&](Literal l) {
    const std::uint32_t section = l.section();
    if (seen_[section] || level_of_[section] == 0) return;
    seen_[section] = 1;
    activity_.bump(section);
    if (level_of_[section] == level) {
      ++open;
    } else {
      clause.push_back(~l);
    }
  };
  for (const Literal l : conflict_) take(l);
  std::vector<std::uint32_t> resolved;
  for (std::size_t k = trail_.size(); open > 0;) {
    const Literal l = trail_[--k];
    if (!seen_[l.section()]) continue;
    --open;
    resolved.push_back(l.section());
    clause.front() = ~l;
    if (open > 0) each_reason(l.section(), take);
  }
  const std::vector<Literal> whole(clause.begin() + 1, clause.end());
  std::erase_if(clause, [&](Literal l) { return !(l == clause.front()) && redundant(l); });
  for (const Literal l : whole) seen_[l.section()] = 0;
  for (const std::uint32_t section : resolved) seen_[section] = 0;
  return clause;
}

// Whether other literals of the clause imply this one.
bool Search::redundant(Literal l) const {
  if (reason_[l.section()].kind == Reason::Kind::Decision) return false;
  bool implied = true;
  each_reason(l.section(),
              [&](Literal r) { implied = implied && (level_of_[r.section()] == 0 || seen_[r.section()]); });
  return implied;
}

}  // namespace stepwright::fleet::internal
