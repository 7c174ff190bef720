#include "tests/app/x_client.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <thread>

namespace vindu::testing {
namespace {

void await_x(const std::function<bool()>& condition, const char* what) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error(what);
}

}  // namespace

struct XClient::Connection {
  explicit Connection(const std::string& name) : display(XOpenDisplay(name.c_str())) {
    if (!display) throw std::runtime_error("no X server at " + name);
    root = DefaultRootWindow(display);
    own = XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, 0, 0);
  }
  ~Connection() { XCloseDisplay(display); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Atom atom(const char* name) const { return XInternAtom(display, name, False); }

  void send(const char* type, const std::array<long, 5>& data) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(type);
    event.xclient.format = 32;
    std::copy(data.begin(), data.end(), event.xclient.data.l);
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
  }

  bool find_target() {
    Window of_root = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    XQueryTree(display, root, &of_root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i)
      if (has_property(children[i], "XdndAware")) target = children[i];
    if (children) XFree(children);
    return target != 0;
  }

  bool has_property(Window window, const char* name) const {
    Atom type = 0;
    int format = 0;
    unsigned long count = 0, left = 0;
    unsigned char* data = nullptr;
    XGetWindowProperty(display, window, atom(name), 0, 1, False, AnyPropertyType, &type, &format,
                       &count, &left, &data);
    if (data) XFree(data);
    return type != 0;
  }

  /// Gives the list of files to whoever asks for it; true when a message of this type came.
  bool serve(const std::string& uris, const char* awaited) const {
    while (XPending(display) > 0) {
      XEvent event{};
      XNextEvent(display, &event);
      if (event.type == ClientMessage && event.xclient.message_type == atom(awaited)) return true;
      if (event.type != SelectionRequest) continue;
      const XSelectionRequestEvent& wish = event.xselectionrequest;
      XChangeProperty(display, wish.requestor, wish.property, wish.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(uris.data()),
                      static_cast<int>(uris.size()));
      XEvent answer{};
      answer.xselection = {.type = SelectionNotify,
                           .serial = 0,
                           .send_event = True,
                           .display = display,
                           .requestor = wish.requestor,
                           .selection = wish.selection,
                           .target = wish.target,
                           .property = wish.property,
                           .time = wish.time};
      XSendEvent(display, wish.requestor, False, NoEventMask, &answer);
      XFlush(display);
    }
    return false;
  }

  Display* display;
  Window root = 0, own = 0, target = 0;
};

XClient::XClient(const std::string& display) : x_(std::make_unique<Connection>(display)) {
  await_x([&] { return x_->find_target(); }, "no window that takes drops");
}

XClient::~XClient() = default;

void XClient::drop(const std::string& file) {
  const std::string uris = "file://" + std::filesystem::absolute(file).string() + "\r\n";
  const auto own = static_cast<long>(x_->own);
  XSetSelectionOwner(x_->display, x_->atom("XdndSelection"), x_->own, CurrentTime);
  x_->send("XdndEnter", {own, 5L << 24, static_cast<long>(x_->atom("text/uri-list")), 0, 0});
  x_->send("XdndPosition",
           {own, 0, 100L << 16 | 100, CurrentTime, static_cast<long>(x_->atom("XdndActionCopy"))});
  await_x([&] { return x_->serve(uris, "XdndStatus"); }, "the window does not say XdndStatus");
  x_->send("XdndDrop", {own, 0, CurrentTime, 0, 0});
  await_x([&] { return x_->serve(uris, "XdndFinished"); }, "the window does not say XdndFinished");
}

void XClient::press(const std::string& key) {
  for (const int type : {KeyPress, KeyRelease}) {
    XEvent event{};
    event.xkey.type = type;
    event.xkey.window = x_->target;
    event.xkey.root = x_->root;
    event.xkey.keycode = XKeysymToKeycode(x_->display, XStringToKeysym(key.c_str()));
    event.xkey.same_screen = True;
    XSendEvent(x_->display, x_->target, False, NoEventMask, &event);
  }
  XFlush(x_->display);
}

void XClient::close_window() {
  x_->send("WM_PROTOCOLS", {static_cast<long>(x_->atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
}

Image XClient::picture() {
  XWindowAttributes screen{};
  XGetWindowAttributes(x_->display, x_->root, &screen);
  XImage* const shot = XGetImage(x_->display, x_->root, 0, 0, static_cast<unsigned>(screen.width),
                                 static_cast<unsigned>(screen.height), AllPlanes, ZPixmap);
  Image image = Image::filled(screen.width, screen.height, {0, 0, 0, 255});
  for (int y = 0; y < screen.height; ++y)
    for (int x = 0; x < screen.width; ++x) {
      const unsigned long pixel = XGetPixel(shot, x, y);
      image.at(x, y) = {static_cast<std::uint8_t>(pixel >> 16),
                        static_cast<std::uint8_t>(pixel >> 8), static_cast<std::uint8_t>(pixel),
                        255};
    }
  XDestroyImage(shot);
  return image;
}

}  // namespace vindu::testing
