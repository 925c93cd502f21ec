#include "supervisor/fleet/schedule/internal/search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace stepwright::fleet::internal {

namespace {

constexpr std::int64_t kWorst = std::numeric_limits<std::int64_t>::max();

// The sequence of Luby, Sinclair and Zuckerman 1993: 1 1 2 1 1 2 4 ...
std::uint64_t luby(std::uint64_t k) {
  std::uint64_t size = 1, power = 0;
  while (size < k + 1) {
    size = 2 * size + 1;
    ++power;
  }
  while (size - 1 != k) {
    size = (size - 1) / 2;
    --power;
    k %= size;
  }
  return std::uint64_t{1} << power;
}

// Which of the model's edges begin, or end, at each timepoint, as one list with the places where each begins.
void index_edges(const SearchModel& model, bool leaving, std::vector<std::uint32_t>& list,
                 std::vector<std::uint32_t>& begin) {
  const auto at = [&](const Constraint& c) { return leaving ? c.from.value : c.to.value; };
  begin.assign(model.timepoints + 1, 0);
  for (const Constraint& c : model.edges) ++begin[at(c) + 1];
  for (std::size_t t = 0; t < model.timepoints; ++t) begin[t + 1] += begin[t];
  list.resize(model.edges.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t e = 0; e < model.edges.size(); ++e) list[next[at(model.edges[e])]++] = e;
}

}  // namespace

Search::Search(const SearchModel& model, const SearchObjective& objective, const SearchLimits& limits,
               const SearchTuning& tuning)
    : model_(model),
      objective_(objective),
      limits_(limits),
      tuning_(tuning),
      network_(model.timepoints),
      clauses_(model.sections()),
      activity_(model.sections()),
      value_(model.sections(), 0),
      level_of_(model.sections(), 0),
      reason_(model.sections()),
      saved_(model.sections(), 0),
      seen_(model.sections(), 0),
      best_ms_(kWorst) {}

Answer Search::next() {
  if (refuted_) return Answer::No;
  if (!prepared_) {
    prepared_ = true;
    if (!prepare()) {
      refuted_ = true;
      return Answer::No;
    }
  }
  const Answer answer = search();
  refuted_ = answer == Answer::No;
  if (refuted_) root_objective_ms_ = best_ms_;
  if (answer == Answer::Yes) {
    orders_.assign(model_.sections(), 0);
    for (std::size_t s = 0; s < model_.sections(); ++s) orders_[s] = value_[s] > 0 ? 0 : 1;
    if (objective_.measure != Measure::None) best_ms_ = objective_now();
  }
  return answer;
}

bool Search::prepare() {
  if (!network_.load(model_.base)) return false;
  root_objective_ms_ = objective_now();
  if (objective_.measure != Measure::None) raise_lower_bound();
  std::vector<Due> due;
  due.reserve(model_.sections());
  for (std::uint32_t s = 0; s < model_.sections(); ++s) due.push_back({due_ms(s), s});
  due_ = std::priority_queue<Due>(std::less<Due>{}, std::move(due));
  return model_.sections() > tuning_.few_sections || watch_latest();
}

// Each section alone makes the objective at least as large as its better order does.
void Search::raise_lower_bound() {
  for (std::uint32_t s = 0; s < model_.sections(); ++s) {
    std::int64_t better = kWorst;
    for (const int side : {0, 1}) {
      const Network::Mark before = network_.mark();
      if (network_.post(model_.edges_of(Literal::of(s, side)))) better = std::min(better, objective_now());
      network_.undo(before);
    }
    if (better < kWorst) root_objective_ms_ = std::max(root_objective_ms_, better);
  }
}

bool Search::watch_latest() {
  network_.track_latest();
  index_edges(model_, true, leaving_, leaving_begin_);
  index_edges(model_, false, arriving_, arriving_begin_);
  return imply_all();
}

Answer Search::search() {
  for (;;) {
    if (!propagate()) {
      ++figures_.conflicts;
      if (!learn()) return Answer::No;
      if (const auto answer = stopped()) return *answer;
      const std::uint64_t patience = tuning_.conflicts_per_restart * luby(figures_.restarts);
      if (figures_.conflicts - conflicts_at_restart_ >= patience && !restart()) return Answer::No;
      continue;
    }
    if (const auto answer = stopped()) return *answer;
    const auto literal = decide();
    if (!literal) return Answer::Yes;
    ++figures_.decisions;
    new_level();
    assign(*literal, {});
  }
}

std::optional<Answer> Search::stopped() {
  if (limits_.conflicts > 0 && figures_.conflicts >= limits_.conflicts) return Answer::OutOfTime;
  if (++steps_ % 256 != 1) return std::nullopt;
  if (limits_.cancel && limits_.cancel->load(std::memory_order_relaxed)) return Answer::Cancelled;
  if (limits_.until && std::chrono::steady_clock::now() >= *limits_.until) return Answer::OutOfTime;
  return std::nullopt;
}

bool Search::restart() {
  back_to(0);
  ++figures_.restarts;
  conflicts_at_restart_ = figures_.conflicts;
  if (!propagate()) return false;
  root_objective_ms_ = std::max(root_objective_ms_, objective_now());
  // What was implied before any decision needs no reason any more.
  for (const Literal l : trail_) reason_[l.section()] = {};
  reasons_.clear();
  if (clauses_.size() > tuning_.clauses_kept) {
    clauses_.reduce();
    tuning_.clauses_kept += tuning_.clauses_kept / 4;
  }
  return network_.tracks_latest() || watch_latest();
}

// Assignment

void Search::assign(Literal l, Reason reason) {
  const std::uint32_t section = l.section();
  value_[section] = l.side() == 0 ? 1 : -1;
  level_of_[section] = static_cast<std::uint32_t>(levels_.size());
  reason_[section] = reason;
  trail_.push_back(l);
}

void Search::new_level() {
  levels_.push_back({trail_.size(), reasons_.size(), network_.mark()});
}

void Search::back_to(std::size_t level) {
  if (levels_.size() <= level) return;
  const Level& first = levels_[level];
  network_.undo(first.mark);
  for (std::size_t k = first.trail; k < trail_.size(); ++k) {
    const std::uint32_t section = trail_[k].section();
    saved_[section] = value_[section];
    value_[section] = 0;
    due_.push({due_ms(section), section});
    if (activity_.active(section)) activity_.insert(section);
  }
  trail_.resize(first.trail);
  reasons_.resize(first.reasons);
  clause_head_ = theory_head_ = first.trail;
  levels_.resize(level);
}

// Decisions

// The first time at which both could be in the section.
std::int32_t Search::due_ms(std::uint32_t section) const {
  const auto& entries = model_.entries[section];
  return std::max(network_.earliest_ms(entries.side[0]), network_.earliest_ms(entries.side[1]));
}

std::optional<std::uint32_t> Search::next_section() {
  while (!activity_.empty()) {
    const std::uint32_t section = activity_.pop();
    if (value_[section] == 0) return section;
  }
  while (!due_.empty()) {
    const Due top = due_.top();
    due_.pop();
    if (value_[top.section] != 0) continue;
    // Delays since it was put here make it due later than others.
    const std::int32_t now = due_ms(top.section);
    if (now <= top.at_ms) return top.section;
    due_.push({now, top.section});
  }
  return std::nullopt;
}

std::optional<Literal> Search::decide() {
  const auto section = next_section();
  if (!section) return std::nullopt;
  if (saved_[*section] != 0) return Literal::of(*section, saved_[*section] > 0 ? 0 : 1);
  return smaller_delay(*section);
}

Literal Search::smaller_delay(std::uint32_t section) const {
  std::int32_t delay[2] = {0, 0};
  for (const int side : {0, 1}) {
    for (const Constraint& c : model_.edges_of(Literal::of(section, side))) {
      const std::int32_t by = network_.earliest_ms(c.from) + c.least_ms - network_.earliest_ms(c.to);
      delay[side] = std::max(delay[side], by);
    }
  }
  if (delay[0] != delay[1]) return Literal::of(section, delay[0] < delay[1] ? 0 : 1);
  const auto& entries = model_.entries[section];
  const bool second_earlier = network_.earliest_ms(entries.side[1]) < network_.earliest_ms(entries.side[0]);
  return Literal::of(section, second_earlier ? 1 : 0);
}

}  // namespace stepwright::fleet::internal
