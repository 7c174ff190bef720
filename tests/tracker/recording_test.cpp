// Recordings: what is written is read again, what is cut off or damaged is said, and a device that
// plays a recording gives the driver what the real one gave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "tracker/recording_devices.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

RecordedReport report_of(int number, int device = 0) {
  return {device,
          Time{milliseconds(10 * number)},
          {0x33, static_cast<std::uint8_t>(number), static_cast<std::uint8_t>(number / 256), 0xff}};
}

struct Reading {
  std::vector<RecordedReport> reports;
  RecordingInfo info;
  RecordingProblems problems;
};

Reading read_all(const std::string& file, DamagePolicy damage = DamagePolicy::refuse) {
  RecordingReader reader(file, damage);
  Reading reading;
  while (auto report = reader.next()) reading.reports.push_back(std::move(*report));
  reading.info = reader.info();
  reading.problems = reader.problems();
  return reading;
}

std::string error_of(const std::string& file) {
  try {
    read_all(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class Recording : public ::testing::Test {
 protected:
  Recording() {
    std::string pattern = (fs::temp_directory_path() / "vindu_recording_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Recording() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  /// Of two devices, "left" and "right".
  static RecordingInfo info() {
    return {.program = "vindu 1.2.3",
            .started_utc_ns = 1'700'000'000'000'000'000,
            .started = Time{milliseconds(5)},
            .wall_file = "wall.toml",
            .wall_text = "[wall]\ncolumns = 7 # sieben B\xc3\xb6gen\n",
            .devices = {{0, "left"}, {1, "right"}}};
  }
  std::string record(const std::string& name, int reports,
                     const RecordingOptions& options = {}) const {
    RecordingWriter writer(path(name), info(), options);
    for (int i = 0; i < reports; ++i) {
      const RecordedReport report = report_of(i, i % 2);
      writer.add(report.device, report.arrival, report.bytes);
    }
    return path(name);
  }
  static std::string bytes_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  fs::path folder_;
};

std::vector<RecordedReport> alternating(int count) {
  std::vector<RecordedReport> reports;
  for (int i = 0; i < count; ++i) reports.push_back(report_of(i, i % 2));
  return reports;
}

constexpr std::size_t kRecord = 8 + 11 + 4;  // of one of our reports

TEST_F(Recording, gives_back_every_report_and_what_stands_at_its_beginning) {
  const Reading reading = read_all(record("a.vrec", 1000));
  EXPECT_EQ(reading.reports, alternating(1000));
  EXPECT_EQ(reading.info, info());
  EXPECT_THAT(reading.problems.remarks, IsEmpty());
}

// Worked out by hand from docs/recording.md; the checksum by Python's zlib.crc32.
TEST_F(Recording, lays_a_report_out_as_documented) {
  {
    RecordingWriter writer(path("a.vrec"), info());
    writer.add(1, Time{Duration(0x0102030405060708)}, std::vector<std::uint8_t>{0x20, 0xab});
  }
  const std::string bytes = bytes_of(path("a.vrec"));
  EXPECT_EQ(bytes.substr(0, 12), std::string("VINDUREC\x01\0\0\0", 12));
  EXPECT_EQ(bytes.substr(bytes.size() - 21), std::string("\x0d\0\0\0"
                                                         "\x03\x70\x16\xb4"
                                                         "\x02"
                                                         "\x01\0"
                                                         "\x08\x07\x06\x05\x04\x03\x02\x01"
                                                         "\x20\xab",
                                                         21));
}

TEST_F(Recording, keeps_notes_apart_from_the_reports_as_documented) {
  {
    RecordingWriter writer(path("a.vrec"), info());
    writer.add(0, report_of(1).arrival, report_of(1).bytes);
    writer.note(Time{Duration(0x0102030405060708)}, "left: gone");
    writer.add(0, report_of(2).arrival, report_of(2).bytes);
  }
  RecordingReader reader(path("a.vrec"));
  EXPECT_EQ(reader.next(), report_of(1));
  EXPECT_EQ(reader.next(), report_of(2));
  EXPECT_EQ(reader.notes(),
            (std::vector<RecordedNote>{{Time{Duration(0x0102030405060708)}, "left: gone"}}));
  const std::string bytes = bytes_of(path("a.vrec"));
  EXPECT_THAT(bytes, HasSubstr(std::string("\x04"
                                           "\x08\x07\x06\x05\x04\x03\x02\x01"
                                           "left: gone")));
}

TEST_F(Recording, cuts_a_note_that_is_longer_than_any_record_may_be) {
  {
    RecordingWriter writer(path("a.vrec"), info());
    writer.note(Time{}, std::string(9999, 'x'));
    writer.add(0, report_of(1).arrival, report_of(1).bytes);
  }
  RecordingReader reader(path("a.vrec"));
  EXPECT_EQ(reader.next(), report_of(1));
  EXPECT_THAT(reader.notes().at(0).text, SizeIs(kMaxRecordedReport));
}

TEST_F(Recording, loses_only_the_last_record_wherever_that_is_cut_off) {
  const std::string whole = bytes_of(record("a.vrec", 10));
  for (std::size_t left = 0; left < kRecord; ++left) {
    const std::string cut = write("cut.vrec", whole.substr(0, whole.size() - kRecord + left));
    const Reading reading = read_all(cut);
    EXPECT_EQ(reading.reports, alternating(9)) << left;
    EXPECT_EQ(reading.problems.torn_bytes, left);
    EXPECT_THAT(reading.problems.remarks, SizeIs(left > 0 ? 1 : 0));
  }
}

TEST_F(Recording, takes_zeros_after_the_last_record_for_a_torn_end) {
  const std::string whole = bytes_of(record("a.vrec", 3));
  const Reading reading = read_all(write("zeros.vrec", whole + std::string(5000, '\0')));
  EXPECT_EQ(reading.reports, alternating(3));
  EXPECT_EQ(reading.problems.torn_bytes, 5000u);
}

TEST_F(Recording, names_file_and_offset_of_any_damaged_byte_in_the_middle) {
  const std::string whole = bytes_of(record("a.vrec", 10));
  const std::size_t begin = whole.size() - 5 * kRecord;
  for (std::size_t at = begin; at < begin + kRecord; ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x41);
    const std::string error = error_of(write("bad.vrec", bytes));
    EXPECT_THAT(error, HasSubstr("bad.vrec, byte " + std::to_string(begin))) << at;
    EXPECT_THAT(error, HasSubstr("--skip-damage"));
  }
}

TEST_F(Recording, is_read_around_the_damage_when_asked) {
  std::string bytes = bytes_of(record("a.vrec", 10));
  bytes[bytes.size() - 5 * kRecord + 20] ^= 1;
  const Reading reading = read_all(write("bad.vrec", bytes), DamagePolicy::skip);
  auto expected = alternating(10);
  expected.erase(expected.begin() + 5);
  EXPECT_EQ(reading.reports, expected);
  EXPECT_EQ(reading.problems.damaged_bytes, kRecord);
}

TEST_F(Recording, is_refused_or_read_but_never_crashes_with_any_byte_of_it_changed) {
  const std::string whole = bytes_of(record("a.vrec", 3));
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const std::string file = write("bad.vrec", bytes);
      std::size_t reports = 0;
      try {
        reports = read_all(file).reports.size();
      } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("bad.vrec"));
      }
      EXPECT_LT(reports, 3u) << at;
    }
}

TEST_F(Recording, goes_on_in_the_next_file_when_it_is_full) {
  const std::string file = record("a.vrec", 100, {.rotate_bytes = 500});
  EXPECT_EQ(read_all(file).reports, alternating(100));
  ASSERT_TRUE(fs::exists(path("a.2.vrec")));
  for (const auto& entry : fs::directory_iterator(fs::path(file).parent_path()))
    EXPECT_LE(fs::file_size(entry), 500u);
  const Reading rest = read_all(path("a.1.vrec"));
  EXPECT_EQ(rest.info, info());
  EXPECT_GT(rest.reports.size(), 50u);
  EXPECT_EQ(rest.reports.back(), report_of(99, 1));
}

TEST_F(Recording, ends_before_a_file_that_was_cut_off_within_its_beginning) {
  const std::string beginning = bytes_of(record("b.vrec", 0)).substr(0, 12);
  for (std::size_t left = 8; left <= beginning.size(); ++left) {
    EXPECT_THAT(error_of(write("cut.vrec", beginning.substr(0, left))),
                HasSubstr("ends within its beginning"));
    const std::string file = path("a" + std::to_string(left) + ".vrec");
    record(fs::path(file).filename(), 5);
    write(fs::path(recording_part(file, 1)).filename(), beginning.substr(0, left));
    EXPECT_EQ(read_all(file).reports, alternating(5)) << left;
    EXPECT_EQ(read_all(file).problems.torn_bytes, left);
  }
}

TEST_F(Recording, does_not_go_on_in_another_recordings_file) {
  const std::string file = record("a.vrec", 5);
  {
    RecordingInfo other = info();
    ++other.started_utc_ns;
    RecordingWriter writer(path("b.vrec"), other, {.rotate_bytes = 1});
    for (int i = 0; i < 3; ++i) writer.add(0, Time{}, report_of(i).bytes);
  }
  fs::rename(path("b.1.vrec"), path("a.1.vrec"));
  const Reading reading = read_all(file);
  EXPECT_EQ(reading.reports, alternating(5));
  EXPECT_THAT(reading.problems.remarks.at(0), HasSubstr("a.1.vrec belongs to another recording"));
}

TEST_F(Recording, names_a_part_that_is_missing_before_others) {
  const std::string file = record("a.vrec", 100, {.rotate_bytes = 500});
  ASSERT_TRUE(fs::exists(path("a.3.vrec")));
  fs::remove(path("a.1.vrec"));
  const Reading reading = read_all(file);
  EXPECT_LT(reading.reports.size(), 100u);
  EXPECT_THAT(reading.problems.missing, ::testing::ElementsAre(path("a.1.vrec")));
  EXPECT_THAT(reading.problems.remarks.at(0),
              HasSubstr("a.1.vrec is missing: " + path("a.2.vrec") + " belongs to this recording"));
  EXPECT_TRUE(read_all(path("a.2.vrec")).problems.missing.empty());
}

TEST_F(Recording, misses_no_part_before_a_file_that_is_not_its_own) {
  const std::string file = record("a.vrec", 5);
  RecordingInfo other = info();
  ++other.started_utc_ns;
  {
    RecordingWriter writer(path("b.vrec"), other, {.rotate_bytes = 1});
    for (int i = 0; i < 3; ++i) writer.add(0, Time{}, report_of(i).bytes);
  }
  for (const std::string& strange : {bytes_of(path("b.2.vrec")), std::string("no recording")}) {
    ASSERT_FALSE(strange.empty());
    write("a.2.vrec", strange);
    EXPECT_TRUE(read_all(file).problems.missing.empty());
    EXPECT_TRUE(read_all(file).problems.remarks.empty());
  }
}

TEST_F(Recording, never_overwrites_a_file) {
  const std::string file = record("a.vrec", 5);
  EXPECT_THROW(RecordingWriter(file, info()), Error);
  EXPECT_EQ(read_all(file).reports, alternating(5));
}

TEST_F(Recording, begins_nothing_that_a_part_left_over_from_another_would_stop_later) {
  write("a.2.vrec", "left over");
  try {
    RecordingWriter writer(path("a.vrec"), info());
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path("a.2.vrec") + ": exists already"));
  }
  EXPECT_FALSE(fs::exists(path("a.vrec")));
}

TEST_F(Recording, is_not_hindered_by_files_that_are_none_of_its_parts) {
  for (const char* name : {"a.old.vrec", "a.1.txt", "b.1.vrec", "aa.1.vrec", "a.vrec.1"})
    write(name, "another");
  EXPECT_THAT(read_all(record("a.vrec", 5)).reports, SizeIs(5));
}

TEST_F(Recording, takes_reports_of_several_threads_in_each_ones_order) {
  constexpr int kThreads = 4, kReports = 5000;
  RecordingInfo four = info();
  four.devices = {{0, "a"}, {1, "b"}, {2, "c"}, {3, "d"}};
  {
    RecordingWriter writer(path("a.vrec"), four, {.rotate_bytes = 100'000});
    std::vector<std::jthread> threads;
    for (int device = 0; device < kThreads; ++device)
      threads.emplace_back([&writer, device] {
        for (int i = 0; i < kReports; ++i) {
          writer.add(device, report_of(i).arrival, report_of(i).bytes);
          if (i % 1000 == 0) writer.flush();
        }
      });
    threads.clear();
    EXPECT_EQ(writer.status().reports, std::vector<std::uint64_t>(kThreads, kReports));
  }
  std::vector<int> next(kThreads);
  for (const RecordedReport& report : read_all(path("a.vrec")).reports)
    EXPECT_EQ(report, report_of(next.at(report.device)++, report.device));
  EXPECT_EQ(next, std::vector<int>(kThreads, kReports));
}

TEST_F(Recording, says_how_many_reports_it_had_to_drop) {
  {
    RecordingWriter writer(path("a.vrec"), info(), {.queue_bytes = 0});
    for (int i = 0; i < 7; ++i) writer.add(0, Time{}, report_of(i).bytes);
    EXPECT_EQ(writer.status().dropped, 7u);
  }
  const Reading reading = read_all(path("a.vrec"));
  EXPECT_THAT(reading.reports, IsEmpty());
  EXPECT_EQ(reading.problems.dropped, 7u);
}

TEST_F(Recording, reads_lines_of_text_with_comments_names_blanks_and_dos_line_ends) {
  const Reading reading =
      read_all(write("a.txt",
                     "# anything\n\nleft 10000000 33 01 00 FF\r\n"
                     "  right\t20000000\t330200ff\n  # more\nleft 30000000 20"));
  ASSERT_THAT(reading.reports, SizeIs(3));
  EXPECT_EQ(reading.reports[0], report_of(1, 0));
  EXPECT_EQ(reading.reports[1], report_of(2, 1));
  EXPECT_EQ(reading.reports[2].bytes, std::vector<std::uint8_t>{0x20});
  EXPECT_EQ(reading.info.devices, (std::vector<RecordedDevice>{{0, "left"}, {1, "right"}}));
}

TEST_F(Recording, passes_by_the_byte_order_mark_of_an_editor) {
  const Reading reading = read_all(write("a.txt", "\xef\xbb\xbfleft 10000000 330100ff\n"));
  EXPECT_EQ(reading.reports.at(0), report_of(1));
  EXPECT_EQ(reading.info.devices, (std::vector<RecordedDevice>{{0, "left"}}));
}

TEST_F(Recording, says_where_the_last_report_stands) {
  RecordingReader text(write("a.txt", "# first\nleft 1 33\n\nleft 2 33\n"));
  text.next(), text.next();
  EXPECT_EQ(text.place(), path("a.txt") + ":4");
  RecordingReader binary(record("a.vrec", 2));
  binary.next(), binary.next();
  const std::size_t last = bytes_of(path("a.vrec")).size() - kRecord;
  EXPECT_EQ(binary.place(), path("a.vrec") + ", byte " + std::to_string(last));
}

TEST_F(Recording, takes_a_number_in_text_for_the_devices_index) {
  const Reading reading = read_all(write("a.txt", "3 10000000 330100ff\n"));
  EXPECT_EQ(reading.reports.at(0), report_of(1, 3));
  EXPECT_EQ(reading.info.devices, (std::vector<RecordedDevice>{{3, ""}}));
}

TEST_F(Recording, names_file_and_line_of_bad_text) {
  for (const char* line :
       {"left", "left x 33", "left -1 33", "left 99999999999999999999 33", "left 1", "left 1 3",
        "left 1 3 3", "left 1 0x33", "left 1 33zz", "left 1.5 33"}) {
    const std::string file = write("bad.txt", "left 1 33\n" + std::string(line) + "\nleft 2 33\n");
    EXPECT_THAT(error_of(file), HasSubstr("bad.txt:2: ")) << line;
    EXPECT_THAT(read_all(file, DamagePolicy::skip).reports, SizeIs(2)) << line;
  }
  EXPECT_THAT(error_of(write("mixed.txt", "left 1 33\n0 2 33\n")), HasSubstr("mixed.txt:2: "));
}

TEST_F(Recording, remarks_a_line_of_text_that_was_cut_off) {
  const Reading reading = read_all(write("a.txt", "left 1 33\nleft 2 3"));
  EXPECT_THAT(reading.reports, SizeIs(1));
  EXPECT_EQ(reading.problems.torn_bytes, 8u);
}

TEST_F(Recording, refuses_what_is_no_recording) {
  EXPECT_THAT(error_of(path("absent")), HasSubstr("cannot be read"));
  EXPECT_THAT(error_of(fs::path(path("a")).parent_path()), HasSubstr("cannot be read"));
  EXPECT_THAT(error_of(write("empty", "")), HasSubstr("is empty"));
  EXPECT_THAT(error_of(write("a.png", std::string("\x89PNG\0\0", 6))), HasSubstr("neither"));
  EXPECT_THAT(error_of(write("new.vrec", std::string("VINDUREC\x02\0\0\0\0", 13))),
              HasSubstr("format 2"));
}

std::vector<RecordedReport> drain(HidDevice& device, Time until) {
  std::vector<RecordedReport> reports;
  std::array<std::uint8_t, 64> buffer;
  for (;;) {
    const HidRead read = device.read(buffer, until);
    if (read.status != HidStatus::report) return reports;
    reports.push_back({0, read.arrival, {buffer.begin(), buffer.begin() + read.size}});
  }
}

TEST_F(Recording, plays_one_device_at_its_arrival_times_and_then_it_is_gone) {
  ManualClock clock;
  ReplayHidDevice device(record("a.vrec", 6), 1, clock, {.shift = std::chrono::seconds(1)});
  const auto early = drain(device, Time{milliseconds(1035)});
  ASSERT_THAT(early, SizeIs(2));
  EXPECT_EQ(early[1].arrival, Time{milliseconds(1030)});
  EXPECT_EQ(early[1].bytes, report_of(3).bytes);
  EXPECT_EQ(clock.now(), Time{milliseconds(1035)});
  EXPECT_THAT(drain(device, Time{milliseconds(1050)}), SizeIs(1));
  std::array<std::uint8_t, 64> buffer;
  EXPECT_EQ(device.read(buffer, Time::max()).status, HidStatus::gone);
  EXPECT_TRUE(device.write(std::vector<std::uint8_t>{0x12, 4, 0x33}));
}

TEST_F(Recording, never_plays_time_backwards) {
  ManualClock clock;
  ReplayHidDevice device(write("a.txt", "0 5 33\n0 3 33\n0 9 33\n"), 0, clock);
  const auto reports = drain(device, Time{Duration(10)});
  ASSERT_THAT(reports, SizeIs(3));
  EXPECT_EQ(reports[1].arrival, Time{Duration(5)});
  EXPECT_EQ(reports[2].arrival, Time{Duration(9)});
}

TEST_F(Recording, hears_what_the_driver_reads_and_passes_on_what_it_writes) {
  ManualClock clock;
  const std::string source = record("a.vrec", 20);
  std::vector<RecordedReport> read;
  {
    RecordingWriter writer(path("b.vrec"), info());
    RecordingHidDevice device(std::make_unique<ReplayHidDevice>(source, 0, clock), writer, 1);
    EXPECT_TRUE(device.write(std::vector<std::uint8_t>{0x12, 4, 0x33}));
    read = drain(device, Time::max());
  }
  ASSERT_THAT(read, SizeIs(10));
  for (RecordedReport& report : read) report.device = 1;
  EXPECT_EQ(read_all(path("b.vrec")).reports, read);
}

}  // namespace
}  // namespace vindu
