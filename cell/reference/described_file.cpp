#include "cell/reference/described_file.h"

#include <algorithm>
#include <array>

#include "cell/config/cell_config.h"
#include "cell/config/cell_keys.h"
#include "cell/reference/sample_cells.h"
#include "cell/reference/sample_files.h"
#include "hmi_web/alarms/definition_file.h"
#include "hmi_web/recipes/definition_file.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_text.h"
#include "supervisor/translate/read_binding.h"

namespace stepwright::reference {
namespace {

using settings::TomlDocument;

constexpr std::string_view kAboutCell =
    "`stepwright check` tells a key that is not here, with\nthe one that was probably meant. Any key can be "
    "set "
    "from outside: `--set hmi.port=8081`.\n\n"
    "NAME, TAG, LINE and PORT stand for names that the file chooses, %QW0 for any output.";
constexpr std::string_view kAboutAlarms =
    "The file that `[history] alarms` names. How alarms behave says [alarms](../../hmi_web/doc/alarms.md).";
constexpr std::string_view kAboutRecipes =
    "The file that `[hmi] recipes` names. What recipes are says [recipes](../../hmi_web/doc/recipes.md).";
constexpr std::string_view kAboutBinding =
    "The file that `[planning] binding` names. How it is written says "
    "[the binding file](../../supervisor/doc/binding_file.md). NAME stands for a name that the file chooses.";
constexpr std::string_view kAboutPlant =
    "The file that `[plant] file` names where `kind = \"model\"`. Types and their parameters: `stepwright "
    "plant "
    "--types`; how it is written says [plants of components](../../plant_models/doc/components.md). Names in "
    "capitals stand for those that the file chooses.";

void read_cell(TomlDocument& document) {
  static_cast<void>(config::read_cell_document(document, "sample.toml"));
}

void read_alarms(TomlDocument& document) {
  static_cast<void>(alarms::read_alarms(document.root()));
}

void read_recipes(TomlDocument& document) {
  static_cast<void>(recipes::read_definitions(document.root()));
}

void read_binding(TomlDocument& document) {
  static_cast<void>(translate::read_binding(document, "sample.toml"));
}

void read_plant(TomlDocument& document) {
  static_cast<void>(components::read_model(document, "sample.toml", components::library::catalogue(), {}));
}

}  // namespace

std::span<const DescribedFile> described_files() {
  static const std::array files = {
      DescribedFile{"cell", "Every key of a cell's file", kAboutCell, config::cell_keys(), sample_cells(),
                    read_cell},
      DescribedFile{"alarms", "Every key of a file of alarms", kAboutAlarms, alarm_keys(), sample_alarms(),
                    read_alarms},
      DescribedFile{"recipes", "Every key of the definitions of recipes", kAboutRecipes, recipe_keys(),
                    sample_recipes(), read_recipes},
      DescribedFile{"binding", "Every key of a binding file", kAboutBinding, binding_keys(),
                    sample_bindings(), read_binding},
      DescribedFile{"plant", "Every key of a plant of components", kAboutPlant, plant_file_keys(),
                    sample_plants(), read_plant}};
  return files;
}

const DescribedFile* find_described_file(std::string_view name) {
  const auto files = described_files();
  const auto found = std::ranges::find(files, name, &DescribedFile::name);
  return found == files.end() ? nullptr : &*found;
}

}  // namespace stepwright::reference
