#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "tests/unit/runtime/modbus/server/tls/plant_certificates.h"
#include "tests/unit/runtime/modbus/server/tls/tls_pair.h"

namespace stepwright::modbus::server {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

class Tls : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    plant_ = new PlantCertificates;
    plant_->certify("engineer", std::string(kClient) + kRole + "UTF8String:engineer\n");
    plant_->certify("nobody", kClient);
    plant_->certify("expired", kClient, "plant-ca", -1);
    plant_->certify("for-servers", "extendedKeyUsage = serverAuth\n");
    plant_->certify("integer-role", std::string(kClient) + kRole + "INTEGER:7\n");
    plant_->certify("empty-role", std::string(kClient) + kRole + "UTF8String:\n");
    plant_->certify("long-role", std::string(kClient) + kRole + "UTF8String:" + std::string(65, 'x') + "\n");
    plant_->certify("strange-role", std::string(kClient) +
                                        "1.3.6.1.4.1.50316.802.1 = DER:0c:09:6f:70:65:72:61:00:74:6f:72\n");
    plant_->certify("trailing-role", std::string(kClient) + "1.3.6.1.4.1.50316.802.1 = DER:0c:01:6f:6f\n");
    plant_->make_authority("other-ca");
    plant_->certify("stranger", std::string(kClient) + kRole + "UTF8String:engineer\n", "other-ca");
    plant_->certify("revoked", kClient);
    plant_->revoke("revoked", "revoked.pem");
  }
  static void TearDownTestSuite() {
    delete plant_;
    plant_ = nullptr;
  }

  static TlsOptions options() {
    TlsOptions out;
    out.certificate = plant_->file("plc.crt");
    out.key = plant_->file("plc.key");
    out.authorities = plant_->file("plant-ca.crt");
    return out;
  }
  static TlsContext context(const TlsOptions& from) {
    auto made = TlsContext::create(from);
    if (!made) throw std::runtime_error(result::to_string(made.error()));
    return *made;
  }
  static ClientOptions client(const std::string& name, int most_version = 0) {
    const bool shows = !name.empty();
    return {shows ? plant_->file(name + ".crt").string() : "",
            shows ? plant_->file(name + ".key").string() : "", plant_->file("plant-ca.crt").string(),
            most_version};
  }
  static std::string error_of(const TlsOptions& from) {
    const auto made = TlsContext::create(from);
    return made ? "" : result::to_string(made.error());
  }

  static PlantCertificates* plant_;
};

PlantCertificates* Tls::plant_ = nullptr;

TEST_F(Tls, Client_WhenItsCertificateIsOfTheRecipe_ThenHasItsRoleAndIsServed) {
  TlsPair pair(context(options()), client("operator"));
  EXPECT_EQ(pair.server().peer(), nullptr);
  ASSERT_TRUE(pair.shake_hands());
  ASSERT_NE(pair.server().peer(), nullptr);
  EXPECT_EQ(pair.server().peer()->role, "operator");
  EXPECT_EQ(pair.server().peer()->address, "192.0.2.7");
  EXPECT_TRUE(pair.server().peer()->authenticated);
  EXPECT_EQ(pair.to_server("request"), "request");
  EXPECT_EQ(pair.to_client("answer"), "answer");
  EXPECT_THAT(pair.refused, ElementsAre());
}

// The transports of an acceptor that has got new certificates.
class OneClientAcceptor final : public Acceptor {
 public:
  OneClientAcceptor(Stream& in, Stream& out) : in_(in), out_(out) {}
  int descriptor() const override { return -1; }
  std::unique_ptr<Transport> admit() override { return std::make_unique<BufferTransport>(in_, out_); }
  void turn_away() override {}
  std::string name() const override { return "tcp buffer"; }

 private:
  Stream& in_;
  Stream& out_;
};

TEST_F(Tls, Acceptor_WhenItsContextIsRenewed_ThenNewConnectionsMeetItAndOldOnesGoOn) {
  TlsOptions other = options();
  other.authorities = plant_->file("other-ca.crt");
  const TlsContext before = context(options());
  const TlsContext after = context(other);
  TlsPair stays(before, client("operator"));
  ASSERT_TRUE(stays.shake_hands());
  Stream in;
  Stream out;
  TlsAcceptor acceptor(std::make_unique<OneClientAcceptor>(in, out), before, {});
  EXPECT_EQ(&acceptor.context().native(), &before.native());
  acceptor.renew(after);
  EXPECT_EQ(&acceptor.context().native(), &after.native());
  EXPECT_EQ(stays.to_server("request"), "request");
  TlsPair comes(acceptor.context(), client("stranger"));
  EXPECT_TRUE(comes.shake_hands());
  TlsPair refused(acceptor.context(), client("operator"));
  EXPECT_FALSE(refused.shake_hands());
}

TEST_F(Tls, Context_WhenItIsMade_ThenItKnowsWhenItsCertificateEnds) {
  const auto left = context(options()).expires() - std::chrono::system_clock::now();
  EXPECT_GT(left, std::chrono::hours(24 * 823));
  EXPECT_LT(left, std::chrono::hours(24 * 826));  // `-days 825` of the recipe
}

TEST_F(Tls, Client_WhenItSpeaksTls12_ThenIsServedAndWhenOlderThenNot) {
  TlsPair pair(context(options()), client("engineer", TLS1_2_VERSION));
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_EQ(pair.server().peer()->role, "engineer");
  TlsPair old(context(options()), client("engineer", TLS1_1_VERSION));
  EXPECT_FALSE(old.shake_hands());
  EXPECT_THAT(old.refused, ElementsAre(HasSubstr("unsupported protocol")));
}

TEST_F(Tls, Client_WhenItsCertificateHasNoRole_ThenComesInWithoutOne) {
  TlsPair pair(context(options()), client("nobody"));
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_EQ(pair.server().peer()->role, "");
  EXPECT_TRUE(pair.server().peer()->authenticated);
}

struct Refusal {
  const char* client;
  const char* reason;
};

class TlsRefusal : public Tls, public testing::WithParamInterface<Refusal> {};

TEST_P(TlsRefusal, Client_WhenItsCertificateIsNotOne_ThenIsRefusedWithTheReason) {
  TlsOptions with_list = options();
  with_list.revoked = plant_->file("revoked.pem");
  TlsPair pair(context(with_list), client(GetParam().client));
  pair.shake_hands();
  EXPECT_TRUE(pair.server_closed);
  EXPECT_EQ(pair.server().peer(), nullptr);
  EXPECT_THAT(pair.refused, ElementsAre("192.0.2.7: " + std::string(GetParam().reason)));
  const std::byte some[1]{};
  EXPECT_EQ(pair.server().write(some).state, Moved::State::Closed);
}

INSTANTIATE_TEST_SUITE_P(All, TlsRefusal,
                         testing::Values(Refusal{"", "peer did not return a certificate"},
                                         Refusal{"expired", "certificate has expired"},
                                         Refusal{"stranger", "unable to get local issuer certificate"},
                                         Refusal{"for-servers", "unsuitable certificate purpose"},
                                         Refusal{"revoked", "certificate revoked"},
                                         Refusal{"integer-role", "the role in its certificate is none"},
                                         Refusal{"empty-role", "the role in its certificate is none"},
                                         Refusal{"long-role", "the role in its certificate is none"},
                                         Refusal{"strange-role", "the role in its certificate is none"},
                                         Refusal{"trailing-role", "the role in its certificate is none"}));

TEST_F(Tls, Client_WhenOthersAreRevoked_ThenStillComesIn) {
  TlsOptions with_list = options();
  with_list.revoked = plant_->file("revoked.pem");
  TlsPair pair(context(with_list), client("operator"));
  EXPECT_TRUE(pair.shake_hands());
}

TEST_F(Tls, Renegotiation_WhenAskedFor_ThenIsRefused) {
  TlsPair pair(context(options()), client("operator", TLS1_2_VERSION));
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_FALSE(pair.renegotiate());
  EXPECT_EQ(pair.server().peer()->role, "operator");
}

TEST_F(Tls, Session_WhenOver_ThenCannotBeResumed) {
  TlsPair pair(context(options()), client("operator", TLS1_2_VERSION));
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_EQ(SSL_SESSION_is_resumable(SSL_get_session(pair.client())), 0);
}

TEST_F(Tls, Handshake_WhenItComesByteByByte_ThenGoesThroughWithoutBlocking) {
  TlsPair pair(context(options()), client("operator"));
  pair.inside().piece = 1;
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_EQ(pair.to_server("request"), "request");
  EXPECT_EQ(pair.to_client("answer"), "answer");
}

TEST_F(Tls, Handshake_WhenItTakesTooLong_ThenIsOver) {
  TlsOptions hasty = options();
  hasty.handshake = milliseconds(20);
  TlsPair pair(context(hasty), client("operator"));
  std::array<std::byte, 16> buffer;
  EXPECT_EQ(pair.server().read(buffer).state, Moved::State::WouldBlock);
  std::this_thread::sleep_for(milliseconds(40));
  EXPECT_FALSE(pair.shake_hands());
  EXPECT_THAT(pair.refused, ElementsAre(HasSubstr("took too long")));
}

TEST_F(Tls, PlainModbus_WhenSentToThePortOfTls_ThenIsRefused) {
  TlsPair pair(context(options()), client("operator"));
  Stream in, out;
  for (const int byte : {0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1}) in.push_back(static_cast<std::byte>(byte));
  std::vector<std::string> refused;
  struct PlainAcceptor final : Acceptor {
    PlainAcceptor(Stream& i, Stream& o) : in(i), out(o) {}
    int descriptor() const override { return -1; }
    std::unique_ptr<Transport> admit() override { return std::make_unique<BufferTransport>(in, out); }
    void turn_away() override {}
    std::string name() const override { return "plain"; }
    Stream& in;
    Stream& out;
  };
  TlsAcceptor acceptor(std::make_unique<PlainAcceptor>(in, out), context(options()),
                       [&](const std::string&, const std::string& reason) { refused.push_back(reason); });
  const auto transport = acceptor.admit();
  std::array<std::byte, 16> buffer;
  EXPECT_EQ(transport->read(buffer).state, Moved::State::Closed);
  EXPECT_THAT(refused, ElementsAre("wrong version number"));
}

TEST_F(Tls, Record_WhenItIsLargerThanWhatIsAskedFor_ThenTheRestIsAnnounced) {
  TlsPair pair(context(options()), client("operator"));
  ASSERT_TRUE(pair.shake_hands());
  EXPECT_FALSE(pair.server().has_buffered());
  const std::string much(1'000, 'x');
  ASSERT_EQ(SSL_write(pair.client(), much.data(), 1'000), 1'000);
  pair.move_bytes();
  std::array<std::byte, 16> buffer;
  std::size_t got = pair.server().read(buffer).bytes;
  EXPECT_EQ(got, buffer.size());
  EXPECT_TRUE(pair.server().has_buffered());
  while (pair.server().has_buffered()) got += pair.server().read(buffer).bytes;
  EXPECT_EQ(got, much.size());
}

TEST_F(Tls, Record_WhenOnlyHalfOfItIsThere_ThenNothingIsAnnounced) {
  TlsPair pair(context(options()), client("operator"));
  ASSERT_TRUE(pair.shake_hands());
  ASSERT_EQ(SSL_write(pair.client(), "request", 7), 7);
  pair.move_bytes();
  pair.inside().limit = 10;  // of its bytes: more than the record's header
  std::array<std::byte, 16> buffer;
  EXPECT_EQ(pair.server().read(buffer).state, Moved::State::WouldBlock);
  EXPECT_FALSE(pair.server().has_buffered()) << "the server would try again for ever";
  pair.inside().limit = SIZE_MAX;
  EXPECT_EQ(pair.server().read(buffer).bytes, 7u);
}

TEST_F(Tls, Connection_WhenCut_ThenIsClosed) {
  TlsPair pair(context(options()), client("operator"));
  ASSERT_TRUE(pair.shake_hands());
  pair.inside().ended = true;
  std::array<std::byte, 16> buffer;
  EXPECT_EQ(pair.server().read(buffer).state, Moved::State::Closed);
  EXPECT_THAT(pair.refused, ElementsAre());
}

TEST_F(Tls, Files_WhenWrong_ThenDiagnosticsNameThem) {
  TlsOptions wrong = options();
  wrong.certificate = plant_->file("missing.crt");
  EXPECT_THAT(error_of(wrong), testing::AllOf(HasSubstr("R0114"), HasSubstr("missing.crt")));
  wrong = options();
  wrong.key = plant_->file("operator.key");
  EXPECT_THAT(error_of(wrong), testing::AllOf(HasSubstr("R0115"), HasSubstr("operator.key")));
  wrong = options();
  wrong.authorities = plant_->file("plc.key");
  EXPECT_THAT(error_of(wrong), testing::AllOf(HasSubstr("R0114"), HasSubstr("authorities")));
  wrong = options();
  wrong.revoked = plant_->file("plc.crt");
  EXPECT_THAT(error_of(wrong), testing::AllOf(HasSubstr("R0114"), HasSubstr("revocation")));
  wrong = options();
  wrong.key = plant_->file("open.key");
  std::filesystem::copy_file(options().key, wrong.key);
  std::filesystem::permissions(wrong.key, std::filesystem::perms(0644));
  EXPECT_THAT(error_of(wrong), testing::AllOf(HasSubstr("R0116"), HasSubstr("open.key")));
}

TEST_F(Tls, Key_WhenItWantsAPassphrase_ThenNobodyIsAskedAndItIsRefused) {
  TlsOptions locked = options();
  locked.key = plant_->file("locked.key");
  const std::string lock = "umask 077 && openssl pkey -aes256 -passout pass:secret -in " +
                           options().key.string() + " -out " + locked.key.string();
  ASSERT_EQ(std::system(lock.c_str()), 0);
  EXPECT_THAT(error_of(locked),
              testing::AllOf(HasSubstr("R0114"), HasSubstr("locked.key"), HasSubstr("passphrase")));
}

TEST_F(Tls, Acceptor_WhenAsked_ThenIsCalledAfterWhatItGuards) {
  struct NoAcceptor final : Acceptor {
    int descriptor() const override { return 7; }
    std::unique_ptr<Transport> admit() override { return nullptr; }
    void turn_away() override {}
    std::string name() const override { return "tcp [::]:802"; }
  };
  TlsAcceptor acceptor(std::make_unique<NoAcceptor>(), context(options()), nullptr);
  EXPECT_EQ(acceptor.name(), "tls [::]:802");
  EXPECT_EQ(acceptor.descriptor(), 7);
  EXPECT_EQ(acceptor.admit(), nullptr);
}

}  // namespace
}  // namespace stepwright::modbus::server
