// Who may do what.

#include "runtime/modbus/server/access.h"

#include <gtest/gtest.h>

namespace stepwright::modbus::server {
namespace {

using map::Table;
using pdu::Exception;

constexpr Table kHolding = Table::HoldingRegisters;

ClientRule rule(const char* address, std::vector<Window> read, std::vector<Window> write,
                std::string role = {}) {
  ClientRule made;
  made.any = *address == '\0';
  if (!made.any) made.address = *network::IpRange::parse(address);
  made.role = std::move(role);
  made.read = std::move(read);
  made.write = std::move(write);
  return made;
}

TEST(Access, WhenThereAreNoRules_ThenEverythingIsReadAndNothingWritten) {
  const Rights rights = Access({}).of({"10.1.2.3", {}, false});
  EXPECT_EQ(rights.read(kHolding, 0, 125), Exception::None);
  EXPECT_EQ(rights.read(Table::DiscreteInputs, 65'535, 1), Exception::None);
  EXPECT_EQ(rights.write(kHolding, 0, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(rights.write(Table::Coils, 0, 1), Exception::IllegalDataAddress);
}

TEST(Access, WhenWindows_ThenOnlyWhatLiesWhollyWithin) {
  const Access access({rule("10.0.0.0/8", {{kHolding, 10, 19}, {kHolding, 20, 29}}, {{kHolding, 10, 19}})});
  const Rights rights = access.of({"10.1.2.3", {}, false});
  EXPECT_EQ(rights.read(kHolding, 10, 20), Exception::None);
  EXPECT_EQ(rights.read(kHolding, 10, 21), Exception::IllegalDataAddress);
  EXPECT_EQ(rights.read(kHolding, 9, 2), Exception::IllegalDataAddress);
  EXPECT_EQ(rights.read(Table::InputRegisters, 10, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(rights.write(kHolding, 19, 1), Exception::None);
  EXPECT_EQ(rights.write(kHolding, 19, 2), Exception::IllegalDataAddress);
  EXPECT_TRUE(access.any_writes());
}

TEST(Access, WhenNoRuleFits_ThenNothing) {
  const Access access({rule("10.0.0.0/8", {{kHolding}}, {})});
  EXPECT_EQ(access.of({"11.0.0.1", {}, false}).read(kHolding, 0, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(access.of({"/dev/ttyUSB0", {}, false}).read(kHolding, 0, 1), Exception::IllegalDataAddress);
  EXPECT_FALSE(access.any_writes());
}

TEST(Access, WhenSeveralFit_ThenTheLongestPrefixDecides) {
  const Access access({rule("10.0.0.0/8", {{kHolding}}, {{kHolding}}),
                       rule("10.0.0.7", {{kHolding, 0, 0}}, {}), rule("10.0.0.0/16", {{kHolding}}, {})});
  EXPECT_EQ(access.of({"10.0.0.7", {}, false}).read(kHolding, 1, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(access.of({"10.0.0.8", {}, false}).write(kHolding, 1, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(access.of({"10.9.0.8", {}, false}).write(kHolding, 1, 1), Exception::None);
}

TEST(Access, WhenRoles_ThenOnlyTheAuthenticatedHaveThemAndRefusalsAreException1) {
  const Access access(
      {rule("", {{kHolding}}, {{kHolding, 0, 9}}, "operator"), rule("0.0.0.0/0", {{kHolding}}, {})});
  EXPECT_EQ(access.of({"10.0.0.7", "operator", true}).write(kHolding, 9, 1), Exception::None);
  EXPECT_EQ(access.of({"10.0.0.7", "operator", true}).write(kHolding, 10, 1), Exception::IllegalFunction);
  EXPECT_EQ(access.of({"10.0.0.7", "operator", false}).write(kHolding, 9, 1), Exception::IllegalDataAddress);
  const Access roles_only({rule("", {{kHolding}}, {}, "operator")});
  EXPECT_EQ(roles_only.of({"10.0.0.7", "viewer", true}).read(kHolding, 0, 1), Exception::IllegalFunction);
  EXPECT_EQ(roles_only.of({"10.0.0.7", "", true}).read(kHolding, 0, 1), Exception::IllegalFunction);
}

}  // namespace
}  // namespace stepwright::modbus::server
