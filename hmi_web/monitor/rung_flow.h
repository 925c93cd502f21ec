#pragma once

// The power of a ladder diagram from the values of one scan, network after network as the engine runs them:
// what is TRUE lets power through. What the values do not tell is open: whether an edge was there, what a
// statement did in between.
//
//   std::vector<RungFlow> flows = flow_of(rungs, rungs.size(), values);
//
// Pure.

#include <string>
#include <vector>

#include "hmi_web/monitor/evaluator.h"
#include "hmi_web/monitor/sheet.h"

namespace stepwright::monitor {

struct NodeFlow {
  Value in;
  Value out;
  bool closed = false;  // a contact, as it is drawn
};

struct RungFlow {
  bool ran = false;             // false: a jump or a return went past it
  Value power;                  // behind the condition
  std::vector<NodeFlow> nodes;  // of the condition: each before its parts
  std::vector<bool> coils;      // drawn as energised
};

// Where values come from, and which names are variables: what nobody declares is a wire between networks.
struct SheetValues {
  const semantics::TypeTable& types;
  Lookup lookup;
  std::function<bool(const std::string&)> declares;
};

// Of the first `count` networks: what those behind them do does not matter to them.
std::vector<RungFlow> flow_of(const std::vector<const Rung*>& rungs, std::size_t count,
                              const SheetValues& values);

// What a coil makes of its variable; none where that depends on more than its power.
Value driven(const Coil& coil, const Value& power, const Evaluator& evaluator);

}  // namespace stepwright::monitor
