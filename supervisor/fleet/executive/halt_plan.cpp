#include "supervisor/fleet/executive/halt_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/fleet/executive/lead_in.h"

namespace stepwright::fleet {
namespace {

constexpr double kReaction_m = 0.3;  // before braking begins
constexpr double kDetour_m = 2.5;    // farther than needed, for a pose of the lattice

struct Piece {
  std::size_t first = 0;  // poses of the path
  std::size_t last = 0;
};

// From where the vehicle is to where it can stand.
Piece piece_of(const VehicleMission& mission, const VehicleReading& now, double permitted_m,
               const DriveData& drive, const GridFrame& frame) {
  const auto& path = mission.path;
  Piece piece;
  while (piece.first + 1 < path.size() && path[piece.first + 1].arc_m <= now.arc_m) ++piece.first;
  piece.last = piece.first;
  const bool rests = now.standing && permitted_m <= now.arc_m + kReaction_m;
  if (rests || now.error != 0) return piece;
  const double speed = std::abs(now.speed_m_s);
  const double needed_m =
      now.arc_m + (now.standing ? 0.0 : kReaction_m + speed * speed / (2.0 * drive.brake_m_s2));
  const auto may_stand = [&](std::size_t k) {
    return path[k].arc_m >= needed_m && path[k].arc_m <= permitted_m;
  };
  for (std::size_t k = piece.first; k < path.size() && path[k].arc_m <= needed_m + kDetour_m; ++k) {
    if (!may_stand(k) || !on_lattice(path[k].pose, frame)) continue;
    piece.last = k;
    return piece;
  }
  while (piece.last + 1 < path.size() && path[piece.last + 1].arc_m <= permitted_m && !may_stand(piece.last))
    ++piece.last;
  return piece;
}

// The old polygons, from the one that it is in to the last one that it may enter.
GrownEnvelope polygons_of(const VehicleMission& mission, std::size_t first, std::size_t last, Piece piece) {
  GrownEnvelope grown;
  grown.envelope.vehicle = mission.vehicle;
  const double begun_m = mission.path[piece.first].arc_m;
  const double end_m = mission.path[piece.last].arc_m;
  for (std::size_t k = first; k <= last; ++k) {
    const Visit& old = mission.grown.visits[k];
    if (k > first && old.entry_m > end_m) break;
    Visit visit = old;
    visit.first_pose = std::clamp(old.first_pose, piece.first, piece.last) - piece.first;
    visit.last_pose = std::clamp(old.last_pose, piece.first, piece.last) - piece.first;
    visit.entry_m = std::max(0.0, old.entry_m - begun_m);
    visit.exit_m = std::clamp(old.exit_m - begun_m, 0.0, end_m - begun_m);
    visit.service = {};
    grown.visits.push_back(visit);
    grown.envelope.polygons.push_back(mission.grown.envelope.polygons[k]);
  }
  return grown;
}

}  // namespace

HaltPlan halt_plan(const FleetPlan& plan, const FleetProgram& program, const FleetReading& reading,
                   const DriveData& drive, const GridFrame& frame) {
  HaltPlan halt;
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    const VehicleMission& old = plan.missions[v];
    const VehicleReading& now = reading.vehicles[v];
    const MissionStep& step = program.missions[v].steps[now.step];
    const std::size_t last = std::min(step.polygon, old.grown.visits.size() - 1);
    const std::size_t first = std::min<std::size_t>(now.areas, last);
    const Piece piece = piece_of(old, now, step.permitted_m, drive, frame);
    VehicleMission mission{.vehicle = old.vehicle,
                           .model = old.model,
                           .speed = old.speed,
                           .path = {},
                           .grown = polygons_of(old, first, last, piece),
                           .stops = {}};
    for (std::size_t k = piece.first; k <= piece.last; ++k) {
      mission.path.push_back(old.path[k]);
      mission.path.back().arc_m -= old.path[piece.first].arc_m;
    }
    if (mission.path.size() > 1) mission.path.front().travel = mission.path[1].travel;
    // Without a way its arc stays 0.
    halt.begun_m.push_back(piece.first == piece.last ? now.arc_m : old.path[piece.first].arc_m);
    halt.plan.missions.push_back(std::move(mission));
  }
  halt.plan.schedule = schedule(envelopes_of(halt.plan), {}, {.mode = Mode::Strict, .explain = false});
  return halt;
}

}  // namespace stepwright::fleet
