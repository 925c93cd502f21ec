#pragma once

// Configurations of a unit (IEC 61131-3, 6.8): what runs, with which memory. See configurer.h.

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

// Which function blocks a configuration gives to tasks; reports nothing.
void note_block_tasks(Analysis& analysis, const syntax::Unit& unit);

// Tasks and program instances, with their memory.
void configure(Analysis& analysis, TypeResolver& types, const syntax::Unit& unit, std::size_t user_pous);

}  // namespace stepwright::semantics::internal
