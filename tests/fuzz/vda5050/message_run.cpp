#include "tests/fuzz/vda5050/message_run.h"

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/write_message.h"

namespace stepwright::fuzz::vda5050 {

namespace {

using namespace fleet::vda5050;

// What the reader takes, the rules take as well, and what is written of it is the same again. Two fractions
// of a second behind the third digit are one.
template <typename Reader>
void judge(Run& done, Topic topic, std::string_view input, Reader read) {
  const auto wrong = check_message(topic, input, "input");
  const auto first = read(input, "input");
  const std::string name(to_string(topic));
  if (wrong.empty() != first.has_value()) {
    done.finding = name + ": the reader and the rules differ";
  } else if (!first) {
    if (wrong.size() > 20 || wrong.front().code.rfind("F09", 0) != 0 || wrong.front().message.empty()) {
      done.finding = name + ": a diagnostic is wrong";
    }
  } else {
    ++done.accepted;
    const std::string text = to_json(*first);
    const auto second = read(text, "written");
    if (!second) {
      done.finding = name + ": what was written is refused: " + to_string(second.error()) + "\n" + text;
    } else if (to_json(*second) != text) {
      done.finding = name + ": what was written is read as something else: " + text;
    }
  }
}

}  // namespace

Run run(std::string_view input) {
  Run done;
  judge(done, Topic::State, input, read_state);
  judge(done, Topic::Order, input, read_order);
  judge(done, Topic::InstantActions, input, read_instant_actions);
  judge(done, Topic::Connection, input, read_connection);
  for (const Topic topic : {Topic::Visualization, Topic::Factsheet}) {
    if (check_message(topic, input, "input").empty()) ++done.accepted;
  }
  return done;
}

}  // namespace stepwright::fuzz::vda5050
