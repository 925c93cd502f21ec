#include "tests/bench/compile/rungs.h"

#include <utility>

namespace stepwright::bench {

namespace {

struct RungNames {
  std::string coil;
  std::string left;
  std::string input;
  std::string right;
};

RungNames names(int i) {
  const auto coil = [](int index) { return "m" + std::to_string(index < 0 ? 0 : index); };
  return {coil(i), coil(i - 1), "in" + std::to_string(i % 16), coil(i - 2)};
}

graphic::Variable boolean(std::string name, std::string address) {
  graphic::Variable variable;
  variable.name = std::move(name);
  variable.type = "BOOL";
  variable.address = std::move(address);
  return variable;
}

std::string input_address(int i) {
  return "%IX" + std::to_string(i / 8) + "." + std::to_string(i % 8);
}

}  // namespace

graphic::Project rungs_as_ladder(int count) {
  graphic::Pou pou;
  pou.name = "main";
  graphic::LadderProgram ladder;
  for (int i = 0; i < 16; ++i) pou.variables.push_back(boolean("in" + std::to_string(i), input_address(i)));
  for (int i = 0; i < count; ++i) {
    const RungNames names_of = names(i);
    pou.variables.push_back(boolean(names_of.coil, ""));
    graphic::Rung rung;
    rung.condition =
        graphic::all({graphic::any({graphic::contact(names_of.left), graphic::contact(names_of.input)}),
                      graphic::contact(names_of.right, true)});
    rung.coils.push_back({graphic::CoilKind::Normal, names_of.coil});
    ladder.rungs.push_back(std::move(rung));
  }
  pou.body = std::move(ladder);
  graphic::Project project;
  project.name = "rungs";
  project.pous.push_back(std::move(pou));
  return project;
}

std::string rungs_as_cpp(int count) {
  std::string text = "#include <cstdint>\nstruct Image {\n  std::uint8_t in[16];\n";
  for (int i = 0; i < count; ++i) text += "  std::uint8_t " + names(i).coil + ";\n";
  text += "};\nvoid scan(Image& p) {\n";
  for (int i = 0; i < count; ++i) {
    const RungNames rung = names(i);
    text += "  p." + rung.coil + " = (p." + rung.left + " | p.in[" + std::to_string(i % 16) + "]) & (p." +
            rung.right + " ^ 1);\n";
  }
  return text + "}\n";
}

}  // namespace stepwright::bench
