#pragma once

// Finds an order for every section such that all constraints hold, or proves that there is none: search that
// learns from conflicts, over difference constraints.
//
// An order that is assigned posts its constraints to the network; a cycle of the network names the orders
// that cannot be together; resolution up to the first unique implication point turns them into a clause
// (Marques Silva and Sakallah 1999; difference logic after Nieuwenhuis and Oliveras 2005). Sections that met
// no conflict are ordered in the order of time, each for the smaller delay, so that the first descent is a
// greedy dispatcher; those that did come first, the most active first. Where latest times are known, orders
// that they exclude are implied.
//
// Nothing of it depends on clocks or addresses but the limits. One thread.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "supervisor/fleet/network/network.h"
#include "supervisor/fleet/schedule/internal/activity_heap.h"
#include "supervisor/fleet/schedule/internal/clauses.h"
#include "supervisor/fleet/schedule/internal/search_model.h"

namespace stepwright::fleet::internal {

struct SearchLimits {
  std::optional<std::chrono::steady_clock::time_point> until;
  const std::atomic<bool>* cancel = nullptr;  // not owned
  std::uint64_t conflicts = 0;                // zero = no limit
};

// When the search does what costs more than it saves on easy problems; answers do not depend on it.
struct SearchTuning {
  // With fewer sections latest times are tracked at once, else from the first restart on.
  std::size_t few_sections = 2000;
  std::uint64_t conflicts_per_restart = 64;
  std::size_t clauses_kept = 2000;  // before half of them are forgotten
};

enum class Answer : std::uint8_t { Yes, No, OutOfTime, Cancelled };

struct SearchFigures {
  std::uint64_t decisions = 0;
  std::uint64_t conflicts = 0;
  std::uint64_t restarts = 0;
};

class Search {
 public:
  Search(const SearchModel& model, const SearchObjective& objective, const SearchLimits& limits,
         const SearchTuning& tuning = {});

  // Yes: `orders` holds one side for each section. Asked again after Yes it looks for orders with a smaller
  // objective; No then means that there are none.
  Answer next();

  const std::vector<std::uint8_t>& orders() const { return orders_; }
  std::int64_t objective_ms() const { return best_ms_; }
  // No orders give less.
  std::int64_t lower_bound_ms() const { return std::min(root_objective_ms_, best_ms_); }
  const SearchFigures& figures() const { return figures_; }

 private:
  // Why a section has its order: a decision, a clause, or literals of reasons_ that are all true.
  struct Reason {
    enum class Kind : std::uint8_t { Decision, Clause, Literals } kind = Kind::Decision;
    std::uint32_t first = 0;  // the clause, or where the literals begin
    std::uint32_t count = 0;
  };
  struct Level {
    std::size_t trail = 0;
    std::size_t reasons = 0;
    Network::Mark mark;
  };
  struct Due {
    std::int32_t at_ms;
    std::uint32_t section;
    bool operator<(const Due& other) const {
      return at_ms != other.at_ms ? at_ms > other.at_ms : section > other.section;
    }
  };

  // assignment
  int value(Literal l) const { return l.side() == 0 ? value_[l.section()] : -value_[l.section()]; }
  void assign(Literal l, Reason reason);
  void new_level();
  void back_to(std::size_t level);

  // propagation; false: conflict_ holds literals that cannot all be true
  bool propagate();
  bool propagate_clauses();
  bool post(Literal l);
  bool imply_by_times(const Network::Mark& since);
  bool imply_all();
  bool exclude_if_late(std::uint32_t edge);
  bool within_objective();
  std::int64_t objective_now() const;
  void literals_of(std::vector<std::uint32_t>& labels, std::vector<Literal>& literals);

  // conflicts
  bool learn();
  template <typename Visitor>
  void each_reason(std::uint32_t section, Visitor&& visit) const;
  std::vector<Literal> first_implication_point(std::size_t level);
  bool redundant(Literal l) const;
  bool restart();

  // decisions
  std::optional<Literal> decide();
  std::optional<std::uint32_t> next_section();
  Literal smaller_delay(std::uint32_t section) const;
  std::int32_t due_ms(std::uint32_t section) const;

  Answer search();
  bool prepare();
  void raise_lower_bound();
  bool watch_latest();
  std::optional<Answer> stopped();

  const SearchModel& model_;
  const SearchObjective& objective_;
  SearchLimits limits_;
  SearchTuning tuning_;
  Network network_;
  Clauses clauses_;
  ActivityHeap activity_;
  std::priority_queue<Due> due_;

  std::vector<std::int8_t> value_;  // by section: 1 side 0, -1 side 1, 0 open
  std::vector<std::uint32_t> level_of_;
  std::vector<Reason> reason_;
  std::vector<std::int8_t> saved_;  // the last value
  std::vector<Literal> reasons_;
  std::vector<Literal> trail_;
  std::size_t clause_head_ = 0;
  std::size_t theory_head_ = 0;
  std::vector<Level> levels_;

  // Edges of literals by the timepoints at their ends; only once latest times are tracked.
  std::vector<std::uint32_t> leaving_, leaving_begin_, arriving_, arriving_begin_;

  std::vector<Literal> conflict_;
  std::vector<char> seen_;
  std::vector<std::uint32_t> labels_;

  std::vector<std::uint8_t> orders_;
  std::int64_t best_ms_;
  std::int64_t root_objective_ms_ = 0;
  SearchFigures figures_;
  std::uint64_t conflicts_at_restart_ = 0;
  bool prepared_ = false;
  bool refuted_ = false;
  std::uint32_t steps_ = 0;
};

}  // namespace stepwright::fleet::internal
