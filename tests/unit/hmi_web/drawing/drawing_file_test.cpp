#include "hmi_web/drawing/drawing_file.h"

#include <gmock/gmock.h>

#include <string>

namespace stepwright::drawing {
namespace {

using testing::HasSubstr;
using testing::Not;

result::Result<Drawing> of(const std::string& inside) {
  return read_drawing("plant.svg", "<svg viewBox=\"0 0 9 9\">\n" + inside + "\n</svg>");
}

std::string drawn(const std::string& inside) {
  const auto drawing = of(inside);
  return drawing ? drawing->svg : result::to_string(drawing.error());
}

// The code, line and message of the first mistake.
std::string mistake(const result::Result<Drawing>& drawing) {
  if (drawing) return "none: " + drawing->svg;
  const result::Diagnostic& first = drawing.error().front();
  return first.code + " " + std::to_string(first.where.line) + " " + first.message;
}

TEST(Drawing, WhenItIsNoUtf8_ThenItsFirstByteIsNamed) {
  EXPECT_THAT(drawn("<text>20 \u00B0C</text>"), HasSubstr("20 \u00B0C"));
  EXPECT_EQ(mistake(of("<text>20 \xB0"
                       "C</text>")),
            "C0640 2 this is no UTF-8");
}

TEST(Drawing, WhenItIsOfADrawingProgram_ThenShapesStayAndItsOwnNotesAreLeftOut) {
  const auto drawing = read_drawing("plant.svg", R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg:svg xmlns:svg="http://www.w3.org/2000/svg" xmlns:inkscape="x" width="210mm" height="100mm" inkscape:version="1.2">
  <sodipodi:namedview id="base"/>
  <svg:metadata><rdf:RDF/></svg:metadata>
  <svg:g inkscape:label="Layer 1" class="layer">
    <svg:path style="fill:#ff0000;stroke:none; -inkscape-font-specification:Sans" fill="blue" d="M0 0H5"/>
    <svg:text x="1">Tank &amp; pump</svg:text>
  </svg:g>
</svg:svg>)");
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_THAT(drawing->svg, HasSubstr(R"(viewBox="0 0 210 100")"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(fill="#ff0000")"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(<text x="1">Tank &amp; pump</text>)"));
  for (const char* gone :
       {"inkscape", "sodipodi", "metadata", "class", "style", "svg:", "blue", "DOCTYPE", "width"})
    EXPECT_THAT(drawing->svg, Not(HasSubstr(gone)));
}

TEST(Drawing, WhenPartsAreReferredTo_ThenTheirIdsAreTheDrawingsOwn) {
  const std::string svg = drawn(
      "<defs><linearGradient id='g'><stop offset='0'/></linearGradient><path id='valve' d='M0 0'/></defs>"
      "<use xlink:href='#valve' fill=\"url('#g')\"/>");
  EXPECT_THAT(svg, HasSubstr(R"(id="drawing-valve")"));
  EXPECT_THAT(svg, HasSubstr(R"(href="#drawing-valve")"));
  EXPECT_THAT(svg, HasSubstr("url('#drawing-g')"));
}

TEST(Drawing, WhenElementsAreBound_ThenEachNameHasItsPlace) {
  const auto drawing = read_drawing("plant.svg",
                                    "<svg viewBox='0 0 9 9'>\n <rect data-on='!main.run'/>\n\n"
                                    "<g><text data-text='a1.level' data-alarm='main.dry'/></g></svg>");
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  std::vector<std::string> names;
  for (const BoundName& each : drawing->names)
    names.push_back(each.name + " " + each.where.file + ":" + std::to_string(each.where.line) + ":" +
                    std::to_string(each.where.column));
  EXPECT_THAT(names, testing::ElementsAre("main.run plant.svg:2:3", "a1.level plant.svg:4:5",
                                          "main.dry plant.svg:4:5"));
  EXPECT_EQ(drawing->bindings, 3u);
}

struct Hostile {
  const char* inside;
  const char* mistake;
};

class HostileDrawing : public testing::TestWithParam<Hostile> {};

TEST_P(HostileDrawing, WhenItIsRead_ThenItIsRefusedWithItsLine) {
  EXPECT_THAT(mistake(of(GetParam().inside)), HasSubstr(GetParam().mistake));
}

INSTANTIATE_TEST_SUITE_P(
    All, HostileDrawing,
    testing::Values(
        Hostile{"<script>alert(1)</script>", "C0641 2 the element <script>"},
        Hostile{"\n<foreignObject><body/></foreignObject>", "C0641 3 the element <foreignObject>"},
        Hostile{"<image href='http://elsewhere/a.png'/>", "C0642 2 the attribute href"},
        Hostile{"<image href='data:image/svg+xml;base64,AA'/>", "C0642 2 the attribute href"},
        Hostile{"<image xlink:href='data:image/png,&lt;script>'/>", "C0642 2 the attribute xlink:href"},
        Hostile{"<style>@import url(//e/a.css);</style>", "C0642 2 the style sheet loads another one"},
        Hostile{"<style>rect{fill:url(//e)}</style>\n<rect/>", "C0642 3 the attribute fill"},
        Hostile{"<style>.a{fill:u/**/rl(//e)}</style><rect class='a'/>", "C0642 2 the attribute fill"},
        Hostile{"<style>*{behavior:url(//e)}</style><rect/>", "C0642 1 the attribute behavior"},
        Hostile{"<style>#a{fill:u\\72l(//e)}</style><rect id='a'/>", "C0642 2 the attribute fill"},
        Hostile{"<style>.a{fill:url(#p)}</style><pattern id='p'><rect class='a'/></pattern>"
                "<rect fill='url(#p)'/>",
                "C0644 2 this <rect> refers"},
        Hostile{"<switch><script>alert(1)</script><g/></switch>", "C0641 2 the element <script>"},
        Hostile{"<mask id='m'><rect mask='url(//e#m)'/></mask>", "C0642 2 the attribute mask"},
        Hostile{"<mask id='m'><rect mask='url(#m)'/></mask>", "C0644 2 this <rect> refers"},
        Hostile{"<a href='#x'/>", "C0641 2 the element <a>"},
        Hostile{"<rect><animate attributeName='x'/></rect>", "C0641 2 the element <animate>"},
        Hostile{"<rect onclick='alert(1)'/>", "C0642 2 the attribute onclick"},
        Hostile{"<rect OnClick='alert(1)'/>", "C0642 2 the attribute OnClick"},
        Hostile{"<rect ONMOUSEOVER='alert(1)'/>", "C0642 2 the attribute ONMOUSEOVER"},
        Hostile{"<symbol viewBox='0 0 NaN 1'/>", "C0640 2 viewBox=\"0 0 NaN 1\" says no place and size"},
        Hostile{"<use href='http://elsewhere/x.svg#a'/>", "C0642 2 the attribute href"},
        Hostile{"<rect fill='url(http://elsewhere/x)'/>", "C0642 2 the attribute fill"},
        Hostile{"<rect style='fill: u\\72l(//elsewhere)'/>", "C0642 2 the attribute fill"},
        Hostile{"<rect style='fill:url( \"//elsewhere\" )'/>", "C0642 2 the attribute fill"},
        Hostile{"<rect width='url(//e)'/>", "C0642 2 the attribute width"},
        Hostile{"<rect style='background:url(//e)'/>", "C0642 2 the attribute background"},
        Hostile{"<rect style='fill:red;list-style: URL( //e )'/>", "C0642 2 the attribute list-style"},
        Hostile{"<rect style='background:url(\"data:;x\")'/>", "C0642 2 the attribute background"},
        Hostile{"<rect filter='url(//e#a)'/>", "C0642 2 the attribute filter"},
        Hostile{"<text>a &b; c</text>", "C0640 2 this is no character that XML knows: &b"},
        Hostile{"<text>\nAT&T</text>", "C0640 3 this is no character that XML knows: &T"},
        Hostile{"<rect data-on='&b;'/>", "C0640 2 this is no character"},
        Hostile{"<text>\n a&#xD800;b</text>", "C0640 3 this is no character that XML knows: &#xD800"},
        Hostile{"<text>&#x110000;</text>", "C0640 2 this is no character that XML knows: &#x110000"},
        Hostile{"<text>&#4294967361;</text>", "C0640 2 this is no character that XML knows: &#42949673"},
        Hostile{"<text>&#1;</text>", "C0640 2 this is no character that XML knows: &#1"},
        Hostile{"<text>&#0;</text>", "C0640 2 this is no character that XML knows: &#0"},
        Hostile{"<text>&#xFFFE;</text>", "C0640 2 this is no character that XML knows: &#xFFFE"},
        Hostile{"<rect data-on='&#27;'/>", "C0640 2 this is no character that XML knows: &#27"},
        Hostile{"<rect data-confirm='\x1B'/>", "C0640 2 this is no character that XML knows: U+001B"},
        Hostile{"<!-- \xEF\xBF\xBF -->", "C0640 2 this is no character that XML knows: U+FFFF"},
        Hostile{"<g><rect></g>", "C0640 2 this is no well-formed XML"},
        Hostile{"<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>", "C0644 2 this <use>"}));

TEST(Drawing, WhenADoctypeDeclaresEntities_ThenItIsRefusedWithItsLine) {
  EXPECT_THAT(mistake(read_drawing("x",
                                   "<?xml version='1.0'?>\n<!DOCTYPE svg [<!ENTITY b 'lots'>]>\n"
                                   "<svg viewBox='0 0 9 9'><text>&b;</text></svg>")),
              HasSubstr("C0641 2 a DOCTYPE with declarations"));
}

TEST(Drawing, WhenCharactersAreWrittenAsXmlHasThem_ThenTheyStay) {
  const std::string svg = drawn("<!-- &b; --><text>&lt;&#176;&#xB0; &amp;<![CDATA[&b;]]></text>");
  EXPECT_THAT(svg, HasSubstr("&lt;\xC2\xB0\xC2\xB0 &amp;"));
}

// Breaks within a label: U+000B of PowerPoint, U+0003 of Illustrator. Neither is a character of XML.
TEST(Drawing, WhenADrawingProgramHasWrittenSoftBreaks_ThenTheyAreLineEnds) {
  const std::string svg =
      drawn("<text data-label='a&#11;b'>Tank&#11;1&#x3;2\v3</text><g><title>x</title></g>");
  EXPECT_THAT(svg, HasSubstr("Tank\n1\n2\n3"));
  EXPECT_THAT(svg, HasSubstr("a&#10;b"));
}

// Whatever is kept is read again.
TEST(Drawing, WhenItIsLargerAsItIsKept_ThenItIsRefused) {
  const std::string quotes(kLargestFile / 2, '"');
  EXPECT_THAT(mistake(of("<text font-family='" + quotes + "'/>")),
              HasSubstr("C0640 0 the drawing as it is kept is larger than 2 MiB"));
}

TEST(Drawing, WhenAZeroByteStandsInIt_ThenItIsRefusedWithItsLine) {
  EXPECT_THAT(mistake(read_drawing("x", std::string("<svg viewBox='0 0 9 9'>\n<g/></svg>\0<g/>", 39))),
              HasSubstr("C0640 2 this is no character that XML knows: U+0000"));
}

TEST(Drawing, WhenNotAnSvgOrWithoutSize_ThenItSaysSo) {
  EXPECT_THAT(mistake(read_drawing("x", "<html/>")), HasSubstr("C0640 1 the file holds <html>"));
  EXPECT_THAT(mistake(read_drawing("x", "<svg/>")), HasSubstr("C0640 1 the drawing has no size"));
  EXPECT_THAT(mistake(read_drawing("x", "")), HasSubstr("C0640 1"));
  EXPECT_THAT(mistake(read_drawing("x", std::string(kLargestFile + 1, ' '))), HasSubstr("larger than 2 MiB"));
  EXPECT_THAT(mistake(load_drawing("/nowhere.svg")), HasSubstr("cannot be read"));
}

TEST(Drawing, WhenAViewBoxIsNoFourNumbers_ThenItIsRefusedOnceWithWhatItIs) {
  for (const char* wrong :
       {"0 0 NaN 100", "nan nan nan nan", "0 0 inf 100", "0 0 1e999 1", "0 0 100", "0 0 0 100", "0 0 100 -1",
        "0 0 100 100 1", "0 0 100px 100", "", "0 0 2000000 1"}) {
    const auto read = read_drawing("x", std::string("<svg viewBox='") + wrong + "' width='9' height='9'/>");
    ASSERT_FALSE(read.has_value()) << wrong;
    EXPECT_EQ(read.error().size(), 1u);
    EXPECT_THAT(mistake(read),
                HasSubstr("C0640 1 viewBox=\"" + std::string(wrong) + "\" says no place and size"));
  }
  for (const char* right : {"0 0 100 50", "-5,-5, 10,10", " 0\n0 1e3 .5 "})
    EXPECT_TRUE(read_drawing("x", std::string("<svg viewBox='") + right + "'/>").has_value()) << right;
  EXPECT_THAT(mistake(read_drawing("x", "<svg width='inf' height='9'/>")),
              HasSubstr("the drawing has no size"));
  EXPECT_THAT(mistake(read_drawing("x", "<svg width='nan' height='9'/>")),
              HasSubstr("the drawing has no size"));
}

TEST(Drawing, WhenTooMuchIsInIt_ThenItIsRefusedAndNotShownInPart) {
  std::string many, deep;
  for (std::size_t i = 0; i <= kMostElements; ++i) many += "<g/>";
  EXPECT_THAT(mistake(of(many)), HasSubstr("more than 20000 elements"));
  for (int i = 0; i < kDeepest; ++i) deep = "<g>" + deep + "</g>";
  EXPECT_THAT(mistake(of(deep)), HasSubstr("nested more than 64 deep"));
  std::string bound;
  for (std::size_t i = 0; i <= kMostBindings; ++i) bound += "<rect data-on='Main.x'/>";
  EXPECT_THAT(mistake(of(bound)), HasSubstr("more than 2000 bindings"));
  std::string uses = "<g id='a'>";
  for (int i = 0; i < 300; ++i) uses += "<rect/>";
  uses += "</g>";
  for (int i = 0; i < 100; ++i) uses += "<use href='#a'/>";
  EXPECT_THAT(mistake(of(uses)), HasSubstr("all <use>, patterns, clips and markers together"));
}

// Eight levels of ten references each: a hundred million shapes, by whatever refers to the level below.
std::string levels(const std::string& element, const std::string& reference) {
  std::string all = "<" + element + " id='a0'><rect/></" + element + ">";
  for (int level = 1; level < 9; ++level) {
    const std::string below = "a" + std::to_string(level - 1);
    all += "<" + element + " id='a" + std::to_string(level) + "'>";
    for (int i = 0; i < 10; ++i)
      all += reference.substr(0, reference.find('*')) + below + reference.substr(reference.find('*') + 1);
    all += "</" + element + ">";
  }
  return all + reference.substr(0, reference.find('*')) + "a8" + reference.substr(reference.find('*') + 1);
}

// Far deeper than any stack of whoever would follow it element by element.
TEST(Drawing, WhenElementsAreNestedWithoutEnd_ThenItIsRefusedAlsoInWhatIsLeftOut) {
  std::string nested;
  for (int i = 0; i < 120'000; ++i) nested += "<g>";
  for (int i = 0; i < 120'000; ++i) nested += "</g>";
  EXPECT_THAT(mistake(of(nested)), HasSubstr("C0644 2 elements are nested more than 64 deep"));
  EXPECT_THAT(mistake(of("<metadata>" + nested + "</metadata>")),
              HasSubstr("C0644 2 elements are nested more than 64 deep"));
}

TEST(Drawing, WhenReferencesMultiply_ThenTheyAreRefusedHoweverTheyAreSpelt) {
  for (const auto& [element, reference] : {std::pair("g", "<use href='#nothing' xlink:href='#*'/>"),
                                           std::pair("g", "<use xlink:href='#*' href='#nothing'/>")}) {
    const auto drawing = of(levels(element, reference));
    ASSERT_TRUE(drawing) << "what counts is href, which refers to nothing";
    EXPECT_THAT(drawing->svg, Not(HasSubstr("#drawing-a")));
  }
  for (const auto& [element, reference] : {std::pair("g", "<use xlink:href='#nothing' href='#*'/>"),
                                           std::pair("pattern", "<rect fill='url(#*)'/>"),
                                           std::pair("pattern", "<rect style='stroke:url(\"#*\")'/>"),
                                           std::pair("clipPath", "<rect clip-path='url(#*)'/>"),
                                           std::pair("marker", "<path d='M0 0L1 1' marker-end='url(#*)'/>"),
                                           std::pair("pattern", "<pattern href='#*'/>")})
    EXPECT_THAT(mistake(of(levels(element, reference))), HasSubstr("C0644 2")) << reference;
  EXPECT_THAT(mistake(of("<pattern id='p'><rect fill='url(#p)'/></pattern><rect fill='url(#p)'/>")),
              HasSubstr("leads back to it"));
  std::string path(60'000, ' ');
  for (std::size_t i = 0; i + 4 < path.size(); i += 4) path.replace(i, 3, "L11");
  EXPECT_THAT(mistake(of("<marker id='m'><rect/></marker><path marker-mid='url(#m)' d='" + path + "'/>")),
              HasSubstr("C0644 2 all <use>"));
}

TEST(Drawing, WhenReferencesAreOrdinary_ThenTheyAreDrawn) {
  const auto drawing =
      of("<defs><clipPath id='c'><rect/></clipPath><linearGradient id='g'/><pattern id='h'><path "
         "fill='url(#g)'/></pattern>"
         "<marker id='m'><path/></marker><symbol id='s'><g clip-path='url(#c)'><rect "
         "fill='url(#h)'/></g></symbol></defs>"
         "<use href='#s'/><use href='#s'/><path marker-end='url(#m)' d='M0 0L1 1'/><path "
         "style='stroke:red;fill:url(#h)' d='" +
         std::string(60'000, ' ') + "'/>");
  EXPECT_TRUE(drawing) << result::to_string(drawing.error());
}

TEST(Drawing, WhenSeveralMistakesAreInIt_ThenAllAreTold) {
  const auto drawing = of("<script/>\n<rect data-on=''/>\n<foreignObject/>");
  ASSERT_FALSE(drawing);
  EXPECT_EQ(drawing.error().size(), 3U);
}

}  // namespace
}  // namespace stepwright::drawing
