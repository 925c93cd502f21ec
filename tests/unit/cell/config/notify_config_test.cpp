#include "cell/config/notify_config.h"

#include <gtest/gtest.h>

#include <fstream>

namespace stepwright::config {
namespace {

struct Read {
  std::vector<NotifyConfig> all;
  std::string codes;  // of the document, then of other files
};

Read read(const std::string& text) {
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read read;
  result::Diagnostics found;
  read.all = read_notify((*document)->root(), testing::TempDir(), found);
  result::Diagnostics problems = (*document)->finish();
  problems.insert(problems.end(), found.begin(), found.end());
  for (const auto& problem : problems) read.codes += (read.codes.empty() ? "" : " ") + problem.code;
  return read;
}

const std::string kMail =
    "[[notify]]\nname = \"shift\"\nmail = [\"a@plant.example\"]\nserver = \"smtp://mail.plant:587\"\nfrom = "
    "\"line@plant\"\n";

TEST(NotifyConfig, WhenNobodyIsNamed_ThenNobodyIsTold) {
  EXPECT_TRUE(read("").all.empty());
}

TEST(NotifyConfig, WhenMailAndWebHookAreGiven_ThenAllOfThemIsRead) {
  std::ofstream(testing::TempDir() + "/mail.secret") << "s3cret\nmore\n";
  const Read both =
      read(kMail +
           "user = \"line\"\npassword_file = \"mail.secret\"\ntls = false\npriority = \"critical\"\n"
           "delay_s = 5\nrepeat_min = 0\n[[notify]]\nname = \"chat\"\nweb_hook = \"https://chat/x\"\n");
  EXPECT_EQ(both.codes, "");
  ASSERT_EQ(both.all.size(), 2u);
  EXPECT_EQ(both.all[0].password, "s3cret") << "its first line";
  EXPECT_FALSE(both.all[0].tls);
  EXPECT_EQ(both.all[0].delay, std::chrono::seconds(5));
  EXPECT_EQ(both.all[0].repeat, std::chrono::minutes(0));
  EXPECT_EQ(both.all[1].web_hook, "https://chat/x");
  EXPECT_EQ(both.all[1].priority, "high");
  EXPECT_EQ(both.all[1].delay, std::chrono::seconds(60));
}

TEST(NotifyConfig, WhenSomethingCannotBe_ThenItIsRefused) {
  EXPECT_EQ(read("[[notify]]\nname = \"x\"\n").codes, "C0635") << "neither mail nor web hook";
  EXPECT_EQ(read(kMail + "web_hook = \"https://chat/x\"\n").codes, "C0635") << "both";
  EXPECT_EQ(read(kMail + kMail).codes, "C0635") << "a name twice";
  EXPECT_EQ(read("[[notify]]\nname = \"x\"\nweb_hook = \"file:///etc/passwd\"\n").codes, "C0635");
  EXPECT_EQ(
      read(
          "[[notify]]\nname = \"x\"\nmail = [\"a@b\\r\\nBcc: c@d\"]\nserver = \"smtp://m\"\nfrom = \"a@b\"\n")
          .codes,
      "C0635");
  EXPECT_EQ(read("[[notify]]\nname = \"x\"\nmail = [\"a@b\"]\n").codes, "C0635 C0635")
      << "no server, no sender";
  EXPECT_EQ(read(kMail + "password_file = \"nowhere.secret\"\n").codes, "E0001");
  EXPECT_EQ(read(kMail + "delay_s = -1\n").codes, "C0004");
  EXPECT_EQ(read(kMail + "smtp = 3\n").codes, "C0002");
}

TEST(NotifyConfig, WhenAnAddressHasAPort_ThenItMustBeOne) {
  const auto mail = [](const std::string& server) {
    return read("[[notify]]\nname = \"x\"\nmail = [\"a@b\"]\nfrom = \"a@b\"\nserver = \"" + server + "\"\n")
        .codes;
  };
  for (const char* right :
       {"smtp://m", "smtp://m:25", "smtps://[::1]:465", "smtp://[fe80::1]", "smtp://m:1/x:y"})
    EXPECT_EQ(mail(right), "") << right;
  for (const char* wrong : {"smtp://m:99999", "smtp://m:0", "smtp://m:", "smtp://m:x", "smtp://[::1]:70000"})
    EXPECT_EQ(mail(wrong), "C0635") << wrong;
  const auto hook = [](const std::string& url) {
    return read("[[notify]]\nname = \"x\"\nweb_hook = \"" + url + "\"\n").codes;
  };
  EXPECT_EQ(hook("https://me:secret@chat:8443/x?at=1:2"), "");
  EXPECT_EQ(hook("https://chat:84430/x"), "C0635");
}

}  // namespace
}  // namespace stepwright::config
