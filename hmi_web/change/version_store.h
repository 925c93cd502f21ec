#pragma once

// The programs that an engineer can bring back: each a file of its own in one folder (mode 0700, files 0600),
// with its container and who brought it, when and why (hmi_web/doc/change.md).
//
//   auto store = VersionStore::open("cell-state/programs");
//   (*store)->put(version, container);
//   for (const Version& version : (*store)->list()) ...
//
// Threads: every function from any. Invariants: what put, settle or remove has confirmed is on the disk,
// whole or not at all; a file is believed only if its container has the digest that its name says.
//
// Diagnostics: H0021 the disk, H0091 no such version, H0095 damaged.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hmi_web/change/version.h"
#include "runtime/ground/result/result.h"

namespace stepwright::change {

class VersionStore {
 public:
  // Makes the folder if it is not there. What was on trial when the server ended is Unknown from now on.
  [[nodiscard]] static result::Result<std::unique_ptr<VersionStore>> open(std::filesystem::path folder);

  // The newest first.
  std::vector<Version> list() const;
  std::optional<Version> find(const std::string& digest) const;
  // Files that were left out, each with H0095.
  result::Diagnostics damaged() const;
  // The bytes are checked anew: the file may have changed since.
  [[nodiscard]] result::Result<std::vector<std::byte>> container(const std::string& digest) const;

  // In place of the one with its digest. Requires that the digest is that of the container.
  [[nodiscard]] result::Result<void> put(const Version& version, std::span<const std::byte> container);
  // Stores the outcome of a version on trial.
  [[nodiscard]] result::Result<void> settle(const std::string& digest, Outcome outcome,
                                            const std::string& note);
  [[nodiscard]] result::Result<void> remove(const std::string& digest);
  // Forgets the oldest ones beyond kMostVersions and kMostVersionBytes, but never these two.
  [[nodiscard]] result::Result<void> trim(const std::string& keep, const std::string& keep_too);

 private:
  struct Kept {
    Version version;
    std::size_t bytes = 0;  // of the container
  };
  explicit VersionStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path file_of(const std::string& digest) const;
  void read_folder();
  result::Result<void> write(const Version& version, std::span<const std::byte> container);
  std::vector<Kept>::iterator at(const std::string& digest);

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;  // guards what follows, and the folder
  std::vector<Kept> kept_;    // the newest first
  result::Diagnostics damaged_;
};

}  // namespace stepwright::change
