#include <gmock/gmock.h>

#include <string>

#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::drawing {
namespace {

using testing::HasSubstr;
using testing::Not;

// Drawings as other programs export them.
result::Result<Drawing> foreign(const std::string& inside) {
  return read_drawing("plant.svg", "<svg viewBox=\"0 0 9 9\">\n" + inside + "\n</svg>");
}

std::string kept(const std::string& inside) {
  const auto drawing = foreign(inside);
  return drawing ? drawing->svg : result::to_string(drawing.error());
}

std::string refusal_of(const result::Result<Drawing>& drawing) {
  return drawing ? "none" : result::to_string(drawing.error());
}

// What it warns of, a line each.
std::string remarks_on(const result::Result<Drawing>& drawing) {
  return drawing ? result::to_string(drawing->warnings) : "refused: " + result::to_string(drawing.error());
}

TEST(ForeignDrawing, WhenItsShapesHaveClasses_ThenTheStyleSheetIsTakenApart) {
  const auto drawing = foreign(R"(<style>/* of a drawing program */
    .cls-1, .cls-2 { fill: #f00; stroke: none }
    .cls-2 { stroke-width: 2px; }
    path.cls-2 { opacity: .5 } #valve { fill: green !important; }
    rect { fill: blue } * { font-size: 9px }
  </style><path class="cls-1 cls-2" fill="white" d="M0 0"/><rect id="valve" class="cls-1"/><rect style="fill:grey"/>)");
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_THAT(
      drawing->svg,
      HasSubstr(
          R"(<path fill="#f00" d="M0 0" font-size="9px" stroke="none" stroke-width="2px" opacity=".5"/>)"));
  EXPECT_THAT(drawing->svg,
              HasSubstr(R"(<rect id="drawing-valve" font-size="9px" fill="green" stroke="none"/>)"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(<rect font-size="9px" fill="grey"/>)"));
  EXPECT_THAT(drawing->svg, Not(HasSubstr("<style")));
  EXPECT_EQ(remarks_on(drawing), "");
  EXPECT_EQ(read_drawing("plant.svg", drawing->svg)->svg, drawing->svg);
}

TEST(ForeignDrawing, WhenARuleCannotBeFollowed_ThenItIsNamed) {
  const auto drawing = foreign(
      "<style>\n.a:hover{fill:red} @media print{.b{fill:red}} g .c{fill:red}\n.d{fill:blue}</style>"
      "<rect class='d'/>");
  const std::string said = remarks_on(drawing);
  for (const char* rule : {"'.a:hover'", "'@media print'", "'g .c'"})
    EXPECT_THAT(said, HasSubstr(std::string("C0646: the style sheet's rule ") + rule + " is left out"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(<rect fill="blue"/>)"));
}

TEST(ForeignDrawing, WhenStyleSheetsSayTooMuch_ThenTheyAreRefused) {
  std::string rules, shapes;
  for (std::size_t i = 0; i < 4'000; ++i) rules += "*{fill:red}";
  for (std::size_t i = 0; i < 9'000; ++i) shapes += "<g/>";
  EXPECT_THAT(refusal_of(foreign("<style>" + rules + "</style>" + shapes)),
              HasSubstr("plant.svg:1:2: C0644: the style sheets"));
  EXPECT_THAT(refusal_of(foreign("<style>" + rules + rules + "</style>")),
              HasSubstr("plant.svg:1:2: C0644: the style sheets"));
}

TEST(ForeignDrawing, WhenOtherProgramsHaveAttributesOfTheirOwn_ThenTheyAreLeftOut) {
  const auto layers = foreign(R"(<g data-name="Layer 1" data-cell-id="2"><rect data-name="pump"/></g>)");
  EXPECT_EQ(remarks_on(layers), "");
  EXPECT_THAT(layers->svg, Not(HasSubstr("data-")));
  EXPECT_EQ(remarks_on(foreign("<rect/>\n<rect data-fil='a1.level'/><rect data-fil=''/>")),
            "plant.svg:3:2: warning: C0643: there is no binding data-fil: it is left out (2 times)\n"
            "  hint: did you mean data-fill?");
  EXPECT_THAT(remarks_on(foreign("<rect data-qqqq='1'/>")), HasSubstr("hint: data-text, data-on"));
}

TEST(ForeignDrawing, WhenAFilterIsUsed_ThenItIsSaidWhatIsMissing) {
  const std::string filter = "<filter id='f'><feFlood/><feImage href='http://elsewhere/a.png'/></filter>";
  EXPECT_EQ(remarks_on(foreign(filter + "<rect/>")), "") << "nobody uses it";
  const auto drawing =
      foreign(filter + "<rect filter='url(#f)'/>\n<g style='filter:url(#f);mix-blend-mode:multiply'/>");
  EXPECT_THAT(remarks_on(drawing), HasSubstr("plant.svg:2:"));
  EXPECT_THAT(remarks_on(drawing),
              HasSubstr("filter is left out: shadows, blurs and other filters are not drawn (2 times)"));
  EXPECT_THAT(remarks_on(drawing), HasSubstr("mix-blend-mode is left out: colours lie on each other"));
  EXPECT_THAT(drawing->svg, Not(HasSubstr("filter")));
}

TEST(ForeignDrawing, WhenSomethingIsMasked_ThenItStaysMasked) {
  const auto drawing = foreign(
      "<mask id='m' style='mask-type:luminance' maskUnits='userSpaceOnUse'><rect/></mask>"
      "<g mask='url(#m)'><circle r='2'/></g>");
  EXPECT_EQ(remarks_on(drawing), "");
  EXPECT_THAT(drawing->svg,
              HasSubstr(R"(<mask id="drawing-m" maskUnits="userSpaceOnUse" mask-type="luminance">)"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"svg(<g mask="url(#drawing-m)">)svg"));
}

TEST(ForeignDrawing, WhenThereIsAChoice_ThenTheFirstThatCanBeDrawnIs) {
  const auto label = foreign(
      "<switch transform='translate(1 2)'><foreignObject><div>B</div></foreignObject>"
      "<text>A</text><text>C</text></switch>");
  EXPECT_THAT(label->svg, HasSubstr(R"svg(<g transform="translate(1 2)"><text>A</text></g>)svg"));
  EXPECT_THAT(label->svg, Not(HasSubstr("div")));
  EXPECT_THAT(remarks_on(label),
              HasSubstr("formatted text (HTML) is left out: the plain text beside it is drawn"));
  const auto help = foreign(
      "<rect/><switch><g requiredFeatures='x'/><a href='https://elsewhere'><text>help</text></a></switch>");
  EXPECT_EQ(remarks_on(help), "");
  EXPECT_THAT(help->svg, HasSubstr("<g><g/></g>"));
  const auto language = foreign("<switch><text systemLanguage='de'>Pumpe</text><text>pump</text></switch>");
  EXPECT_THAT(language->svg, HasSubstr("<g><text>pump</text></g>"));
  EXPECT_THAT(remarks_on(foreign("<rect/><switch><foreignObject/></switch>")),
              HasSubstr("no plain text stands beside it"));
}

TEST(ForeignDrawing, WhenItIsBrokenOrEmpty_ThenItIsSaid) {
  EXPECT_THAT(remarks_on(foreign("<image href='data:image/png;base64,AAAA'/>")),
              HasSubstr("C0646: the data of a picture is none"));
  EXPECT_EQ(remarks_on(foreign(
                "<image href='data:image/png;base64,"
                "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJg"
                "gg=='/>")),
            "");
  EXPECT_THAT(remarks_on(foreign("<title>plant</title><g/>")),
              HasSubstr("plant.svg:1:2: warning: C0646: nothing is drawn in it"));
  EXPECT_EQ(remarks_on(foreign("<g data-part='alarms'/>")), "") << "the page draws it";
  for (const char* wrong : {"width='1e999'", "height='nan'", "x='wide'", "d='M 0 0 L nan 1'",
                            "points='0,0 1e999,1'", "transform='scale(1e999)'", "rx='1 2e10'"})
    EXPECT_THAT(remarks_on(foreign(std::string("<rect/><path ") + wrong + "/>")),
                HasSubstr("that cannot be drawn"))
        << wrong;
  for (const char* right :
       {"width='12.5mm'", "height='50%'", "x='1 2,3 4e1'", "d='M.5.5-1e-400+2 a1,1 0 01 2 2z'", "rx='auto'",
        "width='{wide}'", "transform='rotate(-5 1,2)'", "points=''"})
    EXPECT_EQ(remarks_on(foreign(std::string("<rect/><path ") + right + "/>")), "") << right;
  EXPECT_THAT(kept("<rect width='1e999' height='2'/>"), HasSubstr(R"(<rect height="2"/>)"));
  EXPECT_THAT(kept("<rect style='fill:#FFF !important'/>"), HasSubstr(R"(<rect fill="#FFF"/>)"));
}

}  // namespace
}  // namespace stepwright::drawing
