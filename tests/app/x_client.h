// What a desktop does to a window: drops files on it (XDND, version 5), presses keys, asks it to
// close, and shows its pixels. For tests, on a display without a window manager.
#pragma once

#include <memory>
#include <string>

#include "renderer/image.h"

namespace vindu::testing {

class XClient {
 public:
  /// Waits for the first window that takes drops. Throws std::runtime_error when none comes.
  explicit XClient(const std::string& display);
  ~XClient();
  XClient(const XClient&) = delete;
  XClient& operator=(const XClient&) = delete;

  /// Throws std::runtime_error when the window does not take it.
  void drop(const std::string& file);
  /// A key by its name for X, "F12": down and up.
  void press(const std::string& key);
  void close_window();
  /// Of the whole screen.
  Image picture();

 private:
  struct Connection;
  std::unique_ptr<Connection> x_;
};

}  // namespace vindu::testing
