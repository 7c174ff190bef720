// The same done on many hosts at once, over ssh by ClusterShell, and what became of it on each:
// one that fails says at which step, why, and what to do, and the others go on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vindu {

struct HostFailure {
  std::string step;  ///< "ssh", "files", "display", "start"
  std::string reason;
  std::string remedy;

  auto operator<=>(const HostFailure&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct HostReport {
  std::string host{};
  std::optional<HostFailure> failure{};  ///< empty: done
  std::vector<std::string> lines{};      ///< what it printed besides
};

/// What a program printed until its end.
struct ProgramResult {
  int exit_code = 0;  ///< 127: it is not there; 128 + the signal that ended it
  std::vector<std::string> out, err;
};

/// Runs it, with no shell; Ctrl-C ends it and throws Error.
ProgramResult run_program(const std::vector<std::string>& words);

/// "clush ... COMMAND", which runs the script on the hosts.
std::vector<std::string> clush_words(const std::vector<std::string>& hosts,
                                     const std::string& script);

/// The script says "@done", or "@fail", step, reason and remedy with tabs between; both at the
/// beginning of a line. Throws Error where there is no clush.
std::vector<HostReport> on_hosts(const std::vector<std::string>& hosts, const std::string& script);

/// The same from clush's lines, "HOST: TEXT".
std::vector<HostReport> reports_from(const std::vector<std::string>& hosts,
                                     const ProgramResult& clush);

/// A host, and the folders whose content it is to have.
struct HostFiles {
  std::string host;
  std::vector<std::string> folders;
};

/// Copies them to ~/.vindu of each host by rsync over ssh, all hosts at once; links are followed,
/// and other files there stay.
std::vector<HostReport> copy_to_hosts(const std::vector<HostFiles>& hosts);
std::vector<std::string> rsync_words(const HostFiles& files);

/// Files of a host, by absolute paths.
struct HostPaths {
  std::string host;
  std::vector<std::string> files;
};

/// The other way: copies them into a folder here, all hosts at once.
std::vector<HostReport> copy_from_hosts(const std::vector<HostPaths>& hosts,
                                        const std::string& folder);
std::vector<std::string> rsync_words(const HostPaths& paths, const std::string& folder);

/// A line for each kind of failure: "tile-[0-3]-0: ssh: reason; remedy". Empty when all is well.
std::string failures_of(const std::vector<HostReport>& reports);

}  // namespace vindu
