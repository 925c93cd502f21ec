// What the page draws: the cell and what is driven.

#include <algorithm>
#include <utility>

#include "supervisor/tamp/mission/arms_mission.h"
#include "supervisor/tamp/pictures/draw_arms.h"

namespace stepwright::tamp::mission {
namespace {

run::Pictures pictures_of(const pictures::ArmsPictureInput& input) {
  pictures::ArmsPicture picture = pictures::arms_picture(input);
  for (const scene::Thing& each : input.cell->things) {
    const int kind = kind_of(each);
    const bool known = std::ranges::any_of(picture.kinds, [&](const auto& one) { return one.kind == kind; });
    if (kind > 0 && !known) picture.kinds.push_back({kind, each.kind});
  }
  picture.kinds.push_back({kObstacle, "obstacle"});
  run::Pictures all;
  all.own.push_back(page_picture(picture));
  return all;
}

}  // namespace

// The plan that is driven, else the cell as it is believed to be.
void ArmsMission::show_plan() {
  if (driven_)
    show(pictures_of({.cell = driven_->cell.get(),
                      .schedule = &driven_->schedule,
                      .start = &driven_->start,
                      .program = &driven_->program,
                      .digest = digest_}));
  else
    show_look(nullptr);
}

// `looking`: the program that looks; it tells where the joints are.
void ArmsMission::show_look(const program::ArmsProgram* looking) {
  if (driven_) return;
  scene::GeometricState state = initial_state(planning_.cell());
  for (std::size_t k = 0; k < believed_.size(); ++k) state.things[k].pose = believed_[k];
  show(pictures_of({.cell = &planning_.cell(), .start = &state, .program = looking}));
}

}  // namespace stepwright::tamp::mission
