#include "cell/config/tugger_config.h"

namespace stepwright::config {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr Range kFigure{0.01, 100.0};
constexpr Range kTrailers{0, 15};

TrainConfig read_train(const TomlTable& table) {
  TrainConfig train;
  train.wheelbase_m = table.number("wheelbase_m", train.wheelbase_m, kFigure);
  train.hitch_m = table.number("hitch_m", train.hitch_m, kFigure);
  train.length_m = table.number("length_m", train.length_m, kFigure);
  train.width_m = table.number("width_m", train.width_m, kFigure);
  train.spacing_m = table.number("spacing_m", train.spacing_m, kFigure);
  return train;
}

}  // namespace

TuggerPlantConfig read_tugger_plant(const TomlTable& plant, const std::filesystem::path& folder) {
  TuggerPlantConfig tugger;
  tugger.scene = read_plant_file(plant, "scene", folder);
  if (!plant.has("scene"))
    plant.report("kind", "a tugger train without a hall", "scene = \"hall.geojson\", with its polygons");
  tugger.trailers = static_cast<std::size_t>(plant.integer("trailers", 5, kTrailers));
  const auto as_many = static_cast<std::int64_t>(tugger.trailers);
  tugger.most_trailers = static_cast<std::size_t>(plant.integer("most_trailers", as_many, kTrailers));
  if (tugger.most_trailers < tugger.trailers)
    plant.report("most_trailers", "less than the trailers that are coupled at the start");
  tugger.scanner_m = plant.number("scanner_m", tugger.scanner_m, {0.1, 100.0});
  if (plant.has("start"))
    tugger.start = read_place(plant.table("start"));
  else
    plant.report("kind", "a tugger train that stands nowhere", "[plant.start] with x_m, y_m and heading_deg");
  tugger.train = read_train(plant.table("train"));
  for (const TomlTable& table : plant.tables("blockages")) tugger.blockages.push_back(read_blockage(table));
  return tugger;
}

}  // namespace stepwright::config
