#pragma once

// Check of a message against the rules of VDA 5050 2.1.0: those of its published schemas (members that must
// be there, types, enumerations, ranges, formats) and those that its text adds (sequenceIds alternate between
// nodes and edges, no base behind the horizon, edges join their nodes, ids differ, knot vectors fit). Where
// schema and text differ the text holds, as it says itself: an action may be PAUSED, orientationType has two
// values, headers are complete in every message.
//
// Pure functions; any thread. Any bytes may come: a message has 4 MiB and 32 levels at most.
//
//   for (const auto& wrong : check_message(Topic::State, payload, "uagv/v2/Stepwright/v1/state"))
//     log(to_string(wrong));   // uagv/.../state: F0902: /nodeStates/2: lacks 'released'
//
// Codes: F0901 no JSON, too large, too deep, or the same name twice; F0902 a member that
// is missing or of the wrong type; F0903 a value that is out of range, in no enumeration or wrongly written;
// F0904 members that contradict each other. Each message begins with the JSON pointer of what is wrong.

#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::fleet::vda5050 {

// The first twenty; empty if all is well. `source` is what diagnostics call the message.
result::Diagnostics check_message(Topic topic, std::string_view text, const std::string& source);

}  // namespace stepwright::fleet::vda5050
