// Formulas, automata of other tools, and thousands of mutations of them through the readers.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, for fuzz_ltl. Longer:
// STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_ltl_mutation.

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <random>
#include <span>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/hoa/hoa.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/ltl/ltl_run.h"
#include "tests/unit/supervisor/ltl/dwyer_patterns.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::fuzz::ltl {
namespace {

using namespace stepwright::ltl;

constexpr std::uint64_t kRoundsPerSeed = 250;

constexpr std::array kSentences = {
    "visit press then (visit rack1 and visit rack2), never wash before unload  # a day's work",
    "between (q & !x) and r: s responds to p\n, after q until r: absent \"door open\"",
    "before r: exists p; globally: holds q; after q: s precedes p; a unless b, a M b xor c W d",
    "X X (a <-> b) => !(c | 1 & F 0) || GF(a R \"b\\\"\")"};

constexpr std::array kAutomata = {
    "HOA: v1\nStates: 2\nStart: 0\nAP: 2 \"a\" \"b\"\nAlias: @x 0&1 | 0&!1\nAcceptance: 1 Inf(0)\n"
    "properties: deterministic\n--BODY--\nState: 0 \"wait\"\n[!@x] 0 /* a /* b */ */\n[@x] 1\nState: 1 "
    "{0}\n[t] "
    "1\n--END--\n",
    "HOA: v1\nStart: 0\nAP: 1 \"a\"\nacc-name: co-Buchi\nAcceptance: 1 Fin(0)\n--BODY--\nState: 0\n0 "
    "1\nState: "
    "[t] 1 {0}\n1\n--END--\n"};

constexpr std::array kTokens = {
    "(",        ")",        "!",      "&",    "|",         "->",     "<->",      "xor",      "U",
    "W",        "R",        "M",      "X",    "F",         "G",      "1",        "0",        "a",
    "\"b c\"",  "\"",       ",",      ":",    "then",      "visit",  "never",    "before",   "after q",
    "until",    "globally", "absent", "and",  "between",   "exists", "responds", "precedes", "[",
    "]",        "t",        "{0}",    "2",    "State",     "@x",     "AP:",      "Start:",   "--END--",
    "--BODY--", "/*",       "HOA: ",  "\xff", "4294967296"};

std::vector<std::string> seeds() {
  std::vector<std::string> texts(kSentences.begin(), kSentences.end());
  texts.insert(texts.end(), kAutomata.begin(), kAutomata.end());
  texts.insert(texts.end(), stepwright::ltl::test::kDwyerPatterns.begin(),
               stepwright::ltl::test::kDwyerPatterns.end());
  texts.push_back(stepwright::ltl::test::in_succession(4));
  texts.push_back(stepwright::ltl::test::five_visits(3, true));
  for (const char* each : {"F a & (!b U c)", "G(a | X b)", "never b before a"})
    texts.push_back(*write_hoa(monitor_automaton(*parse_formula(each))->automaton, HoaPart::Bad, each));
  return texts;
}

std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
  for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
    const std::size_t at = below(text.size()), size = below(12);
    const std::string token = std::string(kTokens[below(kTokens.size())]) + " ";
    switch (below(6)) {
      case 0:
        text.erase(at, size);
        break;
      case 1:
        text.insert(at, token);
        break;
      case 2:
        text.replace(at, size, token);
        break;
      case 3: {
        const std::string& other = all[below(all.size())];
        text.insert(at, other.substr(below(other.size()), 2 * size));
        break;
      }
      case 4:
        if (!text.empty())
          text[at] = static_cast<char>(below(3) == 0 ? below(256) : "abpqrs!&|012"[below(12)]);
        break;
      default:
        if (below(8) == 0) text.resize(at);
        break;
    }
  }
  return text;
}

TEST(LtlMutation, Seeds_WhenRead_ThenEveryOneIsAFormulaOrAnAutomaton) {
  for (const std::string& seed : seeds()) {
    const ltl::Run done = run(seed);
    EXPECT_TRUE(done.read) << seed;
    EXPECT_EQ(done.finding, "") << seed;
  }
}

TEST(LtlMutation, Texts_WhenBroken_ThenAreRefusedWithAPlaceOrAreTheSameWrittenAndRead) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261128)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  const std::vector<std::string> all = seeds();
  std::size_t runs = 0, read = 0, automata = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::string text = mutated(all[s], all, random);
      name_case("ltl seed " + std::to_string(s) + ", round " + std::to_string(round),
                std::as_bytes(std::span(text)));
      const ltl::Run done = run(text);
      ++runs;
      read += done.read ? 1 : 0;
      automata += done.automaton ? 1 : 0;
      if (done.finding.empty()) continue;
      ADD_FAILURE() << "seed " << s << ", round " << round << ": " << done.finding << ", in " << keep_case();
      return;
    }
  }
  std::cout << runs << " runs, " << read << " read, " << automata << " automata\n";
  // Else the mutations do not get beyond the syntax.
  EXPECT_GT(read, runs / 10);
  EXPECT_GT(automata, runs / 20);
}

// Where libFuzzer is to find them: STEPWRIGHT_FUZZ_CORPUS.
TEST(LtlMutation, Seeds_WhenWrittenAsACorpus_ThenEachIsAFile) {
  expect_corpus_written(seeds());
}

}  // namespace
}  // namespace stepwright::fuzz::ltl
