#include "tracker/recording_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "tracker/recording_format.h"

namespace vindu {
namespace {

constexpr auto kFlushEvery = std::chrono::milliseconds(500);

std::string reason_of(int error) { return std::generic_category().message(error); }

void check_devices(const std::vector<RecordedDevice>& devices) {
  assert(devices.size() <= 0xffff);
  for (auto device = devices.begin(); device != devices.end(); ++device) {
    assert(device->index >= 0 && device->index <= 0xffff);
    if (std::find_if(devices.begin(), device, [&](const RecordedDevice& other) {
          return other.index == device->index;
        }) != device)
      throw Error({"two devices have the index " + std::to_string(device->index), device->name,
                   "give every device its own"});
  }
}

/// Fails what is to be written to `file`; `error` is of errno.
Error cannot_be_written(const std::string& file, int error) {
  return Error(
      {"cannot be written: " + reason_of(error), file, "make room on the disk and record again"});
}

}  // namespace

RecordingWriter::RecordingWriter(std::string file, RecordingInfo info,
                                 const RecordingOptions& options)
    : file_(std::move(file)), info_(std::move(info)), options_(options) {
  check_devices(info_.devices);
  status_.reports.resize(info_.devices.size());
  if (const auto part = recording_part_after(file_, 0))  // it would stop this one in its turn
    throw Error(
        {"exists already", recording_part(file_, *part), "choose another name, or move it away"});
  open_part(0);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

RecordingWriter::~RecordingWriter() {
  thread_.request_stop();
  thread_.join();
  flush();
}

void RecordingWriter::add(int device, Time arrival, std::span<const std::uint8_t> report) {
  const auto known = std::ranges::find(info_.devices, device, &RecordedDevice::index);
  assert(known != info_.devices.end());
  const std::lock_guard lock(queue_mutex_);
  if (queue_.size() + report.size() > options_.queue_bytes || !status_.failure.empty()) {
    ++status_.dropped;
    ++dropped_unsaid_;
    return;
  }
  append_report(queue_, device, arrival, report);
  ++status_.reports[static_cast<std::size_t>(known - info_.devices.begin())];
  if (queue_.size() > options_.queue_bytes / 4) queue_filled_.notify_one();
}

void RecordingWriter::note(Time time, std::string text) {
  text.resize(std::min(text.size(), kMaxRecordedReport));
  const std::lock_guard lock(queue_mutex_);
  if (status_.failure.empty() && queue_.size() + text.size() <= options_.queue_bytes)
    append_note(queue_, {time, std::move(text)});
}

void RecordingWriter::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(queue_mutex_);
      queue_filled_.wait_for(lock, stop, kFlushEvery,
                             [this] { return queue_.size() > options_.queue_bytes / 4; });
    }
    flush();
  }
}

std::vector<std::uint8_t> RecordingWriter::take_queue() {
  const std::lock_guard lock(queue_mutex_);
  if (!status_.failure.empty()) return {};
  if (dropped_unsaid_ > 0) append_dropped(queue_, {std::exchange(dropped_unsaid_, 0)});
  return std::exchange(queue_, {});
}

void RecordingWriter::flush() {
  const std::lock_guard disk(disk_mutex_);
  const std::vector<std::uint8_t> records = take_queue();
  if (records.empty()) return;
  try {
    write_records(records);
    sync();
  } catch (const Error& error) {
    const std::lock_guard lock(queue_mutex_);
    status_.failure = error.what();
  }
}

/// Begins a new file before the record that would make this one too large.
void RecordingWriter::write_records(std::span<const std::uint8_t> records) {
  std::size_t end = 0;
  while (end < records.size()) {
    const std::size_t size = record_size(records.subspan(end));
    const bool full = options_.rotate_bytes > 0 && part_bytes_ + end > start_bytes_ &&
                      part_bytes_ + end + size > options_.rotate_bytes;
    if (full && end > 0) {
      write(records.first(end));
      records = records.subspan(end);
      end = 0;
    } else if (full) {
      sync();
      open_part(status().files);
    } else {
      end += size;
    }
  }
  write(records);
}

void RecordingWriter::open_part(int part) {
  const std::string name = recording_part(file_, part);
  part_file_.reset(std::fopen(name.c_str(), "wbxe"));  // x: never over what is there
  if (!part_file_)
    throw Error({"cannot be made: " + reason_of(errno), name,
                 "choose a new name in a folder that can be written to"});
  std::vector<std::uint8_t> start;
  append_start(start, {info_, part});
  part_bytes_ = 0;
  start_bytes_ = start.size();
  write(start);
  sync();
  const std::lock_guard lock(queue_mutex_);
  status_.files = part + 1;
}

void RecordingWriter::write(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), part_file_.get()) != bytes.size())
    throw cannot_be_written(recording_part(file_, status().files - 1), errno);
  part_bytes_ += bytes.size();
  const std::lock_guard lock(queue_mutex_);
  status_.bytes += bytes.size();
}

void RecordingWriter::sync() {
  if (std::fflush(part_file_.get()) != 0)
    throw cannot_be_written(recording_part(file_, status().files - 1), errno);
  // Some file systems cannot sync at all (EINVAL, ENOSYS): then the kernel's own time has to do.
  if (fdatasync(fileno(part_file_.get())) != 0 &&
      (errno == EIO || errno == ENOSPC || errno == EDQUOT))
    throw cannot_be_written(recording_part(file_, status().files - 1), errno);
}

RecordingStatus RecordingWriter::status() const {
  const std::lock_guard lock(queue_mutex_);
  return status_;
}

}  // namespace vindu
