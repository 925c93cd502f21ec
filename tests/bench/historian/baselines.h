#pragma once

// Baselines of the historian: a row of SQLite for every sample, written in transactions as large, and lines
// of CSV.
//
// Not thread-safe.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

#include "hmi_web/historian/sample.h"
#include "hmi_web/storage/database.h"

namespace stepwright::bench {

class RowStore {
 public:
  // Throws std::runtime_error where SQLite fails.
  explicit RowStore(const std::filesystem::path& file);
  void append(const historian::TagSample& sample);
  void commit();

  struct Bucket {
    std::int64_t number = 0;
    double least = 0.0, greatest = 0.0;
  };
  std::vector<Bucket> trend(historian::TagId tag, std::int64_t from_ns, std::int64_t to_ns,
                            std::int64_t bucket_ns);

 private:
  storage::Database database_;
  std::optional<storage::Statement> insert_, trend_;
  bool begun_ = false;
};

class CsvStore {
 public:
  explicit CsvStore(const std::filesystem::path& file);
  ~CsvStore();
  CsvStore(const CsvStore&) = delete;
  CsvStore& operator=(const CsvStore&) = delete;
  void append(const historian::TagSample& sample);
  void commit();

 private:
  std::FILE* file_;
};

}  // namespace stepwright::bench
