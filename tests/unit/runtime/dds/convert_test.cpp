#include "runtime/dds/internal/convert.h"

#include <gtest/gtest.h>

#include <limits>

namespace stepwright::dds::internal {
namespace {

const std::string kLong(5'000, 'x');  // beyond every bound of a text

StepEvent some_event() {
  StepEvent event;
  event.sequence = 3;
  event.scan = 41;
  event.time_ns = 400'000'000;
  event.kind = EventKind::Trap;
  event.program_digest = std::string(64, 'a');
  event.detail = "main.st:3: division by zero";
  event.image = {std::byte{1}, std::byte{255}};
  event.plant = {{"level_a1_percent", 49.5}};
  return event;
}

TEST(Convert, WhenAnEventTravels_ThenNothingIsLost) {
  const auto back = from_event(to_event("bench", 7, some_event()));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(*back, some_event());
}

TEST(Convert, WhenAnExtraCommandBreaksABound_ThenItIsDropped) {
  service::WriteBlock write;
  write.block = {std::string(64, 'a'), {{8, 0xFF, 7}}};
  const idl::ExtraCommand good = to_extra("bench", {1, 2, write});
  ASSERT_TRUE(from_extra(good).has_value());
  EXPECT_EQ(std::get<service::WriteBlock>(from_extra(good)->body).block, write.block);
  idl::ExtraCommand bad = good;
  bad.parts().resize(idl::BLOCK_BOUND + 1);
  EXPECT_FALSE(from_extra(bad).has_value());
  bad = good;
  bad.parts().clear();
  EXPECT_FALSE(from_extra(bad).has_value());
  bad = good;
  bad.program_digest(kLong);
  EXPECT_FALSE(from_extra(bad).has_value());
  bad = good;
  bad.kind(5);
  EXPECT_FALSE(from_extra(bad).has_value()) << "an unknown kind";
  for (std::uint8_t kind = 2; kind <= 4; ++kind) {
    bad = good;
    bad.kind(kind);
    EXPECT_TRUE(from_extra(bad).has_value());
    bad.parts().resize(2);
    EXPECT_FALSE(from_extra(bad).has_value()) << "one place at a time";
  }
}

TEST(Convert, WhenARequestNamesMemory_ThenItsProgramTravelsWithIt) {
  const host::ProgramBits place{std::string(64, 'a'), {8, 0xFF, 7}};
  const auto back = [](service::RequestBody body) {
    EXPECT_TRUE(is_extra(body));
    return from_extra(to_extra("bench", {1, 2, std::move(body)}))->body;
  };
  EXPECT_EQ(std::get<service::Force>(back(service::Force{{place, 60'000}})).force,
            (host::ForceRequest{place, 60'000}));
  EXPECT_EQ(std::get<service::Unforce>(back(service::Unforce{place})).place, place);
  EXPECT_EQ(std::get<service::Write>(back(service::Write{place})).place, place);
}

// Clients of earlier versions send bits without a program: the runtime refuses what names none.
TEST(Convert, WhenACommandHasBits_ThenTheyAreOfNoProgram) {
  idl::Command old;
  idl::BitsCommand bits;
  bits.byte_offset(8);
  bits.mask(0xFF);
  for (const idl::CommandKind kind : {idl::CMD_FORCE, idl::CMD_UNFORCE, idl::CMD_WRITE}) {
    old.body().bits(bits);
    old.body()._d(kind);
    const auto request = from_command(old);
    ASSERT_TRUE(request.has_value());
    if (const auto* force = std::get_if<service::Force>(&request->body))
      EXPECT_EQ(force->force.place.program_digest, "");
    else if (const auto* unforce = std::get_if<service::Unforce>(&request->body))
      EXPECT_EQ(unforce->place.program_digest, "");
    else
      EXPECT_EQ(std::get<service::Write>(request->body).place.program_digest, "");
  }
}

TEST(Convert, WhenTextsAreTooLongOutwards_ThenTheyAreCut) {
  StepEvent event = some_event();
  event.detail = kLong;
  event.plant[0].name = kLong;
  const auto back = from_event(to_event("bench", 7, event));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->detail.size(), idl::TEXT_BOUND);
  EXPECT_EQ(back->plant[0].name.size(), idl::NAME_BOUND);
}

TEST(Convert, WhenAnEventBreaksABound_ThenItIsDropped) {
  const idl::Event good = to_event("bench", 7, some_event());
  idl::Event bad = good;
  bad.detail(kLong);
  EXPECT_FALSE(from_event(bad).has_value());
  bad = good;
  bad.program_digest(kLong);
  EXPECT_FALSE(from_event(bad).has_value());
  bad = good;
  bad.kind(static_cast<std::uint8_t>(EventKind::RolledBack) + 1);
  EXPECT_FALSE(from_event(bad).has_value());
  bad = good;
  bad.plant()[0].name(kLong);
  EXPECT_FALSE(from_event(bad).has_value());
  bad = good;
  bad.plant().resize(idl::PLANT_BOUND + 1);
  EXPECT_FALSE(from_event(bad).has_value());
  bad = good;
  bad.image().resize(idl::IMAGE_BOUND + 1);
  EXPECT_FALSE(from_event(bad).has_value());
}

TEST(Convert, WhenAStatusBreaksABound_ThenItIsDropped) {
  const idl::Status good = to_status("bench", {}, true);
  ASSERT_TRUE(from_status(good).has_value());
  idl::Status bad = good;
  bad.detail(kLong);
  EXPECT_FALSE(from_status(bad).has_value());
  bad = good;
  bad.program_digest(kLong);
  EXPECT_FALSE(from_status(bad).has_value());
  bad = good;
  bad.state(4);
  EXPECT_FALSE(from_status(bad).has_value());
}

TEST(Convert, WhenASnapshotBreaksABound_ThenItIsDropped) {
  const idl::Snapshot good = to_snapshot("bench", {});
  ASSERT_TRUE(from_snapshot(good).has_value());
  idl::Snapshot bad = good;
  bad.program_digest(kLong);
  EXPECT_FALSE(from_snapshot(bad).has_value());
  bad = good;
  bad.image().resize(idl::IMAGE_BOUND + 1);
  EXPECT_FALSE(from_snapshot(bad).has_value());
}

TEST(Convert, WhenADownloadHasAMode_ThenItArrivesAndAnUnknownOneIsDropped) {
  for (const DownloadMode mode :
       {DownloadMode::Replace, DownloadMode::Change, DownloadMode::ChangeRestartCharts}) {
    const service::Request request{1, 2, service::DownloadCommit{100, {}, mode}};
    idl::Command sample = to_command("bench", request);
    const auto back = from_command(sample);
    ASSERT_TRUE(back);
    EXPECT_EQ(std::get<service::DownloadCommit>(back->body).mode, mode);
    idl::DownloadCommand unknown = sample.body().download();
    unknown.mode(3);
    sample.body().download(unknown);
    sample.body()._d(idl::CMD_DOWNLOAD_COMMIT);
    EXPECT_FALSE(from_command(sample));
  }
}

TEST(Convert, WhenAReplyTellsOfAChange_ThenItsFiguresArrive) {
  service::Reply reply;
  reply.change = {1, 2, 3, 4, 5, 6.5};
  const auto back = from_reply(to_reply("bench", reply));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->change, reply.change);
}

TEST(Convert, WhenAReplyBreaksABound_ThenItIsDropped) {
  service::Reply reply;
  reply.problems.push_back(
      {"R0002", result::Severity::Error, {"download", 0, 0}, "no program is loaded", "load one"});
  const idl::Reply good = to_reply("bench", reply);
  ASSERT_TRUE(from_reply(good).has_value());
  const auto refused = [&](auto&& change) {
    idl::Reply bad = good;
    change(bad);
    return !from_reply(bad).has_value();
  };
  EXPECT_TRUE(refused([](idl::Reply& r) { r.digest(kLong); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.data().resize(idl::CHUNK_BOUND + 1); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems().resize(idl::PROBLEM_BOUND + 1); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems()[0].code(kLong); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems()[0].file(kLong); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems()[0].message(kLong); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems()[0].hint(kLong); }));
  EXPECT_TRUE(refused([](idl::Reply& r) { r.problems()[0].severity(3); }));
}

TEST(Convert, WhenARequestIsTooLong_ThenItIsDropped) {
  const auto command = [](service::RequestBody body) { return to_command("bench", {1, 2, std::move(body)}); };
  EXPECT_TRUE(from_command(command(service::Stop{"enough"})).has_value());
  EXPECT_FALSE(from_command(command(service::Stop{kLong})).has_value());
  EXPECT_FALSE(from_command(command(service::InjectFault{kLong, 1.0})).has_value());
  const service::DownloadChunk chunk{0, std::vector<std::byte>(idl::CHUNK_BOUND + 1)};
  EXPECT_FALSE(from_chunk(to_chunk("bench", {1, 2, chunk})).has_value());
}

TEST(Convert, WhenARequestIsForTheSocketOnly_ThenItDoesNotTravel) {
  EXPECT_TRUE(travels(service::Start{}));
  EXPECT_TRUE(travels(service::Force{}));
  EXPECT_FALSE(travels(service::BeginRecording{"/tmp/x"}));
  EXPECT_FALSE(travels(service::EndRecording{}));
  EXPECT_FALSE(travels(service::Step{1}));
  EXPECT_FALSE(travels(service::Continue{}));
}

RuntimeHealth some_health() {
  RuntimeHealth health;
  health.readers = 3;
  health.tasks = {{"fast", 5'000, 2, 1, 4, {3, {1, 0, 2}}, {0, {5}}, {}}};
  health.io = IoKind::Modbus;
  health.devices_known = true;
  health.devices = {{"valves", "10.0.0.2:502", 7, true, false, "timeout", 1, 2, 3, 4, 5, 1.5, 2.5, 3.5, 40}};
  return health;
}

TEST(Convert, WhenNothingIsBehindTheInputs_ThenThatTravels) {
  RuntimeHealth health = some_health();
  health.io = IoKind::Nothing;
  const auto back = from_health(to_health("bench", health));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->io, IoKind::Nothing);
}

TEST(Convert, WhenHealthTravels_ThenNothingIsLost) {
  const auto back = from_health(to_health("bench", some_health()));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(*back, some_health());
}

TEST(Convert, WhenThereIsMoreHealthThanTravels_ThenTheFirstGoes) {
  RuntimeHealth health = some_health();
  health.devices.resize(idl::DEVICE_BOUND + 5);
  health.tasks.resize(idl::TASK_BOUND + 5);
  health.devices[0].error = kLong;
  health.tasks[0].latency.first = idl::COUNT_BOUND;
  const auto back = from_health(to_health("bench", health));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->devices.size(), idl::DEVICE_BOUND);
  EXPECT_EQ(back->tasks.size(), idl::TASK_BOUND);
  EXPECT_EQ(back->devices[0].error.size(), idl::REASON_BOUND);
  EXPECT_EQ(back->tasks[0].latency, DurationCounts{}) << "what no reader would take";
}

TEST(Convert, WhenHealthBreaksABound_ThenItIsDropped) {
  const idl::Health good = to_health("bench", some_health());
  const auto refused = [&](auto&& change) {
    idl::Health bad = good;
    change(bad);
    return !from_health(bad).has_value();
  };
  EXPECT_TRUE(refused([](idl::Health& h) { h.tasks().resize(idl::TASK_BOUND + 1); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices().resize(idl::DEVICE_BOUND + 1); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.io(4); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices_problem(kLong); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.tasks()[0].name(kLong); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.tasks()[0].jitter().counts().resize(idl::COUNT_BOUND + 1); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.tasks()[0].latency().first(idl::COUNT_BOUND - 2); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.tasks()[0].execution().first(0xFFFF'FFFFu); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices()[0].name(kLong); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices()[0].endpoint(kLong); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices()[0].error(kLong); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices()[0].answer_age_ms(-2); }));
  EXPECT_TRUE(refused([](idl::Health& h) { h.devices()[0].answer_max_us(-1.0); }));
  EXPECT_TRUE(refused(
      [](idl::Health& h) { h.devices()[0].answer_p50_us(std::numeric_limits<double>::quiet_NaN()); }));
}

}  // namespace
}  // namespace stepwright::dds::internal
