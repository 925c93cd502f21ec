#include <gtest/gtest.h>

#include <ctime>
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

TEST(PrintSvg, WhenThereAreThousandRungs_ThenTheyArePrintedInASecondOfProcessorTime) {
  const graphic::Sheet sheet = sheet_of(long_ladder(1000));
  const std::clock_t start = std::clock();
  const std::string svg = print_svg({sheet}, {.project = "Cell"});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_GT(page_count(svg), 50);
  EXPECT_LT(seconds, 1.0);
}

}  // namespace
}  // namespace stepwright::print
