#include "programs/reach/reach_command.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "supervisor/tamp/intervals/cause/cause.h"
#include "supervisor/tamp/intervals/cause/reached.h"
#include "supervisor/tamp/intervals/cause/witness.h"
#include "supervisor/tamp/intervals/drawing/cell_svg.h"
#include "supervisor/tamp/intervals/file/sequence_file.h"
#include "supervisor/tamp/intervals/network/network.h"
#include "supervisor/tamp/intervals/program/reach_rings.h"

namespace stepwright::reach_program {

namespace {

using nlohmann::json;
using result::ExitCode;

constexpr std::size_t kMostQuestions = 20'000;  // to arms, for poses that they reach

double degrees(double rad) {
  return rad * 180.0 / std::numbers::pi;
}

struct Answered {
  tamp::Solution solution;
  std::optional<tamp::Cause> cause;
};

// [from, to] of each arc in degrees, anticlockwise: `to` is the larger one.
json arcs_json(const tamp::ArcSet& set) {
  json arcs = json::array();
  if (set.is_full()) return json::array({{-180.0, 180.0}});
  for (const tamp::Arc arc : set.arcs()) {
    const double low = degrees(tamp::radians_of(arc.low));
    arcs.push_back({low, low + static_cast<double>(arc.width) * 360.0 / 4294967296.0});
  }
  return arcs;
}

std::string arcs_text(const tamp::ArcSet& set) {
  if (set.is_full()) return "any angle";
  std::string text;
  for (const auto& range : arcs_json(set)) {
    char one[64];
    std::snprintf(one, sizeof one, "%s%.1f .. %.1f", text.empty() ? "" : ", ", range[0].get<double>(),
                  range[1].get<double>());
    text += one;
  }
  return text + " deg";
}

// The angles of the tool at an action: of the object, turned by the hand, as far as the arm reaches.
tamp::ArcSet tool_of(const tamp::Network& network, std::size_t action) {
  const tamp::Network::Handling& handling = network.handlings()[action];
  const tamp::Network::Place& place = network.places()[handling.place];
  tamp::ArcSet turned = tamp::sum_of(network.angle(place.angle).arcs(), network.angle(handling.hand).arcs());
  for (const tamp::Network::Visit& visit : network.visits()) {
    if (network.constraints()[visit.constraint].action != action || visit.radius_nm > 0) continue;
    tamp::Box box = network.box(place.spot);
    box[2] = {box[2].low_nm + visit.rise_nm, box[2].high_nm + visit.rise_nm};
    turned = tamp::intersection_of(turned.arcs(), visit.reach->arcs_over(box).arcs());
  }
  return turned;
}

void print_ranges(const tamp::Network& network) {
  for (std::size_t k = 0; k < network.actions().size(); ++k) {
    const tamp::Network::Handling& handling = network.handlings()[k];
    std::printf("%zu %s\n", k + 1, tamp::text_of(network.cell(), network.actions()[k]).c_str());
    if (handling.place == tamp::Network::kNone) continue;
    const tamp::Network::Place& place = network.places()[handling.place];
    const tamp::Box box = network.box(place.spot);
    std::printf("    x %.4f .. %.4f m, y %.4f .. %.4f m, z %.4f .. %.4f m\n", tamp::metres_of(box[0].low_nm),
                tamp::metres_of(box[0].high_nm), tamp::metres_of(box[1].low_nm),
                tamp::metres_of(box[1].high_nm), tamp::metres_of(box[2].low_nm + place.rise_nm),
                tamp::metres_of(box[2].high_nm + place.rise_nm));
    std::printf("    object %s; tool %s\n", arcs_text(network.angle(place.angle)).c_str(),
                arcs_text(tool_of(network, k)).c_str());
  }
}

json ranges_json(const tamp::Network& network) {
  json all = json::array();
  for (std::size_t k = 0; k < network.actions().size(); ++k) {
    json one = {{"action", tamp::text_of(network.cell(), network.actions()[k])}};
    const tamp::Network::Handling& handling = network.handlings()[k];
    if (handling.place != tamp::Network::kNone) {
      const tamp::Network::Place& place = network.places()[handling.place];
      const tamp::Box box = network.box(place.spot);
      const auto span = [](tamp::Span each, std::int64_t rise) {
        return json{tamp::metres_of(each.low_nm + rise), tamp::metres_of(each.high_nm + rise)};
      };
      one.update({{"x_m", span(box[0], 0)},
                  {"y_m", span(box[1], 0)},
                  {"z_m", span(box[2], place.rise_nm)},
                  {"object_deg", arcs_json(network.angle(place.angle))},
                  {"tool_deg", arcs_json(tool_of(network, k))}});
    }
    all.push_back(std::move(one));
  }
  return all;
}

json cause_json(const tamp::SequenceFile& file, const tamp::Cause& cause) {
  json constraints = json::array(), suggestions = json::array(), bounds = json::array();
  for (const tamp::Constraint& each : cause.constraints)
    constraints.push_back(tamp::text_of(file.cell, file.sequence, each));
  for (const tamp::Suggestion& each : cause.suggestions) {
    const bool turns =
        each.parameter == tamp::Parameter::StartAngle || each.parameter == tamp::Parameter::FinalAngle;
    const std::string unit = turns ? "_deg" : "_m";
    (each.proved ? suggestions : bounds)
        .push_back({{"text", each.text},
                    {"from" + unit, turns ? degrees(each.from) : each.from},
                    {"to" + unit, turns ? degrees(each.to) : each.to}});
  }
  return {{"sentence", cause.sentence},
          {"constraints", std::move(constraints)},
          {"irreducible", cause.irreducible},
          {"suggestions", std::move(suggestions)},
          {"not_before", std::move(bounds)}};
}

void print_cause(const tamp::SequenceFile& file, const tamp::Cause& cause) {
  std::printf("cannot be done: %s\n", cause.sentence.c_str());
  std::printf("these conflict%s:\n", cause.irreducible ? ", and no part of them does" : "");
  for (const tamp::Constraint& each : cause.constraints)
    std::printf("  %s\n", tamp::text_of(file.cell, file.sequence, each).c_str());
  const auto print = [&](bool proved, const char* title) {
    for (const tamp::Suggestion& each : cause.suggestions) {
      if (each.proved != proved) continue;
      std::printf("%s  %s\n", title, each.text.c_str());
      title = "";
    }
  };
  print(true, "any one of these would do:\n");
  print(false, "no pose was found that would do; none will before one of these:\n");
}

int fail(const result::Diagnostics& diagnostics) {
  return process::fail(diagnostics, ExitCode::BadInput);
}

ExitCode write(const std::string& file, const std::string& text) {
  if (file.empty()) return ExitCode::Done;
  const result::Diagnostics unwritten = files::write_file(file, text);
  if (unwritten.empty()) return ExitCode::Done;
  (void)fail(unwritten);
  return ExitCode::BadInput;
}

std::string reach_blocks(const tamp::SequenceFile& file) {
  std::string text;
  for (std::size_t k = 0; k < file.cell.arms.size(); ++k)
    text += (k == 0 ? "" : "\n") +
            tamp::reach_block(file.cell.arms[k].name, tamp::rings_of(*file.reaches[k], file.shoulders[k]));
  return text;
}

ExitCode exit_of(const Answered& answered) {
  switch (answered.solution.answer) {
    case tamp::Answer::Feasible:
      return ExitCode::Done;
    case tamp::Answer::Infeasible:
      return ExitCode::NoPlan;
    case tamp::Answer::Unknown:
      return ExitCode::BudgetExhausted;
  }
  return ExitCode::RuntimeFault;
}

}  // namespace

ExitCode run_reach(const ReachArguments& arguments) {
  for (const std::string& name : {arguments.json_file, arguments.svg_file, arguments.st_file}) {
    if (name.empty()) continue;
    if (const auto unwritable = files::check_writable(name); !unwritable.empty()) {
      (void)fail(unwritable);
      return ExitCode::BadInput;
    }
  }
  const auto file = tamp::load_sequence(arguments.sequence);
  if (!file) {
    (void)fail(file.error());
    return ExitCode::BadInput;
  }
  tamp::Network network(file->cell);
  for (const tamp::Action& action : file->sequence) network.push(action);
  Answered answered{tamp::solve(network), {}};
  if (answered.solution.answer == tamp::Answer::Infeasible)
    answered.cause = tamp::explain(file->cell, file->sequence);
  const bool to_stdout = arguments.json_file == "-" || arguments.svg_file == "-" || arguments.st_file == "-";
  const bool feasible = answered.solution.answer == tamp::Answer::Feasible;
  const bool is_reached = feasible && tamp::reached(file->cell, file->sequence, kMostQuestions).has_value();
  if (!to_stdout) {
    if (file->sequence.empty()) std::printf("there are no actions: nothing to answer\n");
    if (answered.cause) print_cause(*file, *answered.cause);
    if (answered.solution.answer == tamp::Answer::Unknown)
      std::printf("neither refuted nor solved in its budget\n");
    if (answered.solution.answer != tamp::Answer::Infeasible) print_ranges(network);
    if (feasible && !is_reached)
      std::printf(
          "not refuted by the bounds of reach; no poses were found that the arms reach for certain\n");
  }
  json document = {{"feasible", feasible},
                   {"reached", is_reached},
                   {"proved", answered.solution.answer != tamp::Answer::Unknown}};
  if (answered.cause) document["cause"] = cause_json(*file, *answered.cause);
  if (answered.solution.answer != tamp::Answer::Infeasible) document["actions"] = ranges_json(network);
  if (const ExitCode written =
          write(arguments.json_file, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
      written != ExitCode::Done)
    return written;
  if (!arguments.svg_file.empty()) {
    const ExitCode drawn = write(arguments.svg_file, tamp::cell_svg(network));
    if (drawn != ExitCode::Done) return drawn;
  }
  if (!arguments.st_file.empty()) {
    const ExitCode written = write(arguments.st_file, reach_blocks(*file));
    if (written != ExitCode::Done) return written;
  }
  return exit_of(answered);
}

}  // namespace stepwright::reach_program
