#include "runtime/ground/process/command_line.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <thread>

#include "tests/support/scarcity.h"

namespace stepwright::process {
namespace {

TEST(CommandLine, Process_WhenTheSystemRefusesAThread_ThenItEndsWithAWord) {
  EXPECT_EXIT(
      {
        end_with_a_word();
        // Of a thread: GoogleTest catches what comes up to it.
        std::thread([] {
          const support::FailingThread failing(1);
          std::thread([] {}).join();
        }).join();
      },
      testing::ExitedWithCode(to_int(result::ExitCode::RuntimeFault)),
      "R0077: the system gives no more threads");
}

TEST(CommandLine, Process_WhenTheSystemRefusesMemory_ThenItEndsWithAWord) {
  EXPECT_EXIT(
      {
        end_with_a_word();
        std::thread([] { throw std::bad_alloc(); }).join();
      },
      testing::ExitedWithCode(to_int(result::ExitCode::RuntimeFault)),
      "R0077: the system gives no more memory");
}

// Anything else is a fault of the program: it leaves its core.
TEST(CommandLine, Process_WhenSomethingElseIsThrown_ThenItAborts) {
  EXPECT_EXIT(
      {
        end_with_a_word();
        std::thread([] { throw std::logic_error("a fault"); }).join();
      },
      testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace stepwright::process
