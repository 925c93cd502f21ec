// `stepwright vda5050 check TOPIC FILE...`: are these messages what VDA 5050 says?

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "programs/process/command_line.h"
#include "programs/process/files.h"
#include "supervisor/fleet/vda5050/check_message.h"

namespace {

using namespace stepwright;
using fleet::vda5050::Topic;

result::Diagnostics check_files(const std::string& topic_name, const std::vector<std::string>& files) {
  result::Diagnostics wrong;
  for (const Topic topic : fleet::vda5050::kTopics) {
    if (topic_name != fleet::vda5050::to_string(topic)) continue;
    for (const std::string& file : files) {
      const auto text = process::read_file(file);
      const auto found = text ? fleet::vda5050::check_message(topic, *text, file) : text.error();
      wrong.insert(wrong.end(), found.begin(), found.end());
    }
  }
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Messages of VDA 5050, version 2.1.0", "stepwright vda5050"};
  app.require_subcommand(1);
  CLI::App* const check = app.add_subcommand("check", "check messages by the rules of schemas and text");
  std::string topic_name;
  std::vector<std::string> files, topics;
  for (const Topic topic : fleet::vda5050::kTopics) topics.emplace_back(fleet::vda5050::to_string(topic));
  check->add_option("TOPIC", topic_name, "what the files are messages of")
      ->required()
      ->check(CLI::IsMember(topics));
  check->add_option("FILE", files, "a message as JSON; all are checked")->required();
  if (const auto exit = process::parse(app, argc, argv)) return *exit;

  const result::Diagnostics wrong = check_files(topic_name, files);
  return wrong.empty() ? result::to_int(result::ExitCode::Done)
                       : process::fail(wrong, result::ExitCode::BadInput);
}
