#include "cell/runtime/tugger_plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "cell/runtime/cell_io.h"
#include "ladder/driver/compile.h"
#include "supervisor/map/map_file.h"
#include "tests/support/lock_step/host_machine.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::cell_runtime {
namespace {

constexpr const char* kScene = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "border", "name": "border"}, "geometry": {"type": "Polygon",
 "coordinates": [[[0, 0], [30, 0], [30, 20], [0, 20], [0, 0]]]}},
{"type": "Feature", "properties": {"kind": "obstacle", "name": "rack"}, "geometry": {"type": "Polygon",
 "coordinates": [[[10, 8], [20, 8], [20, 12], [10, 12], [10, 8]]]}},
{"type": "Feature", "properties": {"kind": "proposition", "name": "dock"}, "geometry": {"type": "Polygon",
 "coordinates": [[[2, 2], [4, 2], [4, 4], [2, 4], [2, 2]]]}},
{"type": "Feature", "properties": {"kind": "proposition", "name": "store"}, "geometry": {"type": "Polygon",
 "coordinates": [[[25, 15], [28, 15], [28, 18], [25, 15]]]}}]})";

const std::string kStart = "[plant.start]\nx_m = 8.0\ny_m = 4.0\n";

class TuggerCell : public testing::Test {
 protected:
  config::CellReading read(const std::string& plant, const std::string& more = "") {
    const std::filesystem::path file = folder_.path() / "cell.toml";
    std::ofstream(folder_.path() / "hall.geojson") << kScene;
    std::ofstream(file) << "[plant]\nkind = \"tugger\"\n"
                        << plant << more << "[cell]\nstate_dir = \"" << folder_.path().string() << "\"\n";
    return config::read_cell_config(file);
  }
  void expect(const std::string& plant, const std::string& code, std::uint32_t line) {
    auto reading = read(plant);
    const result::Diagnostics problems =
        reading.problems.empty() ? check_cell_io(reading.config) : reading.problems;
    ASSERT_FALSE(problems.empty()) << plant;
    EXPECT_EQ(problems.front().code, code) << result::to_string(problems);
    EXPECT_EQ(problems.front().where.line, line) << result::to_string(problems);
  }

  support::TemporaryFolder folder_;
};

TEST_F(TuggerCell, WhenTheCellIsRight_ThenItsPlantAndWiresAreMade) {
  const auto reading = read("scene = \"hall.geojson\"\ntrailers = 2\nmost_trailers = 3\n" + kStart +
                                "heading_deg = 180.0\n[plant.train]\nspacing_m = 1.1\n"
                                "[[plant.blockages]]\nx_m = 5.0\ny_m = 9.0\nlength_m = 2.0\nwidth_m = 1.0\n",
                            "[[faults]]\nat_s = 1.0\nname = \"block_1\"\nvalue = 1.0\n");
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  EXPECT_TRUE(check_cell_io(reading.config).empty()) << result::to_string(check_cell_io(reading.config));
  const auto parameters = tugger_parameters(reading.config.plant);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->trailers, 2u);
  EXPECT_EQ(parameters->most_trailers, 3u);
  EXPECT_NEAR(parameters->start.angle, 3.14159, 1e-4);
  EXPECT_EQ(parameters->links.spacing_m, 1.1);
  ASSERT_EQ(parameters->places.size(), 2u);
  EXPECT_EQ(parameters->places[1].name, "store");
  ASSERT_EQ(parameters->blockages.size(), 1u);
  EXPECT_EQ(parameters->blockages[0].ring.size(), 4u);

  const auto wires = plant_wires(reading.config);
  const auto address_of = [&](const std::string& port) {
    for (const auto& wire : wires) {
      if (wire.port == port) return wire.address;
    }
    return std::string();
  };
  EXPECT_EQ(wires.size(), 5u + 3u + 1u + 3u + 2u + 3u);
  EXPECT_EQ(address_of("x"), "%IW0");
  EXPECT_EQ(address_of("hitch_3"), "%IW7");
  EXPECT_EQ(address_of("trailers"), "%IW8");
  EXPECT_EQ(address_of("way_free"), "%IX18.2");
  EXPECT_EQ(address_of("at_dock"), "%IX19.0");
  EXPECT_EQ(address_of("at_store"), "%IX19.1");
  EXPECT_EQ(address_of("set_lock"), "%QW1");
  EXPECT_EQ(address_of("enable"), "%QX4.0");
}

TEST_F(TuggerCell, WhenTheRuntimeIsKilled_ThenTheNextOneGoesOnFromWhereTheTrainStands) {
  const auto reading = read("scene = \"hall.geojson\"\nuncertainty = false\n" + kStart);
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  std::vector<std::byte> inputs(reading.config.image.input_bytes);
  std::vector<std::byte> outputs(reading.config.image.output_bytes);
  const auto x_cm = [&] { return std::to_integer<int>(inputs[0]) + 256 * std::to_integer<int>(inputs[1]); };
  outputs[0] = std::byte{0xE8};  // 1000 mm/s
  outputs[1] = std::byte{0x03};
  outputs[4] = std::byte{1};
  auto first = CellIo::create(reading.config);
  ASSERT_TRUE(first) << result::to_string(first.error());
  for (std::int64_t scan = 0; scan < 300; ++scan) {
    (*first)->driver().read_inputs(scan * 10'000'000, inputs);
    (*first)->driver().write_outputs(scan * 10'000'000, outputs);
  }
  const int stood_cm = x_cm();
  EXPECT_GT(stood_cm, 1000);
  // The file of the first one is there as long as it is not closed.
  auto second = CellIo::create(reading.config);
  ASSERT_TRUE(second) << result::to_string(second.error());
  (*second)->driver().read_inputs(0, inputs);
  EXPECT_NEAR(x_cm(), stood_cm, 1);
}

// The blocks of the library drive it as they drive a forklift; the program stops when the scanner sees
// something.
constexpr const char* kProgram = R"(
PROGRAM Main
VAR
  X AT %IW0 : INT; Y AT %IW1 : INT; Heading AT %IW2 : INT; Speed AT %IW3 : INT; Lock AT %IW4 : INT;
  Bumper AT %IX22.0 : BOOL; EstopOk AT %IX22.1 : BOOL; WayFree AT %IX22.2 : BOOL;
  SetSpeed AT %QW0 : INT; SetLock AT %QW1 : INT; Enable AT %QX4.0 : BOOL; ErrorID AT %QW3 : UINT;
  Tractor : VEHICLE_REF := (Wheelbase := 1.0, MaxSpeed := 2.0, MaxLock := 1.0, LockRate := 1.0);
  Read : MC_ReadVehicle; Power : MC_VehiclePower; Run : MC_RunVehicle;
  Refusal : UINT;
END_VAR
  Tractor.MeasuredX := INT_TO_REAL(X) * 0.01;
  Tractor.MeasuredY := INT_TO_REAL(Y) * 0.01;
  Tractor.MeasuredHeading := INT_TO_REAL(Heading) * 0.000174532925;
  Tractor.MeasuredSpeed := INT_TO_REAL(Speed) * 0.001;
  Tractor.MeasuredLock := INT_TO_REAL(Lock) * 0.000174532925;
  Tractor.Bumper := Bumper;
  Tractor.SafetyOk := EstopOk;
  Read(CYCLE := T#10ms, Vehicle := Tractor);
  Power(Enable := TRUE, Vehicle := Tractor);
  IF Tractor.State = mcGroupStandby THEN
    Refusal := MC_BeginVehicle(State := mcGroupMoving, Vehicle := Tractor);
  END_IF;
  Tractor.WishSpeed := SEL(WayFree, 0.0, 1.5);
  Tractor.WishLock := 0.0;
  Run(CYCLE := T#10ms, Vehicle := Tractor);
  SetSpeed := REAL_TO_INT(Tractor.SetSpeed * 1000.0);
  SetLock := REAL_TO_INT(Tractor.SetLock * 5729.578);
  Enable := Tractor.DriveOn;
  ErrorID := Tractor.ErrorID;
END_PROGRAM
)";

TEST_F(TuggerCell, WhenBlocksOfTheLibraryDriveIt_ThenItStopsInFrontOfWhatStandsInItsWay) {
  const auto reading = read("scene = \"hall.geojson\"\n" + kStart +
                            "[[plant.blockages]]\nx_m = 20.0\ny_m = 4.0\nlength_m = 2.0\nwidth_m = 1.0\n");
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  auto compiled = driver::compile({.texts = {{"tugger.st", kProgram}}});
  ASSERT_TRUE(compiled) << result::to_string(compiled.error());
  auto io = CellIo::create(reading.config);
  ASSERT_TRUE(io) << result::to_string(io.error());
  support::HostMachine machine(std::move(compiled->container), host::EngineKind::Auto, 100'000'000);
  std::vector<std::byte> inputs(reading.config.image.input_bytes);
  std::vector<std::byte> outputs(reading.config.image.output_bytes);
  host::PlantAccess& plant = *(*io)->plant();
  ASSERT_TRUE(plant.inject_fault("block_1", 1.0));
  for (std::int64_t scan = 0; scan < 1'500; ++scan) {
    ASSERT_EQ((*io)->driver().read_inputs(10'000'000 * scan, inputs), image::IoStatus::Good);
    const auto used = std::span(inputs).first(machine.image().inputs().size());
    ASSERT_EQ(machine.scan(used).state, scan::ScanState::Running);
    std::ranges::copy(machine.image().outputs(), outputs.begin());
    ASSERT_EQ((*io)->driver().write_outputs(10'000'000 * scan, outputs), image::IoStatus::Good);
  }
  std::vector<double> values(plant.value_names().size());
  plant.read_values(values);
  const auto truth = [&](const std::string& name) {
    const auto names = plant.value_names();
    return values.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  };
  EXPECT_EQ(outputs[6], std::byte{0});  // no error
  EXPECT_EQ(outputs[4], std::byte{1});
  EXPECT_EQ(truth("contacts"), 0.0);
  EXPECT_NEAR(truth("true_speed"), 0.0, 0.02);
  EXPECT_GT(truth("true_x"), 19.0 - 2.5 - 0.45);
  EXPECT_LT(truth("true_x"), 19.0 - 0.45 - 0.3);
  EXPECT_GT(truth("smallest_gap"), 0.3);
}

TEST_F(TuggerCell, WhenAFigureIsWrong_ThenItsKeyIsNamed) {
  const std::string scene = "scene = \"hall.geojson\"\n";
  expect(kStart, "C0006", 2);  // no hall
  expect(scene, "C0006", 2);   // stands nowhere
  expect("scene = \"none.geojson\"\n" + kStart, "C0006", 3);
  expect(scene + "trailers = 16\n" + kStart, "C0004", 4);
  expect(scene + "trailers = 4\nmost_trailers = 2\n" + kStart, "C0006", 5);
  expect(scene + kStart + "[plant.train]\nhitch_m = 0\n", "C0004", 8);
  expect(scene + kStart + "[plant.train]\nhitch = 1.0\n", "C0002", 8);
  expect(scene + kStart + "[plant.ports]\nhitch_6 = \"%IW0\"\n", "C0301", 8);
}

TEST_F(TuggerCell, WhenNoFigureIsGiven_ThenTheyAreThoseOfThePlant) {
  const auto reading = read("scene = \"hall.geojson\"\n" + kStart);
  const auto made = tugger_parameters(reading.config.plant);
  ASSERT_TRUE(made) << result::to_string(made.error());
  const assemblies::TuggerParameters plain;
  EXPECT_EQ(made->drive.top_speed_m_s, plain.drive.top_speed_m_s);
  EXPECT_EQ(made->drive.time_constant_s, plain.drive.time_constant_s);
  EXPECT_EQ(made->drive.acceleration_m_s2, plain.drive.acceleration_m_s2);
  EXPECT_EQ(made->drive.braking_m_s2, plain.drive.braking_m_s2);
  EXPECT_EQ(made->drive.spring_brake_m_s2, plain.drive.spring_brake_m_s2);
  EXPECT_EQ(made->drive.tractor_kg, plain.drive.tractor_kg);
  EXPECT_EQ(made->drive.trailer_kg, plain.drive.trailer_kg);
  EXPECT_EQ(made->steering.full_lock_rad, plain.steering.full_lock_rad);
  EXPECT_EQ(made->steering.time_constant_s, plain.steering.time_constant_s);
  EXPECT_EQ(made->steering.rate_rad_s, plain.steering.rate_rad_s);
  EXPECT_EQ(made->slip.drive_slip, plain.slip.drive_slip);
  EXPECT_EQ(made->slip.understeer_s2_m2, plain.slip.understeer_s2_m2);
  EXPECT_EQ(made->slip.hitch_slip_s2_m2, plain.slip.hitch_slip_s2_m2);
  EXPECT_EQ(made->noise.position_m, plain.noise.position_m);
  EXPECT_EQ(made->noise.heading_rad, plain.noise.heading_rad);
  EXPECT_EQ(made->noise.speed_m_s, plain.noise.speed_m_s);
  EXPECT_EQ(made->noise.hitch_rad, plain.noise.hitch_rad);
}

TEST_F(TuggerCell, WhenFiguresOfTheDriveAreGiven_ThenTheTrainHasThem) {
  const std::string all = "scene = \"hall.geojson\"\nuncertainty = false\n" + kStart +
                          "[plant.drive]\ntop_speed_m_s = 1.0\ntime_constant_s = 0.5\n"
                          "acceleration_m_s2 = 0.6\nbraking_m_s2 = 1.5\nspring_brake_m_s2 = 3.0\n"
                          "tractor_kg = 400.0\ntrailer_kg = 0.0\n"
                          "[plant.steering]\nfull_lock_rad = 0.7\ntime_constant_s = 0.2\nrate_rad_s = 0.5\n"
                          "[plant.slip]\ndrive_slip = 0.0\nundersteer_s2_m2 = 0.02\nhitch_slip_s2_m2 = 0.0\n"
                          "[plant.noise]\nposition_m = 0.5\n";
  const auto reading = read(all);
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  const auto made = tugger_parameters(reading.config.plant);
  ASSERT_TRUE(made) << result::to_string(made.error());
  EXPECT_EQ(made->drive.top_speed_m_s, 1.0);
  EXPECT_EQ(made->drive.time_constant_s, 0.5);
  EXPECT_EQ(made->drive.acceleration_m_s2, 0.6);
  EXPECT_EQ(made->drive.braking_m_s2, 1.5);
  EXPECT_EQ(made->drive.spring_brake_m_s2, 3.0);
  EXPECT_EQ(made->drive.tractor_kg, 400.0);
  EXPECT_EQ(made->drive.trailer_kg, 0.0);
  EXPECT_EQ(made->steering.full_lock_rad, 0.7);
  EXPECT_EQ(made->steering.time_constant_s, 0.2);
  EXPECT_EQ(made->steering.rate_rad_s, 0.5);
  EXPECT_EQ(made->slip.understeer_s2_m2, 0.02);
  EXPECT_EQ(made->slip.hitch_slip_s2_m2, 0.0);
  EXPECT_EQ(made->noise.position_m, 0.0) << "uncertainty = false";
  // And it drives with them: asked for 2 m/s it makes 1.
  std::vector<std::byte> inputs(reading.config.image.input_bytes);
  std::vector<std::byte> outputs(reading.config.image.output_bytes);
  outputs[0] = std::byte{0xD0};  // 2000 mm/s
  outputs[1] = std::byte{0x07};
  outputs[4] = std::byte{1};
  auto io = CellIo::create(reading.config);
  ASSERT_TRUE(io) << result::to_string(io.error());
  for (std::int64_t scan = 0; scan < 500; ++scan) {
    (*io)->driver().read_inputs(scan * 10'000'000, inputs);
    (*io)->driver().write_outputs(scan * 10'000'000, outputs);
  }
  EXPECT_NEAR(std::to_integer<int>(inputs[6]) + 256 * std::to_integer<int>(inputs[7]), 1000, 5);
}

TEST_F(TuggerCell, WhenAFigureOfTheDriveIsWrong_ThenItsKeyIsNamed) {
  const std::string scene = "scene = \"hall.geojson\"\n" + kStart;
  expect(scene + "[plant.drive]\ntop_speed_m_s = 0.0\n", "C0004", 8);
  expect(scene + "[plant.drive]\ntime_constant_s = -1.0\n", "C0004", 8);
  expect(scene + "[plant.drive]\ntop_speed = 1.0\n", "C0002", 8);
  expect(scene + "[plant.steering]\nfull_lock_rad = 1.6\n", "C0004", 8);
  expect(scene + "[plant.slip]\ndrive_slip = 1.0\n", "C0004", 8);
  expect(scene + "[plant.noise]\nposition_m = -0.1\n", "C0004", 8);
}

// Of 30 x 20 m in cells of half a metre: free, but for a block where the scene's rack is.
void write_hall_map(const std::filesystem::path& folder) {
  fleet::OccupancyGrid grid({.resolution_m = 0.5, .origin = {0, 0}, .columns = 60, .rows = 40});
  for (int column = 20; column < 40; ++column)
    for (int row = 16; row < 24; ++row) grid.set({column, row}, true);
  ASSERT_TRUE(fleet::write_map(grid, folder / "hall.yaml"));
}

constexpr const char* kPlaces = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "proposition", "name": "dock"}, "geometry": {"type": "Polygon",
 "coordinates": [[[2, 2], [4, 2], [4, 4], [2, 4], [2, 2]]]}}]})";

TEST_F(TuggerCell, WhenTheHallIsARosMap_ThenItsBlockedCellsAreWalls) {
  write_hall_map(folder_.path());
  std::ofstream(folder_.path() / "places.geojson") << kPlaces;
  const auto alone = read("map = \"hall.yaml\"\n" + kStart);
  ASSERT_TRUE(alone.problems.empty()) << result::to_string(alone.problems);
  const auto bare = tugger_parameters(alone.config.plant);
  ASSERT_TRUE(bare) << result::to_string(bare.error());
  EXPECT_TRUE(bare->places.empty());
  const auto reading = read("map = \"hall.yaml\"\nscene = \"places.geojson\"\n" + kStart);
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  const auto made = tugger_parameters(reading.config.plant);
  ASSERT_TRUE(made) << result::to_string(made.error());
  ASSERT_EQ(made->walls.size(), 1u);
  const auto corner = body2d::Vec2{30.0, 20.0};
  EXPECT_TRUE(std::ranges::any_of(made->walls[0].ring,
                                  [&](body2d::Vec2 at) { return at.x == corner.x && at.y == corner.y; }));
  ASSERT_EQ(made->obstacles.size(), 1u) << "blocked cells as one rectangle";
  EXPECT_EQ(made->obstacles[0].ring.front().x, 10.0);
  EXPECT_EQ(made->obstacles[0].ring.front().y, 8.0);
  ASSERT_EQ(made->places.size(), 1u);
  EXPECT_EQ(made->places[0].name, "dock");
  expect("map = \"hall.yaml\"\n[plant.start]\nx_m = 15.0\ny_m = 10.0\n", "C0322", 4);
}

TEST_F(TuggerCell, WhenTheMapIsWrong_ThenItSaysWhere) {
  write_hall_map(folder_.path());
  expect("scene = \"hall.yaml\"\n" + kStart, "C0006", 3);
  expect("map = \"none.yaml\"\n" + kStart, "C0006", 3);
  // A border of its own beside that of the map.
  expect("map = \"hall.yaml\"\nscene = \"hall.geojson\"\n" + kStart, "L0405", 0);
  const auto reading = read("map = \"hall.yaml\"\n" + kStart);
  ASSERT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  const auto expect_map = [&](const std::string& text, const std::string& code) {
    std::ofstream(folder_.path() / "hall.yaml") << text;
    const result::Diagnostics problems = check_cell_io(reading.config);
    ASSERT_FALSE(problems.empty()) << text;
    EXPECT_EQ(problems.front().code, code) << result::to_string(problems);
    EXPECT_NE(problems.front().where.file.find("hall."), std::string::npos) << result::to_string(problems);
  };
  expect_map("image: [", "F0102");
  expect_map("image: hall.pgm\nresolution: -1\norigin: [0, 0, 0]\n", "F0103");
  std::ofstream(folder_.path() / "hall.pgm") << "P5 no image";
  expect_map(
      "image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      "F0104");
}

TEST_F(TuggerCell, WhenALinkStandsInAWall_ThenTheStartIsNamed) {
  const std::string scene = "scene = \"hall.geojson\"\n";
  expect(scene + "[plant.start]\nx_m = 15.0\ny_m = 10.0\n", "C0322", 4);
  expect(scene + "[plant.start]\nx_m = 4.0\ny_m = 4.0\n", "C0322", 4);  // the last trailers are outside
  expect(scene + "[plant.start]\nx_m = -10.0\ny_m = 4.0\n", "C0322", 4);
}

TEST_F(TuggerCell, WhenTheSceneIsWrong_ThenItSaysWhy) {
  auto reading = read("scene = \"hall.geojson\"\n" + kStart);
  ASSERT_TRUE(reading.problems.empty());
  std::ofstream(folder_.path() / "hall.geojson") << "{}";
  const result::Diagnostics problems = check_cell_io(reading.config);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.front().code, "L0402");
  EXPECT_NE(problems.front().where.file.find("hall.geojson"), std::string::npos);

  std::string crossed = kScene;
  crossed.replace(crossed.find("[20, 12], [10, 12]"), 18, "[10, 12], [20, 12]");
  std::ofstream(folder_.path() / "hall.geojson") << crossed;
  const auto outline = tugger_parameters(reading.config.plant);
  ASSERT_FALSE(outline);
  EXPECT_EQ(outline.error().front().code, "C0321");
  EXPECT_NE(outline.error().front().where.file.find("hall.geojson"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::cell_runtime
