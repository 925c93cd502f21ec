#include "tests/support/tamp_cells/paper_cells.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "supervisor/htn/task/read_task.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/planner/skeleton_planner.h"
#include "supervisor/tamp/predicates/grounding.h"
#include "supervisor/tamp/scene/cell_file.h"

namespace stepwright::tamp::test {

namespace {

lisp::Source source_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {file.string(), {std::istreambuf_iterator<char>(in), {}}};
}

}  // namespace

namespace {

std::optional<scene::CellFile> read_cell(const std::string& name) {
  auto file = scene::load_cell(std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/robot_cell" /
                               ("tamp_" + name + ".toml"));
  if (!file) {
    std::fprintf(stderr, "%s\n", result::to_string(file.error()).c_str());
    return std::nullopt;
  }
  return *std::move(file);
}

std::optional<PaperProblem> read_problem(const std::string& name) {
  auto file = read_cell(name);
  if (!file) return std::nullopt;
  PaperProblem problem;
  problem.domain = source_of(file->domain);
  problem.problem = source_of(file->problem);
  auto task = htn::read_task(problem.domain, problem.problem, predicates::geometric_predicates());
  if (!task) {
    std::fprintf(stderr, "%s\n", result::to_string(task.error()).c_str());
    return std::nullopt;
  }
  problem.task = std::move(task->task);
  problem.cell = std::move(file->cell);
  return problem;
}

}  // namespace

std::optional<PaperProblem> paper_problem(const std::string& name) {
  // Spheres take their time: a file is read once.
  static std::map<std::string, std::optional<PaperProblem>> known;
  const auto found = known.find(name);
  return found != known.end() ? found->second : known.emplace(name, read_problem(name)).first->second;
}

std::optional<SkeletonProblem> skeleton_problem(const std::string& name) {
  auto file = read_cell(name);
  if (!file) return std::nullopt;
  auto task = planner::read_skeletons(source_of(file->domain), source_of(file->problem));
  if (!task) {
    std::fprintf(stderr, "%s\n", result::to_string(task.error()).c_str());
    return std::nullopt;
  }
  return SkeletonProblem{std::move(file->cell), *std::move(task)};
}

void move_things(scene::RobotCell& cell, std::uint64_t seed, double most_m) {
  if (seed == 0) return;
  motion::Random random(seed);
  for (scene::Thing& each : cell.things) {
    each.start.x_m += random.between(-most_m, most_m);
    each.start.y_m += random.between(-most_m, most_m);
  }
}

void set_slack(scene::RobotCell& cell, double slack_m) {
  const int tray = cell.surface("tray");
  if (tray < 0 || cell.things.empty()) return;
  scene::Surface& surface = cell.surfaces[static_cast<std::size_t>(tray)];
  const double across_m = 2.0 * cell.things.front().form.radius_m;
  for (double* size : {&surface.size_x_m, &surface.size_y_m})
    *size = std::floor(*size / across_m) * across_m + slack_m;
  for (scene::Furniture& each : cell.furniture)
    if (each.name == "plate") {
      each.form.size_x_m = surface.size_x_m;
      each.form.size_y_m = surface.size_y_m;
    }
}

}  // namespace stepwright::tamp::test
