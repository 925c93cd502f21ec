#include "tests/bench/plant/model_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>

#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/bridge/plant_driver.h"
#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using components::ModelPlant;
using namespace std::chrono_literals;

const std::filesystem::path kBench = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench_model/plant.toml";

double microseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

std::unique_ptr<ModelPlant> load(const std::filesystem::path& file) {
  return std::move(ModelPlant::load(file, components::library::catalogue(), {}).value());
}

double run_job(const std::vector<Outputs>& job) {
  const auto plant = load(kBench);
  auto driver = bridge::PlantDriver::create(*plant, bridge::default_bench_wires(),
                                            {.input_bytes = 8, .output_bytes = 1})
                    .value();
  std::array<std::byte, 8> inputs{};
  std::array<std::byte, 1> outputs{};
  const auto start = Clock::now();
  for (std::size_t i = 0; i < job.size(); ++i) {
    const auto now_ns = static_cast<std::int64_t>(i) * 10'000'000;
    driver.read_inputs(now_ns, inputs);
    const Outputs& o = job[i];
    const unsigned bits = (o[0] ? 1u : 0u) | (o[1] ? 2u : 0u) | (o[4] ? 4u : 0u) | (o[5] ? 8u : 0u) |
                          (o[2] ? 16u : 0u) | (o[3] ? 32u : 0u);
    outputs[0] = static_cast<std::byte>(bits);
    driver.write_outputs(now_ns, outputs);
  }
  return microseconds_since(start) / static_cast<double>(job.size());
}

std::string row_text(std::size_t components, bool implicit) {
  std::string text = implicit ? "[solver]\nmethod = \"implicit\"\n" : "";
  const auto tank = [](std::size_t i) { return "t" + std::to_string(i); };
  std::size_t made = 0;
  for (std::size_t i = 0; made < components; ++i) {
    text += "[components." + tank(i) + "]\ntype = \"tank\"\nvolume = \"1 m3\"\nstart = \"" +
            (i % 2 == 0 ? "80" : "20") + " percent\"\n";
    if (++made >= components && i > 0) break;
    if (i > 0 && made < components) {
      text += "[components.p" + std::to_string(i) +
              "]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"0.1 bar\"\nin = \"" + tank(i - 1) +
              "\"\nout = \"" + tank(i) + "\"\n";
      ++made;
    }
    if (i % 4 == 0 && i > 0 && made < components) {
      text += "[components.s" + std::to_string(i) + "]\ntype = \"level_sensor\"\nof = \"" + tank(i) + "\"\n";
      ++made;
    }
  }
  return text;
}

// The last tank may stand alone, which is an error: it is left away.
std::string connected_row(std::size_t components, bool implicit) {
  std::string text = row_text(components, implicit);
  const std::size_t last = text.rfind("[components.t");
  if (text.find("[components.p", last) == std::string::npos && last != std::string::npos) text.resize(last);
  return text;
}

double scan_cost(ModelPlant& plant) {
  constexpr auto kPatience = 500ms;
  const auto start = Clock::now();
  int scans = 0;
  while (Clock::now() - start < kPatience) {
    for (int i = 0; i < 10; ++i) {
      if (plant.advance(10ms) != core::PlantStatus::Good) return std::nan("");
      (void)plant.truth(core::TruthId(0));
    }
    scans += 10;
  }
  return microseconds_since(start) / scans;
}

}  // namespace

ModelFigures measure_model(const std::vector<Outputs>& job, int repeats) {
  ModelFigures figures;
  figures.us = 1e300;
  for (int i = 0; i < repeats; ++i) figures.us = std::min(figures.us, run_job(job));
  figures.realtime_factor = 1e4 / figures.us;
  const auto model = load(kBench);
  auto built_in = assemblies::TankBench::create({}).value();
  for (std::size_t i = 0; i < std::min<std::size_t>(job.size(), 60'000); ++i) {
    operate(job[i], *model);
    operate(job[i], *built_in);
    model->advance(10ms);
    built_in->advance(10ms);
    for (const char* level :
         {"level_f1_percent", "level_v1_percent", "level_a1_percent", "level_a2_percent"}) {
      const double one = model->truth(core::find_truth(*model, level).value());
      const double other = built_in->truth(core::find_truth(*built_in, level).value());
      figures.largest_level_error_percent =
          std::max(figures.largest_level_error_percent, std::abs(one - other));
    }
  }
  return figures;
}

Growth measure_row(std::size_t components) {
  const support::TemporaryFolder folder;
  const auto file = folder / "plant.toml";
  Growth growth;
  std::ofstream(file) << connected_row(components, false);
  const auto start = Clock::now();
  const auto plant = load(file);
  growth.load_ms = microseconds_since(start) / 1e3;
  growth.components = plant->model().text.components.size();
  growth.states = plant->model().states;
  growth.scan_us = scan_cost(*plant);
  growth.realtime_factor = 1e4 / growth.scan_us;
  std::ofstream(file) << connected_row(components, true);
  growth.implicit_scan_us = scan_cost(*load(file));
  return growth;
}

std::size_t library_size() {
  return components::library::catalogue().size();
}

}  // namespace stepwright::bench
