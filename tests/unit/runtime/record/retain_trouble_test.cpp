// A disk that is full, a folder that is not ours, a file that disappears: the program runs on, the status
// says so, and when the trouble is over the values are written.

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "tests/support/patience.h"
#include "tests/unit/runtime/record/retained_machine.h"

namespace stepwright::record {
namespace {

constexpr const char* kNumbers = "VAR RETAIN n : DINT; a : ARRAY[0..9999] OF LINT; END_VAR";

bool notes(RetainedMachine& machine, const char* text, bool wanted = true) {
  const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
  while ((machine.retain().note().find(text) != std::string::npos) != wanted) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

// Runs it in a process of its own, where limits and mounts end with it; the number says what went wrong.
template <typename Body>
int in_child(Body body) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

TEST(RetainTrouble, WhenFilesMayNotGrow_ThenItIsSaidAndRepairedLater) {
  const TestFolder folder;
  const int wrong = in_child([&] {
    const rlimit small{4'096, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &small) != 0) return 1;
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    machine.start();
    machine.set("MAIN.n", 7);
    machine.offer();
    if (!notes(machine, "File too large")) return 2;
    if (machine.retain().committed() != 0) return 3;
    const rlimit large{RLIM_INFINITY, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &large) != 0) return 4;
    if (!machine.settled()) return 5;
    return notes(machine, "File too large", false) ? 0 : 6;
  });
  EXPECT_EQ(wrong, 0);
  const auto found = RetainStore::read(folder.store());
  ASSERT_TRUE(found && *found);
  EXPECT_EQ(std::to_integer<int>((*found)->payload[0]), 7);
}

TEST(RetainTrouble, WhenTheDiskIsFull_ThenTheOldValuesStayAndTheRestIsWrittenLater) {
  const TestFolder folder;
  const int wrong = in_child([&] {
    // A disk of its own needs the right to mount.
    if (geteuid() != 0 || mount("retain", folder.path().c_str(), "tmpfs", 0, "size=400k") != 0) return 77;
    const auto done = [&](int result) {
      umount2(folder.path().c_str(), MNT_DETACH);
      return result;
    };
    const std::filesystem::path ballast = folder.path() / "ballast";
    {
      RetainedMachine machine("VAR RETAIN n : DINT; END_VAR", {.store = folder.store()});
      machine.start();
      machine.set("MAIN.n", 7);
      machine.stop();
      if (!machine.settled()) return done(2);
    }
    std::ofstream(ballast) << std::string(1 << 20, 'x');  // as much as fits
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    machine.start();
    if (machine.get("MAIN.n") != 7) return done(3);
    if (!notes(machine, "No space left")) return done(4);
    const auto found = RetainStore::read(folder.store());
    if (!found || !*found || (*found)->payload[0] != std::byte{7}) return done(5);
    std::filesystem::remove(ballast);
    return done(machine.settled() && notes(machine, "No space left", false) ? 0 : 6);
  });
  if (wrong == 77) GTEST_SKIP() << "no right to mount a small disk";
  EXPECT_EQ(wrong, 0);
}

TEST(RetainTrouble, WhenTheFileSystemIsReadOnly_ThenItIsSaidAndTheValuesAreRead) {
  const TestFolder folder;
  const int wrong = in_child([&] {
    if (geteuid() != 0 || mount("retain", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) return 77;
    const auto done = [&](int result) {
      umount2(folder.path().c_str(), MNT_DETACH);
      return result;
    };
    {
      RetainedMachine machine(kNumbers, {.store = folder.store()});
      machine.start();
      machine.set("MAIN.n", 7);
      machine.stop();
      if (!machine.settled()) return done(2);
    }
    if (mount("retain", folder.path().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=1m") != 0)
      return done(3);
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    machine.start();
    if (machine.get("MAIN.n") != 7) return done(4);
    machine.set("MAIN.n", 8);
    machine.stop();
    if (!notes(machine, "Read-only file system")) return done(5);
    if (mount("retain", folder.path().c_str(), "tmpfs", MS_REMOUNT, "size=1m") != 0) return done(6);
    return done(machine.settled() ? 0 : 7);
  });
  if (wrong == 77) GTEST_SKIP() << "no right to mount a small disk";
  EXPECT_EQ(wrong, 0);
}

TEST(RetainTrouble, WhenTheFolderIsNotOurs_ThenItIsSaidAndTheProgramRuns) {
  const TestFolder folder;
  const int wrong = in_child([&] {
    // To root nothing is forbidden.
    if (geteuid() == 0 && setresuid(65'534, 65'534, 65'534) != 0) return 77;
    if (geteuid() != 65'534 && chmod(folder.path().c_str(), 0500) != 0) return 1;
    RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
    if (!machine.start().empty()) return 2;
    machine.offer();
    return notes(machine, "Permission denied") ? 0 : 3;
  });
  if (wrong == 77) GTEST_SKIP() << "no other user to be";
  EXPECT_EQ(wrong, 0);
  chmod(folder.path().c_str(), 0700);
}

TEST(RetainTrouble, WhenSomebodyRemovesTheStore_ThenItIsMadeAgain) {
  const TestFolder folder;
  RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
  machine.start();
  ASSERT_TRUE(machine.settled());
  std::filesystem::remove(folder.store());
  machine.set("MAIN.n", 9);
  machine.offer();
  ASSERT_TRUE(machine.settled());
  const auto found = RetainStore::read(folder.store());
  ASSERT_TRUE(found && *found);
  EXPECT_EQ(std::to_integer<int>((*found)->payload[0]), 9);
}

// The store goes elsewhere, and something else takes its place: what is there is what the path names.
TEST(RetainTrouble, WhenTheStoreIsMovedAway_ThenItIsMadeAgain) {
  const TestFolder folder;
  RetainedMachine machine(kNumbers, {.store = folder.store(), .period_ns = 1'000'000});
  machine.start();
  ASSERT_TRUE(machine.settled());
  std::filesystem::rename(folder.store(), folder.path() / "taken");
  machine.set("MAIN.n", 7);
  machine.offer();
  ASSERT_TRUE(machine.settled());
  std::filesystem::copy_file(folder.path() / "taken", folder.store(),
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::rename(folder.store(), folder.path() / "again");
  std::filesystem::copy_file(folder.path() / "taken", folder.store());
  machine.set("MAIN.n", 8);
  machine.offer();
  ASSERT_TRUE(machine.settled());
  const auto found = RetainStore::read(folder.store());
  ASSERT_TRUE(found && *found);
  EXPECT_EQ(std::to_integer<int>((*found)->payload[0]), 8);
}

}  // namespace
}  // namespace stepwright::record
