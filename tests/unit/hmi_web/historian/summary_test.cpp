#include "hmi_web/historian/summary.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace stepwright::historian {
namespace {

std::vector<Sample> samples(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Sample> made;
  for (std::size_t i = 0; i < count; ++i)
    made.push_back({static_cast<std::int64_t>(i), static_cast<double>(random() % 50),
                    random() % 5 == 0 ? Quality::Bad : Quality::Good});
  return made;
}

TEST(Summary, WhenPartsAreMerged_ThenItIsTheSummaryOfTheWhole) {
  const auto all = samples(300, 4);
  for (const std::size_t cut : {0u, 1u, 77u, 299u, 300u}) {
    Summary merged = summary_of(std::span(all).first(cut));
    merged.add(summary_of(std::span(all).subspan(cut)));
    EXPECT_EQ(merged, summary_of(all)) << cut;
  }
}

TEST(Summary, WhenSamplesAreBad_ThenTheyAreCountedAndAreNoExtremes) {
  const std::vector<Sample> all = {
      {1, 5.0}, {2, 900.0, Quality::Bad}, {3, -900.0, Quality::Missing}, {4, 7.0}};
  const Summary summary = summary_of(all);
  EXPECT_EQ(summary.count, 4u);
  EXPECT_EQ(summary.unusable, 2u);
  EXPECT_EQ(summary.least, all[0]);
  EXPECT_EQ(summary.greatest, all[3]);
  EXPECT_FALSE(summary_of(std::span(all).subspan(1, 2)).has_extremes());
}

TEST(Summary, WhenEncoded_ThenItIsReadBackAndDamageIsSeen) {
  const Summary summary = summary_of(samples(50, 5));
  auto bytes = encode(summary);
  EXPECT_EQ(decode_summary(bytes), summary);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= std::byte{4};
    EXPECT_FALSE(decode_summary(bytes).has_value()) << i;
    bytes[i] ^= std::byte{4};
  }
  EXPECT_FALSE(decode_summary(std::span(bytes).first(bytes.size() - 1)).has_value());
}

}  // namespace
}  // namespace stepwright::historian
