#include "programs/fleet/fleet_command.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "programs/fleet/fleet_text.h"
#include "programs/process/files.h"
#include "programs/process/interruption.h"
#include "supervisor/fleet/mission/fleet_svg.h"
#include "supervisor/fleet/mission/problem_reader.h"
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
  if (arguments.cache_folder) return *arguments.cache_folder;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return std::filesystem::path(cache) / "stepwright";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".cache" / "stepwright";
  }
  return {};
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
  options.on_progress = [&line](const FleetProgress& progress) { line.show(progress); };
  return options;
}

struct Work {
  FleetAnswer answer;
  std::optional<MissionProblem> problem;  // nothing: envelopes alone
};

result::Result<Work> plan(const FleetArguments& arguments, const std::string& text) {
  const process::Interruption interruption;
  ProgressLine line(arguments.progress);
  FleetOptions options = options_of(arguments, line);
  options.cancel = interruption.flag();
  if (is_scheduling_problem(text)) {
    auto problem = read_problem(text, arguments.problem);
    if (!problem) return result::forward(problem);
    return Work{schedule_fleet(*problem, options), std::nullopt};
  }
  auto problem = read_mission_problem(text, arguments.problem);
  if (!problem) return result::forward(problem);
  line.show({"preparing", 0, 0.0});
  auto floor = FleetFloor::create(problem->map, models_of(*problem),
                                  {.table_folder = cache_folder(arguments), .threads = arguments.threads});
  if (!floor) return result::forward(floor);
  for (const std::string& note : floor->notes()) std::fprintf(stderr, "note: %s\n", note.c_str());
  auto answer = plan_fleet(*problem, *floor, options);
  if (!answer) return result::forward(answer);
  return Work{*std::move(answer), *std::move(problem)};
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
  const auto unwritten = process::write_file(path, text);
  print(unwritten);
  return unwritten.empty();
}

bool writable(const std::string& path) {
  if (path.empty()) return true;
  const auto refused = process::check_writable(path);
  print(refused);
  return refused.empty();
}

ExitCode exit_code(Verdict verdict) {
  if (verdict == Verdict::Scheduled) return ExitCode::Done;
  return verdict == Verdict::Infeasible ? ExitCode::NoPlan : ExitCode::BudgetExhausted;
}

}  // namespace

ExitCode run_fleet(const FleetArguments& arguments) {
  const auto text = process::read_file(arguments.problem);
  if (!text) {
    print(text.error());
    return ExitCode::BadInput;
  }
  if (!writable(arguments.json_file) || !writable(arguments.svg_file)) return ExitCode::BadInput;
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
       write(arguments.svg_file, fleet_svg(answer.plan, problem != nullptr ? &problem->map : nullptr)));
  return written ? exit_code(answer.verdict) : ExitCode::BadInput;
}

}  // namespace stepwright::fleet
