#pragma once

// Verdict on a program that has just been brought in: it has its first scans behind it, it trapped in them,
// or nobody knows yet. An online change is on trial for as many scans (runtime/doc/online_change.md).
//
// Threads: that of the connection. Requires a connection that was open when the program was brought in: the
// events since then say when it began.

#include <chrono>
#include <cstdint>
#include <string>

#include "runtime/service/connection.h"

namespace stepwright::download {

enum class Verdict : std::uint8_t {
  Runs,       // its first scans are over
  TakenBack,  // it trapped on trial, and the program before goes on
  Fault,      // it trapped, and no other goes on
  Open,       // it was stopped, or the time was over before its first scans
};

struct ProgramVerdict {
  Verdict verdict = Verdict::Open;
  std::string detail;  // what trapped, and where
};

// Waits for `scans` scans of the program with this digest, at most `time`.
ProgramVerdict await_verdict(service::Connection& connection, const std::string& digest, std::uint32_t scans,
                             std::chrono::milliseconds time);

}  // namespace stepwright::download
