#include "tests/app/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

#ifdef __SANITIZE_ADDRESS__
constexpr auto kLimit = 1000s;  // planning takes minutes under this sanitizer
#else
constexpr auto kLimit = 200s;
#endif

std::vector<std::string> environment_with(const Environment& changes) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable; ++variable) {
    const std::string name = std::string(*variable).substr(0, std::string(*variable).find('='));
    if (name != "DISPLAY" && name != "WAYLAND_DISPLAY" && !changes.contains(name))
      variables.emplace_back(*variable);
  }
  for (const auto& [name, value] : changes) variables.push_back(name + "=" + value);
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the child's descriptors are, beside its own.
class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void to_file(int descriptor, const std::string& file) {
    posix_spawn_file_actions_addopen(&actions_, descriptor, file.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  void from_nothing() { posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0); }
  void duplicate(int from, int to) { posix_spawn_file_actions_adddup2(&actions_, from, to); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// -1 when the program is not there.
pid_t start(std::vector<std::string> words, const Environment& changes,
            const FileActions& actions) {
  std::vector<std::string> variables = environment_with(changes);
  pid_t child = -1;
  if (posix_spawnp(&child, words.front().c_str(), actions.get(), nullptr, pointers_to(words).data(),
                   pointers_to(variables).data()))
    return -1;
  return child;
}

int wait_for(pid_t child) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) kill(child, SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// To the end of the line: the server dies when it can no longer write it.
std::string first_line(int descriptor, std::chrono::milliseconds limit) {
  std::string line;
  pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
  for (char character = 0; poll(&ready, 1, static_cast<int>(limit.count())) == 1;) {
    if (read(descriptor, &character, 1) != 1) return "";
    if (character == '\n') return line;
    line += character;
  }
  return "";
}

fs::path new_folder() {
  std::string pattern = (fs::temp_directory_path() / "vindu_app_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  return pattern;
}

}  // namespace

ProcessResult run(const std::vector<std::string>& words, const Environment& environment) {
  const fs::path folder = new_folder();
  FileActions actions;
  actions.from_nothing();
  actions.to_file(1, folder / "out");
  actions.to_file(2, folder / "err");
  const pid_t child = start(words, environment, actions);
  if (child < 0) throw std::runtime_error("cannot start " + words.front());
  ProcessResult result;
  result.exit_code = wait_for(child);
  result.out = bytes_of(folder / "out");
  result.err = bytes_of(folder / "err");
  fs::remove_all(folder);
  return result;
}

ProcessResult vindu(std::vector<std::string> arguments, const Environment& environment) {
  arguments.insert(arguments.begin(), VINDU_PROGRAM);
  return run(arguments, environment);
}

AppTest::AppTest() : folder_(new_folder()) {}

AppTest::~AppTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string AppTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> AppTest::files_in(const std::string& name) const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path(name), ignored))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

std::string bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

double number_after(const std::string& json, const std::string& key, std::size_t from) {
  const std::size_t at = json.find("\"" + key + "\":", from);
  return at == std::string::npos ? -1 : std::stod(json.substr(at + key.size() + 3));
}

std::string small_model() { return "/usr/share/assimp/models/OBJ/box.obj"; }

VirtualDisplay::VirtualDisplay() {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC)) return;
  FileActions actions;
  actions.from_nothing();
  actions.to_file(1, "/dev/null");
  actions.to_file(2, "/dev/null");
  actions.duplicate(ends[1], 3);
  server_ = start({"Xvfb", "-displayfd", "3", "-screen", "0", "1600x1000x24", "-nolisten", "tcp"},
                  {}, actions);
  close(ends[1]);
  name_ = first_line(ends[0], 60s);
  if (!name_.empty()) name_ = ":" + name_;
  close(ends[0]);
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  wait_for(server_);
}

}  // namespace vindu::testing
