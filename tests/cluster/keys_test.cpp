// The folder of a wall's keys: what vindu keys makes, what a participant reads of it, and what it
// refuses.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cluster/keys/authority.h"
#include "cluster/keys/internal/openssl.h"
#include "cluster/wall_tile.h"
#include "cluster/wall_view.h"
#include "core/error.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;
using std::chrono::system_clock;

const KeyOwner kMaster{Role::master}, kTile{Role::tile, "tile-0-0"}, kOther{Role::tile, "tile-1-0"};

Validity days_from_now(int from, int until) {
  const auto now = system_clock::now();
  return {now + std::chrono::days(from), now + std::chrono::days(until)};
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class Keys : public ::testing::Test {
 protected:
  Keys() {
    for (const KeyOwner& owner : {kMaster, kTile, kOther})
      authority_.issue(owner, days_from_now(-1, 100));
  }
  ~Keys() override { fs::remove_all(folder_); }

  static fs::path new_folder() {
    std::string pattern = fs::temp_directory_path() / "vindu_keys_XXXXXX";
    return mkdtemp(pattern.data());
  }
  fs::path keys() const { return folder_ / "keys"; }
  void expect_refused(const std::string& why) const {
    EXPECT_THAT([&] { read_credentials(keys(), kTile); }, ThrowsMessage<Error>(HasSubstr(why)));
  }

  fs::path folder_ = new_folder();
  Authority authority_{folder_ / "keys"};
};

TEST_F(Keys, AreReadByNobodyButTheirOwner) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(keys())) {
    struct stat status {};
    ASSERT_EQ(stat(entry.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, entry.is_directory() ? 0700u : 0600u) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 15);
}

TEST_F(Keys, OfAHostAreItsOwnAndTheAuthoritysStayWhereTheyAre) {
  for (const std::string& file : files_of(kTile)) {
    EXPECT_TRUE(fs::exists(keys() / file)) << file;
    if (file.ends_with("private.pem")) {
      EXPECT_EQ(file, "hosts/tile-0-0/private.pem");
    }
    EXPECT_THAT(file, Not(HasSubstr("ca/")));
  }
}

TEST_F(Keys, AreThoseOfTheFirstTimeWhenTheAuthorityIsOpenedAgain) {
  const std::string before = read_credentials(keys(), kTile).identity_ca;

  const Authority again(keys());

  EXPECT_FALSE(again.is_new());
  EXPECT_EQ(read_credentials(keys(), kTile).identity_ca, before);
}

TEST_F(Keys, CannotBeMadeOnAHostThatWasOnlyBroughtThem) {
  fs::remove_all(keys() / "ca");
  EXPECT_THAT([&] { Authority{keys()}; }, ThrowsMessage<Error>(HasSubstr("are not here")));
}

TEST_F(Keys, ThatOthersMayReadAreRefused) {
  fs::permissions(keys() / "hosts/tile-0-0/private.pem", fs::perms(0640));
  expect_refused("may be read or written by others");
}

TEST_F(Keys, ThatAreMissingSayWhatToDo) {
  fs::remove(keys() / "hosts/tile-0-0/permissions.p7s");
  expect_refused("permissions.p7s: cannot be read (No such file or directory); make the wall's");
}

TEST_F(Keys, ThatEndedOrHaveNotBegunAreRefused) {
  authority_.issue(kTile, days_from_now(-10, -1));
  expect_refused("certificate has expired");
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::expired);
  authority_.issue(kTile, days_from_now(2, 10));
  expect_refused("certificate is not yet valid");
}

TEST_F(Keys, ThatEndWithinAMonthAreCalledSo) {
  authority_.issue(kTile, days_from_now(-1, 29));
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::ends_soon);
  authority_.issue(kTile, days_from_now(-1, 31));
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::good);
}

TEST_F(Keys, OutliveNoAuthority) {
  authority_.issue(kTile, days_from_now(-1, 100 * 365));
  EXPECT_EQ(inspect_key(keys(), kTile).until, authority_.until());
}

TEST_F(Keys, ThatWereRevokedAreRefusedAndSoAreAllThatTheirOwnerHadBefore) {
  const std::string first = text_of(keys() / "hosts/tile-0-0/certificate.pem");
  authority_.issue(kTile, days_from_now(-1, 100));

  EXPECT_EQ(authority_.revoke(kTile), 2);

  expect_refused("certificate revoked");
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::revoked);
  const auto list = internal::revoked_list_from(text_of(keys() / "revoked.pem"), "");
  EXPECT_TRUE(internal::is_revoked(*list, *internal::certificate_from(first, "")));
  EXPECT_EQ(inspect_key(keys(), kOther).state, KeyState::good);
  authority_.issue(kTile, days_from_now(-1, 100));
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::good);
}

TEST_F(Keys, OfAnotherAuthorityAreRefused) {
  Authority other(folder_ / "other");
  other.issue(kTile, days_from_now(-1, 100));
  for (const char* file : {"certificate.pem", "private.pem"})
    fs::copy_file(folder_ / "other/hosts/tile-0-0" / file, keys() / "hosts/tile-0-0" / file,
                  fs::copy_options::overwrite_existing);
  expect_refused("does not count: unable to get local issuer certificate");
}

TEST_F(Keys, WhosePartsDoNotBelongTogetherAreRefused) {
  const auto take_from_other = [&](const char* file) {
    fs::copy_file(keys() / "hosts/tile-1-0" / file, keys() / "hosts/tile-0-0" / file,
                  fs::copy_options::overwrite_existing);
  };
  take_from_other("private.pem");
  expect_refused("is not the key of the certificate beside it");
}

TEST_F(Keys, ThatAreNoneAreRefused) {
  std::ofstream(keys() / "hosts/tile-0-0/certificate.pem") << "-----BEGIN CERTIFICATE-----\nnone";
  expect_refused("is no certificate");
  EXPECT_EQ(inspect_key(keys(), kTile).state, KeyState::unusable);
}

TEST_F(Keys, WhosePermissionsWereChangedAreRefused) {
  const fs::path file = keys() / "hosts/tile-0-0/permissions.p7s";
  std::string text = text_of(file);
  text.replace(text.find("v*/ready"), 8, "v*/frame");
  std::ofstream(file) << text;
  expect_refused("permissions.p7s: is not signed by the wall's permissions_ca.pem");
}

TEST_F(Keys, OfHostsWhoseNamesArePathsAreRefused) {
  for (const std::string host : {"../../etc", "", ".", "a/b", "a b", "$(x)", "a\nb"})
    EXPECT_THAT(
        [&] {
          authority_.issue({Role::tile, host}, days_from_now(-1, 1));
        },
        ThrowsMessage<Error>(HasSubstr("is no host name")));
  EXPECT_THAT(
      [&] {
        authority_.issue({Role::tile, std::string(65, 'x')}, days_from_now(-1, 1));
      },
      ThrowsMessage<Error>(HasSubstr("use a host name of up to 64 letters")));
}

/// Why there are two authorities: a document counts that is signed by whomever the authority has
/// certified.
TEST_F(Keys, OfTilesSignNothingThatCounts) {
  const Credentials tile = read_credentials(keys(), kTile);
  const auto certificate = internal::certificate_from(tile.certificate, "");
  const auto key = internal::key_from(tile.private_key, "");

  const std::string forged = internal::sign_document(
      permissions_document(internal::subject_of(*certificate), Role::master, days_from_now(-1, 1)),
      {*certificate, *key});

  const auto signs = [&](const std::string& authority) {
    return internal::is_signed_by(forged, *internal::certificate_from(authority, ""));
  };
  EXPECT_TRUE(signs(tile.identity_ca));
  EXPECT_FALSE(signs(tile.permissions_ca));
}

TEST(Permissions, NameWhatARoleWritesAndReadsAndNothingElse) {
  const std::string text = permissions_document("CN=a,OU=tile", Role::tile, days_from_now(0, 1));
  const std::string publishes = text.substr(0, text.find("</publish>"));
  EXPECT_THAT(publishes, AllOf(HasSubstr("<subject_name>CN=a,OU=tile<"), HasSubstr(">v*/ready<"),
                               HasSubstr(">v*/tile_status<"), HasSubstr(">vindu/is_tile<")));
  for (const char* topic : {"frame", "scene", "command", "pose", "is_master", ">*<"})
    EXPECT_THAT(publishes, Not(HasSubstr(topic)));
  EXPECT_THAT(text, AllOf(HasSubstr(">v*/frame<"), HasSubstr("<default>DENY</default>")));
}

/// The table against what the programs join with.
TEST(Permissions, LetTilesAndConsolesDoTheirWork) {
  const auto fit = [](Topics asked, Topics granted) {
    for (int i = 0; i < kTopics; ++i) {
      const auto topic = static_cast<Topic>(i);
      const Topic needed = topic == Topic::presence ? Topic::tile_status : topic;
      EXPECT_TRUE(!asked.has(topic) || granted.has(needed)) << rules_of(topic).name;
    }
  };
  fit(WallTile::publishes(), rights_of(Role::tile).writes);
  fit(WallTile::hears(), rights_of(Role::tile).reads);
  fit(WallView::hears(), rights_of(Role::console).reads);
}

}  // namespace
}  // namespace vindu
