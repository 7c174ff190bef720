// What recording costs the thread that reads a device: adding a report, beside a plain fwrite of
// the same bytes without checksum, lock or confirmation by the disk. Then reading it back.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "tracker/recording_reader.h"
#include "tracker/recording_writer.h"

namespace vindu {
namespace {

using Stopwatch = std::chrono::steady_clock;
constexpr int kBatch = 10'000;
constexpr std::array<std::uint8_t, 18> kReport = {0x33, 0x40, 0x20, 0x85, 0x99, 0x25,
                                                  0xc9, 0x63, 0xf7, 0xc8, 0x53, 0x36,
                                                  0xca, 0x63, 0xff, 0xff, 0xff, 0x01};
constexpr std::size_t kOnDisk = 8 + 11 + kReport.size();

/// A name that goes away with its files.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "vindu_bench_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(folder_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

RecordingInfo one_device() {
  RecordingInfo info;
  info.program = "bench";
  info.devices = {{0, "left"}};
  return info;
}

/// Adding, and then waiting until the disk has it, each once for every batch.
void add_over_fwrite(benchmark::State& state) {
  const Folder folder;
  RecordingWriter writer(folder.file("a.vrec"), one_device());
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> plain(
      std::fopen(folder.file("plain").c_str(), "wb"), std::fclose);
  const std::array<std::uint8_t, kOnDisk> record{};
  Duration adding{}, plainly{};
  std::int64_t number = 0;
  for (auto _ : state) {
    const auto start = Stopwatch::now();
    for (int i = 0; i < kBatch; ++i) writer.add(0, Time{Duration(++number)}, kReport);
    const auto middle = Stopwatch::now();
    for (int i = 0; i < kBatch; ++i) std::fwrite(record.data(), 1, record.size(), plain.get());
    std::fflush(plain.get());
    plainly += Stopwatch::now() - middle;
    adding += middle - start;
    state.PauseTiming();
    writer.flush();
    state.ResumeTiming();
  }
  if (writer.status().dropped > 0) return state.SkipWithError("reports were dropped");
  const double reports = static_cast<double>(number);
  state.counters["add_ns"] = 1e9 * seconds(adding) / reports;
  state.counters["fwrite_ns"] = 1e9 * seconds(plainly) / reports;
  state.counters["ratio"] = seconds(adding) / seconds(plainly);
}
BENCHMARK(add_over_fwrite);

void add_and_flush(benchmark::State& state) {
  const Folder folder;
  RecordingWriter writer(folder.file("a.vrec"), one_device());
  for (auto _ : state) {
    for (int i = 0; i < kBatch; ++i) writer.add(0, Time{}, kReport);
    writer.flush();
  }
  state.SetItemsProcessed(state.iterations() * kBatch);
}
BENCHMARK(add_and_flush)->UseRealTime();

void read_back(benchmark::State& state) {
  const Folder folder;
  {
    RecordingWriter writer(folder.file("a.vrec"), one_device());
    for (int i = 0; i < kBatch; ++i) writer.add(0, Time{}, kReport);
  }
  for (auto _ : state) {
    RecordingReader reader(folder.file("a.vrec"));
    int reports = 0;
    while (reader.next()) ++reports;
    if (reports != kBatch) return state.SkipWithError("reports are missing");
  }
  state.SetItemsProcessed(state.iterations() * kBatch);
}
BENCHMARK(read_back);

}  // namespace
}  // namespace vindu
