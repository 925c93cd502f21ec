#pragma once

// The names that a task declares, for files that refer to them (bindings).
//
// Thread rule: pure function.

#include "supervisor/model/vocabulary.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl {

model::Vocabulary vocabulary(const Task& task);

}  // namespace stepwright::pddl
