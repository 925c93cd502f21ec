#pragma once

// Common ground of the searches for one problem, whatever they are asked: the floor and its walls, the guide,
// and graphs of ways that keep one of three clearances. Each part is made when it is first asked for.
//
// Any thread may ask, several at once: who comes while a part is being made waits for it. What it was made
// from must outlive it. Example:
//   const SearchGround ground(floor, map, places, model, task.automaton());
//   TrainSearch one(ground, states), other(ground, states_of_its_own);   // each in its own thread

#include <array>
#include <memory>
#include <mutex>

#include "supervisor/ltl/guide/guide.h"
#include "supervisor/ltl/route/route_graph.h"
#include "supervisor/ltl/route/route_search.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::ltl {

enum class SearchGuide : std::uint8_t { OnTheRegions, None };

// The first keeps most of what a train of that length wants to walls, and the last the least.
enum class Clearance : std::uint8_t { Wanted, More, Least };
inline constexpr std::size_t kClearances = 3;

class SearchGround {
 public:
  // Without an automaton (null: the task is planned step by step), or with SearchGuide::None, there is no
  // guide on the regions.
  SearchGround(const Floor& floor, const RegionMap& map, const Places& places, const TrainModel& model,
               const Automaton* automaton, SearchGuide use = SearchGuide::OnTheRegions);
  SearchGround(const SearchGround&) = delete;
  SearchGround& operator=(const SearchGround&) = delete;

  const RegionMap& map() const { return map_; }
  const Places& places() const { return places_; }
  const TrainModel& model() const { return model_; }
  // A little larger, for what happens between two looks.
  const TrainModel& wide() const { return wide_; }
  const Walls& walls() const { return walls_; }
  // Whether the task's states are those of one automaton, so that what one thread has made of them means the
  // same to another one. Those of a progression are numbered as they are met.
  bool has_automaton() const { return automaton_ != nullptr; }

  // Null where there is none.
  const Guide* guide() const;
  RouteGuide route_guide() const;
  // Null where `stop` has ended it before it was whole: somebody else may make it then. Where it is the time
  // that ended it, it is left as it is.
  const RouteGraph* graph(Clearance clearance, const Stop& stop, std::size_t threads = 1) const;

 private:
  struct Slot {
    std::mutex making;
    std::unique_ptr<RouteGraph> graph;
  };

  const Floor& floor_;
  const RegionMap& map_;
  const Places& places_;
  const TrainModel model_;
  const TrainModel wide_;
  const Automaton* automaton_;
  const SearchGuide use_;
  const Walls walls_;
  mutable std::once_flag guided_;
  mutable std::unique_ptr<Guide> guide_;
  mutable std::array<Slot, kClearances> slots_;
};

// The radius of the tightest turn that it plans.
double tightest_m(const TrainModel& model);
// And of the tightest that it can drive.
double least_turn_m(const TrainModel& model);

}  // namespace stepwright::ltl
