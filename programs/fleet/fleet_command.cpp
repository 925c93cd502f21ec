#include "programs/fleet/fleet_command.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "cell/fleet/cell_fleet.h"
#include "programs/fleet/fleet_text.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/interruption.h"
#include "supervisor/fleet/mission/fleet_svg.h"
#include "supervisor/fleet/mission/problem_reader.h"
#include "supervisor/fleet/prepare/prepare_fleet.h"
#include "supervisor/fleet/report/fleet_json.h"
#include "supervisor/fleet/schedule/retiming.h"

namespace stepwright::fleet {

namespace {

using result::ExitCode;
using std::chrono::milliseconds;

void print(const result::Diagnostics& diagnostics) {
  if (!diagnostics.empty()) std::fprintf(stderr, "%s\n", to_string(diagnostics).c_str());
}

// What the chain is at, on stderr: one line that is written over on a terminal, a line each elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(bool asked) : terminal_(isatty(STDERR_FILENO) != 0), shown_(terminal_ || asked) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() {
    if (written_ && terminal_) std::fputs("\r\x1b[K", stderr);
  }

  void show(const FleetProgress& progress) {
    if (!shown_) return;
    std::string text(progress.stage);
    if (progress.done > 0) text += " " + std::to_string(progress.done);
    std::fprintf(stderr, terminal_ ? "\r\x1b[K%.1f s: %s" : "%.1f s: %s\n", progress.wall_ms / 1000.0,
                 text.c_str());
    std::fflush(stderr);
    written_ = true;
  }

 private:
  bool terminal_;
  bool shown_;
  bool written_ = false;
};

std::filesystem::path cache_folder(const FleetArguments& arguments) {
  return arguments.cache_folder ? std::filesystem::path(*arguments.cache_folder)
                                : config::fleet_table_folder();
}

FleetOptions options_of(const FleetArguments& arguments, ProgressLine& line) {
  const auto whole_ms = [](double seconds) {
    return milliseconds(std::llround(std::ceil(1000.0 * seconds)));
  };
  FleetOptions options;
  options.mode = arguments.paper ? Mode::EarliestTimes : Mode::Strict;
  options.objective = arguments.objective;
  options.time = whole_ms(arguments.time_s);
  if (arguments.path_time_s) options.path_time = whole_ms(*arguments.path_time_s);
  options.path_factor = arguments.path_factor;
  options.alternatives = arguments.alternatives;
  options.give_way = arguments.give_way;
  options.on_progress = [&line](const FleetProgress& progress) { line.show(progress); };
  return options;
}

struct Work {
  FleetAnswer answer;
  std::optional<MissionProblem> problem;  // nothing: envelopes alone
  std::optional<FleetProgram> program = {};
  std::vector<std::byte> container = {};
};

// What the program of the plan needs to know of the cell that runs it.
result::Result<PrepareOptions> prepare_options(const FleetArguments& arguments, const FleetOptions& planning,
                                               std::size_t vehicles) {
  PrepareOptions options{.planning = planning, .program = {}, .terminals = {}, .reserve = {}};
  if (arguments.config.empty()) {
    options.terminals = terminals_in_a_row(vehicles);
    return options;
  }
  auto cell = config::load_cell_config(arguments.config, arguments.overrides);
  if (!cell) return result::forward(cell);
  auto terminals = config::fleet_terminals(*cell, vehicles);
  if (!terminals) return result::forward(terminals);
  options.terminals = *std::move(terminals);
  options.program = config::fleet_program_options(*cell);
  return options;
}

// The plan that a program drives, and the program.
result::Result<Work> prepare(const FleetArguments& arguments, const FleetOptions& planning,
                             MissionProblem problem) {
  auto options = prepare_options(arguments, planning, problem.vehicles.size());
  if (!options) return result::forward(options);
  auto floor = FleetFloor::create(problem.map, models_of(with_reserve(problem, options->reserve)),
                                  {.table_folder = cache_folder(arguments), .threads = arguments.threads});
  if (!floor) return result::forward(floor);
  auto prepared = prepare_fleet(problem, *floor, *options);
  if (!prepared) return result::forward(prepared);
  if (prepared->program) print(prepared->program->warnings);
  return Work{std::move(prepared->answer), std::move(problem), std::move(prepared->program),
              std::move(prepared->container)};
}

result::Result<Work> plan(const FleetArguments& arguments, const std::string& text) {
  const process::Interruption interruption;
  ProgressLine line(arguments.progress);
  FleetOptions options = options_of(arguments, line);
  options.cancel = interruption.flag();
  if (is_scheduling_problem(text)) {
    if (!arguments.program_file.empty()) {
      return result::fail("F1101", {arguments.problem, 0, 0}, "envelopes alone make no program",
                          "a program drives along paths: give a problem with a map");
    }
    auto problem = read_problem(text, arguments.problem);
    if (!problem) return result::forward(problem);
    return Work{.answer = schedule_fleet(*problem, options), .problem = std::nullopt};
  }
  auto problem = read_mission_problem(text, arguments.problem);
  if (!problem) return result::forward(problem);
  line.show({"preparing", 0, 0.0});
  if (!arguments.program_file.empty()) return prepare(arguments, options, *std::move(problem));
  auto floor = FleetFloor::create(
      problem->map, models_of(*problem),
      {.table_folder = cache_folder(arguments), .threads = arguments.threads, .cancel = options.cancel});
  if (!floor) return result::forward(floor);
  for (const std::string& note : floor->notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  auto answer = plan_fleet(*problem, *floor, options);
  if (!answer) return result::forward(answer);
  return Work{.answer = *std::move(answer), .problem = *std::move(problem)};
}

// How long it takes to give all vehicles new times after one is 5 s late in the middle of its way.
double measure_retiming(const FleetPlan& plan) {
  const auto envelopes = envelopes_of(plan);
  Retiming retiming(envelopes, plan.constraints, plan.schedule);
  std::uint32_t longest = 0;
  for (std::uint32_t v = 0; v < envelopes.size(); ++v) {
    if (envelopes[v].polygons.size() > envelopes[longest].polygons.size()) longest = v;
  }
  const TimepointRef late{{longest, static_cast<std::uint32_t>(envelopes[longest].polygons.size() / 2)},
                          Side::Exit};
  const auto begin = std::chrono::steady_clock::now();
  // That it may break a deadline is an answer as well.
  static_cast<void>(retiming.not_before(late, retiming.earliest(late) + std::chrono::seconds(5)));
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

bool write(const std::string& path, const std::string& text) {
  if (path.empty()) return true;
  const auto unwritten = files::write_file(path, text);
  print(unwritten);
  return unwritten.empty();
}

bool writable(const std::string& path) {
  if (path.empty()) return true;
  const auto refused = files::check_writable(path);
  print(refused);
  return refused.empty();
}

// A proof for some paths only is none that there is no plan: the alternatives that may be tried have ended.
ExitCode exit_code(const FleetAnswer& answer) {
  if (answer.verdict == Verdict::Scheduled) return ExitCode::Done;
  return answer.proof == Proof::AllPaths ? ExitCode::NoPlan : ExitCode::BudgetExhausted;
}

}  // namespace

ExitCode run_fleet(const FleetArguments& arguments) {
  const auto text = files::read_file(arguments.problem);
  if (!text) {
    print(text.error());
    return ExitCode::BadInput;
  }
  if (!writable(arguments.json_file) || !writable(arguments.svg_file) || !writable(arguments.program_file))
    return ExitCode::BadInput;
  const auto work = plan(arguments, *text);
  if (!work) {
    print(work.error());
    return ExitCode::BadInput;
  }
  const FleetAnswer& answer = work->answer;
  const MissionProblem* problem = work->problem ? &*work->problem : nullptr;
  std::optional<double> retime_ms;
  if (answer.verdict == Verdict::Scheduled && !answer.plan.missions.empty())
    retime_ms = measure_retiming(answer.plan);
  std::fputs(fleet_text(answer, arguments.problem).c_str(),
             answer.verdict == Verdict::Scheduled ? stdout : stderr);
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!flushed) std::fprintf(stderr, "standard output cannot be written\n");
  const bool written =
      flushed &&
      (arguments.json_file.empty() || write(arguments.json_file, fleet_json(answer, problem, retime_ms))) &&
      (arguments.svg_file.empty() ||
       write(arguments.svg_file, fleet_svg(answer.plan, problem != nullptr ? &problem->map : nullptr))) &&
      (!work->program || write(arguments.program_file, {reinterpret_cast<const char*>(work->container.data()),
                                                        work->container.size()}));
  return written ? exit_code(answer) : ExitCode::BadInput;
}

}  // namespace stepwright::fleet
