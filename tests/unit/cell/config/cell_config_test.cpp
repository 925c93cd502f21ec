#include "cell/config/cell_config.h"

#include <gtest/gtest.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "cell/missions/planning/table/planning_table.h"

namespace stepwright::config {
namespace {

class CellConfigTest : public testing::Test {
 protected:
  // Of this process alone: each case runs in its own, several at a time.
  CellConfigTest() : folder_(testing::TempDir() + "cell_config." + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~CellConfigTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "cell.toml") << text;
    return folder_ / "cell.toml";
  }
  missions::PlanningTable planning_of(const std::string& text) const {
    return *missions::table_as<missions::PlanningTable>(load_cell_config(write(text)).value().mission.table);
  }

  std::filesystem::path folder_;
};

TEST(CellConfigBench, WhenTheBenchIsLoaded_ThenItIsSound) {
  const auto config =
      load_cell_config(STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/cell.toml", {"plant.seed=7"});
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->name, "bench");
  EXPECT_EQ(config->plant.seed, 7u);
  EXPECT_EQ(config->plant.ports.size(), 12u);
}

TEST(CellConfigLine, WhenFourDivertersAreLoaded_ThenThePlantHasThem) {
  const auto config = load_cell_config(STEPWRIGHT_SOURCE_DIR "/tests/cells/four_diverters/cell.toml");
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->plant.diverters, 4u);
  EXPECT_EQ(config->plant.boxes, 6u);
}

TEST(CellConfigBench, WhenThereIsNoFile_ThenTheErrorNamesIt) {
  const auto config = load_cell_config("/nonexistent/cell.toml");
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error()[0].where.file, "/nonexistent/cell.toml");
}

TEST_F(CellConfigTest, WhenAFileThatIsWrittenIsOneThatIsRead_ThenItsLineSaysSo) {
  std::ofstream(folder_ / "main.st") << "PROGRAM Main END_PROGRAM\n";
  const std::string sources = "[runtime]\nsources = [\"main.st\"]\n";
  for (const char* text :
       {"program = \"./main.st\"\n", "program = \"cell.toml\"\n", "program = \"../\"\n",
        "[retain]\nfile = \"../main.st\"\n", "[log]\nfile = \"main.st\"\n",
        "[record]\nfile = \"../cell.toml\"\n", "[retain]\nfile = \"../x\"\n[log]\nfile = \"x\"\n"}) {
    const auto config = load_cell_config(write("cell.state_dir = \"state\"\n" + sources + text));
    ASSERT_FALSE(config.has_value()) << text;
    EXPECT_EQ(config.error().front().code, "C0472") << text;
    EXPECT_GE(config.error().front().where.line, 4u) << text;
    EXPECT_NE(config.error().front().hint, "") << text;
  }
}

TEST_F(CellConfigTest, WhenTheProgramIsAFileOfSomebodyElse_ThenItIsNotTaken) {
  std::ofstream(folder_ / "main.st") << "PROGRAM Main END_PROGRAM\n";
  const std::string text = "[runtime]\nsources = [\"main.st\"]\nprogram = \"line.swb\"\n";
  for (const char* content : {"SWB1 and more", ""}) {
    std::ofstream(folder_ / "line.swb") << content;
    EXPECT_TRUE(load_cell_config(write(text)).has_value()) << content;
  }
  std::ofstream(folder_ / "line.swb") << "a letter";
  const auto config = load_cell_config(write(text));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error().front().code, "C0472");
  EXPECT_EQ(config.error().front().where.line, 3u);
}

TEST_F(CellConfigTest, WhenTheLogIsAFileOfSomebodyElse_ThenItIsNotTaken) {
  const std::string text = "[log]\nfile = \"cell.log\"\n";
  for (const char* content : {"", "2026-11-30T10:00:00.000Z info    runtime: ends\n"}) {
    std::ofstream(folder_ / "cell.log") << content;
    EXPECT_TRUE(load_cell_config(write(text)).has_value()) << content;
  }
  std::ofstream(folder_ / "cell.log") << "a thesis";
  const auto config = load_cell_config(write(text));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error().front().code, "C0472");
  EXPECT_EQ(config.error().front().where.line, 2u);
}

TEST_F(CellConfigTest, WhenAnOperatorStartsRuns_ThenThatIsSoOfAFleetToo) {
  const auto planned = load_cell_config(write("[executive]\nstart = \"operator\"\nwhat_if_ms = 2_000\n"));
  ASSERT_TRUE(planned.has_value()) << result::to_string(planned.error());
  EXPECT_EQ(planned->executive.start, RunStart::Operator);
  EXPECT_EQ(planned->executive.what_if, std::chrono::milliseconds(2'000));
  std::ofstream(folder_ / "hall.json") << "{}";
  const auto fleet =
      load_cell_config(write("[fleet]\nproblem = \"hall.json\"\n[executive]\nstart = \"operator\"\n"));
  ASSERT_TRUE(fleet.has_value()) << result::to_string(fleet.error());
  EXPECT_EQ(fleet->executive.start, RunStart::Operator);
  EXPECT_FALSE(load_cell_config(write("[executive]\nstart = \"later\"\n")).has_value());
}

TEST_F(CellConfigTest, WhenOutputsAreReal_ThenAnOperatorStartsRunsUnlessTheCellSaysOtherwise) {
  const std::string real = "[clock]\nmode = \"real\"\n[io]\nkind = \"shared_memory\"\n";
  EXPECT_EQ(load_cell_config(write(""))->executive.start, RunStart::Auto);
  EXPECT_EQ(load_cell_config(write(real))->executive.start, RunStart::Operator);
  EXPECT_EQ(load_cell_config(write(real + "[executive]\nstart = \"auto\"\n"))->executive.start,
            RunStart::Auto);
  std::ofstream(folder_ / "hall.json") << "{}";
  const std::string fleet = "[fleet]\nproblem = \"hall.json\"\n";
  EXPECT_EQ(load_cell_config(write(real + fleet))->executive.start, RunStart::Operator);
  EXPECT_EQ(load_cell_config(write(fleet))->executive.start, RunStart::Auto);
}

TEST_F(CellConfigTest, WhenInputsAreReal_ThenTheFirstPlanStartsFromThemUnlessTheCellSaysOtherwise) {
  for (const char* file : {"domain.pddl", "problem.pddl", "binding.toml"})
    std::ofstream(folder_ / file) << "";
  const std::string planning =
      "[planning]\ndomain = \"domain.pddl\"\nproblem = \"problem.pddl\"\nbinding = \"binding.toml\"\n";
  const std::string real = "[clock]\nmode = \"real\"\n[io]\nkind = \"shared_memory\"\n" + planning;
  EXPECT_EQ(planning_of(planning).initial, missions::InitialState::Problem);
  EXPECT_EQ(planning_of(real).initial, missions::InitialState::Observed);
  EXPECT_EQ(planning_of(real + "initial = \"problem\"\n").initial, missions::InitialState::Problem);
  EXPECT_FALSE(load_cell_config(write(planning + "initial = \"guessed\"\n")).has_value());
}

TEST_F(CellConfigTest, WhenNobodyDescribesAPlant_ThenThereIsNone) {
  EXPECT_EQ(load_cell_config(write(""))->plant.kind, "none");
  EXPECT_EQ(load_cell_config(write("[plant]\nseed = 3\n"))->plant.kind, "tank_bench");
}

TEST_F(CellConfigTest, WhenAPlanningFileIsMissing_ThenTheErrorStandsAtItsKey) {
  const auto config = load_cell_config(write("[planning]\ndomain = \"gone.pddl\"\n"));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error()[0].where.line, 2u);
}

TEST_F(CellConfigTest, WhenProgramsAreOfAnotherSystem_ThenItsDialectIsNamed) {
  const std::string files = "domain = \"cell.toml\"\nproblem = \"cell.toml\"\nbinding = \"cell.toml\"\n";
  const auto config = load_cell_config(write("[planning]\n" + files + "dialect = \"codesys\"\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->mission.table->dialect().name, "codesys");
  const auto wrong = load_cell_config(write("[planning]\n" + files + "dialect = \"basic\"\n"));
  ASSERT_FALSE(wrong.has_value());
  EXPECT_EQ(wrong.error()[0].where.line, 5u);
}

TEST_F(CellConfigTest, WhenALineHasMoreDivertersOrBoxesThanThereAre_ThenEachIsReportedAtItsKey) {
  const auto config = load_cell_config(write("[plant]\nkind = \"sorting_line\"\ndiverters = 5\nboxes = 0\n"));
  ASSERT_FALSE(config.has_value());
  ASSERT_EQ(config.error().size(), 2u) << result::to_string(config.error());
  EXPECT_EQ(config.error()[0].where.line, 3u);
  EXPECT_EQ(config.error()[1].where.line, 4u);
}

TEST_F(CellConfigTest, WhenThereIsNoPlanning_ThenTheCellIsARuntimeOnly) {
  const auto config = load_cell_config(write("[cell]\nname = \"line\"\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->mission.table, nullptr);
  EXPECT_EQ(config->mission.name, "");
  EXPECT_NE(missions::mission_tables().find("[planning]"), std::string::npos);
}

TEST_F(CellConfigTest, WhenSeveralThingsAreWrong_ThenAllAreReported) {
  const auto config =
      load_cell_config(write("[clock]\nmode = \"simulatd\"\nspeed = -1\n[hmi]\nport = 70000\n[typo]\n"));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error().size(), 4u) << result::to_string(config.error());
}

TEST_F(CellConfigTest, WhenThePlantIsKept_ThenItIsInMemoryUnderItsStateFolder) {
  const auto path = [&](const std::string& state_dir) {
    return load_cell_config(write("[cell]\nstate_dir = \"" + state_dir + "\"\n"))->plant_memory_path();
  };
  struct statfs system {};
  ASSERT_EQ(statfs(path("a").parent_path().c_str(), &system), 0);
  EXPECT_EQ(system.f_type, TMPFS_MAGIC);
  EXPECT_EQ(path("a"), path("b/../a"));
  EXPECT_EQ(path("a"), path(folder_ / "a"));
  EXPECT_NE(path("a"), path("b"));
}

TEST_F(CellConfigTest, WhenTheTemporaryFolderIsGone_ThenThereIsStillAStateFolder) {
  const char* const before = getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", "/nonexistent", 1);
  const auto config = load_cell_config(write("[cell]\nname = \"line\"\n"));
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
  ASSERT_TRUE(config.has_value());
  EXPECT_EQ(config->state_dir, "/tmp/stepwright-" + std::to_string(geteuid()) + "/line");
}

TEST_F(CellConfigTest, WhenNothingIsSaidOfRetain_ThenValuesAreKeptInTheStateFolderAndProgramsAreNot) {
  const auto config = load_cell_config(write("[cell]\nstate_dir = \"s\"\n"));
  ASSERT_TRUE(config.has_value());
  EXPECT_EQ(config->retain.file, folder_ / "s" / "retain.store");
  EXPECT_EQ(config->retain.period.count(), 100);
  EXPECT_EQ(config->retain.policy, RetainPolicy::Carry);
  EXPECT_TRUE(config->boot.program.empty());
  EXPECT_TRUE(config->boot.keep.empty());
  EXPECT_FALSE(config->boot.autostart);
}

TEST_F(CellConfigTest, WhenRetainAndBootAreSet_ThenPathsHaveTheirFolders) {
  const auto config = load_cell_config(
      write("[cell]\nstate_dir = \"s\"\n[retain]\nfile = \"\"\nperiod_ms = 7\npolicy = \"refuse\"\n"
            "[runtime]\nprogram = \"line.swb\"\nautostart = true\nboot = true\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_TRUE(config->retain.file.empty());
  EXPECT_EQ(config->retain.period.count(), 7);
  EXPECT_EQ(config->retain.policy, RetainPolicy::Refuse);
  EXPECT_EQ(config->boot.program, folder_ / "line.swb");
  EXPECT_EQ(config->boot.keep, folder_ / "s" / "boot.swb");
}

TEST_F(CellConfigTest, WhenSourcesAreNamed_ThenTheProgramIsMadeOfThem) {
  std::ofstream(folder_ / "line.st") << "x";
  const auto config = load_cell_config(
      write("[cell]\nstate_dir = \"s\"\n[runtime]\nsources = [\"line.st\"]\nautostart = true\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->boot.sources, std::vector<std::filesystem::path>{folder_ / "line.st"});
  EXPECT_EQ(config->boot.program, folder_ / "s" / "program.swb");
  const auto named = load_cell_config(write("[runtime]\nsources = [\"line.st\"]\nprogram = \"line.swb\"\n"));
  ASSERT_TRUE(named.has_value()) << result::to_string(named.error());
  EXPECT_EQ(named->boot.program, folder_ / "line.swb");
}

TEST_F(CellConfigTest, WhenRetainIsWrong_ThenEachPlaceIsNamed) {
  const std::pair<const char*, const char*> wrong[] = {
      {"[retain]\nperiod_ms = 0\n", "cell.toml:2:13: C0004"},
      {"[retain]\npolicy = \"maybe\"\n", "cell.toml:2:10: C000"},
      {"[retain]\nfiles = \"x\"\n", "cell.toml:2:1: C0002"},
      {"[runtime]\nautostart = true\n", "cell.toml:2:13: C0006"},
      {"[runtime]\nsources = [\"gone.st\"]\n", "cell.toml:2:11: C0006: there is no file"},
  };
  for (const auto& [text, place] : wrong) {
    const auto config = load_cell_config(write(text));
    ASSERT_FALSE(config.has_value()) << text;
    EXPECT_NE(result::to_string(config.error()).find(place), std::string::npos)
        << result::to_string(config.error());
  }
}

TEST_F(CellConfigTest, WhenAnOverrideHasNoValue_ThenItSaysHowOneIsWritten) {
  const auto config = load_cell_config(write("[cell]\nname = \"line\"\n"), {"nonsense"});
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(result::to_string(config.error()),
            "--set nonsense: C0001: this is not KEY=VALUE: there is no '='\n  hint: for example --set "
            "plant.seed=7");
}

TEST_F(CellConfigTest, WhenFaultsAreListed_ThenTheyAreReadInOrder) {
  for (const char* file : {"domain.pddl", "problem.pddl", "binding.toml"})
    std::ofstream(folder_ / file) << "x";
  const auto config =
      load_cell_config(write("[planning]\ndomain = \"domain.pddl\"\nproblem = \"problem.pddl\"\nbinding = "
                             "\"binding.toml\"\n[[faults]]\nat_s = 3.5\nname = \"leak_a1\"\nvalue = 0.2\n"
                             "[[faults]]\nat_s = 9\nname = \"(demand c1)\"\nvalue = 8\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  ASSERT_EQ(config->faults.size(), 2u);
  EXPECT_EQ(config->faults[1].name, "(demand c1)");
  EXPECT_DOUBLE_EQ(config->faults[0].at_s, 3.5);
}

TEST_F(CellConfigTest, WhenNoPlannerTakesAChangedDemand_ThenItIsRefusedAtItsPlace) {
  std::ofstream(folder_ / "problem.json") << "{}";
  for (const std::string mission : {"", "[ltl]\nproblem = \"problem.json\"\n"}) {
    const auto config =
        load_cell_config(write(mission + "[[faults]]\nat_s = 9\nname = \"(demand c1)\"\nvalue = 8\n"));
    ASSERT_FALSE(config.has_value()) << mission;
    EXPECT_EQ(config.error()[0].code, "C0449");
    EXPECT_EQ(config.error()[0].where.line, mission.empty() ? 3u : 5u);
  }
}

TEST_F(CellConfigTest, WhenARecordingIsConfigured_ThenItsFileIsInTheStateFolder) {
  EXPECT_TRUE(load_cell_config(write(""))->record.file.empty());
  const auto config = load_cell_config(
      write("[cell]\nstate_dir = \"state\"\n[record]\nfile = \"run.swrec\"\nmax_mb = 5\nhash_every = 2\n"));
  ASSERT_TRUE(config) << result::to_string(config.error());
  EXPECT_EQ(config->record.file, folder_ / "state/run.swrec");
  EXPECT_EQ(config->record.max_mb, 5u);
  EXPECT_EQ(config->record.hash_every, 2u);
  EXPECT_EQ(load_cell_config(write("[record]\nfile = \"/var/run.swrec\"\n"))->record.file, "/var/run.swrec");
  const auto wrong = load_cell_config(write("[record]\nfiel = \"x\"\nhash_every = 0\n"));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().size(), 2u);
}

TEST_F(CellConfigTest, WhenAnOverrideIsWrong_ThenItIsNamedInsteadOfALine) {
  const auto config = load_cell_config(write("[cell]\nname = \"line\"\n"), {"plant.seed=-4"});
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(result::to_string(config.error()[0]).substr(0, 23), "--set plant.seed=-4: C0");
}

TEST_F(CellConfigTest, WhenFaultsAreListed_ThenTheyKeepTheirPlaces) {
  const auto config = load_cell_config(write(
      "[safe_state.outputs]\n\"%QX0.0\" = \"one\"\n[[faults]]\nat_s = 1\nname = \"leak_a1\"\nvalue = 1\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->faults.at(0).where.line, 5u);
}

TEST_F(CellConfigTest, WhenANameCannotNameARuntime_ThenItIsRefusedAtItsPlace) {
  for (const char* text : {"[cell]\nname = \"a b\"\n", "[dds]\nruntime_id = \"*\"\n"}) {
    const auto config = load_cell_config(write(text));
    ASSERT_FALSE(config.has_value()) << text;
    EXPECT_EQ(config.error()[0].code, "C0461");
    EXPECT_EQ(config.error()[0].where.line, 2u);
  }
}

TEST_F(CellConfigTest, WhenTheStateFolderIsTooLongForASocket_ThenItIsRefusedAtItsPlace) {
  const auto config = load_cell_config(write("[cell]\nstate_dir = \"" + std::string(120, 'x') + "\"\n"));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error()[0].code, "C0462");
  EXPECT_EQ(config.error()[0].where.line, 2u);
}

TEST_F(CellConfigTest, WhenTheModbusClientsSocketIsTheLongerOne_ThenItCounts) {
  // The runtime's socket has 107 bytes, which an address can hold.
  const std::string cell = "[cell]\nstate_dir = \"/" + std::string(93, 'x') + "\"\n";
  EXPECT_TRUE(load_cell_config(write(cell)));
  const auto config = load_cell_config(write(
      cell +
      "[clock]\nmode = \"real\"\n[io]\nkind = \"modbus\"\n[[modbus.device]]\nname = \"d\"\nhost = \"h\"\n"
      "[[modbus.device.group]]\ntags = [{ address = \"%IW0\", holding = 1 }]\n"));
  ASSERT_FALSE(config.has_value());
  EXPECT_EQ(config.error()[0].code, "C0462");
  EXPECT_NE(config.error()[0].message.find("modbus-client.sock"), std::string::npos);
}

TEST_F(CellConfigTest, WhenAnInterfaceIsNoAddress_ThenItIsRefusedAtItsPlace) {
  for (const char* text :
       {"[dds]\ninterfaces = [\"eth0\"]\n", "[dds]\npeers = [\"1.2.3\"]\n", "[dds]\ninterfaces = []\n"}) {
    const auto config = load_cell_config(write(text));
    ASSERT_FALSE(config.has_value()) << text;
    EXPECT_EQ(config.error()[0].code, "C0466");
    EXPECT_EQ(config.error()[0].where.line, 2u);
  }
}

TEST_F(CellConfigTest, WhenTheLogIsConfigured_ThenItsFileIsTakenFromTheFolder) {
  const auto config =
      load_cell_config(write("[log]\nformat = \"json\"\nlevel = \"warning\"\nfile = "
                             "\"cell.log\"\nlimit_per_s = 3\nmax_mb = 5\nkeep = 2\n"));
  ASSERT_TRUE(config.has_value()) << result::to_string(config.error());
  EXPECT_EQ(config->log.format, log::LogFormat::Json);
  EXPECT_EQ(config->log.level, log::LogLevel::Warning);
  EXPECT_EQ(config->log.file, folder_ / "cell.log");
  EXPECT_EQ(config->log.limit_per_s, 3u);
  EXPECT_EQ(config->log.max_mb, 5u);
  EXPECT_EQ(config->log.keep, 2u);
}

TEST_F(CellConfigTest, WhenOneThingIsWrong_ThenTheReadingStillHasTheRest) {
  const CellReading reading = read_cell_config(write("[clock]\nmood = \"real\"\n[plant]\nseed = 9\n"));
  EXPECT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.config.plant.seed, 9u);
}

TEST_F(CellConfigTest, WhenTheRuntimeHasALimitOfMemory_ThenItIsRead) {
  EXPECT_EQ(load_cell_config(write(""))->memory_limit_mb, 0u);
  EXPECT_EQ(load_cell_config(write("[runtime]\nmemory_limit_mb = 200\n"))->memory_limit_mb, 200u);
  EXPECT_FALSE(load_cell_config(write("[runtime]\nmemory_limit_mb = -1\n")).has_value());
}

}  // namespace
}  // namespace stepwright::config
