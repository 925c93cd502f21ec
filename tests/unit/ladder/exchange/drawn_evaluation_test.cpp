// Random drawings against a direct evaluation of them: every element once, after what its inputs come from.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/drawn_elements.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

constexpr int kVariables = 4;
constexpr int kScans = 6;

std::string variable(int number) {
  return "v" + std::to_string(number);
}

std::string all_variables() {
  return bools("v0 v1 v2 v3");
}

// What the variables hold after each of the scans, which begin with the same random values.
template <typename Scan, typename Set, typename Get>
std::string trace(unsigned seed, Scan scan, Set set, Get get) {
  std::mt19937 random(seed);
  std::string text;
  for (int i = 0; i < kScans; ++i) {
    for (int v = 0; v < kVariables; ++v)
      if (random() % 2 == 0) set(v, random() % 2 == 0);
    scan();
    for (int v = 0; v < kVariables; ++v) text += get(v) ? '1' : '0';
    text += ' ';
  }
  return text;
}

std::string trace_of(const graphic::Project& project, unsigned seed) {
  support::CompiledProgram program(input_of(project));
  return trace(
      seed, [&] { ASSERT_FALSE(program.scan().trap); },
      [&](int v, bool value) { program.set("run." + variable(v), value ? 1 : 0); },
      [&](int v) { return program.get("run." + variable(v)) != 0; });
}

// The drawing as it was read, and as it is after it was written.
void expect_trace(const std::string& xml, unsigned seed, const std::string& expected) {
  const auto project = read_plcopen("plc.xml", xml);
  ASSERT_TRUE(project) << result::to_string(project.error());
  ASSERT_EQ(trace_of(*project, seed), expected) << xml;
  const auto written = write_plcopen(*project);
  ASSERT_TRUE(written);
  ASSERT_EQ(trace_of(*read_plcopen("again.xml", *written), seed), expected) << *written;
}

// A contact or coil of a random rung. Its inputs lead to the rail (-1) or to elements left of it.
struct Drawn {
  bool is_coil = false;
  int variable = 0;
  bool negated = false;
  char edge = ' ';     // 'r', 'f'
  char storage = ' ';  // 's', 'r'
  int row = 0;
  std::vector<int> from;
  bool before = false;  // for its edge
};

std::vector<Drawn> random_rungs(std::mt19937& random) {
  std::vector<Drawn> all(4 + random() % 9);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Drawn& each = all[i];
    each.is_coil = random() % 5 < 2;
    each.variable = static_cast<int>(random() % kVariables);
    each.negated = random() % 4 == 0;
    if (random() % 4 == 0) each.edge = random() % 2 == 0 ? 'r' : 'f';
    if (each.is_coil && random() % 2 == 0) each.storage = random() % 2 == 0 ? 's' : 'r';
    if (each.storage != ' ') each.edge = ' ';
    if (each.is_coil && each.edge != ' ') each.negated = false;
    each.row = static_cast<int>(random() % 4);
    const std::size_t inputs = 1 + random() % 2;
    for (std::size_t k = 0; k < inputs; ++k)
      each.from.push_back(i == 0 || random() % 4 == 0 ? -1 : static_cast<int>(random() % i));
    std::sort(each.from.begin(), each.from.end());
    each.from.erase(std::unique(each.from.begin(), each.from.end()), each.from.end());
  }
  return all;
}

std::string attributes(const Drawn& each) {
  std::string text = each.negated ? " negated=\"true\"" : "";
  if (each.edge != ' ') text += each.edge == 'r' ? " edge=\"rising\"" : " edge=\"falling\"";
  if (each.storage != ' ') text += each.storage == 's' ? " storage=\"set\"" : " storage=\"reset\"";
  return text;
}

std::string xml_of(const std::vector<Drawn>& all) {
  std::string body;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::string from;
    for (const int each : all[i].from) from += " " + std::to_string(each + 2);
    const auto element = all[i].is_coil ? coil : contact;
    const int place = static_cast<int>(i);
    body += element(place + 2, 50 + 40 * place, 10 + 50 * all[i].row, from, variable(all[i].variable),
                    attributes(all[i]));
  }
  return ladder(all_variables(), body);
}

// The drawing itself, evaluated.
class Direct {
 public:
  explicit Direct(std::vector<Drawn> elements) : elements_(std::move(elements)) {
    std::vector<int> network(elements_.size());
    for (std::size_t i = 0; i < network.size(); ++i) network[i] = static_cast<int>(i);
    for (std::size_t i = 0; i < network.size(); ++i)
      for (const int from : elements_[i].from)
        if (from >= 0) {
          const int joined = network[static_cast<std::size_t>(from)];
          const int own = network[i];
          std::replace(network.begin(), network.end(), joined, own);
        }
    std::map<int, std::pair<int, int>> corner;  // top and left of a network
    for (std::size_t i = 0; i < network.size(); ++i) {
      const std::pair here(elements_[i].row, static_cast<int>(i));
      auto& known = corner.try_emplace(network[i], here).first->second;
      known = {std::min(known.first, here.first), std::min(known.second, here.second)};
    }
    for (std::size_t i = 0; i < network.size(); ++i)
      if (elements_[i].is_coil) coils_.push_back(i);
    std::sort(coils_.begin(), coils_.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(corner[network[a]], elements_[a].row, a) <
             std::tuple(corner[network[b]], elements_[b].row, b);
    });
  }

  void scan() {
    links_.assign(elements_.size(), -1);
    for (const std::size_t each : coils_) link(static_cast<int>(each));
  }

  bool values[kVariables] = {};

 private:
  // The state behind an element, which is evaluated if it was not.
  bool link(int index) {
    if (index < 0) return true;
    Drawn& each = elements_[static_cast<std::size_t>(index)];
    int& state = links_[static_cast<std::size_t>(index)];
    if (state >= 0) return state != 0;
    bool power = false;
    for (const int from : each.from) power = link(from) || power;
    bool& value = values[each.variable];
    if (each.is_coil) {
      drive(each, power, value);
    } else {
      power = sensed(each, value) != each.negated && power;
    }
    state = power ? 1 : 0;
    return power;
  }

  static bool sensed(Drawn& each, bool now) {
    const bool was = std::exchange(each.before, now);
    return each.edge == ' ' ? now : each.edge == 'r' ? now && !was : was && !now;
  }

  static void drive(Drawn& each, bool power, bool& value) {
    const bool on = sensed(each, power) != each.negated;
    if (each.storage == ' ') value = on;
    if (each.storage != ' ' && on) value = each.storage == 's';
  }

  std::vector<Drawn> elements_;
  std::vector<std::size_t> coils_;
  std::vector<int> links_;
};

TEST(DrawnEvaluation, WhenRungsAreRandom_ThenEveryLinkHasOneStateInAScan) {
  for (unsigned seed = 1; seed <= 400 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::vector<Drawn> rungs = random_rungs(random);
    Direct direct(rungs);
    const std::string expected = trace(
        seed, [&] { direct.scan(); }, [&](int v, bool value) { direct.values[v] = value; },
        [&](int v) { return direct.values[v]; });
    expect_trace(xml_of(rungs), seed, expected);
  }
}

// A rung made by program: its power has one state, too, and keeps it in the file.
graphic::LadderProgram random_program(std::mt19937& random) {
  using graphic::CoilKind;
  const auto any = [&] { return variable(static_cast<int>(random() % kVariables)); };
  graphic::LadderProgram program;
  for (std::size_t i = 0; i < 1 + random() % 4; ++i) {
    graphic::Rung& rung = program.rungs.emplace_back();
    std::vector<graphic::Condition> branches;
    for (std::size_t k = 0; k < 1 + random() % 2; ++k)
      branches.push_back(graphic::all({graphic::contact(any(), random() % 3 == 0), graphic::contact(any())}));
    rung.condition = graphic::any(std::move(branches));
    if (random() % 4 == 0) rung.condition = graphic::compare(any(), graphic::CompareOp::NotEqual, any());
    for (std::size_t k = 0; k < random() % 3; ++k)
      rung.blocks.emplace_back().st_body = any() + " := " + (random() % 2 == 0 ? "TRUE" : any()) + ";";
    for (std::size_t k = 0; k < random() % 4; ++k)
      rung.coils.push_back({static_cast<CoilKind>(random() % 6), any()});
  }
  return program;
}

TEST(DrawnEvaluation, WhenRungsMadeByProgramAreWritten_ThenTheyDoTheSame) {
  for (unsigned seed = 1; seed <= 300 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    graphic::Project project;
    project.name = "demo";
    project.tasks = {{"fast", 10'000, 1}};
    project.instances = {{"run", "main", "fast"}};
    graphic::Pou& pou = project.pous.emplace_back();
    pou.name = "main";
    for (int v = 0; v < kVariables; ++v) pou.variables.push_back({variable(v), "BOOL"});
    pou.body = random_program(random);
    const auto written = write_plcopen(project);
    ASSERT_TRUE(written) << result::to_string(written.error());
    ASSERT_EQ(trace_of(*read_plcopen("plc.xml", *written), seed), trace_of(project, seed)) << *written;
  }
}

TEST(DrawnEvaluation, WhenAVariableIsReadTwiceAndWrittenBetween_ThenBothReadersSeeItsFirstValue) {
  // The MOVE in the upper row clears a; the output below reads the link, which was TRUE.
  const std::string body = input(2, 0, 10, "v0") + input(3, 0, 40, "FALSE") +
                           block(4, 100, 10, "MOVE", "EN=2 IN=3", "ENO OUT") +
                           output(5, 200, 10, "4:OUT", "v0") + output(6, 200, 90, "2", "v1");
  const std::string xml = editor_project(editor_program(all_variables(), "<FBD>\n" + body + "</FBD>\n"));
  EXPECT_EQ(run(xml, "v0", "v0| ", "v0 v1"), "01 00");
}

TEST(DrawnEvaluation, WhenAContactThatSensesAnEdgeHoldsACall_ThenItIsCalledOnce) {
  const std::string tick =
      "<pou name=\"Tick\" pouType=\"function\"><interface><returnType><BOOL/></returnType><inOutVars>" +
      ints("n") +
      "</inOutVars></interface><body><ST><xhtml:p>n := n + 1; Tick := n = 2;</xhtml:p></ST></body></pou>\n";
  const std::string body =
      contact(2, 50, 10, "1", "Tick(k)", " edge=\"rising\"") + coil(3, 200, 10, "2", "v0") +
      contact(4, 50, 60, "1", "Tick(m)", " edge=\"falling\"") + coil(5, 200, 60, "4", "v1");
  const std::string xml = editor_project(
      tick + editor_program(all_variables() + ints("k m"), "<LD>\n" + rail() + body + "</LD>\n"));
  EXPECT_EQ(run(xml, "v2", " | | | ", "k v0 m v1"), "1010 2120 3031 4040");
}

TEST(DrawnEvaluation, WhenAnInstanceIsCalledTwice_ThenEachReaderSeesItsOwnCall) {
  const auto call = [](int id, int y, const std::string& from) {
    return at("block", id, 100, y,
              "<inputVariables><variable formalParameter=\"CLK\">" + in(from) +
                  "</variable></inputVariables><inOutVariables/><outputVariables><variable "
                  "formalParameter=\"Q\"><connectionPointOut/></variable></outputVariables>",
              " typeName=\"R_TRIG\" instanceName=\"edge\"");
  };
  const std::string body =
      input(2, 0, 10, "v0") + call(3, 10, "2") + input(4, 0, 60, "v1") + call(5, 60, "4") +
      block(6, 200, 110, "AND", "IN1=5:Q IN2=3:Q", "OUT") + output(7, 300, 110, "6:OUT", "v2") +
      block(8, 200, 160, "OR", "IN1=5:Q IN2=3:Q", "OUT") + output(9, 300, 160, "8:OUT", "v3");
  const std::string xml = editor_project(editor_program(
      all_variables() + "<variable name=\"edge\"><type><derived name=\"R_TRIG\"/></type></variable>\n",
      "<FBD>\n" + body + "</FBD>\n"));
  EXPECT_EQ(run(xml, "v0 v1", "v0|v1|v0 v1| ", "v2 v3"), "01 01 00 00");
}

}  // namespace
}  // namespace stepwright::exchange
