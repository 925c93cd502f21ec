#pragma once

// The intervals of a sequence of actions: for each place that an object gets, where and at which angles it
// may be, and for each time that it is held, how the hand may be turned; narrowed by propagation until
// nothing changes. After F. Lagriffoul, L. Karlsson, A. Saffiotti, Constraints on Intervals for Reducing the
// Search Space of Geometric Configurations (2012), with three differences: equations are substituted (the
// tool is the object's place plus the grasp), angles are sets of arcs, and linear programs are asked only
// where several linear rows bind positions together. An answer "refuted" is a proof, with a certificate.
//
// Invariant: no solution of the constraints is outside of the intervals. Lengths are whole nanometres and
// angles 2^-32 of a turn, in which all that is done to them is exact; what comes from outside (reaches,
// turned regions) is rounded outward.
//
// Thread rule: one owner. The cell outlives the network and does not change.
//
//   Network network(cell);
//   for (const Action& action : sequence)
//     if (!network.push(action)) break;              // refuted: network.certificate() says why
//   network.pop();                                   // as before the last push

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/network/certificate.h"
#include "supervisor/tamp/intervals/network/constraint.h"
#include "supervisor/tamp/intervals/network/linear_program.h"
#include "supervisor/tamp/intervals/network/spot_filter.h"
#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

struct NetworkOptions {
  std::vector<bool> dropped = {};  // constraints that do not count, by number; beyond its end: they do
  // Of a discretised problem: angles are multiples of a turn by so many steps. 0: any angle. Powers of two.
  std::uint32_t hand_steps = 0;   // of hands, seen from the object
  std::uint32_t place_steps = 0;  // of placed objects whose final angle is not given
};

class Network {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  // What an object has after it was placed, or at first.
  struct Place {
    std::size_t object = 0;
    std::uint32_t spot = 0;
    std::int64_t rise_nm = 0;  // above the spot
    AngleId angle = 0;
  };
  struct Visit {
    ConstraintId constraint = 0;
    std::uint32_t place = 0;
    AngleId hand = 0;
    const ReachBounds* reach = nullptr;
    std::int64_t rise_nm = 0;  // of the tool above the spot
    std::int64_t radius_nm = 0;
  };
  // Of each action, in its order; kNone of a hand that moves away.
  struct Handling {
    std::uint32_t place = kNone;  // where it grasps or releases
    AngleId hand = kNone;
  };

  explicit Network(const WorkCell& cell, NetworkOptions options = {});

  // Requires an action that can follow on those before it (validate()). False: refuted, now or before; it is
  // to be popped like any other.
  bool push(const Action& action);
  void pop();

  std::span<const Action> actions() const { return actions_; }
  std::span<const Handling> handlings() const { return handlings_; }
  std::span<const Constraint> constraints() const { return constraints_; }
  std::span<const Place> places() const { return places_; }
  std::span<const Visit> visits() const { return visits_; }
  std::span<const LinearRow> rows() const { return rows_; }
  std::size_t spots() const { return spots_.size(); }
  std::size_t angles() const { return angles_.size(); }
  const WorkCell& cell() const { return *cell_; }

  bool refuted() const { return refuted_; }
  // Requires refuted(). Steps that the conflict does not need are left out.
  Certificate certificate() const;

  Span length(LengthId id) const { return lengths_[id]; }
  Box box(std::uint32_t spot) const {
    return {lengths_[3 * spot], lengths_[3 * spot + 1], lengths_[3 * spot + 2]};
  }
  const ArcSet& angle(AngleId id) const { return angles_[id]; }
  // Visits of a spot, the latest first.
  std::uint32_t last_visit(std::uint32_t spot) const { return spots_[spot]; }
  std::uint32_t visit_before(std::uint32_t visit) const { return before_[visit]; }

  // Choices: narrow some variables, propagate, look, take all back.
  std::size_t mark() const { return trail_.size(); }
  void choose(LengthId id, Span span);
  void choose_angle(AngleId id, const ArcSet& arcs);
  bool propagate();
  void undo(std::size_t mark);

  // A point of all linear rows within the intervals, if there are rows: x, y, z of each spot in nanometres.
  // Nothing if there is none.
  std::optional<std::vector<double>> point();

  std::size_t linear_questions() const { return linear_questions_; }
  std::size_t passes() const { return passes_; }  // spots that were filtered

 private:
  struct Saved {
    bool is_angle = false;
    std::uint32_t variable = 0;
    Span span{};
    ArcSet arcs{};
  };
  struct Held {
    std::size_t object = 0, grasp = 0;
    AngleId hand = 0;
  };
  struct Frame {
    std::size_t places, visits, rows, spots, angles, constraints, trail, changed_places, arm;
    std::optional<Held> held;
    bool refuted;
  };
  struct Watch {
    std::uint32_t spots[2] = {kNone, kNone};
    std::uint32_t steps = 0;  // of a discretised angle
  };

  bool counts(ConstraintId id) const { return id >= options_.dropped.size() || !options_.dropped[id]; }
  ConstraintId add(Constraint constraint);
  std::uint32_t add_spot();
  AngleId add_angle(std::uint32_t steps);
  std::uint32_t add_place(std::size_t object, std::uint32_t spot, std::int64_t rise_nm, std::uint32_t steps);
  std::uint32_t place_of(std::size_t object);
  void put_start(std::size_t object);
  void push_pick(const Action& action);
  void push_place(const Action& action);
  std::uint32_t put_on_region(const Action& action);
  std::uint32_t put_on_object(const Action& action);
  void add_beyond(const Action& action, std::uint32_t place);
  void add_visit(const Action& action, std::uint32_t place, const Held& held);

  void given(ConstraintId id, LengthId length, Span span);
  void given_angle(ConstraintId id, AngleId angle, const ArcSet& arcs);
  void narrow(StepKind kind, std::uint32_t subject, LengthId id, Span span);
  void narrow_angle(StepKind kind, std::uint32_t subject, AngleId id, const ArcSet& arcs,
                    std::uint32_t except);
  void wake(std::uint32_t spot);
  void filter_spot(std::uint32_t spot);
  void filter_rows();
  void filter_row(std::uint32_t row);
  void ask_rows();
  bool needs_program() const;
  void load_program();
  bool proves(std::span<const double> multipliers) const;

  const WorkCell* cell_;
  NetworkOptions options_;
  std::vector<Action> actions_;
  std::vector<Handling> handlings_;
  std::vector<Constraint> constraints_;
  std::vector<Place> places_;
  std::vector<Visit> visits_;
  std::vector<std::uint32_t> before_;  // of each visit: the one before it at its spot
  std::vector<std::uint32_t> spots_;   // of each spot: its last visit
  std::vector<LinearRow> rows_;
  std::vector<Span> lengths_;  // x, y, z of each spot
  std::vector<ArcSet> angles_;
  std::vector<Watch> watches_;                         // of each angle
  std::vector<std::optional<std::uint32_t>> current_;  // of each object: its place
  std::vector<std::pair<std::size_t, std::optional<std::uint32_t>>> changed_places_;
  std::vector<std::optional<Held>> held_;  // of each arm
  std::vector<Frame> frames_;

  std::vector<Saved> trail_;  // of each step: what was there before
  std::vector<Step> steps_;
  std::vector<double> multipliers_;  // of a refutation by rows
  std::vector<std::uint32_t> awake_;
  std::vector<bool> is_awake_;
  bool rows_awake_ = false;
  bool program_due_ = false;  // once the rows have narrowed what they can
  bool refuted_ = false;
  SpotFilter filter_;
  std::vector<std::uint32_t> filter_places_, filter_visits_;
  std::unique_ptr<LinearProgram> program_;  // of the rows as they are; none: to be made
  std::vector<LengthId> columns_;
  std::size_t linear_questions_ = 0, passes_ = 0;
};

}  // namespace stepwright::tamp
