#include <algorithm>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/ompl/ompl_planner.h"

namespace stepwright::motion {

const std::vector<OmplPlannerName>& ompl_planners() {
  // In the order of OMPL's folders. Left out: TSRRT, VFRRT, XXL, QRRT and those of experience, which need
  // more than a space and a checker; LazyLBTRRT, which ends the process by an assertion of its own (1.5.2).
  static const std::vector<OmplPlannerName> all{
      {"RRTConnect", true, false},  {"RRT", true, false},
      {"RRTstar", true, true},      {"InformedRRTstar", true, true},
      {"SORRTstar", true, true},    {"RRTsharp", true, true},
      {"RRTXstatic", true, true},   {"LBTRRT", true, true},
      {"LazyRRT", true, false},     {"TRRT", true, false},
      {"BiTRRT", true, false},      {"pRRT", false, false},
      {"EST", true, false},         {"BiEST", true, false},
      {"ProjEST", true, false},     {"KPIECE1", true, false},
      {"BKPIECE1", true, false},    {"LBKPIECE1", true, false},
      {"SBL", true, false},         {"pSBL", false, false},
      {"PDST", true, false},        {"STRIDE", true, false},
      {"SST", true, true},          {"RLRT", true, false},
      {"BiRLRT", true, false},      {"PRM", false, false},
      {"PRMstar", false, true},     {"LazyPRM", true, false},
      {"LazyPRMstar", false, true}, {"SPARS", false, true},
      {"SPARStwo", false, true},    {"FMT", true, false},
      {"BFMT", true, false},        {"BITstar", true, true},
      {"ABITstar", true, true},     {"AITstar", true, true},
      {"CForest", false, true},     {"AnytimePathShortening", false, true}};
  return all;
}

const OmplPlannerName* ompl_planner(std::string_view name) {
  const auto& all = ompl_planners();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
  return found == all.end() ? nullptr : &*found;
}

result::Diagnostics no_such_planner(std::string_view name, std::vector<std::string> others) {
  std::vector<std::string> names = std::move(others);
  for (const OmplPlannerName& each : ompl_planners()) names.emplace_back(each.name);
  std::string list;
  for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
  constexpr std::size_t kSlips = 3;
  const std::string* meant = result::closest(name, names, kSlips);
  return {{code::kNoPlanner,
           result::Severity::Error,
           {},
           "there is no planner '" + std::string(name) + "'",
           (meant ? "did you mean '" + *meant + "'? There are " : "there are ") + list}};
}

}  // namespace stepwright::motion
