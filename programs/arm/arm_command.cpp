#include "programs/arm/arm_command.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/diagnostics_json.h"
#include "runtime/ground/process/interruption.h"
#include "supervisor/motion/drawing/arm_svg.h"
#include "supervisor/motion/problem/plan_arm.h"

namespace stepwright::arm_program {

namespace {

using nlohmann::json;
using result::ExitCode;

ExitCode fail(const result::Diagnostics& diagnostics) {
  (void)process::fail(diagnostics, ExitCode::BadInput);
  return ExitCode::BadInput;
}

ExitCode write(const std::string& file, const std::string& text) {
  if (file.empty()) return ExitCode::Done;
  const result::Diagnostics unwritten = files::write_file(file, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten);
}

motion::ArmFiles files_of(const ArmArguments& arguments) {
  motion::ArmFiles files{.urdf = arguments.urdf, .srdf = arguments.srdf, .instead = arguments.instead};
  for (const std::string& each : arguments.packages) {
    const auto equals = each.find('=');
    files.packages.emplace_back(each.substr(0, equals), each.substr(equals + 1));
  }
  files.cover.protrusion_m = arguments.protrusion_m;
  return files;
}

const char* name_of(motion::CertainPath::Means means) {
  switch (means) {
    case motion::CertainPath::Means::BySpheres:
      return "spheres";
    case motion::CertainPath::Means::WaysOut:
      return "spheres, bodies near the ends";
    case motion::CertainPath::Means::ByBodies:
      return "bodies where spheres say no";
  }
  return "";
}

void print(const motion::ArmModel& model, const motion::ArmProblem& problem, const ArmArguments& arguments,
           const motion::ArmAnswer& answer) {
  if (answer.path.empty()) {
    std::printf("%s: %s\n",
                answer.ending == motion::ArmAnswer::Ending::Impossible ? "cannot be done" : "no path",
                answer.cause.c_str());
    return;
  }
  std::printf(
      "path of %s: %zu way-points, length %.3f; planned in %.1f ms by %s (%s; %zu of %zu paths refused), "
      "seed %llu\n",
      problem.group.c_str(), answer.path.size(), answer.length, answer.planning_ms, arguments.planner.c_str(),
      name_of(answer.means), answer.refused, answer.rounds, static_cast<unsigned long long>(arguments.seed));
  std::printf("recheck: %zu motions are free as a whole, by the bodies themselves (%.1f ms)\n",
              answer.path.size() - 1, answer.recheck_ms);
  for (std::size_t k = 0; k < problem.coordinates.size(); ++k) {
    std::printf("  %-24s",
                model.robot.coordinates[static_cast<std::size_t>(problem.coordinates[k])].name.c_str());
    for (const motion::Configuration& each : answer.path) std::printf(" %8.4f", each[k]);
    std::printf("\n");
  }
}

json document_of(const motion::ArmModel& model, const motion::ArmProblem& problem,
                 const ArmArguments& arguments, const motion::ArmAnswer& answer,
                 const result::Diagnostics& notes) {
  json joints = json::array();
  for (const int each : problem.coordinates)
    joints.push_back(model.robot.coordinates[static_cast<std::size_t>(each)].name);
  json document = {{"found", !answer.path.empty()},
                   {"proved", answer.ending != motion::ArmAnswer::Ending::GivenUp},
                   {"robot", model.robot.name},
                   {"group", problem.group},
                   {"joints", std::move(joints)},
                   {"from", problem.from},
                   {"to", problem.to},
                   {"planner", arguments.planner},
                   {"seed", arguments.seed},
                   {"spheres", model.spheres.count()},
                   {"rounds", answer.rounds},
                   {"refused", answer.refused},
                   {"planning_ms", answer.planning_ms},
                   {"recheck_ms", answer.recheck_ms},
                   {"warnings", process::diagnostics_json(notes)}};
  if (answer.path.empty()) {
    document["cause"] = answer.cause;
    return document;
  }
  document["path"] = answer.path;
  document["length"] = answer.length;
  document["means"] = name_of(answer.means);
  document["recheck"] = {{"motions", answer.path.size() - 1}, {"free", true}};
  return document;
}

ExitCode exit_of(motion::ArmAnswer::Ending ending) {
  switch (ending) {
    case motion::ArmAnswer::Ending::Found:
      return ExitCode::Done;
    case motion::ArmAnswer::Ending::Impossible:
      return ExitCode::NoPlan;
    case motion::ArmAnswer::Ending::GivenUp:
      return ExitCode::BudgetExhausted;
  }
  return ExitCode::RuntimeFault;
}

}  // namespace

ExitCode run_arm(const ArmArguments& arguments) {
  for (const std::string& name : {arguments.json_file, arguments.svg_file}) {
    if (name.empty()) continue;
    if (const auto unwritable = files::check_writable(name); !unwritable.empty()) return fail(unwritable);
  }
  const auto model = motion::load_arm(files_of(arguments));
  if (!model) return fail(model.error());
  const auto problem = motion::load_problem(*model, arguments.scene, arguments.request);
  if (!problem) return fail(problem.error());
  const process::Interruption interruption;
  const auto answer = motion::plan_arm(*model, *problem,
                                       {.planner = arguments.planner,
                                        .seed = arguments.seed,
                                        .seconds = arguments.time_s,
                                        .cancel = interruption.flag()});
  if (!answer) return fail(answer.error());
  result::Diagnostics notes = model->notes;
  notes.insert(notes.end(), problem->notes.begin(), problem->notes.end());
  notes.insert(notes.end(), answer->notes.begin(), answer->notes.end());
  if (!notes.empty()) std::fprintf(stderr, "%s\n", result::to_string(notes).c_str());
  if (arguments.json_file != "-" && arguments.svg_file != "-") print(*model, *problem, arguments, *answer);
  const json document = document_of(*model, *problem, arguments, *answer, notes);
  const ExitCode written =
      write(arguments.json_file, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  if (written != ExitCode::Done) return written;
  if (!arguments.svg_file.empty()) {
    const ExitCode drawn = write(arguments.svg_file,
                                 motion::arm_svg({model->robot, problem->world, problem->coordinates,
                                                  problem->rest, answer->path, "Path of " + problem->group}));
    if (drawn != ExitCode::Done) return drawn;
  }
  return exit_of(answer->ending);
}

}  // namespace stepwright::arm_program
