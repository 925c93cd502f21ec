#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <pugixml.hpp>

#include "ladder/driver/sheets.h"
#include "ladder/print/print.h"
#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/print/page_boxes.h"

namespace stepwright::print {
namespace {

graphic::Sheet sheet_of(std::variant<graphic::Listing, graphic::LadderProgram, graphic::SfcChart> body) {
  graphic::Sheet sheet{"PROGRAM", "p"};
  sheet.file = "p.st";
  sheet.body = std::move(body);
  return sheet;
}

// Rungs of 3 to 16 contacts, parallel branches, blocks and long comments.
graphic::LadderProgram long_ladder(int rungs) {
  graphic::LadderProgram program;
  for (int i = 0; i < rungs; ++i) {
    graphic::Rung& rung = program.rungs.emplace_back();
    if (i % 7 == 0)
      rung.comment = "A comment about rung " + std::to_string(i) + " that goes on and on and " +
                     "on until no page is wide enough for it, and then on for another while";
    std::vector<graphic::Condition> parts;
    for (int k = 0; k < 3 + i * 5 % 14; ++k)
      parts.push_back(graphic::contact("Conveyor" + std::to_string((i + k) % 20) + "_ready", k % 3 == 1));
    parts.push_back(graphic::any({graphic::contact("M" + std::to_string((i + 1) % rungs)),
                                  graphic::compare("level", graphic::CompareOp::Less, "limit_of_level")}));
    rung.condition = graphic::all(std::move(parts));
    rung.coils = {{graphic::CoilKind::Normal, "M" + std::to_string(i)}};
    if (i % 5 == 0) {
      graphic::Block& block = rung.blocks.emplace_back();
      block.type = "TON";
      block.instance = "delay_" + std::to_string(i);
      block.power_input = "IN";
      block.inputs = {{"PT", "T#1m30s"}};
      block.outputs = {{"ET", "elapsed_time"}};
    }
  }
  return program;
}

void expect_clean(const std::string& svg, int width = 794) {
  const int pages = page_count(svg);
  ASSERT_GT(pages, 0);
  for (int page = 1; page <= pages; ++page) {
    const auto texts = texts_of_page(svg, page);
    EXPECT_TRUE(faults_of_page(texts, width).empty())
        << "page " << page << ": " << faults_of_page(texts, width).front();
  }
}

TEST(PrintSvg, WhenLadderIsPrinted_ThenNothingOverlapsOrLeavesItsPage) {
  expect_clean(print_svg({sheet_of(long_ladder(40))}, {.project = "Cell"}));
  expect_clean(print_svg({sheet_of(long_ladder(40))}, {.project = "Cell", .paper = Paper::A3}), 1588);
}

TEST(PrintSvg, WhenChartsArePrinted_ThenNothingOverlapsOrLeavesItsPage) {
  for (const graphic::SfcChart& chart : {support::sequence_chart(), support::nested_chart(),
                                         support::partial_order_chart(), support::rich_chart()})
    expect_clean(print_svg({sheet_of(chart)}, {.project = "Cell"}));
}

// A simultaneous branch of long sequences with actions, each with a detour that skips a step.
graphic::SfcChart wide_chart(std::uint32_t branches, std::uint32_t length) {
  graphic::SfcChart chart;
  const auto step = [&chart](const std::string& name) {
    graphic::Step& added = chart.steps.emplace_back();
    added.name = name;
    const auto number = static_cast<int>(chart.steps.size());
    for (int i = 0; i < number % 3; ++i)
      added.actions.push_back({graphic::Qualifier::D, "output_" + std::to_string(number + i), "T#1m30s"});
    return graphic::StepId(static_cast<std::uint32_t>(number - 1));
  };
  const auto transition = [&chart](std::vector<graphic::StepId> from, std::vector<graphic::StepId> to) {
    graphic::Transition& added = chart.transitions.emplace_back();
    const std::string number = std::to_string(chart.transitions.size());
    added.name = "T" + number;
    added.sources = std::move(from);
    added.targets = std::move(to);
    added.condition =
        graphic::all({graphic::contact("door_closed_" + number), graphic::contact("ready_" + number),
                      graphic::contact("level_reached_" + number)});
  };
  const graphic::StepId start = step("Start");
  chart.steps[0].initial = true;
  std::vector<graphic::StepId> heads;
  std::vector<graphic::StepId> tails;
  for (std::uint32_t b = 0; b < branches; ++b) {
    std::vector<graphic::StepId> steps;
    for (std::uint32_t i = 0; i < length; ++i) {
      steps.push_back(step("Station_" + std::to_string(b) + "_" + std::to_string(i)));
      if (i > 0) transition({steps[i - 1]}, {steps[i]});
      if (i > 2 && i % 4 == 3) transition({steps[i - 2]}, {steps[i]});
    }
    heads.push_back(steps.front());
    tails.push_back(steps.back());
  }
  const graphic::StepId done = step("Done");
  transition({start}, heads);
  transition(tails, {done});
  transition({done}, {start});
  return chart;
}

// Every "/7.2" on page 3 has a "/3.2" on page 7.
std::size_t expect_partners(const std::string& svg) {
  std::map<std::string, int> references;  // "3/7.2", less those of the other side
  for (int page = 1; page <= page_count(svg); ++page) {
    for (const PageText& each : texts_of_page(svg, page)) {
      const std::size_t dot = each.text.find('.');
      if (each.text[0] != '/' || dot == std::string::npos) continue;
      const int other = std::stoi(each.text.substr(1, dot - 1));
      const std::string low = std::to_string(std::min(page, other));
      const std::string high = std::to_string(std::max(page, other));
      references[low + "/" + high + each.text.substr(dot)] += page == other ? 0 : page < other ? 1 : -1;
    }
  }
  for (const auto& [reference, sum] : references) EXPECT_EQ(sum, 0) << reference;
  return references.size();
}

TEST(PrintSvg, WhenChartsAreCut_ThenNothingOverlapsAndReferencesHavePartners) {
  for (const std::uint32_t branches : {1U, 2U, 3U, 4U, 6U, 9U}) {
    SCOPED_TRACE(std::to_string(branches) + " branches");
    const graphic::Sheet sheet = sheet_of(wide_chart(branches, 14));
    const std::string a4 = print_svg({sheet}, {.project = "Cell"});
    expect_clean(a4);
    // Two branches fit side by side on one page.
    EXPECT_EQ(expect_partners(a4) == 0, branches == 2);
    expect_clean(print_svg({sheet}, {.project = "Cell", .paper = Paper::A3}), 1588);
  }
}

TEST(PrintSvg, WhenListingHasLongLines_ThenTheyAreWrapped) {
  graphic::Listing listing;
  listing.first_line = 998;
  for (int i = 0; i < 200; ++i)
    listing.lines.push_back(std::string(static_cast<std::size_t>(i), 'x') + " := 1;");
  const std::string svg = print_svg({sheet_of(listing)}, {.project = "Cell"});
  EXPECT_GT(page_count(svg), 3);
  expect_clean(svg);
}

TEST(PrintSvg, WhenPagesAreCounted_ThenTitleBlocksSaySo) {
  graphic::Sheet first = sheet_of(long_ladder(30));
  graphic::Sheet second = sheet_of(graphic::Listing{{"a := b;"}, 3});
  second.name = "other";
  const std::string svg = print_svg({first, second}, {.project = "Cell"});
  const int pages = page_count(svg);
  for (int page = 1; page <= pages; ++page) {
    const std::string number = std::to_string(page) + " of " + std::to_string(pages);
    int found = 0;
    for (const PageText& each : texts_of_page(svg, page)) found += each.text == number ? 1 : 0;
    EXPECT_EQ(found, 1) << number;
  }
  // The contents name the page on which a sheet begins.
  bool listed = false;
  for (const PageText& each : texts_of_page(svg, 1)) listed = listed || each.text == std::to_string(pages);
  EXPECT_TRUE(listed);
  EXPECT_NE(svg.find("@page{size:210mm 297mm"), std::string::npos);
  EXPECT_EQ(svg, print_svg({first, second}, {.project = "Cell"}));
}

TEST(PrintSvg, WhenTextsHoldAnyBytes_ThenTheSvgIsWellFormed) {
  graphic::Listing listing;
  for (int c = 1; c < 256; ++c)
    listing.lines.push_back(std::string("a<b&\"") + static_cast<char>(c) + "\xC3");
  pugi::xml_document document;
  const std::string svg = print_svg({sheet_of(listing)}, {.project = "<\xFF&>"});
  EXPECT_TRUE(document.load_string(svg.c_str()));
}

// The best of three, in seconds of the processor.
double seconds_to_print(const graphic::Sheet& sheet, int least_pages) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    const std::string svg = print_svg({sheet}, {.project = "Cell"});
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    EXPECT_GT(page_count(svg), least_pages);
  }
  return best;
}

TEST(PrintSvg, WhenThereAreTenTimesAsManyRungs_ThenTheyTakeFarLessThanAHundredTimesAsLong) {
  const double few = seconds_to_print(sheet_of(long_ladder(100)), 5);
  EXPECT_LT(seconds_to_print(sheet_of(long_ladder(1000)), 50), 40 * std::max(few, 0.001));
}

}  // namespace
}  // namespace stepwright::print
