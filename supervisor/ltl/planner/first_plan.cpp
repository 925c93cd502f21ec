#include "supervisor/ltl/planner/first_plan.h"

#include <array>
#include <utility>

#include "supervisor/ltl/lanes/lanes.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kSliceRounds = 4;
constexpr std::uint64_t kOddSeeds = 0x5851'F42D'4C95'7F2Du;  // of the second line

class Line {
 public:
  enum class State : std::uint8_t { Going, Found, Over };

  Line(std::size_t number, const FirstPlanMeans& means, const FirstPlanOptions& options,
       const Deadline& deadline)
      : means_(means), options_(options), deadline_(deadline) {
    found_.line = number;
  }

  // Some rounds of a search, and the plan checker where it has found something.
  State slice() {
    if (search_ == nullptr) search_ = means_.search();
    if (!asked_) search_->ask(query());
    asked_ = true;
    const bool is_very_first = !std::exchange(has_begun_, true) && found_.line == 0;
    if (!search_->go_on(is_very_first ? 1 : kSliceRounds)) return State::Going;
    asked_ = false;
    found_.search = search_->answer();
    ++found_.tries;
    if (!found_.search.plan) return State::Over;
    found_.judgement = means_.judge(*found_.search.plan, enough_);
    if (found_.judgement.accepted()) return State::Found;
    return found_.tries < options_.most_tries ? State::Going : State::Over;
  }

  FirstPlan& found() { return found_; }
  std::atomic<bool>& enough() { return enough_; }

 private:
  SearchQuery query() const {
    const bool is_first = found_.line == 0;
    return {.start = options_.start,
            .seed = options_.seed + 0x9E37'79B9u * found_.tries + (is_first ? 0 : kOddSeeds),
            .most_s = deadline_.left_s(),
            .most_rounds = options_.most_rounds,
            .by_chance = !is_first || found_.tries > 0,
            .cancel = options_.cancel,
            .enough = &enough_};
  }

  const FirstPlanMeans& means_;
  const FirstPlanOptions& options_;
  const Deadline& deadline_;
  std::unique_ptr<TrainSearch> search_;
  bool asked_ = false;
  bool has_begun_ = false;
  std::atomic<bool> enough_{false};
  FirstPlan found_;
};

// Slices of both lines in one order: (slice, line).
class Order {
 public:
  static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

  // Whether a slice may begin: no plan comes before it.
  bool begin(std::size_t line, std::uint64_t slice) {
    at_[line].store(kLanes * slice + line);
    return kLanes * slice + line < best_.load();
  }
  // A plan of the slice that the line is in; whether the other line's present slice is of no use now.
  bool found(std::size_t line) {
    const std::uint64_t mine = at_[line].load();
    std::uint64_t known = best_.load();
    while (mine < known && !best_.compare_exchange_weak(known, mine)) {
    }
    const std::uint64_t other = at_[1 - line].load();
    return other != kNone && other > mine;
  }
  std::uint64_t best() const { return best_.load(); }
  // The first line knows that there is no plan for anybody.
  void close() { best_.store(0); }

 private:
  std::array<std::atomic<std::uint64_t>, kLanes> at_{kNone, kNone};
  std::atomic<std::uint64_t> best_{kNone};
};

bool is_final(const FirstPlan& ended) {
  return ended.search.end == SearchEnd::BadStart || ended.search.end == SearchEnd::NoWay ||
         ended.search.end == SearchEnd::Cancelled;
}

class Race {
 public:
  Race(const FirstPlanMeans& means, const FirstPlanOptions& options, const Deadline& deadline)
      : threads_(options.threads),
        lines_{Line(0, means, options, deadline), Line(1, means, options, deadline)} {}

  FirstPlan run() {
    // Most often the cheapest route is the plan: the second line begins where it is not.
    const bool goes_on = one(0, 0);
    if (threads_ > 1 && order_.best() == Order::kNone)
      on_lanes(threads_, [this, goes_on](std::size_t line) {
        if (line == 0 && !goes_on) return;
        for (std::uint64_t slice = line == 0 ? 1 : 0; one(line, slice); ++slice) {
        }
      });
    else if (order_.best() == Order::kNone)
      take_turns(goes_on);
    const std::uint64_t best = order_.best();
    const bool is_found = best != Order::kNone && lines_[best % kLanes].found().found();
    if (is_found) return std::move(lines_[best % kLanes].found());
    FirstPlan none = std::move(lines_[0].found());
    if (none.judgement.reason.empty()) none.judgement = lines_[1].found().judgement;
    return none;
  }

 private:
  // Whether the line goes on.
  bool one(std::size_t line, std::uint64_t slice) {
    if (!order_.begin(line, slice)) return false;
    switch (lines_[line].slice()) {
      case Line::State::Going:
        return true;
      case Line::State::Found:
        if (order_.found(line)) lines_[1 - line].enough().store(true);
        return false;
      case Line::State::Over:
        break;
    }
    if (line == 0 && is_final(lines_[0].found())) {
      order_.close();
      lines_[1].enough().store(true);
    }
    return false;
  }

  void take_turns(bool first_goes_on) {
    std::array<bool, kLanes> goes_on{first_goes_on, true};
    for (std::uint64_t slice = 0; goes_on[0] || goes_on[1]; ++slice)
      for (std::size_t line = slice == 0 ? 1 : 0; line < kLanes; ++line)
        if (goes_on[line]) goes_on[line] = one(line, slice);
  }

  const std::size_t threads_;
  Order order_;
  std::array<Line, kLanes> lines_;
};

}  // namespace

FirstPlan first_plan(const FirstPlanMeans& means, const FirstPlanOptions& options, const Deadline& deadline) {
  return Race(means, options, deadline).run();
}

}  // namespace stepwright::ltl
