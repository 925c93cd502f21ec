#include "runtime/ground/markup/xml_text.h"

#include <gtest/gtest.h>

namespace stepwright::markup {
namespace {

TEST(XmlText, WhenItIsEscaped_ThenXmlCanHoldIt) {
  EXPECT_EQ(xml_escaped("a<b & \"c\" > d"), "a&lt;b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_escaped("tab\tline\nbell\a"), "tab\tline\nbell ");
  EXPECT_EQ(xml_escaped("Förderer"), "Förderer");
  EXPECT_EQ(xml_escaped("\xFFx\xC3"), "\xEF\xBF\xBDx\xEF\xBF\xBD");
  for (const char* text : {"\xFF", "\xC3", "\xED\xA0\x80", "\xEF\xBF\xBF", "\a"}) {
    EXPECT_FALSE(is_xml_text(text));
    EXPECT_TRUE(is_xml_text(xml_escaped(text)));
  }
  EXPECT_TRUE(is_xml_text("a\tb\r\n\xF0\x9F\x94\xA7"));
}

}  // namespace
}  // namespace stepwright::markup
