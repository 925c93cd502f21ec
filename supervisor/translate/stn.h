#pragma once

// A simple temporal network (Dechter, Meiri, Pearl 1991, "Temporal constraint networks"): events, and bounds
// on the time between two of them. Event 0 happens at time 0; no event happens before it.
//
// A value; one thread changes it, any thread may read.
//
//   Stn stn(3);
//   stn.at_least(0, 1, 2.0);            // event 1 comes 2 s after event 0, or later
//   stn.at_most(1, 2, 5.0);
//   const auto times = stn.earliest();  // nothing if the bounds contradict each other

#include <cstddef>
#include <optional>
#include <vector>

namespace stepwright::translate {

class Stn {
 public:
  explicit Stn(std::size_t events) : events_(events) {}

  std::size_t size() const { return events_; }
  // `to` happens at least (at most) `seconds` after `from`.
  void at_least(std::size_t from, std::size_t to, double seconds) { bounds_.push_back({from, to, seconds}); }
  void at_most(std::size_t from, std::size_t to, double seconds) { bounds_.push_back({to, from, -seconds}); }
  // Takes back the newest bound.
  void pop() { bounds_.pop_back(); }

  // The earliest time of each event; all of them together meet every bound. Nothing if none do.
  std::optional<std::vector<double>> earliest() const;
  // The latest time of each event if `last` happens at `horizon_s` at the latest. Events that nothing holds
  // before `last` may happen at `horizon_s`. Nothing if no times meet every bound and the horizon.
  std::optional<std::vector<double>> latest(std::size_t last, double horizon_s) const;

 private:
  // time(to) - time(from) >= seconds
  struct Bound {
    std::size_t from;
    std::size_t to;
    double seconds;
  };

  std::size_t events_;
  std::vector<Bound> bounds_;
};

}  // namespace stepwright::translate
