#pragma once

// A message as JSON, with what is wrong with it. Pure; any thread.
//
//   const Document document = read_document(Topic::State, text, source);
//   if (document.wrong.empty()) use(document.root);   // keeps all rules

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::fleet::vda5050 {

struct Document {
  nlohmann::json root;
  result::Diagnostics wrong;
};

Document read_document(Topic topic, std::string_view text, const std::string& source);

}  // namespace stepwright::fleet::vda5050
