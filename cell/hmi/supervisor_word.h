#pragma once

// Reading of a supervisor's newest published document (supervisor/doc/plan_document.md), for whether it is at
// work.
//
//   const std::string why = at_work(document, "9f..");   // empty: nobody is in the way
//
// Pure; any thread. Whatever the text is: what cannot be read is nobody's work.

#include <string>

namespace stepwright::hmi {

// `alive`: the supervisor is there now. One that is gone counts while its program is the one that runs
// (`running`, a digest): it comes back and goes on with its plan.
std::string at_work(const std::string& document, bool alive, const std::string& running);

}  // namespace stepwright::hmi
