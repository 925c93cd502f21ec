// `stepwright vda5050 TOPIC FILE...`: are these messages what VDA 5050 says?

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "programs/process/command_line.h"
#include "programs/process/files.h"
#include "supervisor/fleet/vda5050/check_message.h"

namespace {

using namespace stepwright;
using fleet::vda5050::Topic;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Check messages of VDA 5050 (version 2.1.0) by the rules of its schemas and its text",
               "stepwright vda5050"};
  std::string topic_name;
  std::vector<std::string> files;
  std::vector<std::string> topics;
  for (const Topic topic : fleet::vda5050::kTopics) topics.emplace_back(fleet::vda5050::to_string(topic));
  app.add_option("TOPIC", topic_name, "what the files are messages of")
      ->required()
      ->check(CLI::IsMember(topics));
  app.add_option("FILE", files, "a message as JSON; all are checked")->required();
  if (const auto exit = process::parse(app, argc, argv)) return *exit;

  result::Diagnostics wrong;
  for (const Topic topic : fleet::vda5050::kTopics) {
    if (topic_name != fleet::vda5050::to_string(topic)) continue;
    for (const std::string& file : files) {
      const auto text = process::read_file(file);
      const auto found = text ? fleet::vda5050::check_message(topic, *text, file) : text.error();
      wrong.insert(wrong.end(), found.begin(), found.end());
    }
  }
  return wrong.empty() ? result::to_int(result::ExitCode::Done)
                       : process::fail(wrong, result::ExitCode::BadInput);
}
