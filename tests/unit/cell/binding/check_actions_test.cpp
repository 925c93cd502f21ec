#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "cell/binding/check_binding.h"
#include "cell/binding/ground_actions.h"
#include "supervisor/pddl/task/vocabulary.h"

namespace stepwright::cell_binding {
namespace {

const std::string kDomain = R"((define (domain tank)
  (:requirements :typing :numeric-fluents)
  (:types tank amount - object)
  (:predicates (joined ?t - tank) (rinsed ?t - tank))
  (:functions (level ?t - tank) (litres ?a - amount) (made))
  (:action fill
    :parameters (?t - tank ?a - amount)
    :precondition (and (joined ?t) (rinsed ?t) (<= (+ (level ?t) (litres ?a)) 50))
    :effect (increase (level ?t) (litres ?a)))
  (:action rinse
    :parameters (?t - tank)
    :precondition (joined ?t)
    :effect (rinsed ?t))))";
const std::string kProblem = R"((define (problem p) (:domain tank)
  (:objects t1 t2 - tank a10 a20 - amount)
  (:init (joined t1) (= (level t1) 0) (= (level t2) 0) (= (litres a10) 10) (= (litres a20) 20) (= (made) 0))
  (:goal (= (level t1) 30))))";

const std::string kBinding = R"toml([tags]
P = { address = "%QX0.0" }
R = { address = "%QX0.1" }
L = { address = "%IW1", type = "INT" }
L_2 = { address = "%IW2", type = "INT" }
C = { address = "%IX0.0" }
[sensors.L1]
tag = "L"
fluent = "(level t1)"
range = [0, 50]
calibration = [[0, 0], [50, 27648]]
[sensors.L2]
tag = "L_2"
fluent = "(level t2)"
calibration = [[0, 0], [50, 27648]]
[[facts]]
fact = "(rinsed t1)"
tag = "C"
[[actions]]
action = "(fill ?t ?a)"
outputs = ["P"]
until = { fluent = "(level ?t)" }
timeout_s = 60
duration = { per_unit_s = 2, of = "(level ?t)" }
[[actions]]
action = "(rinse ?t)"
outputs = ["R"]
until = { fact = "(rinsed ?t)" }
timeout_s = 60
)toml";

pddl::Task task_of(const std::string& domain) {
  auto task = pddl::parse_task({"domain.pddl", domain}, {"problem.pddl", kProblem});
  if (!task) throw std::runtime_error(result::to_string(task.error()));
  return *task;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const auto at = text.find(old);
  if (at == std::string::npos) throw std::runtime_error("no " + old);
  return text.replace(at, old.size(), by);
}

result::Diagnostics found(const std::string& binding, const std::string& domain = kDomain) {
  const pddl::Task task = task_of(domain);
  const model::Vocabulary names = pddl::vocabulary(task);
  const auto read = translate::read_binding(binding, "binding.toml", &names);
  if (!read) throw std::runtime_error(result::to_string(read.error()));
  return check_actions(task, *read);
}

// The only problem's code and place.
std::string only(const result::Diagnostics& problems) {
  if (problems.size() != 1) return result::to_string(problems);
  return problems.front().code;
}

TEST(GroundActions, WhenAStaticFactIsMissing_ThenTheActionIsNotThere) {
  const GroundActions actions = ground_actions(task_of(kDomain), 100);
  EXPECT_TRUE(actions.complete);
  ASSERT_EQ(actions.actions.size(), 3u);  // t2 is not joined
  EXPECT_EQ(model::to_string(actions.actions[0].action), "(fill t1 a10)");
  EXPECT_NE(precondition_text(actions.actions[0]).find("(rinsed t1)"), std::string::npos);
}

TEST(GroundActions, WhenThereAreTooMany_ThenItSaysSo) {
  EXPECT_FALSE(ground_actions(task_of(kDomain), 2).complete);
}

TEST(CheckActions, WhenAllFits_ThenNothingIsSaid) {
  EXPECT_EQ(result::to_string(found(kBinding)), "");
}

TEST(CheckActions, WhenAnEntryHasNoOutputs_ThenItWarnsUnlessItSaysSo) {
  EXPECT_EQ(only(found(replaced(kBinding, "outputs = [\"R\"]\n", ""))), "B0010");
  EXPECT_EQ(result::to_string(found(replaced(kBinding, "outputs = [\"R\"]\n", "outputs = []\n"))), "");
}

TEST(CheckActions, WhenNothingShowsWhatOthersNeed_ThenItWarnsUnlessItIsBelieved) {
  const std::string domain = replaced(replaced(kDomain, "(<= (+ (level ?t) (litres ?a)) 50)",
                                               "(<= (+ (level ?t) (litres ?a)) 50) (<= (made) 9)"),
                                      ":effect (rinsed ?t)", ":effect (and (rinsed ?t) (increase (made) 1))");
  EXPECT_EQ(only(found(kBinding, domain)), "B0012");
  EXPECT_EQ(result::to_string(found("believed = [\"(made)\"]\n" + kBinding, domain)), "");
}

TEST(CheckActions, WhenAnActionDoesNotBringItsCompletionAbout_ThenItCanNeverEnd) {
  EXPECT_EQ(only(found(replaced(kBinding, "until = { fact = \"(rinsed ?t)\" }",
                                "until = { fluent = \"(level ?t)\" }"))),
            "B0014");
}

TEST(CheckActions, WhenAChangeIsLargerThanTheRange_ThenItCanNeverEnd) {
  EXPECT_EQ(only(found(replaced(kBinding, "range = [0, 50]", "range = [0, 15]"))), "B0014");
}

TEST(CheckActions, WhenTheTimeoutIsShorterThanTheDuration_ThenItSaysWhatToWrite) {
  const result::Diagnostics problems = found(replaced(kBinding, "timeout_s = 60", "timeout_s = 30"));
  ASSERT_EQ(only(problems), "B0015");
  EXPECT_EQ(problems.front().hint, "timeout_s = 60");
}

}  // namespace
}  // namespace stepwright::cell_binding
