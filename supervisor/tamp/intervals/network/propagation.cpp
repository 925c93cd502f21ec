#include <algorithm>
#include <cmath>

#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp {
namespace {

// Rows are followed while they narrow by this much; what is left is for the linear program.
constexpr std::int64_t kWorthwhile_nm = 1'000;
constexpr int kMostSweeps = 10;
// More than the rounding of a row's sum, in nanometres: its terms are below 1e11, computed to 64 bits.
constexpr long double kOff_nm = 1e-3L;
// Results beyond this say nothing about positions.
constexpr long double kFar_nm = 1e12L;

long double least_of(const LinearRow::Term& term, Span span) {
  return static_cast<long double>(term.factor) *
         static_cast<long double>(term.factor > 0.0 ? span.low_nm : span.high_nm);
}
long double most_of(const LinearRow::Term& term, Span span) {
  return static_cast<long double>(term.factor) *
         static_cast<long double>(term.factor > 0.0 ? span.high_nm : span.low_nm);
}

}  // namespace

void Network::given(ConstraintId id, LengthId length, Span span) {
  if (counts(id)) narrow(StepKind::Given, id, length, span);
}

void Network::given_angle(ConstraintId id, AngleId angle, const ArcSet& arcs) {
  if (counts(id)) narrow_angle(StepKind::Given, id, angle, arcs, kNone);
}

void Network::choose(LengthId id, Span span) {
  narrow(StepKind::Chosen, 0, id, span);
}

void Network::choose_angle(AngleId id, const ArcSet& arcs) {
  narrow_angle(StepKind::Chosen, 0, id, arcs, kNone);
}

void Network::narrow(StepKind kind, std::uint32_t subject, LengthId id, Span span) {
  const Span before = lengths_[id], after = intersection_of(before, span);
  if (refuted_ || after == before) return;
  trail_.push_back({false, id, before, {}});
  steps_.push_back({kind, subject, false, id, after, {}});
  lengths_[id] = after;
  if (after.empty()) {
    refuted_ = true;
    return;
  }
  if (kind != StepKind::Spot) wake(id / 3);
  rows_awake_ = rows_awake_ || (!rows_.empty() && id % 3 != 2);
}

void Network::narrow_angle(StepKind kind, std::uint32_t subject, AngleId id, const ArcSet& arcs,
                           std::uint32_t except) {
  if (refuted_) return;
  const ArcSet& before = angles_[id];
  ArcSet after = intersection_of(before.arcs(), arcs.arcs());
  if (watches_[id].steps != 0) after = at_steps(after, watches_[id].steps, 0);
  if (after == before) return;
  trail_.push_back({true, id, {}, before});
  steps_.push_back({kind, subject, true, id, {}, after});
  angles_[id] = after;
  if (after.empty()) {
    refuted_ = true;
    return;
  }
  for (const std::uint32_t spot : watches_[id].spots)
    if (spot != kNone && spot != except) wake(spot);
}

void Network::wake(std::uint32_t spot) {
  if (is_awake_[spot] || spots_[spot] == kNone) return;
  is_awake_[spot] = true;
  awake_.push_back(spot);
}

void Network::undo(std::size_t mark) {
  while (trail_.size() > mark) {
    const Saved& saved = trail_.back();
    if (saved.is_angle)
      angles_[saved.variable] = saved.arcs;
    else
      lengths_[saved.variable] = saved.span;
    trail_.pop_back();
    steps_.pop_back();
  }
  for (const std::uint32_t spot : awake_) is_awake_[spot] = false;
  awake_.clear();
  rows_awake_ = program_due_ = false;
  refuted_ = false;
  multipliers_.clear();
}

bool Network::propagate() {
  while (!refuted_) {
    if (!awake_.empty()) {
      // The latest first: what a new action says of its own place is what most often has no room.
      const std::uint32_t spot = awake_.back();
      awake_.pop_back();
      is_awake_[spot] = false;
      filter_spot(spot);
    } else if (rows_awake_) {
      filter_rows();
      program_due_ = true;
    } else if (program_due_) {
      program_due_ = false;
      if (needs_program()) ask_rows();
    } else {
      break;
    }
  }
  for (const std::uint32_t spot : awake_) is_awake_[spot] = false;
  awake_.clear();
  rows_awake_ = program_due_ = false;
  return !refuted_;
}

void Network::filter_spot(std::uint32_t spot) {
  ++passes_;
  filter_.begin(box(spot));
  filter_places_.clear();
  filter_visits_.clear();
  for (std::uint32_t v = spots_[spot]; v != kNone; v = before_[v]) {
    const Visit& visit = visits_[v];
    const auto known = std::ranges::find(filter_places_, visit.place);
    const auto object = static_cast<std::size_t>(known - filter_places_.begin());
    if (known == filter_places_.end()) {
      filter_places_.push_back(visit.place);
      filter_.add_object(angles_[places_[visit.place].angle]);
    }
    filter_visits_.push_back(v);
    filter_.add_visit({visit.reach, object, visit.rise_nm, visit.radius_nm}, angles_[visit.hand]);
  }
  if (!filter_.run()) return narrow(StepKind::Spot, spot, 3 * spot, {1, 0});
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    narrow(StepKind::Spot, spot, 3 * spot + axis, filter_.box()[axis]);
  for (std::size_t k = 0; k < filter_places_.size(); ++k)
    narrow_angle(StepKind::Spot, spot, places_[filter_places_[k]].angle, filter_.object(k), spot);
  for (std::size_t k = 0; k < filter_visits_.size(); ++k)
    narrow_angle(StepKind::Spot, spot, visits_[filter_visits_[k]].hand, filter_.hand(k), spot);
}

void Network::filter_rows() {
  for (int sweep = 0; sweep < kMostSweeps && !refuted_; ++sweep) {
    const std::size_t before = trail_.size();
    for (std::uint32_t row = 0; row < rows_.size() && !refuted_; ++row) filter_row(row);
    if (trail_.size() == before) break;
  }
  rows_awake_ = false;
}

void Network::filter_row(std::uint32_t index) {
  const LinearRow& row = rows_[index];
  long double least = 0.0L;
  for (const LinearRow::Term& term : row.terms) least += least_of(term, lengths_[term.length]);
  for (const LinearRow::Term& term : row.terms) {
    if (term.factor == 0.0) continue;
    const Span span = lengths_[term.length];
    const long double rest = static_cast<long double>(row.high_nm) - (least - least_of(term, span));
    const long double bound = rest / static_cast<long double>(term.factor);
    if (!(std::abs(bound) < kFar_nm)) continue;
    Span narrower = span;
    if (term.factor > 0.0)
      narrower.high_nm = std::min(span.high_nm, static_cast<std::int64_t>(std::floor(bound + kOff_nm)));
    else
      narrower.low_nm = std::max(span.low_nm, static_cast<std::int64_t>(std::ceil(bound - kOff_nm)));
    if (!narrower.empty() && span.width_nm() - narrower.width_nm() < kWorthwhile_nm) continue;
    narrow(StepKind::Row, index, term.length, narrower);
    if (refuted_) return;
    least += least_of(term, lengths_[term.length]) - least_of(term, span);
  }
}

// One row alone is as narrow as propagation makes it.
bool Network::needs_program() const {
  std::size_t open = 0;
  for (const LinearRow& row : rows_) {
    long double most = 0.0L;
    for (const LinearRow::Term& term : row.terms) most += most_of(term, lengths_[term.length]);
    if (most > static_cast<long double>(row.high_nm)) ++open;
  }
  return open >= 2;
}

void Network::load_program() {
  if (!program_) {
    columns_.clear();
    std::vector<ProgramRow> rows;
    for (const LinearRow& row : rows_) {
      ProgramRow& added = rows.emplace_back(ProgramRow{{}, row.high_nm * 1e-9});
      for (const LinearRow::Term& term : row.terms) {
        const auto known = std::ranges::find(columns_, term.length);
        added.terms.emplace_back(static_cast<std::size_t>(known - columns_.begin()), term.factor);
        if (known == columns_.end()) columns_.push_back(term.length);
      }
    }
    program_ = std::make_unique<LinearProgram>(columns_.size(), rows);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c)
    program_->bound(c, metres_of(lengths_[columns_[c]].low_nm), metres_of(lengths_[columns_[c]].high_nm));
}

void Network::ask_rows() {
  load_program();
  ++linear_questions_;
  const auto multipliers = program_->refute();
  if (!multipliers || !proves(*multipliers)) return;
  multipliers_ = *multipliers;
  refuted_ = true;
}

// The solver's word is not taken for it.
bool Network::proves(std::span<const double> multipliers) const {
  std::vector<long double> factors(lengths_.size(), 0.0L);
  long double high = 0.0L;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    high += static_cast<long double>(multipliers[r]) * static_cast<long double>(rows_[r].high_nm);
    for (const LinearRow::Term& term : rows_[r].terms)
      factors[term.length] +=
          static_cast<long double>(multipliers[r]) * static_cast<long double>(term.factor);
  }
  long double least = 0.0L;
  for (std::size_t k = 0; k < factors.size(); ++k)
    least +=
        factors[k] * static_cast<long double>(factors[k] > 0.0L ? lengths_[k].low_nm : lengths_[k].high_nm);
  return least > high + kOff_nm * 10.0L;
}

std::optional<std::vector<double>> Network::point() {
  std::vector<double> found(lengths_.size());
  for (std::size_t k = 0; k < lengths_.size(); ++k) found[k] = static_cast<double>(lengths_[k].middle_nm());
  if (rows_.empty()) return found;
  load_program();
  ++linear_questions_;
  if (program_->refute()) return std::nullopt;
  for (std::size_t c = 0; c < columns_.size(); ++c) found[columns_[c]] = program_->point()[c] * 1e9;
  return found;
}

Certificate Network::certificate() const {
  std::vector<bool> lengths(lengths_.size(), false), angles(angles_.size(), false);
  const auto need = [&](const Step& step) {
    if (step.kind == StepKind::Row)
      for (const LinearRow::Term& term : rows_[step.subject].terms) lengths[term.length] = true;
    if (step.kind != StepKind::Spot) return;
    for (std::uint32_t axis = 0; axis < 3; ++axis) lengths[3 * step.subject + axis] = true;
    for (std::uint32_t v = spots_[step.subject]; v != kNone; v = before_[v]) {
      angles[visits_[v].hand] = true;
      angles[places_[visits_[v].place].angle] = true;
    }
  };
  Certificate certificate{{}, multipliers_};
  if (multipliers_.empty() && !steps_.empty()) {
    const Step& last = steps_.back();
    (last.is_angle ? angles : lengths)[last.variable] = true;
  }
  for (std::size_t r = 0; r < multipliers_.size(); ++r)
    if (multipliers_[r] > 0.0)
      for (const LinearRow::Term& term : rows_[r].terms) lengths[term.length] = true;
  for (std::size_t k = steps_.size(); k-- > 0;) {
    const Step& step = steps_[k];
    if (!(step.is_angle ? angles : lengths)[step.variable]) continue;
    need(step);
    certificate.steps.push_back(step);
  }
  std::ranges::reverse(certificate.steps);
  return certificate;
}

}  // namespace stepwright::tamp
