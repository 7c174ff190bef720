#include "tests/launch/namespace_hosts.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace vindu::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRig = VINDU_SOURCE_DIR "/tests/launch/namespace_hosts.sh";

fs::path new_folder() {
  std::string pattern = (fs::temp_directory_path() / "vindu_hosts_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  return pattern;
}

/// With spaces between its words.
std::string command_line(const fs::path& process) {
  std::ifstream stream(process / "cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(stream, word, '\0');) text += word + ' ';
  return text;
}

}  // namespace

NamespaceHosts::NamespaceHosts(std::vector<std::string> names, bool slurm)
    : names_(std::move(names)), folder_(new_folder()), prefix_("vh" + std::to_string(getpid())) {
  std::string command =
      std::string(kRig) + (slurm ? " up_with_slurm " : " up ") + folder_.string() + " " + prefix_;
  for (const std::string& name : names_) command += " " + name;
  // By system(): run_program would end what it leaves behind.
  made_ = std::system(command.c_str()) == 0;
  for (const std::string& name : names_)
    if (struct stat file{}; stat(("/var/run/netns/" + prefix_ + "-" + name).c_str(), &file) == 0)
      networks_[name] = "net:[" + std::to_string(file.st_ino) + "]";
}

NamespaceHosts::~NamespaceHosts() {
  take_down();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void NamespaceHosts::take_down() { rig({"down", folder_, prefix_}); }

ProgramResult NamespaceHosts::rig(std::vector<std::string> words) const {
  words.insert(words.begin(), kRig);
  return run_program(words);
}

std::vector<std::string> NamespaceHosts::words_on_head(std::vector<std::string> words) const {
  words.insert(words.begin(), {kRig, "run", folder_, prefix_, names_.front()});
  return words;
}

ProgramResult NamespaceHosts::on_head(const std::vector<std::string>& words) const {
  return run_program(words_on_head(words));
}

std::vector<pid_t> NamespaceHosts::processes(const std::string& host,
                                             const std::string& words) const {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code gone;  // a process that ends meanwhile, or is no process
    const fs::path network = fs::read_symlink(entry.path() / "ns/net", gone);
    if (gone || !networks_.contains(host) || network != networks_.at(host)) continue;
    if (command_line(entry.path()).find(words) != std::string::npos)
      found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

std::vector<pid_t> NamespaceHosts::processes(const std::string& words) const {
  std::vector<pid_t> all;
  for (const std::string& host : names_)
    std::ranges::copy(processes(host, words), std::back_inserter(all));
  return all;
}

}  // namespace vindu::testing
