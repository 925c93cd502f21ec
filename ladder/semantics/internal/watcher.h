#pragma once

// A program that watches others: it reads the variables of all program instances under the names that every
// viewer uses (INSTANCE.block.variable), also those that are internal to their POU, and writes its own only.
// At its beginning stand assignments whose values know none of its own names, so that these shadow nothing.
// It has one instance, of its own name, and runs behind the programs of the task whose instances it reads; of
// what reads none of them, the first task.
//
// Thread rule: one analysis, one thread.

#include "ladder/semantics/analysis/analysis.h"

namespace stepwright::semantics::internal {

// Analyses the body and adds instance and call. Requires that the configuration was read without errors.
// Reports E0604 where the program reads instances of several tasks: they may run at once.
void add_watcher(Analysis& analysis, Pou& pou);

}  // namespace stepwright::semantics::internal
