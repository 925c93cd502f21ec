// The process behind `stepwright ltl`.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "programs/ltl/automaton_command.h"
#include "programs/ltl/check_command.h"
#include "programs/ltl/monitor_command.h"
#include "programs/ltl/plan_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

constexpr const char* kFormula = "the formula, a file with it (.ltl), or an automaton of another tool (.hoa)";

void describe_check(CLI::App& app, ltl_program::CheckArguments& arguments) {
  app.add_option("formula", arguments.formula, kFormula)->required();
  app.add_option("trace", arguments.trace,
                 "a table as `stepwright exec --csv` and `stepwright trace` write it")
      ->required();
  app.add_option(
      "--let", arguments.bindings,
      "NAME=COLUMN, NAME=!COLUMN or \"NAME=COLUMN > VALUE\": what a proposition means (default: the "
      "BOOL column of its name)");
  app.add_flag("--decided", arguments.decided, "UNDECIDED is exit code 5 as well");
  app.add_option("--json", arguments.json_file, "write the verdict as JSON");
  app.footer("Exit codes: 0 TRUE or UNDECIDED, 1 wrong input, 2 wrong usage, 4 a bound was met, 5 FALSE.");
}

void describe_automaton(CLI::App& app, ltl_program::AutomatonArguments& arguments) {
  const std::map<std::string, ltl::HoaPart> parts = {{"good", ltl::HoaPart::Good},
                                                     {"bad", ltl::HoaPart::Bad}};
  app.add_option("formula", arguments.formula, kFormula)->required();
  app.add_option("--to", arguments.to, "hoa (default), svg or st")
      ->check(CLI::IsMember({"hoa", "svg", "st"}));
  app.add_option_function<std::string>(
         "--part", [&arguments, parts](const std::string& word) { arguments.part = parts.at(word); },
         "of HOA: good prefixes, or bad ones (default: as the formula is)")
      ->check(CLI::IsMember(parts));
  app.add_option("-o,--out", arguments.out_file, "the file (default: standard output)");
}

void describe_monitor(CLI::App& app, ltl_program::MonitorArguments& arguments) {
  const std::map<std::string, ltl::BlockForm> forms = {{"table", ltl::BlockForm::Table},
                                                       {"branches", ltl::BlockForm::Branches}};
  app.add_option("formula", arguments.formula, kFormula)->required();
  app.add_option("-o,--out", arguments.out_file, "the file (default: standard output)");
  app.add_option("--name", arguments.name, "of the function block (default LTL_MONITOR)");
  app.add_option_function<std::string>(
         "--form", [&arguments, forms](const std::string& word) { arguments.form = forms.at(word); },
         "table, or branches to be read by people (default: a table within its bound)")
      ->check(CLI::IsMember(forms));
}

// A number that is none passes the ranges of the library.
std::string is_seconds(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0' && seconds >= 0.0 && seconds <= 86'400.0;
  return number ? "" : "'" + text + "' is no number of seconds from 0 to 86400";
}

std::string is_file_name(const std::string& text) {
  return text.empty() ? "a file has a name" : "";
}

void describe_plan(CLI::App& app, ltl_program::PlanArguments& arguments) {
  app.add_option("problem", arguments.problem, "the problem, JSON (supervisor/doc/ltl.md)")->required();
  app.add_option("--json", arguments.json_file, "write the plan: controls, way, word, figures")
      ->check(is_file_name);
  app.add_option("--svg", arguments.svg_file, "draw the plan on its floor")->check(is_file_name);
  app.add_option("--seed", arguments.seed, "of what is tried by chance (default 1)")
      ->check(process::refuse_seed);
  app.add_option("--time", arguments.time_s, "seconds until a plan must be there (default 10)")
      ->check(is_seconds);
  app.add_option("--shorten", arguments.shorten_s, "seconds for a shorter one after it (default 1)")
      ->check(is_seconds);
  app.add_option(
         "--threads", arguments.threads,
         "1 or 2 (default: as many of them as the machine has); the plan is the same, the time is not")
      ->check(CLI::Range(1, 2));
  app.footer(
      "Exit codes: 0 a plan that the plan checker accepts, 1 wrong input, 2 wrong usage, 3 even a point "
      "cannot do "
      "the task, 4 no plan in that time.");
}

// `stepwright ltl PROBLEM.json` is `stepwright ltl plan PROBLEM.json`.
std::vector<char*> with_its_command(int argc, char** argv) {
  static char plan[] = "plan";
  std::vector<char*> all(argv, argv + argc);
  const std::size_t first = argc > 1 && std::string_view(argv[1]) == "ltl" ? 2 : 1;
  std::error_code unknown;
  if (first < all.size() &&
      (std::string_view(all[first]).ends_with(".json") || std::filesystem::exists(all[first], unknown)))
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(first), plan);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Plans drives that do a task of temporal logic, judges traces by formulas, and makes automata and "
      "monitors of them",
      "stepwright ltl");
  app.require_subcommand(1);
  ltl_program::CheckArguments check_arguments;
  ltl_program::AutomatonArguments automaton_arguments;
  ltl_program::MonitorArguments monitor_arguments;
  ltl_program::PlanArguments plan_arguments;
  CLI::App* plan = app.add_subcommand("plan", "plan a drive of a train; `ltl PROBLEM.json` is the same");
  CLI::App* check = app.add_subcommand("check", "judge a recorded trace");
  CLI::App* automaton = app.add_subcommand("automaton", "write the minimal automaton");
  CLI::App* monitor = app.add_subcommand("monitor", "write a function block in ST that watches in the scan");
  describe_check(*check, check_arguments);
  describe_automaton(*automaton, automaton_arguments);
  describe_monitor(*monitor, monitor_arguments);
  describe_plan(*plan, plan_arguments);
  std::vector<char*> words = with_its_command(argc, argv);
  if (const auto exit = process::parse(app, static_cast<int>(words.size()), words.data())) return *exit;
  if (plan->parsed()) return result::to_int(ltl_program::run_plan(plan_arguments));
  if (check->parsed()) return result::to_int(ltl_program::run_check(check_arguments));
  if (automaton->parsed()) return result::to_int(ltl_program::run_automaton(automaton_arguments));
  return result::to_int(ltl_program::run_monitor(monitor_arguments));
}
