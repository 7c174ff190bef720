#include "tests/tracker/other_parsers.h"

#include <cwiid.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <thread>
#include <vector>

// libcwiid exports it (libcwiid/connect.c), but its header keeps quiet: what cwiid_open() calls
// once both Bluetooth channels are connected.
extern "C" cwiid_wiimote_t* cwiid_new(int control, int interrupt, int flags);

#if defined(__SANITIZE_ADDRESS__)
// cwiid_send_rpt() allocates twice the payload and writes it with two bytes before: one too many
// where the payload has one.
extern "C" const char* __asan_default_suppressions() { return "interceptor_via_lib:libcwiid"; }
#endif

namespace vindu::testing {
namespace {

constexpr std::uint8_t kInput = 0xa1, kHandshake = 0x00;  // of the Bluetooth HID profile

OthersSlots slots_of(const cwiid_ir_mesg& message) {
  OthersSlots slots;
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (const cwiid_ir_src& source = message.src[i]; source.valid)
      slots[i] = OthersDot{source.pos[CWIID_X], source.pos[CWIID_Y], std::max(0, +source.size)};
  return slots;
}

/// `count` bits from bit `at` on, the lowest of a byte first: how GCC lays out Dolphin's
/// bit-fields.
int bits(ReportBytes bytes, std::size_t at, std::size_t count) {
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= (bytes[(at + i) / 8] >> ((at + i) % 8) & 1) << i;
  return value;
}

constexpr int kDolphinRows_px = 768;

std::optional<OthersDot> dolphin_dot(int x_px, int y_px, int size) {
  if (y_px > kDolphinRows_px - 1) return std::nullopt;  // IRState::ProcessData
  return OthersDot{x_px, y_px, size};
}

// struct IRBasic { x1: 8, y1: 8, x2hi: 2, y2hi: 2, x1hi: 2, y1hi: 2, x2: 8, y2: 8 }
OthersSlots dolphin_basic(ReportBytes bytes) {
  OthersSlots slots;
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const ReportBytes b = bytes.subspan(5 * pair);
    slots[2 * pair] =
        dolphin_dot(bits(b, 20, 2) << 8 | bits(b, 0, 8), bits(b, 22, 2) << 8 | bits(b, 8, 8), 0);
    slots[2 * pair + 1] =
        dolphin_dot(bits(b, 16, 2) << 8 | bits(b, 24, 8), bits(b, 18, 2) << 8 | bits(b, 32, 8), 0);
  }
  return slots;
}

// struct IRExtended { x: 8, y: 8, size: 4, xhi: 2, yhi: 2 }
std::optional<OthersDot> dolphin_extended(ReportBytes b) {
  return dolphin_dot(bits(b, 20, 2) << 8 | bits(b, 0, 8), bits(b, 22, 2) << 8 | bits(b, 8, 8),
                     bits(b, 16, 4));
}

// struct IRFull : IRExtended { xmin: 7, : 1, ymin: 7, : 1, xmax: 7, : 1, ymax: 7, : 1, zero: 8,
// intensity: 8 }
std::optional<OthersDot> dolphin_full(ReportBytes b) {
  auto dot = dolphin_extended(b);
  if (dot)
    dot->blob = {bits(b, 24, 7), bits(b, 32, 7), bits(b, 40, 7), bits(b, 48, 7), bits(b, 64, 8)};
  return dot;
}

}  // namespace

struct Cwiid::Connection {
  Connection();
  ~Connection();
  void answer(const std::stop_token& stop);

  std::array<int, 2> control{}, interrupt{};  // cwiid's end, and ours
  std::jthread device;
  cwiid_wiimote_t* wiimote = nullptr;
};

Cwiid::Connection::Connection() {
  cwiid_set_err([](cwiid_wiimote_t*, const char*, va_list) {});  // silent about missing extensions
  [[maybe_unused]] const int failures = socketpair(AF_UNIX, SOCK_SEQPACKET, 0, control.data()) +
                                        socketpair(AF_UNIX, SOCK_SEQPACKET, 0, interrupt.data());
  assert(failures == 0);
  device = std::jthread([this](const std::stop_token& stop) { answer(stop); });
  wiimote = cwiid_new(control[0], interrupt[0], CWIID_FLAG_MESG_IFC);
  assert(wiimote);
  [[maybe_unused]] const int refused = cwiid_set_rpt_mode(wiimote, CWIID_RPT_IR);
  assert(refused == 0);
}

Cwiid::Connection::~Connection() {
  cwiid_close(wiimote);  // and its ends of the sockets
  device = {};
  close(control[1]);
  close(interrupt[1]);
}

/// A handshake for whatever is asked for, and for a write to memory its acknowledgement.
void Cwiid::Connection::answer(const std::stop_token& stop) {
  constexpr int kLook_ms = 20;
  while (!stop.stop_requested()) {
    pollfd ready{control[1], POLLIN, 0};
    std::array<std::uint8_t, 64> request{};
    if (poll(&ready, 1, kLook_ms) <= 0) continue;
    if (recv(control[1], request.data(), request.size(), 0) <= 0) return;
    send(control[1], &kHandshake, 1, MSG_NOSIGNAL);
    const std::uint8_t acknowledgement[] = {kInput, 0x22, 0, 0, 0x16, 0};
    if (request[1] == 0x16)
      send(interrupt[1], acknowledgement, sizeof(acknowledgement), MSG_NOSIGNAL);
  }
}

Cwiid::Cwiid() : connection_(std::make_unique<Connection>()) {}
Cwiid::~Cwiid() = default;

OthersSlots Cwiid::read(ReportBytes report) {
  std::vector<std::uint8_t> packet = {kInput};
  packet.insert(packet.end(), report.begin(), report.end());
  send(connection_->interrupt[1], packet.data(), packet.size(), MSG_NOSIGNAL);
  int count = 0;
  cwiid_mesg* messages = nullptr;
  timespec time{};
  if (cwiid_get_mesg(connection_->wiimote, &count, &messages, &time) != 0) return {};
  OthersSlots slots;
  for (const cwiid_mesg& message : std::span(messages, static_cast<std::size_t>(count)))
    if (message.type == CWIID_MESG_IR) slots = slots_of(message.ir_mesg);
  std::free(messages);
  return slots;
}

OthersSlots read_as_wiiuse(ReportBytes report) {
  OthersSlots slots;
  const auto take = [](int rx, int ry, int size) -> std::optional<OthersDot> {
    if (ry == 1023) return std::nullopt;
    return OthersDot{1023 - rx, ry, size};  // it mirrors x: turned back
  };
  if (report[0] == 0x33) {  // calculate_extended_ir(wm, msg + 5), msg after the id
    const ReportBytes data = report.subspan(6);
    for (std::size_t i = 0; i < 4; ++i)
      slots[i] =
          take(1023 - (data[3 * i] | ((data[(3 * i) + 2] & 0x30) << 4)),
               data[(3 * i) + 1] | ((data[(3 * i) + 2] & 0xC0) << 2), data[(3 * i) + 2] & 0x0F);
    return slots;
  }
  assert(report[0] == 0x36 || report[0] == 0x37);  // calculate_basic_ir, msg + 2 or msg + 5
  const ReportBytes data = report.subspan(report[0] == 0x36 ? 3 : 6);
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const std::size_t at = 5 * pair;
    slots[2 * pair] = take(1023 - (data[at] | ((data[at + 2] & 0x30) << 4)),
                           data[at + 1] | ((data[at + 2] & 0xC0) << 2), 0);
    slots[2 * pair + 1] = take(1023 - (data[at + 3] | ((data[at + 2] & 0x03) << 8)),
                               data[at + 4] | ((data[at + 2] & 0x0C) << 6), 0);
  }
  return slots;
}

OthersSlots read_as_dolphin(ReportBytes report) {
  OthersSlots slots;
  switch (report[0]) {  // IncludeIR<offset after the id, length>
    case 0x33:
      for (std::size_t i = 0; i < 4; ++i) slots[i] = dolphin_extended(report.subspan(6 + 3 * i));
      return slots;
    case 0x36:
      return dolphin_basic(report.subspan(3));
    case 0x37:
      return dolphin_basic(report.subspan(6));
    default:
      assert(report[0] == 0x3e || report[0] == 0x3f);
      for (std::size_t i = 0; i < 2; ++i) slots[i] = dolphin_full(report.subspan(4 + 9 * i));
      return slots;
  }
}

}  // namespace vindu::testing
