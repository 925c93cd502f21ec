#pragma once

// One input through all readers of VDA 5050 messages: whatever becomes a value is written and read back as
// the same value.

#include <string>
#include <string_view>

namespace stepwright::fuzz::vda5050 {

struct Run {
  int accepted = 0;     // topics of which it is a message
  std::string finding;  // what is wrong with us; empty = nothing
};

Run run(std::string_view input);

}  // namespace stepwright::fuzz::vda5050
