#pragma once

// Keeps the machine busy while a scan is measured: processors that compute, a disk that is written and
// synced, a network (loopback) that is flooded. All at ordinary priority.
//
// Threads: its own, ended by the destructor.

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::scan_test {

struct LoadKinds {
  bool cpu = false;   // one computing thread per processor
  bool disk = false;  // blocks of 64 KiB, each synced, to a file in the temporary folder
  bool net = false;   // datagrams over loopback from one thread to another

  // "cpu,disk,net" in any order. Fails with R0073 for another word.
  [[nodiscard]] static result::Result<LoadKinds> parse(const std::string& list);
};

class LoadGenerator {
 public:
  // Fails with R0074 if the file or the socket cannot be had.
  [[nodiscard]] static result::Result<std::unique_ptr<LoadGenerator>> create(const LoadKinds& kinds);
  ~LoadGenerator();
  LoadGenerator(const LoadGenerator&) = delete;
  LoadGenerator& operator=(const LoadGenerator&) = delete;

 private:
  LoadGenerator() = default;
  [[nodiscard]] result::Result<void> start_disk();
  [[nodiscard]] result::Result<void> start_net();

  std::atomic<bool> quit_{false};
  int file_ = -1;
  int receiver_ = -1;
  int sender_ = -1;
  std::vector<std::thread> threads_;
};

}  // namespace stepwright::scan_test
