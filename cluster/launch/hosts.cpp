#include "cluster/launch/hosts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "cluster/launch/child_processes.h"
#include "cluster/launch/node_set.h"
#include "cluster/launch/words.h"
#include "core/error.h"

namespace vindu {
namespace {

// No question is ever asked, and a dead host is given up soon.
constexpr const char* kSshOptions = "-oBatchMode=yes -oConnectTimeout=10";

/// "step\treason\tremedy"
HostFailure failure_from(const std::string& text) {
  std::istringstream stream(text);
  HostFailure failure;
  for (std::string* part : {&failure.step, &failure.reason, &failure.remedy})
    std::getline(stream, *part, '\t');
  return failure;
}

std::string ssh_remedy(const std::string& reason) {
  const auto says = [&reason](const char* part) { return reason.find(part) != std::string::npos; };
  if (says("Permission denied")) return "give it your key: ssh-copy-id HOST";
  if (says("resolve")) return "add it to /etc/hosts or to DNS, or correct the wall file";
  if (says("Host key verification")) return "log in once by hand: ssh HOST";
  return "see that it is on, on the network, and runs sshd: ssh HOST";
}

/// A host that never said how it went.
HostFailure silence(const HostReport& report, const std::vector<std::string>& errors) {
  std::string reason = !errors.empty()        ? errors.back()
                       : report.lines.empty() ? "the connection ended"
                                              : report.lines.back();
  if (reason.starts_with("ssh: ")) reason.erase(0, 5);
  return {"ssh", reason, ssh_remedy(reason)};
}

/// The text of a line that is this host's.
std::optional<std::string> of_host(const std::string& line, const std::string& host) {
  if (!line.starts_with(host + ": ")) return std::nullopt;
  return line.substr(host.size() + 2);
}

HostReport report_from(const std::string& host, const ProgramResult& clush) {
  HostReport report{.host = host};
  bool done = false;
  for (const std::string& line : clush.out) {
    const auto text = of_host(line, host);
    if (!text) continue;
    if (text->starts_with("@fail\t"))
      report.failure = failure_from(text->substr(6));
    else if (*text == "@done")
      done = true;
    else
      report.lines.push_back(*text);
  }
  std::vector<std::string> errors;
  for (const std::string& line : clush.err)
    if (const auto text = of_host(line, host)) errors.push_back(*text);
  if (!done && !report.failure) report.failure = silence(report, errors);
  return report;
}

/// Until all children have ended.
std::map<std::string, ProgramResult> listen(ChildProcesses& children) {
  std::map<std::string, ProgramResult> results;
  while (!children.empty()) {
    ChildNews news = children.wait(std::chrono::steady_clock::now() + std::chrono::seconds(1));
    if (news.stop) throw Error({"was stopped", "", ""});
    for (ChildLine& line : news.lines) {
      auto& lines = line.result ? results[line.name].out : results[line.name].err;
      if (line.text.ends_with('\r')) line.text.pop_back();  // as ssh has them
      lines.push_back(std::move(line.text));
    }
    for (const ChildEnd& end : news.ends)
      results[end.name].exit_code = end.signal ? 128 + end.signal : end.exit_code;
  }
  return results;
}

[[noreturn]] void no_program(const std::string& name, const std::string& package) {
  throw Error({"is not installed here", name, "apt-get install " + package});
}

/// "connect to host HOST port 22": what ssh says of several hosts differs in their names alone.
std::string without_name(const std::string& text, const std::string& host) {
  const auto in_name = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '_';
  };
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const bool begins = at == 0 || !in_name(text[at - 1]);
    const std::size_t end = at + host.size();
    if (begins && text.compare(at, host.size(), host) == 0 &&
        (end >= text.size() || !in_name(text[end]))) {
      result += "HOST";
      at = end;
    } else {
      result += text[at++];
    }
  }
  return result;
}

/// By rsync, of each host its own command.
std::vector<HostReport> copied(const std::map<std::string, std::vector<std::string>>& words) {
  ChildProcesses children;
  for (const auto& [host, command] : words) children.start(host, command);
  auto results = listen(children);
  std::vector<HostReport> reports;
  for (const auto& [host, command] : words) {
    const ProgramResult& rsync = results[host];
    if (rsync.exit_code == kNotStarted) no_program("rsync", "rsync");
    HostReport& report = reports.emplace_back(HostReport{.host = host});
    if (rsync.exit_code == 0) continue;
    const std::string reason = rsync.err.empty() ? "it says nothing" : rsync.err.front();
    report.failure = {"copy", reason,
                      reason.find("rsync: command not found") != std::string::npos ||
                              reason.find("rsync: not found") != std::string::npos
                          ? "there: apt-get install rsync"
                          : ssh_remedy(reason)};
  }
  return reports;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& words) {
  ChildProcesses children;
  children.start(words.front(), words);
  return listen(children)[words.front()];
}

std::vector<std::string> clush_words(const std::vector<std::string>& hosts,
                                     const std::string& script) {
  return {"clush", "--nostdin",       "--color=never",          "-f", "64", "-o", kSshOptions,
          "-w",    fold_names(hosts), command_for_hosts(script)};
}

std::vector<HostReport> on_hosts(const std::vector<std::string>& hosts, const std::string& script) {
  if (hosts.empty()) return {};
  const ProgramResult clush = run_program(clush_words(hosts, script));
  if (clush.exit_code == kNotStarted) no_program("clush", "clustershell");
  return reports_from(hosts, clush);
}

std::vector<HostReport> reports_from(const std::vector<std::string>& hosts,
                                     const ProgramResult& clush) {
  std::vector<HostReport> reports;
  for (const std::string& host : hosts) reports.push_back(report_from(host, clush));
  return reports;
}

std::vector<std::string> rsync_words(const HostFiles& files) {
  std::vector<std::string> words = {"rsync",    "--recursive", "--copy-links",
                                    "--perms",  "--times",     "--compress",
                                    "--mkpath", "--rsh",       std::string("ssh ") + kSshOptions,
                                    "--"};
  for (const std::string& folder : files.folders) words.push_back(folder + "/");
  words.push_back(files.host + ":.vindu/");
  return words;
}

std::vector<HostReport> copy_to_hosts(const std::vector<HostFiles>& hosts) {
  std::map<std::string, std::vector<std::string>> words;
  for (const HostFiles& files : hosts) words[files.host] = rsync_words(files);
  return copied(words);
}

// Paths reach no shell there (--secluded-args).
std::vector<std::string> rsync_words(const HostPaths& paths, const std::string& folder) {
  std::vector<std::string> words = {
      "rsync", "--secluded-args", "--times", "--rsh", std::string("ssh ") + kSshOptions, "--"};
  for (const std::string& file : paths.files) words.push_back(paths.host + ":" + file);
  words.push_back(folder + "/");
  return words;
}

std::vector<HostReport> copy_from_hosts(const std::vector<HostPaths>& hosts,
                                        const std::string& folder) {
  std::map<std::string, std::vector<std::string>> words;
  for (const HostPaths& paths : hosts) words[paths.host] = rsync_words(paths, folder);
  return copied(words);
}

std::string failures_of(const std::vector<HostReport>& reports) {
  std::map<HostFailure, std::vector<const HostReport*>> alike;
  for (const HostReport& report : reports) {
    if (!report.failure) continue;
    HostFailure failure = *report.failure;
    failure.reason = without_name(failure.reason, report.host);
    alike[failure].push_back(&report);
  }
  std::string text;
  for (const auto& [common, each] : alike) {
    const HostFailure& failure = each.size() == 1 ? *each.front()->failure : common;
    std::vector<std::string> names;
    for (const HostReport* report : each) names.push_back(report->host);
    text += fmt::format("{}: {}: {}", fold_names(names), failure.step, failure.reason);
    text += failure.remedy.empty() ? "\n" : "; " + failure.remedy + "\n";
  }
  return text;
}

}  // namespace vindu
