// The udev rules: whose nodes they open. Debian 12's udevadm cannot verify a file, so this reads
// the little of the rule language that they use (man 7 udev), and takes nothing else.
#include <fnmatch.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace {

namespace fs = std::filesystem;

struct Token {
  std::string key, operation, value;
};
using Rule = std::vector<Token>;

const fs::path kFile = fs::path(VINDU_SOURCE_DIR) / "assets/70-vindu-wiimote.rules";

/// Throws unless all of the line is KEY OPERATION "VALUE", with commas between.
Rule rule_from(std::string line) {
  static const std::regex token(R"re(^([A-Z]+)(==|=|\+=)"([^"]*)"(, |$))re");
  Rule rule;
  for (std::smatch match; !line.empty(); line = match.suffix()) {
    if (!std::regex_search(line, match, token)) throw std::runtime_error("no rule: " + line);
    rule.push_back({match[1], match[2], match[3]});
  }
  return rule;
}

std::vector<Rule> rules() {
  std::vector<Rule> rules;
  std::ifstream file(kFile);
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') rules.push_back(rule_from(line));
  return rules;
}

bool any_of_patterns(const std::string& patterns, const std::string& text) {
  std::istringstream stream(patterns);
  for (std::string pattern; std::getline(stream, pattern, '|');)
    if (fnmatch(pattern.c_str(), text.c_str(), 0) == 0) return true;
  return false;
}

/// Of a hidraw node, by the kernel's name of its HID device: what the rules set.
std::vector<std::string> settings_for(const std::string& hid_name) {
  std::vector<std::string> settings;
  for (const Rule& rule : rules()) {
    bool matches = true;
    for (const auto& [key, operation, value] : rule) {
      if (operation != "==") continue;
      if (key == "SUBSYSTEM")
        matches &= value == "hidraw";
      else if (key == "KERNELS")
        matches &= any_of_patterns(value, hid_name);
      else
        throw std::runtime_error("the test does not know " + key);
    }
    for (const auto& [key, operation, value] : rule)
      if (matches && operation != "==") settings.push_back(key + operation + value);
  }
  return settings;
}

const auto kOpen = ::testing::UnorderedElementsAre("GROUP=input", "MODE=0660", "TAG+=uaccess");

TEST(UdevRules, OpenWiimotesOnBluetoothForTheSeatAndTheGroupInput) {
  EXPECT_THAT(settings_for("0005:057E:0306.0001"), kOpen);
  EXPECT_THAT(settings_for("0005:057E:0330.00A2"), kOpen);
  EXPECT_THAT(settings_for("0005:054C:0306.0003"), kOpen);
}

TEST(UdevRules, OpenTheSlotsOfAUsbAdapter) {
  EXPECT_THAT(settings_for("0003:057E:0306.0004"), kOpen);
}

TEST(UdevRules, OpenNothingElse) {
  EXPECT_THAT(settings_for("0003:054C:0306.0001"), ::testing::IsEmpty());
  EXPECT_THAT(settings_for("0005:057E:2009.0001"), ::testing::IsEmpty());  // Switch Pro Controller
  EXPECT_THAT(settings_for("0003:046D:C31C.0001"), ::testing::IsEmpty());  // a keyboard
}

TEST(UdevRules, ComeBeforeTheFileThatActsOnTheTag) {
  EXPECT_LT(kFile.filename().string(), "73-seat-late.rules");
}

}  // namespace
