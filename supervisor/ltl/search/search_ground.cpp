#include "supervisor/ltl/search/search_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "supervisor/geometry/box.h"

namespace stepwright::ltl {

namespace {

constexpr double kSwell_m = 0.05;               // of links, against what two looks do not see between them
constexpr std::size_t kMostStages = 2'000'000;  // of the guide: regions times states

TrainModel swollen(TrainModel model) {
  model.length_m += kSwell_m;
  model.width_m += kSwell_m;
  if (model.most_hitch_rad < std::numbers::pi) model.most_hitch_rad -= 1.2 * kSwell_m / model.hitch_m;
  return model;
}

// How far the last trailer may cut a corner, roughly; growing with what is pulled.
double wanted_m(const TrainModel& model) {
  return 0.5 * model.width_m + 0.3 +
         0.13 * static_cast<double>(model.trailers) * std::min(1.0, model.hitch_m);
}

}  // namespace

double least_turn_m(const TrainModel& model) {
  return 1.02 * model.wheelbase_m / std::tan(0.98 * model.most_lock_rad);
}

double tightest_m(const TrainModel& model) {
  const double pulled = model.hitch_m * (0.8 + 0.1 * static_cast<double>(model.trailers));
  return model.trailers == 0 ? least_turn_m(model) : std::max(least_turn_m(model), pulled);
}

SearchGround::SearchGround(const Floor& floor, const RegionMap& map, const Places& places,
                           const TrainModel& model, const Automaton* automaton, SearchGuide use)
    : floor_(floor),
      map_(map),
      places_(places),
      model_(model),
      wide_(swollen(model)),
      automaton_(automaton),
      use_(use),
      walls_(floor, wide_) {}

const Guide* SearchGround::guide() const {
  std::call_once(guided_, [this] {
    const bool is_asked = use_ == SearchGuide::OnTheRegions && automaton_ != nullptr;
    if (is_asked && map_.regions().size() * automaton_->size() <= kMostStages)
      guide_ = std::make_unique<Guide>(map_, *automaton_);
  });
  return guide_.get();
}

RouteGuide SearchGround::route_guide() const {
  if (use_ == SearchGuide::None) return {};
  if (const Guide* const known = guide()) return {.map = &map_, .guide = known};
  const geometry::Box box = geometry::bounds_of(map_.points());
  return {.place_m = distance(box.low, box.high)};
}

const RouteGraph* SearchGround::graph(Clearance clearance, const Stop& stop, std::size_t threads) const {
  Slot& slot = slots_[static_cast<std::size_t>(clearance)];
  const std::lock_guard lock(slot.making);
  if (slot.graph == nullptr) {
    const double half_m = 0.5 * model_.width_m;
    RouteOptions options{
        .margin_m = half_m + 0.1, .wanted_m = wanted_m(model_), .threads = threads, .stop = stop};
    if (clearance == Clearance::More) options.wanted_m *= 1.5;
    if (clearance == Clearance::Least) options.wanted_m = half_m + 0.3;
    auto made = std::make_unique<RouteGraph>(floor_, places_, walls_, options);
    if (stop.unwanted()) return nullptr;
    slot.graph = std::move(made);
  }
  return slot.graph.get();
}

}  // namespace stepwright::ltl
