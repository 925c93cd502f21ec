// A drawing with what other programs export, and thousands of mutations of it, through the reader: each is
// refused with a code, words and its file, or becomes a drawing that runs and loads nothing and stays the
// same when it is read again.
//
// Longer: STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_drawing_mutation.

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/drawing/drawing_file.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/text_mutation.h"

namespace stepwright::fuzz::drawings {
namespace {

constexpr const char* kDrawing =
    R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 60" data-name="Layer 1">
<style>.a, #v { fill: #f00; stroke: url(#g) } path.a { opacity: .5 } @media print { .a { fill: red } }</style>
<defs><linearGradient id="g"><stop offset="0"/></linearGradient><mask id="m"><rect width="5" height="5"/></mask>
<filter id="f"><feFlood/></filter><pattern id="p"><circle r="2"/></pattern></defs>
<g mask="url(#m)" filter="url(#f)" style="fill:red;mix-blend-mode:multiply"><path class="a b" d="M0 0 L 5 5z"/></g>
<switch><foreignObject><div>B</div></foreignObject><text x="1 2" data-text="Main.level">A</text></switch>
<use href="#v"/><rect id="v" width="12.5" height="1e1" transform="rotate(5)" data-on="!Main.run"/>
<image href="data:image/png;base64,AAAA" width="1" height="1"/>
<g data-part="button" data-key="k" data-write="Main.n" data-value="4"><rect width="9" height="9"/></g></svg>)svg";

const std::vector<std::string> kPieces = {"0",
                                          "-1",
                                          "1e999",
                                          "nan",
                                          "\"",
                                          "'",
                                          "<",
                                          "/>",
                                          "{",
                                          "}",
                                          ";",
                                          ":",
                                          "/*",
                                          "*/",
                                          "@import url(//e/a.css);",
                                          "url(//e)",
                                          "url(#g)",
                                          "url('http://e#a')",
                                          "u\\72l(//e)",
                                          "javascript:alert(1)",
                                          "<script>alert(1)</script>",
                                          "<style>*{fill:url(//e)}</style>",
                                          "<switch>",
                                          "</switch>",
                                          "<foreignObject/>",
                                          "<a href='//e'/>",
                                          " onclick='alert(1)'",
                                          " href='//e'",
                                          " xlink:href='#v'",
                                          " style='fill:url(//e)'",
                                          " class='a b a b'",
                                          " data-fil='x'",
                                          "<mask mask='url(#m)'>",
                                          "</mask>",
                                          "\xff",
                                          "&b;",
                                          "<![CDATA[",
                                          "]]>",
                                          "<!--",
                                          "!important"};

// What must never be in a drawing that is shown; empty: it is harmless.
std::string harm_in(const std::string& svg) {
  pugi::xml_document document;
  if (!document.load_string(svg.c_str())) return "it is no XML";
  for (const char* query : {"//script", "//style", "//foreignObject", "//a", "//@style", "//@class"})
    if (document.select_node(query)) return query;
  for (const pugi::xpath_node each : document.select_nodes("//@*")) {
    const std::string_view name = each.attribute().name();
    const std::string_view value = each.attribute().value();
    if (name.starts_with("on") || name.starts_with("ON")) return std::string(name);
    if (name == "href" && !value.starts_with('#') && !value.starts_with("data:image/"))
      return std::string(value);
    // Whatever these say is no style.
    if (name == "href" || name == "id" || name.starts_with("data-")) continue;
    const std::size_t at = value.find("url(");
    if (at != std::string_view::npos && value.find('#', at) > at + 5) return std::string(value);
    if (value.find("javascript:") != std::string_view::npos) return std::string(value);
  }
  return {};
}

TEST(DrawingMutation, Drawings_WhenBroken_ThenAreRefusedOrHarmlessAndStable) {
  TextMutation mutation(setting("STEPWRIGHT_FUZZ_SEED", 20261130), kPieces);
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", 4'000);
  std::size_t accepted = 0;
  ASSERT_TRUE(drawing::read_drawing("plant.svg", kDrawing).has_value());
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::string text = mutation.mutated(kDrawing);
    const auto drawn = drawing::read_drawing("plant.svg", text);
    const result::Diagnostics& said = drawn ? drawn->warnings : drawn.error();
    for (const result::Diagnostic& each : said) {
      ASSERT_FALSE(each.code.empty() || each.message.empty() || each.hint.empty()) << text;
      ASSERT_EQ(each.where.file, "plant.svg") << text;
    }
    if (!drawn) continue;
    ++accepted;
    ASSERT_EQ(harm_in(drawn->svg), "") << text << "\n" << drawn->svg;
    const auto again = drawing::read_drawing("plant.svg", drawn->svg);
    ASSERT_TRUE(again.has_value()) << result::to_string(again.error()) << "\n" << text;
    ASSERT_EQ(again->svg, drawn->svg) << text;
  }
  EXPECT_GT(accepted, rounds / 20) << "else only the parser is tested";
}

}  // namespace
}  // namespace stepwright::fuzz::drawings
