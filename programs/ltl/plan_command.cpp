#include "programs/ltl/plan_command.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "programs/ltl/formula_input.h"
#include "runtime/ground/files/files.h"
#include "supervisor/ltl/bound/point_bound.h"
#include "supervisor/ltl/planner/plan_svg.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "supervisor/ltl/planner/plan_way.h"
#include "supervisor/ltl/scene/problem_reader.h"

namespace stepwright::ltl_program {

namespace {

using ltl::PlanAnswer;
using ltl::Problem;
using nlohmann::json;
using result::ExitCode;

constexpr std::chrono::seconds kBoundTime{2};  // for the bound, beyond which it is left out
constexpr std::uintmax_t kMostProblemBytes = 4u << 20;

struct Figures {
  double spent_s = 0.0;
  std::optional<double> bound_m;  // greater than 0
};

Figures figures_of(const Problem& problem, double spent_s) {
  auto bound_m = ltl::point_bound_m(problem, {.until = std::chrono::steady_clock::now() + kBoundTime});
  if (bound_m && !(*bound_m > 0.0)) bound_m.reset();
  return {spent_s, bound_m};
}

std::vector<std::string> places_of(const Problem& problem, ltl::Label label) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < problem.floor.propositions.size(); ++k)
    if ((label >> k & 1) != 0) names.push_back(problem.floor.propositions[k].name);
  return names;
}

// "press + rack", "-" for none.
std::string text_of(const Problem& problem, ltl::Label label) {
  std::string text;
  for (const std::string& name : places_of(problem, label)) text += (text.empty() ? "" : " + ") + name;
  // A name must not command a terminal.
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  return text.empty() ? "-" : text;
}

void print(const Problem& problem, const PlanAnswer& answer, const Figures& figures) {
  const ltl::PlanJudgement& judged = answer.judgement;
  std::printf("plan: %.1f m in %.1f s, %zu controls\n", judged.length_m, judged.duration_s,
              answer.plan.pieces.size());
  if (figures.bound_m)
    std::printf("length: %.2f times the least that a point needs (%.1f m)\n",
                judged.length_m / *figures.bound_m, *figures.bound_m);
  std::string word;
  for (const ltl::Label each : judged.word) word += (word.empty() ? "" : ", ") + text_of(problem, each);
  std::printf("places: %s\n", word.c_str());
  std::printf("judged: by CVODE, %zu looks, ends %.2g m from where the planner says\n", judged.looks,
              judged.end_error);
  std::printf("found: %.3f s, %zu drives, %zu states", answer.search.spent_s, answer.search.drives,
              answer.search.nodes);
  if (answer.shortened) std::printf("; %.1f m at first", answer.search.plan->length_m);
  std::printf("; %.3f s in all, %zu thread%s\n", figures.spent_s, answer.threads,
              answer.threads == 1 ? "" : "s");
}

json pieces_of(const PlanAnswer& answer) {
  json pieces = json::array();
  for (const ltl::TrainPiece& each : answer.plan.pieces) {
    pieces.push_back({{"acceleration_m_s2", each.control.acceleration_m_s2},
                      {"lock_rate_rad_s", each.control.lock_rate_rad_s},
                      {"duration_s", each.duration_s}});
  }
  return pieces;
}

// Time, then the state: x, y, heading, speed, lock and the headings of the trailers.
json way_of(const Problem& problem, const PlanAnswer& answer) {
  json way = json::array();
  for (const ltl::WayState& each : ltl::way_of(problem.train, answer.plan)) {
    json row = {each.time_s};
    for (std::size_t k = 0; k < problem.train.states(); ++k) row.push_back(each.state[k]);
    way.push_back(std::move(row));
  }
  return way;
}

std::string json_of(const Problem& problem, const PlanAnswer& answer, const PlanArguments& arguments,
                    const Figures& figures) {
  json word = json::array();
  for (const ltl::Label label : answer.judgement.word) word.push_back(places_of(problem, label));
  const json document = {
      {"solved", true},
      {"task", problem.task},
      {"trailers", problem.train.trailers},
      {"seed", arguments.seed},
      {"length_m", answer.judgement.length_m},
      {"first_length_m", answer.search.plan->length_m},
      {"bound_m", figures.bound_m ? json(*figures.bound_m) : json()},
      {"length_ratio", figures.bound_m ? json(answer.judgement.length_m / *figures.bound_m) : json()},
      {"duration_s", answer.judgement.duration_s},
      {"end_error", answer.judgement.end_error},
      {"tries", answer.tries},
      {"threads", answer.threads},
      {"drives", answer.search.drives},
      {"states", answer.search.nodes},
      {"found_s", answer.search.spent_s},
      {"spent_s", figures.spent_s},
      {"word", std::move(word)},
      {"controls", pieces_of(answer)},
      {"way", way_of(problem, answer)}};
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

// Of a run before this one, which the plan beside it does not belong to.
void remove_picture(const std::string& file) {
  std::error_code failed;
  if (file.empty() || files::is_stream(file) || !std::filesystem::remove(file, failed)) return;
  std::fprintf(stderr, "the picture of an earlier run was removed: %s\n", file.c_str());
}

ExitCode failed(const result::Diagnostics& diagnostics, const PlanArguments& arguments) {
  const std::string code = diagnostics.empty() ? "" : diagnostics.front().code;
  const ExitCode exit = code == ltl::kImpossible                           ? ExitCode::NoPlan
                        : code == ltl::kNoPlan || code == ltl::kAllRefused ? ExitCode::BudgetExhausted
                                                                           : ExitCode::BadInput;
  const bool unsolved = exit != ExitCode::BadInput;
  if (unsolved && !arguments.json_file.empty()) {
    const json document = {{"solved", false}, {"code", code}, {"reason", diagnostics.front().message}};
    (void)write(arguments.json_file, document.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  }
  if (unsolved) remove_picture(arguments.svg_file);
  (void)fail(diagnostics);
  return exit;
}

// Of the three files that a run names.
result::Diagnostics one_for_two(const PlanArguments& arguments) {
  const auto same = [](const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || files::is_stream(a) || files::is_stream(b)) return false;
    std::error_code unknown;
    return std::filesystem::weakly_canonical(a, unknown) == std::filesystem::weakly_canonical(b, unknown);
  };
  const std::string& json_file = arguments.json_file;
  if (!same(json_file, arguments.svg_file) && !same(json_file, arguments.problem) &&
      !same(arguments.svg_file, arguments.problem))
    return {};
  return {{"E0002",
           result::Severity::Error,
           {same(json_file, arguments.svg_file) ? json_file : arguments.problem, 0, 0},
           "one file for two things",
           "the problem, the plan and the picture are three files"}};
}

}  // namespace

ExitCode run_plan(const PlanArguments& arguments) {
  if (const auto twice = one_for_two(arguments); !twice.empty()) {
    (void)fail(twice);
    return ExitCode::Usage;
  }
  for (const std::string& file : {arguments.json_file, arguments.svg_file}) {
    if (file.empty()) continue;
    if (const auto unwritable = files::check_writable(file); !unwritable.empty()) return fail(unwritable);
  }
  const auto text = files::read_file(arguments.problem, kMostProblemBytes);
  if (!text) return fail(text.error());
  const auto problem = ltl::read_planning_problem(*text, arguments.problem);
  if (!problem) return fail(problem.error());
  const auto began = std::chrono::steady_clock::now();
  const auto answer = ltl::plan_train(*problem, {.seed = arguments.seed,
                                                 .most_s = arguments.time_s,
                                                 .shorten_s = arguments.shorten_s,
                                                 .threads = arguments.threads});
  if (!answer) return failed(answer.error(), arguments);
  const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const Figures figures = figures_of(*problem, spent_s);
  if (arguments.json_file != "-") print(*problem, *answer, figures);
  if (!arguments.json_file.empty()) {
    const ExitCode written = write(arguments.json_file, json_of(*problem, *answer, arguments, figures));
    if (written != ExitCode::Done) return written;
  }
  if (arguments.svg_file.empty()) return ExitCode::Done;
  return write(arguments.svg_file, ltl::plan_svg(*problem, answer->plan));
}

}  // namespace stepwright::ltl_program
