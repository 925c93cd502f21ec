#include "cell/import/address_tokens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stepwright::cell_import {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(AddressTokens, WhenItIsCodeOrAnAttributeOfOne_ThenItIsAnAddress) {
  EXPECT_THAT(
      addresses_in("<variable name='a' address = '%QX0.0'/><body><ST><xhtml:p>a := %IX0.1 &gt; %MW3;"
                   "</xhtml:p></ST></body><expression>%IW2</expression><ST><![CDATA[b := %QW1.0.3..]]></ST>"
                   "<action><reference name=\"%QX0.7\"/></action><task single='%IX0.2'/>"),
      ElementsAre("%QX0.0", "%IX0.1", "%MW3", "%IW2", "%QW1.0.3", "%QX0.7", "%IX0.2"));
}

TEST(AddressTokens, WhenPeopleWriteAboutIt_ThenItIsNone) {
  EXPECT_THAT(addresses_in("<!-- %QW0 --><?%QW0?><documentation><xhtml:p>%QW0</xhtml:p></documentation>"
                           "<comment><content><xhtml:p>%QW0</xhtml:p></content></comment>"
                           "<addData><data name='x'><b address='%QW0'>%QW0</b></data></addData>"
                           "<fileHeader contentDescription='%QW0'/>"),
              IsEmpty());
}

TEST(AddressTokens, WhenItStandsInATextOrACommentOfTheProgram_ThenItIsNone) {
  EXPECT_THAT(
      addresses_in("<ST><![CDATA[s := '%QW0 $'%QW1'; t := \"%QW2\"; (* %QW3 (* %QW4 *) %QW5 *) // %QW6\n"
                   "a := %QW7;]]></ST><ST>s := &apos;%QW8&apos;; t := &quot;%QW9&quot;; b := %QW10;</ST>"),
      ElementsAre("%QW7", "%QW10"));
}

TEST(AddressTokens, WhenACommentGoesOverLines_ThenItEndsWhereTheBodyDoes) {
  EXPECT_THAT(addresses_in("<ST><xhtml:p>(* one</xhtml:p><xhtml:p>%QW0 *) a := %QW1; (*</xhtml:p></ST>"
                           "<ST><xhtml:p>b := %QW2;</xhtml:p></ST>"),
              ElementsAre("%QW1", "%QW2"));
}

TEST(AddressTokens, WhenAddressesChange_ThenEverythingElseStays) {
  const std::string xml = "<ST>'%QW0' %QW0 <!-- %QW0 --> %QW0</ST>";
  EXPECT_EQ(with_addresses(xml, [](const std::string&) { return "%QW10"; }),
            "<ST>'%QW0' %QW10 <!-- %QW0 --> %QW10</ST>");
}

}  // namespace
}  // namespace stepwright::cell_import
