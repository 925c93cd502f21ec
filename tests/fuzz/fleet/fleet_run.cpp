#include "tests/fuzz/fleet/fleet_run.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>

#include "supervisor/fleet/mission/problem_reader.h"
#include "supervisor/fleet/schedule/problem_file.h"
#include "supervisor/fleet/schedule/schedule.h"
#include "supervisor/map/map_file.h"

namespace stepwright::fuzz::fleet {

namespace {

using namespace stepwright::fleet;

constexpr std::string_view kMapMark = "\n;;map\n";
constexpr std::string_view kImageMark = "\n;;image\n";
constexpr std::size_t kMostPolygons = 40;

struct Parts {
  std::string_view problem;
  std::string_view yaml;
  std::string_view image;
};

Parts split(std::string_view input) {
  Parts parts{input, {}, {}};
  const std::size_t map = input.find(kMapMark);
  if (map == std::string_view::npos) return parts;
  parts.problem = input.substr(0, map);
  parts.yaml = input.substr(map + kMapMark.size());
  const std::size_t image = parts.yaml.find(kImageMark);
  if (image == std::string_view::npos) return parts;
  parts.image = parts.yaml.substr(image + kImageMark.size());
  parts.yaml = parts.yaml.substr(0, image);
  return parts;
}

void write(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string check_diagnostics(const result::Diagnostics& diagnostics, std::string_view text) {
  if (diagnostics.empty()) return "refused without a diagnostic";
  const auto lines = static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const result::Diagnostic& d : diagnostics) {
    const bool code =
        d.code.size() == 5 && d.code[0] == 'F' &&
        std::all_of(d.code.begin() + 1, d.code.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!code || d.message.empty() || d.where.file.empty()) {
      return "a diagnostic without code, message or file: " + to_string(d);
    }
    if (d.where.file.ends_with(".json") && d.where.line > lines)
      return "a place beyond the file: " + to_string(d);
  }
  return {};
}

std::string schedule_small(const SchedulingProblem& problem) {
  std::size_t polygons = 0;
  for (const TrajectoryEnvelope& envelope : problem.envelopes) polygons += envelope.polygons.size();
  if (polygons > kMostPolygons) return {};
  const Schedule made =
      schedule(problem.envelopes, problem.constraints, {.time = std::chrono::milliseconds(200)});
  if (made.verdict == Verdict::Scheduled && made.earliest.size() != problem.envelopes.size()) {
    return "a schedule without times";
  }
  const auto again = read_problem(write_problem(problem), "again.json");
  return again ? std::string() : "what is written is not read: " + to_string(again.error());
}

// What the reader promises of indices.
std::string check_indices(const MissionProblem& problem) {
  const auto within = [](std::size_t index, const auto& list) { return index < list.size(); };
  for (const MissionVehicle& vehicle : problem.vehicles) {
    if (!within(vehicle.vehicle_class, problem.classes)) return "a vehicle without a model";
  }
  for (const MissionGoal& goal : problem.goals) {
    if (!within(goal.from, problem.locations) || !within(goal.to, problem.locations))
      return "a goal without places";
    if (goal.vehicle && !within(*goal.vehicle, problem.vehicles)) return "a goal without its vehicle";
  }
  for (const MissionTask& task : problem.tasks) {
    if (!within(task.vehicle, problem.vehicles) || !within(task.location, problem.locations)) {
      return "a task without vehicle or place";
    }
  }
  return {};
}

}  // namespace

Runner::Runner() {
  std::string name = (std::filesystem::temp_directory_path() / "fuzz_fleet_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) std::abort();
  folder_ = name;
}

Runner::~Runner() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Run Runner::run(std::string_view input) const {
  Run run;
  const Parts parts = split(input);
  write(folder_ / "map.yaml", parts.yaml);
  write(folder_ / "map.image", parts.image);
  run.mapped = read_map(folder_ / "map.yaml").has_value();
  if (is_scheduling_problem(parts.problem)) {
    const auto problem = read_problem(parts.problem, "p.json");
    run.read = problem.has_value();
    run.finding = problem ? schedule_small(*problem) : check_diagnostics(problem.error(), parts.problem);
    return run;
  }
  const auto problem = read_mission_problem(parts.problem, folder_ / "p.json");
  run.read = problem.has_value();
  run.finding = problem ? check_indices(*problem) : check_diagnostics(problem.error(), parts.problem);
  return run;
}

}  // namespace stepwright::fuzz::fleet
