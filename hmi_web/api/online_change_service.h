#pragma once

// Service for changes of the program: engineers bring one to look at, compare it with the one that runs, have
// it take over, and bring back an earlier one (hmi_web/doc/change.md).
//
//   auto candidate = service.take_container("mixer.swb", bytes);
//   auto seen = service.compare(candidate->digest);
//   service.change({candidate->digest, seen->running, false, "emil", "engineer", "127.0.0.1", "new limit"});
//   service.turn();                                   // now and then: what became of the trial
//
// Threads: every function from any; `change` blocks as CellChange does. Invariants: nothing takes over that
// was not verified here; a program that takes over is on the disk before, and so is the one that it replaces;
// at most kMostCandidates programs wait in memory.
//
// Diagnostics: those of CellChange, VersionStore and of the container; H0091 no such program, H0092 another
// program runs than the one that it was compared with, H0093 the supervisor acts, H0094 what was brought is
// no program, H0097 it runs already, H0098 a change is on trial.

#include <chrono>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/access/audit_log.h"
#include "hmi_web/api/cell_change.h"
#include "hmi_web/change/program_diff.h"
#include "hmi_web/change/version_store.h"
#include "runtime/ground/result/result.h"

namespace stepwright::api {

// The cell is not in the state that a change was asked for.
inline constexpr const char* kComparedWithAnother = "H0092";
inline constexpr const char* kSupervisorActs = "H0093";
inline constexpr const char* kRunsAlready = "H0097";
inline constexpr const char* kOnTrial = "H0098";

inline constexpr std::size_t kMostCandidates = 4;
inline constexpr std::size_t kMostSources = 64;            // files of one program
inline constexpr std::size_t kMostSourceBytes = 2u << 20;  // of one file
inline constexpr std::size_t kLongestSourceName = 128;     // bytes

struct Candidate {
  std::string digest;
  std::string name;
  std::size_t bytes = 0;
  result::Diagnostics warnings = {};  // of the compiler
};

struct Comparison {
  std::string running;  // digest
  std::string program;
  change::ProgramDiff diff;
  result::Diagnostics now;  // why nothing could take over at this moment: no program runs, a supervisor acts
};

struct ChangeOrder {
  std::string program;  // digest of a candidate or of a version
  std::string base;     // of the program that it was compared with
  bool restart_charts = false;
  std::string user;
  std::string role;
  std::string address;
  std::string reason;
};

// The newest change from this server.
struct ChangeRecord {
  ChangeOrder order;
  std::string name;
  std::chrono::system_clock::time_point when;
  Takeover takeover;
  Trial trial;
};

class OnlineChangeService {
 public:
  // References must outlive it.
  OnlineChangeService(CellChange& cell, change::VersionStore& versions, access::AuditLog& audit,
                      access::WallClock clock);

  // Programs to look at. Compiles, verifies, and keeps them for a while.
  [[nodiscard]] result::Result<Candidate> take_container(const std::string& name, std::string bytes);
  [[nodiscard]] result::Result<Candidate> take_sources(const SourceTexts& sources);

  [[nodiscard]] result::Result<Comparison> compare(const std::string& digest);
  // Of a candidate or of a version.
  Answer sources(const std::string& digest);

  [[nodiscard]] result::Result<ChangeRecord> change(const ChangeOrder& order);
  // Learns what became of the newest change and writes it down.
  void turn();

  std::optional<ChangeRecord> newest() const;
  std::string running() { return digest_of_loaded(); }
  std::string engaged() { return cell_.engaged(); }
  std::vector<change::Version> versions() const { return versions_.list(); }
  result::Diagnostics damaged() const { return versions_.damaged(); }

 private:
  struct Waiting {
    Candidate candidate;
    std::vector<std::byte> container;
  };
  // A program with its name, wherever it is kept.
  struct Known {
    std::string name;
    std::vector<std::byte> container;
  };
  result::Result<Candidate> keep(std::string name, std::vector<std::byte> container,
                                 result::Diagnostics warnings);
  result::Result<Known> known(const std::string& digest) const;
  std::string digest_of_loaded();
  result::Result<void> check(const ChangeOrder& order, const LoadedNow& now);
  void take_back(const ChangeOrder& order, const Known& next, const std::string& running,
                 const std::optional<change::Version>& before, bool was_known,
                 const result::Diagnostics& problems);
  result::Result<void> write_down(const ChangeOrder& order, const LoadedNow& now, const Known& next);

  CellChange& cell_;
  change::VersionStore& versions_;
  access::AuditLog& audit_;
  const access::WallClock clock_;
  std::mutex turn_;           // one change at a time
  mutable std::mutex mutex_;  // guards what follows
  std::deque<Waiting> candidates_;
  std::optional<ChangeRecord> newest_;
};

}  // namespace stepwright::api
