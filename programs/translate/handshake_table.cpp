#include "programs/translate/handshake_table.h"

#include <nlohmann/json.hpp>

namespace stepwright::translate_command {
namespace {

constexpr int kFirstMemoryWord = 1024;  // holding register of %MW0 in the standard map

}  // namespace

std::string handshake_table(const translate::Translation& translation) {
  nlohmann::json actions = nlohmann::json::array();
  const auto& steps = translation.chart().steps;
  for (std::size_t i = 0; i < translation.steps.size(); ++i) {
    const translate::StepInfo& info = translation.steps[i];
    if (info.kind != translate::StepKind::Action) continue;
    nlohmann::json after = nlohmann::json::array();
    for (const model::Ordering& ordering : translation.orderings) {
      if (ordering.after == *info.action) after.push_back(ordering.before + 1);
    }
    actions.push_back({{"number", *info.action + 1},
                       {"action", steps[i].comment},
                       {"step", info.name},
                       {"after", std::move(after)}});
  }
  return nlohmann::json{{"registers", kFirstMemoryWord}, {"actions", std::move(actions)}}.dump(2) + "\n";
}

}  // namespace stepwright::translate_command
