// How Wiimotes are numbered, and what each is said to be hindered by, on emulated devices.
#include "app/wiimote_findings.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "tracker/wiimote/emulator_bus.h"
#include "tracker/wiimote/find.h"

namespace vindu::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

SensorView dark(Time) { return {}; }

class WiimoteFindings : public ::testing::Test {
 protected:
  EmulatedDevice& add(EmulatedDeviceOptions options = {}) { return bus_.add(options, dark); }
  std::vector<WiimoteFinding> found() { return examine_wiimotes(bus_, clock_); }
  std::vector<std::string> states() {
    std::vector<std::string> states;
    for (const WiimoteFinding& finding : found()) states.push_back(finding.state);
    return states;
  }
  std::vector<int> numbers_beside(const std::vector<NumberedWiimote>& known) {
    std::vector<int> numbers;
    for (const NumberedWiimote& each : newcomers(bus_, clock_, known))
      numbers.push_back(each.number);
    return numbers;
  }
  /// A Wiimote as the adapter knows it.
  static BluezDevice known_as(const std::string& address, bool paired, bool connected) {
    return {.address = address,
            .name = "Nintendo RVL-CNT-01",
            .adapter = "hci0",
            .paired = paired,
            .connected = connected};
  }

  ManualClock clock_;
  EmulatedHidBus bus_{clock_};
};

TEST_F(WiimoteFindings, CallsReadyWhatAnswers) {
  add();
  const auto findings = found();
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].state, "ready");
  ASSERT_TRUE(findings[0].status);
  EXPECT_EQ(findings[0].status->battery, 0xc0);
}

TEST_F(WiimoteFindings, SaysThatOneMayNotBeOpenedWithTheRemedy) {
  EmulatedDeviceOptions forbidden;
  forbidden.permitted = false;
  add(forbidden);
  const auto findings = found();
  EXPECT_THAT(findings.at(0).state, AllOf(HasSubstr("permission"), HasSubstr("udev rules")));
  EXPECT_TRUE(findings[0].forbidden);
}

TEST_F(WiimoteFindings, SaysThatASilentOneDoesNotAnswer) {
  add().stay_silent(true);
  EXPECT_THAT(states(), ElementsAre(HasSubstr("does not answer: press a button")));
}

TEST_F(WiimoteFindings, TellsTheEmptySlotsOfAnAdapterFromThoseInUse) {
  bus_.add_dolphin_bar({dark, dark});
  EXPECT_THAT(states(), ElementsAre("ready", "ready", "an empty slot", "an empty slot"));
  for (const WiimoteFinding& finding : found())
    EXPECT_EQ(kind_of(finding.info), WiimoteKind::adapter);
}

/// A bus of one device, whose path is a file.
class FileBus final : public HidBus {
 public:
  explicit FileBus(std::string path) : path_(std::move(path)) {}
  std::vector<HidInfo> list() override {
    return {{path_, 0x057e, 0x0306, "Nintendo RVL-CNT-01", "00:1f:c5:1b:3a:b1"}};
  }
  std::unique_ptr<HidDevice> open(const std::string& path) override {
    throw Error({"was opened although somebody has it", path, "leave it alone"});
  }

 private:
  std::string path_;
};

TEST_F(WiimoteFindings, NamesTheProgramThatHasADeviceAndLeavesItAlone) {
  std::string file = std::filesystem::temp_directory_path() / "vindu_device_XXXXXX";
  const int descriptor = mkstemp(file.data());
  FileBus bus(file);
  const auto findings = examine_wiimotes(bus, clock_);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].state, HasSubstr("in use by wiimote_finding"));
  EXPECT_THAT(findings[0].state, HasSubstr("(pid " + std::to_string(getpid()) + ")"));
  close(descriptor);
  std::filesystem::remove(file);
}

Site site_with(CameraSource source, const std::string& address = "") {
  Site site;
  CameraConfig& camera = site.cameras.emplace_back();
  camera.source = source;
  camera.address = address;
  return site;
}

TEST_F(WiimoteFindings, NamesThoseOfASiteThatAnotherProgramHas) {
  std::string file = std::filesystem::temp_directory_path() / "vindu_device_XXXXXX";
  const int descriptor = mkstemp(file.data());
  FileBus bus(file);
  const auto lines_for = [&](const std::string& address) {
    return wiimotes_in_use(bus, site_with(CameraSource::wiimote, address));
  };
  EXPECT_THAT(lines_for("00:1f:c5:1b:3a:b1"),
              ElementsAre(AllOf(HasSubstr("00:1f:c5:1b:3a:b1 is in use by"),
                                HasSubstr("(pid " + std::to_string(getpid()) + ")"))));
  EXPECT_THAT(lines_for(""), SizeIs(1)) << "any Wiimote will do";
  EXPECT_THAT(lines_for("00:1f:c5:00:00:00"), IsEmpty());
  EXPECT_THAT(wiimotes_in_use(bus, site_with(CameraSource::emulated)), IsEmpty());
  close(descriptor);
  EXPECT_THAT(lines_for(""), IsEmpty());
  std::filesystem::remove(file);
}

TEST_F(WiimoteFindings, AddTheAdapterToAReadyOneWithABond) {
  const std::string address = add().options().info.address;
  auto findings = found();
  add_bluetooth({.adapters = {}, .wiimotes = {known_as(address, true, true)}, .trouble = ""},
                findings);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].state, "ready");
  EXPECT_EQ(findings[0].adapter, "hci0");
}

TEST_F(WiimoteFindings, SayThatAConnectedOneWithoutABondHasToBePressedEachTime) {
  const std::string address = add().options().info.address;
  auto findings = found();
  add_bluetooth({.adapters = {}, .wiimotes = {known_as(address, false, true)}, .trouble = ""},
                findings);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].state, AllOf(HasSubstr("not bonded"), HasSubstr("1+2")));
  EXPECT_EQ(findings[0].adapter, "hci0");
}

TEST_F(WiimoteFindings, KeepWhatHindersADeviceMoreThanItsMissingBond) {
  EmulatedDevice& device = add();
  device.stay_silent(true);
  auto findings = found();
  add_bluetooth({.adapters = {},
                 .wiimotes = {known_as(device.options().info.address, false, true)},
                 .trouble = ""},
                findings);
  EXPECT_THAT(findings.at(0).state, HasSubstr("does not answer"));
}

TEST_F(WiimoteFindings, AddThoseThatBluetoothAloneKnows) {
  std::vector<WiimoteFinding> findings;
  add_bluetooth({.adapters = {},
                 .wiimotes = {known_as("00:1F:C5:00:00:0A", false, false),
                              known_as("00:1F:C5:00:00:0B", true, false),
                              known_as("00:1F:C5:00:00:0C", true, true)},
                 .trouble = ""},
                findings);
  ASSERT_THAT(findings, SizeIs(3));
  EXPECT_EQ(findings[0].state, "not bonded: vindu wiimote pair");
  EXPECT_THAT(findings[1].state, HasSubstr("not connected: press a button"));
  EXPECT_THAT(findings[2].state, HasSubstr("no HID device"));
}

TEST_F(WiimoteFindings, ChooseByNumberOrAddress) {
  add(), add();
  const NumberedWiimote second = choose_wiimote(bus_, "2");
  EXPECT_EQ(second.number, 2);
  EXPECT_EQ(second.info.path, bus_.path(1));
  EXPECT_EQ(choose_wiimote(bus_, "00:1F:C5:00:00:01").number, 2);
  for (const char* none : {"0", "3", "", "00:1f:c5:00:00:07"})
    EXPECT_THROW(choose_wiimote(bus_, none), Error) << none;
}

TEST_F(WiimoteFindings, ChooseASlotByItsNumberInTheList) {
  bus_.add_dolphin_bar({dark, dark});
  EXPECT_EQ(choose_wiimote(bus_, "2").info.path, bus_.path(1));
  EXPECT_THROW(choose_wiimote(bus_, ""), Error);
}

TEST_F(WiimoteFindings, WatchWhatIsThereByTheNumbersOfTheList) {
  bus_.add_dolphin_bar({dark, dark});
  bus_.device(0).unplug();
  add();
  EXPECT_THAT(numbers_beside({}), ElementsAre(2, 5));
}

TEST_F(WiimoteFindings, TakeInLaterOnesWithoutChangingTheNumbersThatAreSeen) {
  EmulatedDevice& first = add();
  first.unplug();
  add();
  const auto watched = newcomers(bus_, clock_, {});
  ASSERT_THAT(watched, SizeIs(1));
  EXPECT_EQ(watched[0].number, 1);
  first.plug_in();
  EXPECT_THAT(numbers_beside(watched), ElementsAre(2));
}

TEST_F(WiimoteFindings, TakeNothingInTwice) {
  EmulatedDevice& device = add();
  bus_.add_dolphin_bar({dark});
  const auto watched = newcomers(bus_, clock_, {});
  device.unplug(), device.plug_in();
  ASSERT_NE(bus_.path(0), "/dev/hidraw0");
  EXPECT_THAT(numbers_beside(watched), IsEmpty());
}

TEST_F(WiimoteFindings, TakeInAWiimoteThatComesIntoAnEmptySlot) {
  bus_.add_dolphin_bar({dark});
  bus_.device(0).unplug();
  EXPECT_THAT(numbers_beside({}), IsEmpty());
  bus_.device(0).plug_in();
  EXPECT_THAT(numbers_beside({}), ElementsAre(1));
}

}  // namespace
}  // namespace vindu::app
