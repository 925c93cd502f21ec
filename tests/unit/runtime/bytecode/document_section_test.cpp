#include "runtime/bytecode/writer/document_section.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "runtime/bytecode/reader/document_text.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/sample_model.h"
#include "tests/unit/runtime/bytecode/container_change.h"

namespace stepwright::bytecode {
namespace {

std::vector<std::byte> bare() {
  return writer::write_container(support::sample_model()).value();
}

TEST(DocumentSection, WhenADocumentIsAdded_ThenTheVerifierTakesItAndTheTextIsThere) {
  const auto bytes = writer::with_document(bare(), "the sources");
  EXPECT_TRUE(verify_bytes(bytes).ok());
  EXPECT_EQ(reader::document_text(bytes), "the sources");
  const auto info = reader::ProgramInfo::read(bytes);
  const auto same = reader::ProgramInfo::read(bare());
  ASSERT_TRUE(info && same);
  EXPECT_EQ(info->tags().size(), same->tags().size());
}

TEST(DocumentSection, WhenItIsTakenAway_ThenTheBytesAreThoseOfTheProgramAlone) {
  EXPECT_EQ(writer::without_document(writer::with_document(bare(), "x")), bare());
  EXPECT_EQ(writer::with_document(writer::with_document(bare(), "x"), "yz"),
            writer::with_document(bare(), "yz"));
  EXPECT_EQ(reader::document_text(bare()), "");
}

TEST(DocumentSection, WhenItIsEmptyOrTooLong_ThenItIsLeftOut) {
  EXPECT_EQ(writer::with_document(bare(), ""), bare());
  EXPECT_EQ(writer::with_document(bare(), std::string(kMaxDocumentBytes + 1, 'x')), bare());
  const auto longest = writer::with_document(bare(), std::string(kMaxDocumentBytes, 'x'));
  EXPECT_TRUE(verify_bytes(longest).ok());
}

TEST(DocumentSection, WhenBytesAreNoContainer_ThenTheyStayAsTheyAre) {
  const std::vector<std::byte> garbage(100, std::byte{7});
  EXPECT_EQ(writer::with_document(garbage, "x"), garbage);
  EXPECT_EQ(reader::document_text(garbage), "");
}

TEST(DocumentSection, WhenAnyBitIsFlipped_ThenTheFileIsRefused) {
  std::vector<std::byte> bytes = writer::with_document(bare(), "the sources");
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    ASSERT_FALSE(verify_bytes(bytes).ok()) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

// What the checksum does not guard against: somebody who computes it.
TEST(DocumentSection, WhenItsEntryOrTheirNumberIsWrong_ThenTheFileIsRefused) {
  const auto changed = [](std::size_t at, std::uint32_t value, std::size_t size) {
    std::vector<std::byte> bytes = writer::with_document(bare(), "the sources");
    std::memcpy(bytes.data() + at, &value, size);
    fix_checksum(bytes);
    return verify_bytes(bytes).status;
  };
  const std::size_t entry = sizeof(FileHeader) + kSectionCount * sizeof(SectionEntry);
  for (const std::uint32_t count : {0u, 1u, 19u, 20u, 22u, 65535u})
    EXPECT_EQ(changed(6, count, 2), VerifyStatus::BadSectionTable) << count;
  for (const std::uint32_t value : {0u, 8u, 0xFFFFFFF8u})
    EXPECT_EQ(changed(entry + 4, value, 4), VerifyStatus::BadSectionTable) << "offset " << value;
  for (const std::uint32_t value : {0u, 10u, 12u, 0xFFFFFFFFu})
    EXPECT_EQ(changed(entry + 8, value, 4), VerifyStatus::BadSectionTable) << "size " << value;
  EXPECT_EQ(changed(entry, 19, 4), VerifyStatus::BadSectionTable);
}

}  // namespace
}  // namespace stepwright::bytecode
