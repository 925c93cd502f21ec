#include "plant_models/components/model_text.h"

#include <algorithm>
#include <set>

#include "plant_models/components/component_reader.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::components {
namespace {

using settings::TomlTable;

// A figure of the whole plant.
double plant_figure(const TomlTable& table, const char* name, const char* unit, const char* fallback,
                    double low, double high) {
  return read_figure(table, {.name = name, .unit = unit, .fallback = fallback, .low = low, .high = high}, {})
      .value;
}

Parameters read_plant(const TomlTable& table, const ModelOptions& options) {
  Parameters of_plant;
  of_plant.density_kg_m3 = plant_figure(table, "density", "kg/m3", "1 kg/l", 1e-3, 1e5);
  of_plant.heat_capacity_j_kg_k = plant_figure(table, "heat_capacity", "J/(kg K)", "4186 J/(kg K)", 1.0, 1e6);
  of_plant.gravity_m_s2 = plant_figure(table, "gravity", "m/s2", "9.80665 m/s2", 0.01, 1e3);
  of_plant.room_k = plant_figure(table, "room_temperature", "K", "20 degC", 1.0, 5e3);
  of_plant.seed = options.seed;
  of_plant.uncertainty = options.uncertainty;
  return of_plant;
}

void read_terminals(const TomlTable& table, ModelText& model) {
  for (const std::string& name : table.keys()) {
    TerminalText terminal{name, {}, {}, table.where(name)};
    if (table.has_table(name)) {
      const TomlTable inner = table.table(name);
      terminal.address = inner.required_text("address");
      terminal.from = inner.required_text("from");
      terminal.where = inner.where("from");
    } else {
      terminal.address = table.required_text(name);
    }
    model.terminals.push_back(std::move(terminal));
  }
}

std::vector<AliasText> read_aliases(const TomlTable& table) {
  std::vector<AliasText> aliases;
  for (const std::string& name : table.keys()) {
    AliasText alias{.name = name, .of = {}, .unit = {}, .where = table.where(name)};
    if (table.has_table(name)) {
      const TomlTable inner = table.table(name);
      alias.of = inner.required_text("of");
      alias.unit = inner.text("unit", {});
      alias.factor = inner.number("factor", 1.0, {1e-12, 1e12});
    } else {
      alias.of = table.required_text(name);
    }
    aliases.push_back(std::move(alias));
  }
  return aliases;
}

}  // namespace

result::Result<ModelText> read_model(const std::filesystem::path& file, Catalogue catalogue,
                                     const ModelOptions& options) {
  auto document = settings::TomlDocument::load(file);
  if (!document) return result::forward(document);
  return read_model(**document, file, catalogue, options);
}

result::Result<ModelText> read_model(settings::TomlDocument& document, const std::filesystem::path& file,
                                     Catalogue catalogue, const ModelOptions& options) {
  const TomlTable root = document.root();
  ModelText model;
  model.file = file;
  const TomlTable plant = root.table("plant");
  model.name = plant.text("name", file.stem().string());
  const Parameters of_plant = read_plant(plant, options);
  const TomlTable solver = root.table("solver");
  model.solver.implicit = solver.choice("method", "explicit", {"explicit", "implicit"}) == "implicit";
  model.solver.relative_tolerance = solver.number("relative_tolerance", 1e-6, {1e-12, 1e-2});
  model.solver.max_step_s =
      read_figure(solver,
                  {.name = "longest_step", .unit = "s", .fallback = "0.1 s", .low = 1e-6, .high = 3600.0}, {})
          .value;
  model.communication_step_s = plant_figure(plant, "communication_step", "s", "10 ms", 1e-6, 60.0);
  ComponentReader reader(catalogue, of_plant, root, options, model);
  const TomlTable components = root.table("components");
  for (const std::string& name : components.keys()) reader.read(components.table(name), name);
  reader.read_unused();
  if (!root.has("components"))
    root.report("components", "the plant has no components", "[components.tank1] with type = \"tank\"");
  read_terminals(root.table("terminals"), model);
  model.truths = read_aliases(root.table("truths"));
  model.faults = read_aliases(root.table("faults"));
  result::Diagnostics problems = document.finish();
  if (result::has_errors(problems)) return tl::unexpected(std::move(problems));
  return model;
}

}  // namespace stepwright::components
