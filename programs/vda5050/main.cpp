// `stepwright vda5050 check TOPIC FILE...`: are these messages what VDA 5050 says?
// `stepwright vda5050 publish --config CELL.toml --broker mqtt://HOST`: a running fleet on a broker.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "cell/config/cell_options.h"
#include "programs/vda5050/publish_command.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "supervisor/fleet/vda5050/check_message.h"

namespace {

using namespace stepwright;
using fleet::vda5050::Topic;

result::Diagnostics check_files(const std::string& topic_name, const std::vector<std::string>& files) {
  result::Diagnostics wrong;
  for (const Topic topic : fleet::vda5050::kTopics) {
    if (topic_name != fleet::vda5050::to_string(topic)) continue;
    for (const std::string& file : files) {
      const auto text = files::read_file(file);
      const auto found = text ? fleet::vda5050::check_message(topic, *text, file) : text.error();
      wrong.insert(wrong.end(), found.begin(), found.end());
    }
  }
  return wrong;
}

struct CheckArguments {
  std::string topic;
  std::vector<std::string> files;
};

CLI::App* add_check(CLI::App& app, CheckArguments& arguments) {
  CLI::App* const check = app.add_subcommand("check", "check messages by the rules of schemas and text");
  std::vector<std::string> topics;
  for (const Topic topic : fleet::vda5050::kTopics) topics.emplace_back(fleet::vda5050::to_string(topic));
  check->add_option("TOPIC", arguments.topic, "what the files are messages of")
      ->required()
      ->check(CLI::IsMember(topics));
  check->add_option("FILE", arguments.files, "a message as JSON; all are checked")->required();
  return check;
}

struct PublishLine {
  config::CellOptions cell;
  vda5050_link::PublishArguments publish;
  double state_s = 30.0;
  double visualization_s = 0.5;
};

CLI::App* add_publish(CLI::App& app, PublishLine& line) {
  CLI::App* const publish = app.add_subcommand("publish", "the fleet of a running cell on an MQTT broker");
  config::add_cell_options(*publish, line.cell);
  auto& broker = line.publish.broker;
  publish->add_option("--broker", broker.url, "mqtt://HOST[:PORT], or mqtts://HOST[:PORT] for TLS")
      ->required();
  publish->add_option("--credentials", broker.credentials_file, "TOML file with user and password");
  publish->add_option("--ca", broker.ca_file,
                      "PEM file of the authorities that are trusted (default: those of the system)");
  auto* const certificate =
      publish->add_option("--certificate", broker.certificate_file, "PEM file, of this client");
  publish->add_option("--key", broker.key_file, "PEM file, of the certificate")->needs(certificate);
  publish->add_option("--interface", line.publish.interface_name,
                      "first level of the topics (default: uagv)");
  publish->add_option("--manufacturer", line.publish.manufacturer, "default: Stepwright");
  publish->add_option("--map", line.publish.map_id, "mapId (default: the name of the cell's map)");
  const CLI::Validator seconds(process::refuse_seconds, "SECONDS");
  publish->add_option("--state-every", line.state_s, "a state so often at least (default: 30 s)")
      ->check(seconds);
  publish->add_option("--visualization-every", line.visualization_s, "while a vehicle moves (default: 0.5 s)")
      ->check(seconds);
  return publish;
}

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::min(seconds, 1e6) * 1e3));
}

int run_publish(PublishLine& line) {
  const auto config = config::load_cell(line.cell);
  if (!config) return config.error();
  // The standard asks for one every 30 s.
  line.publish.times.state_every = milliseconds(std::min(line.state_s, 30.0));
  line.publish.times.visualization = milliseconds(line.visualization_s);
  return result::to_int(vda5050_link::run_publish(*config, line.publish));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Messages of VDA 5050, version 2.1.0", "stepwright vda5050"};
  app.require_subcommand(1);
  CheckArguments arguments;
  PublishLine line;
  CLI::App* const check = add_check(app, arguments);
  add_publish(app, line);
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (!check->parsed()) return run_publish(line);
  const result::Diagnostics wrong = check_files(arguments.topic, arguments.files);
  return wrong.empty() ? result::to_int(result::ExitCode::Done)
                       : process::fail(wrong, result::ExitCode::BadInput);
}
