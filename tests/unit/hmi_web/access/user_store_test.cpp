#include "hmi_web/access/user_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "hmi_web/access/secrets.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::access {
namespace {

// The cheapest that libsodium takes: what it costs is not what is tested here.
constexpr PasswordCost kCheap{1, 8'192};

class UserStoreTest : public testing::Test {
 protected:
  UserStoreTest() : file_(folder_.path() / "users.json"), hash_(*hash_password("long enough", kCheap)) {}

  std::unique_ptr<UserStore> open() {
    auto users = UserStore::open(file_);
    EXPECT_TRUE(users) << result::to_string(users.error());
    return users ? std::move(*users) : nullptr;
  }
  void write(const std::string& text) { std::ofstream(file_) << text; }
  std::string code_of_opening() {
    const auto users = UserStore::open(file_);
    return users ? "" : users.error().front().code;
  }

  support::TemporaryFolder folder_;
  std::filesystem::path file_;
  std::string hash_;
};

TEST_F(UserStoreTest, WhenItIsOpenedAgain_ThenTheUsersAreThere) {
  ASSERT_TRUE(open()->add("ada", Role::Engineer, hash_));
  const auto users = open();
  ASSERT_TRUE(users->find("ada"));
  EXPECT_EQ(users->find("ada")->role, Role::Engineer);
  EXPECT_TRUE(password_matches(users->find("ada")->password_hash, "long enough"));
  EXPECT_FALSE(users->find("bob"));
  EXPECT_FALSE(users->has_administrator());
}

TEST_F(UserStoreTest, WhenItIsWritten_ThenOnlyTheOwnerReadsIt) {
  ::umask(0);
  ASSERT_TRUE(open()->add("ada", Role::Viewer, hash_));
  struct stat status {};
  ASSERT_EQ(::stat(file_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(UserStoreTest, WhenTheLastAdministratorWouldGo_ThenItIsRefused) {
  const auto users = open();
  ASSERT_TRUE(users->add("root", Role::Administrator, hash_));
  EXPECT_EQ(users->remove("root").error().front().code, "H0025");
  EXPECT_EQ(users->set_role("root", Role::Viewer).error().front().code, "H0025");
  ASSERT_TRUE(users->add("other", Role::Administrator, hash_));
  EXPECT_TRUE(users->remove("root"));
  EXPECT_FALSE(open()->find("root"));
}

TEST_F(UserStoreTest, WhenANameCannotBeOne_ThenItIsRefused) {
  for (const char* name :
       {"", "1st", "a b", "a/b", "../x", "<b>", "änne", "abcdefghijklmnopqrstuvwxyz1234567"}) {
    EXPECT_FALSE(check_name(name)) << name;
  }
  for (const char* name : {"a", "Ada.Lovelace", "op_2", "x-y"}) EXPECT_TRUE(check_name(name)) << name;
}

TEST_F(UserStoreTest, WhenAPasswordIsPoor_ThenItIsRefused) {
  EXPECT_FALSE(check_password("nine char", "ada"));
  EXPECT_FALSE(check_password("adalovelace", "adalovelace"));
  EXPECT_FALSE(check_password(std::string(129, 'x'), "ada"));
  EXPECT_TRUE(check_password("ten chars!", "ada"));
}

TEST_F(UserStoreTest, WhenTheNameIsTaken_ThenItIsRefused) {
  const auto users = open();
  ASSERT_TRUE(users->add("ada", Role::Viewer, hash_));
  EXPECT_EQ(users->add("ada", Role::Administrator, hash_).error().front().code, "H0029");
  EXPECT_EQ(users->find("ada")->role, Role::Viewer);
}

TEST_F(UserStoreTest, WhenTheFileIsDamaged_ThenOpeningFailsAndNobodyIsLetIn) {
  const std::string user = R"({"name":"a","role":"viewer","password":")" + hash_ + "\"}";
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string(R"({"users":[1]})"),
        std::string(R"({"users":[{"name":"a","role":"viewer","password":"plain"}]})"),
        std::string(R"({"users":[{"name":"a","role":"king","password":")") + hash_ + "\"}]}",
        R"({"users":[)" + user + "," + user + "]}"}) {
    write(text);
    EXPECT_EQ(code_of_opening(), "H0022") << text;
  }
  write(R"({"users":[)" + user + "]}");
  EXPECT_EQ(code_of_opening(), "");
}

TEST_F(UserStoreTest, WhenItCannotBeWritten_ThenTheUserIsNotThere) {
  const auto users = open();
  ASSERT_TRUE(users->add("ada", Role::Viewer, hash_));
  std::filesystem::create_directory(file_.string() + ".new");  // in the way of what is written beside it
  EXPECT_EQ(users->add("bob", Role::Viewer, hash_).error().front().code, "H0021");
  EXPECT_FALSE(users->find("bob"));
}

}  // namespace
}  // namespace stepwright::access
