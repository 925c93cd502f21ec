#pragma once

// The actions of a plan that is commanded step by step, as JSON for whoever commands it:
//
//   {"registers": 1024,
//    "actions": [{"number": 1, "action": "(load v1 f1 level8)", "step": "S01_LOAD", "after": []}]}
//
// "registers": the holding register of HS_ENABLE in the standard map; "after": the actions that must be done
// before. Pure.

#include <string>

#include "supervisor/translate/translation.h"

namespace stepwright::translate_command {

std::string handshake_table(const translate::Translation& translation);

}  // namespace stepwright::translate_command
