#include "supervisor/ltl/mission/train_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "supervisor/geometry/convex_polygon.h"
#include "supervisor/geometry/union_outlines.h"
#include "supervisor/ltl/mission/task_picture.h"
#include "supervisor/ltl/planner/plan_way.h"

namespace stepwright::ltl {
namespace {

using geometry::ConvexPolygon;
using run::FloorPicture;

constexpr double kLookEvery_s = 0.05;
constexpr double kHull_m = 0.2;        // between two places of the train that are taken for one movement
constexpr double kPiece_m = 0.5;       // of what is swept, at least
constexpr double kMostPieces = 160.0;  // of a plan
constexpr double kOutline_m = 0.02;    // what is nearer to an outline is on it
constexpr double kWayPoint_m = 0.4;
constexpr std::size_t kMostEarlier = 400;  // outlines of earlier plans
constexpr std::size_t kMostRegions = 6'000;

run::PictureArea drawn_area(const Area& area) {
  return {area.name, area.ring};
}

std::vector<run::PictureArea> drawn_areas(const std::vector<Area>& areas) {
  std::vector<run::PictureArea> all;
  for (const Area& each : areas) all.push_back(drawn_area(each));
  return all;
}

ConvexPolygon link_at(const TrainModel& train, const LinkBox& box) {
  return geometry::footprint_at(
      {box.middle.x_m, box.middle.y_m, std::atan2(box.ahead.y_m, box.ahead.x_m)},
      {.front_m = 0.5 * train.length_m, .rear_m = 0.5 * train.length_m, .half_width_m = 0.5 * train.width_m});
}

// What the links cover from one place of the train to the next, which is near.
void add_movement(const TrainModel& train, const LinkBoxes& from, const LinkBoxes& to,
                  std::vector<ConvexPolygon>& hulls) {
  for (std::size_t k = 0; k < train.links(); ++k) {
    std::vector<geometry::Point> corners;
    for (const LinkBox& box : {from[k], to[k]}) {
      const ConvexPolygon link = link_at(train, box);
      corners.insert(corners.end(), link.corners().begin(), link.corners().end());
    }
    if (auto hull = ConvexPolygon::hull(corners)) hulls.push_back(*std::move(hull));
  }
}

std::vector<FloorPicture::Swept> swept_by(const TrainModel& train, const TrainPlan& plan) {
  const double piece_m = std::max(kPiece_m, plan.length_m / kMostPieces);
  const std::vector<WayState> way = way_of(train, plan, kLookEvery_s);
  std::vector<FloorPicture::Swept> all;
  std::vector<ConvexPolygon> hulls;
  LinkBoxes last = link_boxes(train, way.front().state);
  double arc_m = 0.0, last_m = 0.0, begun_m = 0.0;
  for (std::size_t k = 1; k < way.size(); ++k) {
    arc_m += std::hypot(way[k].state[kTrainX] - way[k - 1].state[kTrainX],
                        way[k].state[kTrainY] - way[k - 1].state[kTrainY]);
    const bool ends = k + 1 == way.size();
    if (arc_m - last_m < kHull_m && !ends) continue;
    const LinkBoxes here = link_boxes(train, way[k].state);
    add_movement(train, last, here, hulls);
    last = here;
    last_m = arc_m;
    if (arc_m - begun_m < piece_m && !ends) continue;
    all.push_back({begun_m, arc_m, geometry::union_outlines(hulls, kOutline_m)});
    hulls.clear();
    begun_m = arc_m;
  }
  return all;
}

std::vector<FloorPicture::WayPoint> drawn_way(const std::vector<vehicle::PathSample>& samples) {
  std::vector<FloorPicture::WayPoint> way;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool turns = k > 0 && samples[k].way != samples[k - 1].way;
    const bool ends = k + 1 == samples.size() || samples[k + 1].way != samples[k].way;
    if (!way.empty() && !turns && !ends && samples[k].arc_m - way.back().arc_m < kWayPoint_m) continue;
    way.push_back({samples[k].pose.position(), samples[k].arc_m, samples[k].way < 0.0});
  }
  return way;
}

// Where the way comes into places: for the first time, or where the task's monitor makes something of it.
std::vector<FloorPicture::Stop> stops_of(const PreparedTrain& plan, const std::vector<std::string>& places) {
  std::vector<FloorPicture::Stop> stops;
  const Automaton& monitor = plan.watch.automaton;
  std::uint32_t state = monitor.initial;
  Label before = 0, met = 0;
  for (const WayLabel& read : plan.way.labels) {
    const std::uint32_t next = monitor.next(state, read.label);
    FloorPicture::Stop stop{.places = {}, .arc_m = read.arc_m, .counts = next != state};
    const Label entered = read.label & ~before & (stop.counts ? ~Label{0} : ~met);
    for (std::size_t k = 0; k < places.size(); ++k)
      if ((entered >> k & 1) != 0) stop.places.push_back(places[k]);
    if (entered != 0) stops.push_back(std::move(stop));
    met |= read.label;
    before = read.label;
    state = next;
  }
  return stops;
}

// That of the regions: what can be read on this floor.
std::vector<Label> letters_of(const RegionMap& regions) {
  std::vector<Label> letters;
  for (const Region& region : regions.regions()) letters.push_back(region.label);
  std::ranges::sort(letters);
  letters.erase(std::ranges::unique(letters).begin(), letters.end());
  return letters;
}

}  // namespace

void TrainPictures::clear() {
  plan_ = {};
  visited_.clear();
  labels_.clear();
  begins_.reset();
}

void TrainPictures::cover(double arc_m) {
  plan_.covered_m = std::clamp(arc_m, plan_.covered_m, std::max(plan_.covered_m, plan_.length_m));
}

void TrainPictures::keep_what_was_driven() {
  for (FloorPicture::Swept& piece : plan_.swept) {
    if (piece.from_m >= plan_.covered_m) break;
    for (run::PictureRing& outline : piece.outlines) plan_.earlier.push_back(std::move(outline));
  }
  if (plan_.earlier.size() > kMostEarlier)
    plan_.earlier.erase(plan_.earlier.begin(),
                        plan_.earlier.end() - static_cast<std::ptrdiff_t>(kMostEarlier));
  for (const FloorPicture::Stop& stop : plan_.stops)
    if (stop.counts && stop.arc_m <= plan_.covered_m)
      visited_.insert(visited_.end(), stop.places.begin(), stop.places.end());
}

void TrainPictures::drive(const PreparedTrain& plan, std::string program) {
  keep_what_was_driven();
  if (task_ != plan.watch.text) visited_.clear();
  plan_.program = std::move(program);
  plan_.swept = swept_by(plan.train, plan.answer.plan);
  plan_.way = drawn_way(plan.way.samples);
  plan_.stops = stops_of(plan, planning_.options().problem.places());
  plan_.length_m = plan.way.end_m;
  plan_.covered_m = 0.0;
  task_ = plan.watch.text;
  labels_ = plan.way.labels;
  begins_ = plan.watch.automaton.initial;
}

run::FloorPicture TrainPictures::floor(const std::vector<Area>& blocked) const {
  const Problem& problem = planning_.options().problem;
  const Floor& hall = problem.floor;
  FloorPicture picture = plan_;
  picture.id = "floor";
  picture.border = hall.border.ring;
  picture.walls = drawn_areas(hall.obstacles);
  picture.blocked = drawn_areas(blocked);
  const std::vector<std::string> switches = place_names(problem.places());
  for (std::size_t k = 0; k < hall.propositions.size(); ++k) {
    const std::string& name = hall.propositions[k].name;
    picture.places.push_back({.area = drawn_area(hall.propositions[k]),
                              .at = switches[k],
                              .visited = std::ranges::find(visited_, name) != visited_.end()});
  }
  const RegionMap& regions = planning_.regions();
  if (regions.regions().size() <= kMostRegions) {
    picture.corners.assign(regions.points().begin(), regions.points().end());
    for (const Region& region : regions.regions()) picture.regions.push_back(region.corners);
  }
  picture.progress = "arc";
  picture.x = "vehicle_train.X";
  picture.y = "vehicle_train.Y";
  picture.heading = "vehicle_train.Heading";
  picture.coupled = "trailers";
  for (std::size_t k = 0; k < problem.train.links(); ++k)
    picture.links.push_back({.length_m = problem.train.length_m,
                             .width_m = problem.train.width_m,
                             .behind_m = k == 0 ? 0.0 : problem.train.spacing_m,
                             .hitch = k == 0 ? std::string() : "hitch_" + std::to_string(k),
                             .hitch_rad = std::numbers::pi / 18'000.0});
  return picture;
}

run::Pictures TrainPictures::draw(const TrainTask& task, const std::string& watched,
                                  const std::vector<Area>& blocked) const {
  run::Pictures pictures;
  pictures.floors.push_back(floor(blocked));
  TaskPictureInput input{.task = &task,
                         .places = planning_.options().problem.places(),
                         .letters = letters_of(planning_.regions())};
  if (task_ == task.text) {
    input.planned = labels_;
    input.begins = begins_;
  }
  pictures.automata.push_back(task_picture(input));
  if (watched == task.text) pictures.automata.back().variable = kTaskState;
  return pictures;
}

}  // namespace stepwright::ltl
