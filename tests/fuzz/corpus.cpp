#include "tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::fuzz {

namespace fs = std::filesystem;

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> contents(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(content(file));
  return texts;
}

void expect_corpus_written(const std::vector<std::string>& texts) {
  const support::TemporaryFolder own;
  const char* const asked = std::getenv("STEPWRIGHT_FUZZ_CORPUS");
  const fs::path folder = asked == nullptr ? own.path() : fs::path(asked);
  fs::create_directories(folder);
  for (std::size_t s = 0; s < texts.size(); ++s) {
    const fs::path file = folder / ("seed" + std::to_string(s));
    std::ofstream(file, std::ios::binary) << texts[s];
    EXPECT_EQ(fs::file_size(file), texts[s].size());
  }
}

}  // namespace stepwright::fuzz
