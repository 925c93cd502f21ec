#pragma once

// Shared parts of the tests of mutations: settings from the environment, seeds from files and to files.
//
//   const auto rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", 600);

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stepwright::fuzz {

// A number of the environment, or `otherwise`.
std::uint64_t setting(const char* name, std::uint64_t otherwise);

std::string content(const std::filesystem::path& file);

// The contents of a folder's files, by their names.
std::vector<std::string> contents(const std::filesystem::path& folder);

// Writes each text as a file where libFuzzer is to find it, STEPWRIGHT_FUZZ_CORPUS, or else into a folder
// that does not stay, and expects them to be whole.
void expect_corpus_written(const std::vector<std::string>& texts);

}  // namespace stepwright::fuzz
