#include "programs/ltl/check_command.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "programs/ltl/formula_input.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/result/counted.h"
#include "supervisor/ltl/trace/judge.h"

namespace stepwright::ltl_program {

namespace {

using ltl::Verdict;
using result::ExitCode;

struct Answer {
  std::string file;
  std::vector<std::string> propositions;
  ltl::Trace trace;
  ltl::Judgement judgement;
};

const char* name_of(Verdict verdict) {
  return verdict == Verdict::True ? "TRUE" : verdict == Verdict::False ? "FALSE" : "UNDECIDED";
}

result::Result<Answer> judge(const CheckArguments& arguments) {
  std::vector<ltl::Binding> bindings;
  for (const std::string& each : arguments.bindings) {
    auto binding = ltl::read_binding(each);
    if (!binding) return result::forward(binding);
    bindings.push_back(*std::move(binding));
  }
  // Of a formula the automaton is left to the judge: where it is too large, he does without.
  std::optional<Watched> watched;
  std::optional<ltl::Formula> formula;
  if (is_automaton(arguments.formula)) {
    auto read = read_watched(arguments.formula);
    if (!read) return result::forward(read);
    watched = *std::move(read);
  } else {
    auto read = read_formula(arguments.formula);
    if (!read) return result::forward(read);
    formula = *std::move(read);
  }
  auto table = files::open_file(arguments.trace);
  if (!table) return result::forward(table);
  Answer answer{
      arguments.trace, watched ? watched->automaton.propositions : formula->tree.propositions, {}, {}};
  auto trace = watched ? ltl::read_trace(*table, arguments.trace, answer.propositions, bindings)
                       : ltl::read_trace(*table, arguments.trace, formula->tree, bindings);
  if (!trace) return result::forward(trace);
  answer.trace = *std::move(trace);
  if (watched) {
    answer.judgement.whole = ltl::judge(watched->automaton, answer.trace);
    answer.judgement.stutter = watched->stutter;
    return answer;
  }
  auto judgement = ltl::judge(*formula, answer.trace, {}, file_of(arguments.formula));
  if (!judgement) return result::forward(judgement);
  answer.judgement = *std::move(judgement);
  return answer;
}

std::string holding(const Answer& answer, ltl::Letter letter) {
  std::string text;
  for (std::size_t k = 0; k < answer.propositions.size(); ++k)
    if ((letter >> k & 1) != 0) text += (text.empty() ? "" : ", ") + answer.propositions[k];
  return text.empty() ? "nothing holds" : text;
}

// Without zeros at the end that say nothing.
std::string seconds(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// "at scan 5, 0.04 s (run.csv:6)".
std::string place(const Answer& answer, const ltl::Judged& judged) {
  if (!judged.decided_at) return judged.verdict == Verdict::Undecided ? "" : " whatever happens";
  const ltl::TraceChange& change = answer.trace.changes[*judged.decided_at];
  std::string text =
      change.scan.empty() ? " at row " + std::to_string(change.row) : " at scan " + change.scan;
  if (!change.time_s.empty()) text += ", " + seconds(change.time_s) + " s";
  return text + " (" + answer.file + ":" + std::to_string(change.line) + ")";
}

const char* open_text(ltl::Class kind) {
  switch (kind) {
    case ltl::Class::CoSafe:
      return "is still to be satisfied";
    case ltl::Class::Safe:
      return "was not violated";
    default:
      return "is open";
  }
}

void print(const Answer& answer) {
  const ltl::Judged& whole = answer.judgement.whole;
  std::printf("%s%s", name_of(whole.verdict), place(answer, whole).c_str());
  if (whole.decided_at) {
    std::printf(": %s", holding(answer, answer.trace.changes[*whole.decided_at].letter).c_str());
  } else if (whole.verdict == Verdict::Undecided) {
    std::printf(
        " after %s, in which what holds changes %s",
        result::counted(answer.trace.rows, "row", "rows").c_str(),
        result::counted(answer.trace.changes.empty() ? 0 : answer.trace.changes.size() - 1, "time", "times")
            .c_str());
  }
  std::puts("");
  for (const ltl::JudgedPart& part : answer.judgement.parts) {
    std::printf("  %u:%u: %s ", part.at.line, part.at.column, part.text.c_str());
    if (!part.told)
      std::puts("cannot be told by a run that ends");
    else if (part.judged.verdict == Verdict::Undecided)
      std::printf("%s\n", open_text(part.kind));
    else
      std::printf("is %s%s\n", name_of(part.judged.verdict), place(answer, part.judged).c_str());
  }
}

void add_judged(nlohmann::json& json, const Answer& answer, const ltl::Judged& judged) {
  json["verdict"] = name_of(judged.verdict);
  json["stepwise"] = judged.stepwise;
  if (!judged.stepwise) json["state"] = judged.state;
  if (!judged.decided_at) return;
  const ltl::TraceChange& change = answer.trace.changes[*judged.decided_at];
  json["row"] = change.row;
  json["line"] = change.line;
  if (!change.scan.empty()) json["scan"] = change.scan;
  if (!change.time_s.empty()) json["time_s"] = change.time_s;
  json["holds"] = nlohmann::json::array();
  for (std::size_t k = 0; k < answer.propositions.size(); ++k)
    if ((change.letter >> k & 1) != 0) json["holds"].push_back(answer.propositions[k]);
}

std::string json_of(const Answer& answer) {
  nlohmann::json json = {{"rows", answer.trace.rows},
                         {"letters", answer.trace.changes.size()},
                         {"propositions", answer.propositions},
                         {"parts", nlohmann::json::array()},
                         {"note", answer.judgement.stutter.reason}};
  add_judged(json, answer, answer.judgement.whole);
  for (const ltl::JudgedPart& part : answer.judgement.parts) {
    nlohmann::json each = {
        {"formula", part.text}, {"line", part.at.line}, {"column", part.at.column}, {"told", part.told}};
    nlohmann::json judged;
    add_judged(judged, answer, part.judged);
    each["judged"] = std::move(judged);
    json["parts"].push_back(std::move(each));
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

ExitCode run_check(const CheckArguments& arguments) {
  const auto answer = judge(arguments);
  if (!answer) return fail(answer.error());
  print_note(answer->judgement.stutter);
  if (answer->judgement.whole.stepwise)
    std::fputs("note: too large for an automaton: told when it follows without looking ahead\n", stderr);
  if (arguments.json_file != "-") print(*answer);
  if (!arguments.json_file.empty())
    if (const ExitCode written = write(arguments.json_file, json_of(*answer)); written != ExitCode::Done)
      return written;
  const Verdict verdict = answer->judgement.whole.verdict;
  const bool missed = verdict == Verdict::False || (arguments.decided && verdict == Verdict::Undecided);
  return missed ? ExitCode::RuntimeFault : ExitCode::Done;
}

}  // namespace stepwright::ltl_program
