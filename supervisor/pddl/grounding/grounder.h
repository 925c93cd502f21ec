#pragma once

// From a checked definition to the numbered task of the search.
//
// Thread rule: pure function.

#include <functional>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "supervisor/pddl/ground_task/memory_room.h"

namespace stepwright::pddl {

// `stop` is asked now and then, `room_for` before the lists of operators grow; when one says so the result is
// marked cancelled. The definition must outlive the task.
GroundTask ground_task(const Definition& definition, const std::function<bool()>& stop,
                       const RoomFor& room_for = everything_fits);

}  // namespace stepwright::pddl
