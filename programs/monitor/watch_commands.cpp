#include <poll.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "programs/monitor/attach.h"
#include "programs/monitor/commands.h"
#include "programs/monitor/report.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::monitor {
namespace {

using process::fail;
using result::ExitCode;
using Variables = std::vector<reader::NamedVariable>;

Variables every_variable(const reader::ProgramInfo& info) {
  Variables variables;
  for (const reader::Tag& tag : info.tags()) variables.push_back({tag.name, tag.variable});
  return variables;
}

// Prints the values, those that are not as before with a star. `before` becomes what was printed.
void print(const host::Snapshot& snapshot, const Variables& variables, std::vector<std::string>& before) {
  std::printf("%s\n", moment(snapshot.scan, snapshot.time_ns).c_str());
  const bool first = before.size() != variables.size();
  before.resize(variables.size());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    std::string now = reader::read_printable(variables[i].variable, snapshot.image);
    const bool changed = !first && now != before[i];
    std::printf("  %s = %s%s\n", variables[i].name.c_str(), now.c_str(), changed ? " *" : "");
    before[i] = std::move(now);
  }
  std::fflush(stdout);
}

result::Result<Variables> resolve(Attached& runtime, const std::vector<trace::AskedName>& names) {
  if (names.empty()) return every_variable(runtime.program());
  return trace::resolve_names(runtime.program(), names);
}

// Until `count` samples are taken or a signal comes.
result::Result<nlohmann::json> sample_often(Attached& runtime, const std::vector<trace::AskedName>& names,
                                            const WatchArguments& arguments) {
  const process::StopSignal stop;
  nlohmann::json samples = nlohmann::json::array();
  std::vector<std::string> before;
  std::optional<Variables> variables;
  for (std::uint64_t i = 0; arguments.count == 0 || i < arguments.count; ++i) {
    if (i > 0) {
      pollfd entry{stop.descriptor(), POLLIN, 0};
      if (poll(&entry, 1, static_cast<int>(arguments.period_ms)) > 0) break;
    }
    auto snapshot = runtime.sample();
    if (!snapshot) return result::forward(snapshot);
    if (runtime.program_changed()) {
      std::printf("another program was loaded\n");
      variables.reset();
      before.clear();
    }
    if (!variables) {
      auto resolved = resolve(runtime, names);
      if (!resolved) return result::forward(resolved);
      variables = std::move(*resolved);
    }
    print(*snapshot, *variables, before);
    if (std::ferror(stdout) != 0) break;  // nobody reads any more
    if (!arguments.json_file.empty()) samples.push_back(sample_json(*snapshot, *variables));
  }
  return samples;
}

int look(const config::CellConfig& config, const WatchArguments& arguments, bool once) {
  auto names = all_names(arguments.names, arguments.list_file);
  if (!names) return fail(names.error(), ExitCode::BadInput);
  if (names->empty() && !once) {
    const auto none =
        result::fail("R0060", {}, "nothing to watch", "name variables, or a file of names with --list");
    return fail(none.value(), ExitCode::BadInput);
  }
  auto runtime = Attached::open(config, service::Role::Observer);
  if (!runtime) return fail(runtime.error(), ExitCode::BadInput);
  if (auto read = (*runtime)->read_program(); !read) return fail(read.error(), ExitCode::BadInput);
  auto samples = sample_often(**runtime, *names, arguments);
  if (!samples) return fail(samples.error(), ExitCode::BadInput);
  if (!once) return finish(arguments.json_file, {{"samples", std::move(*samples)}});
  if (arguments.json_file.empty()) return to_int(ExitCode::Done);
  nlohmann::json report = std::move((*samples)[0]);
  report["program_digest"] = (*runtime)->digest();
  return finish(arguments.json_file, report);
}

}  // namespace

int watch(const config::CellConfig& config, const WatchArguments& arguments) {
  return look(config, arguments, false);
}

int snapshot(const config::CellConfig& config, const WatchArguments& arguments) {
  WatchArguments once = arguments;
  once.count = 1;
  return look(config, once, true);
}

}  // namespace stepwright::monitor
