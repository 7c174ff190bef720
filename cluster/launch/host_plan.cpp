#include "cluster/launch/host_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "cluster/launch/words.h"
#include "core/error.h"

namespace vindu {
namespace {

/// What is no host name may be an option, a group or a set of hosts to ssh and clush.
void expect_host_name(const std::string& host, const std::string& where) {
  const auto allowed = [](char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '.' ||
           letter == '_';
  };
  if (host.empty() || !std::isalnum(static_cast<unsigned char>(host.front())) ||
      !std::ranges::all_of(host, allowed))
    throw Error({"\"" + host + "\" is no host name", where,
                 "use letters, digits, - _ and . ; other addresses belong into ~/.ssh/config"});
}

HostPlan& plan_of(std::vector<HostPlan>& plans, const std::string& host, const std::string& where) {
  expect_host_name(host, where);
  const auto found = std::ranges::find(plans, host, &HostPlan::host);
  if (found != plans.end()) return *found;
  return plans.emplace_back(HostPlan{.host = host});
}

std::string unit_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += " " + unit_word(word);
  return line;
}

std::string model_word(const HostRequest& request) {
  return request.model.empty() ? "" : " " + unit_word(request.model, "%h/.vindu/scene/");
}

/// In a here-document, which no line of a unit can end: all begin otherwise.
std::string write_file(const std::string& file, const std::string& text) {
  return "cat > \"$units/" + file + "\" <<'VINDU_END' || fail units 'cannot be written' " +
         "'free some space in its home'\n" + text + "VINDU_END\n";
}

std::string own_part(const std::vector<HostPlan>& hosts) {
  std::string text = "node=$(uname -n)\ncase $node in\n";
  for (const HostPlan& plan : hosts) {
    const std::string host = shell_word(plan.host);
    const std::string tiles = fmt::format("{}", fmt::join(plan.tiles, " "));
    text += fmt::format("{}|{}.*) tiles={} master={} ;;\n", host, host, shell_word(tiles),
                        plan.master ? 1 : 0);
  }
  return text +
         "*) fail name \"its own name is $node\" 'the wall file must call it by that name' ;;\n"
         "esac\n";
}

constexpr const char* kFail = R"sh(set -u
fail() {
  printf '@fail\t%s\t%s\t%s\n' "$1" "$(printf '%s' "$2" | tr '\n\t' '  ')" "$3"
  exit 1
}
)sh";

constexpr const char* kSession =
    R"sh(export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-/run/user/$(id -u)}"
session=$(systemctl --user show-environment 2>&1) || fail systemd \
  "no systemd of the user: $session" \
  'log the user in at its screen (auto-login); without a screen: loginctl enable-linger'
)sh";

std::string begin() { return std::string(kFail) + kSession; }

constexpr const char* kCheckFiles = R"sh(vindu=$HOME/.vindu/bin/vindu
[ -x "$vindu" ] || fail files 'there is no vindu' 'bring it: vindu deploy'
said=$("$vindu" --version 2>&1) || fail program "$said" \
  'install the packages that Vindu runs with (README)'
printf '%s  %s\n' "$program_sha256" "$vindu" | sha256sum --check --status ||
  fail files "its vindu ($said) is not this one" 'bring it: vindu deploy'
printf '%s  %s\n' "$wall_sha256" "$HOME/.vindu/wall.toml" | sha256sum --check --status ||
  fail files 'its wall file is not this one' 'bring it: vindu deploy'
[ -z "$model" ] || [ -e "$HOME/.vindu/scene/$model" ] ||
  fail files "there is no scene/$model" 'bring it: vindu deploy MODEL'
)sh";

// What a session of the user's at the screen told systemd, or what is found.
constexpr const char* kFindDisplay =
    R"sh(display=$(printf '%s\n' "$session" | sed -n 's/^DISPLAY=//p')
authority=$(printf '%s\n' "$session" | sed -n 's/^XAUTHORITY=//p')
for socket in /tmp/.X11-unix/X*; do
  [ -z "$display" ] && [ -S "$socket" ] && display=:${socket##*/X}
done
for file in "$XDG_RUNTIME_DIR/gdm/Xauthority" "$HOME/.Xauthority"; do
  [ -z "$authority" ] && [ -r "$file" ] && authority=$file
done
)sh";

constexpr const char* kNeedDisplay =
    R"sh([ -n "$display" ] || fail display 'nobody is logged in at its screen' \
  'set up auto-login there, or launch with --headless'
environment="\"DISPLAY=$display\""
[ -z "$authority" ] || environment="$environment \"XAUTHORITY=$authority\""
)sh";

constexpr const char* kUnits = "units=${XDG_CONFIG_HOME:-$HOME/.config}/systemd/user\n";

constexpr const char* kStart = R"sh(start() {
  systemctl --user reset-failed "$1" 2>/dev/null
  said=$(systemctl --user restart "$1" 2>&1) && return
  last=$(journalctl --user -u "$1" -n 1 -o cat 2>/dev/null)
  fail start "$1: ${last:-$said}" 'read what it says: vindu logs HOST'
}
found=0
for unit in vindu-master.service vindu-tile.service; do
  [ -e "$units/$unit" ] || continue
  found=1
  start "$unit"
done
[ "$found" = 1 ] || fail units 'nothing was launched there' 'vindu launch'
echo @done
)sh";

/// The beginning of a script for a host that has what was deployed.
std::string checked_host(const std::vector<HostPlan>& hosts, const HostRequest& request) {
  return begin() + own_part(hosts) + "program_sha256=" + shell_word(request.program_sha256) +
         " wall_sha256=" + shell_word(request.wall_sha256) + " model=" + shell_word(request.model) +
         "\n" + kCheckFiles;
}

}  // namespace

std::vector<HostPlan> host_plans(const Site& site) {
  std::vector<HostPlan> plans;
  if (!site.cluster.master.empty())
    plan_of(plans, site.cluster.master, "[cluster] master").master = true;
  for (const Tile& tile : site.wall.tiles)
    plan_of(plans, tile.host, "the host of " + tile.name).tiles.push_back(tile.name);
  return plans;
}

std::vector<std::string> names_of(const std::vector<HostPlan>& hosts) {
  std::vector<std::string> names;
  for (const HostPlan& plan : hosts) names.push_back(plan.host);
  return names;
}

std::string tile_unit(const HostRequest& request) {
  std::string text = R"sh([Unit]
Description=Vindu: the tiles of this host
PartOf=graphical-session.target
StartLimitIntervalSec=60
StartLimitBurst=20

[Service]
Type=notify
)sh";
  if (!request.headless) text += "ExecStartPre=-xset s off s noblank\nExecStartPre=-xset -dpms\n";
  text += "ExecStart=%h/.vindu/bin/vindu tile $TILES --wall %h/.vindu/wall.toml" +
          std::string(request.headless ? " --headless" : "") + unit_words(request.tile_arguments);
  return text + R"sh(
Restart=on-failure
RestartSec=200ms
RestartPreventExitStatus=2
TimeoutStartSec=30
TimeoutStopSec=5
WatchdogSec=10
)sh";
}

std::string master_unit(const HostRequest& request) {
  return R"sh([Unit]
Description=Vindu: the master
StartLimitIntervalSec=60
StartLimitBurst=20

[Service]
Type=notify
ExecStart=%h/.vindu/bin/vindu master)sh" +
         model_word(request) + " --wall %h/.vindu/wall.toml" +
         unit_words(request.master_arguments) +
         R"sh(
Restart=on-failure
RestartSec=200ms
RestartPreventExitStatus=2 3
TimeoutStartSec=60
TimeoutStopSec=5
WatchdogSec=10
)sh";
}

std::string start_script(const std::vector<HostPlan>& hosts, const HostRequest& request) {
  std::string text = checked_host(hosts, request);
  text += "environment=\n";
  if (!request.headless)
    text += "if [ -n \"$tiles\" ]; then\n" + std::string(kFindDisplay) + kNeedDisplay + "fi\n";
  text += std::string(kUnits) +
          "mkdir -p \"$units/vindu-tile.service.d\" ||\n"
          "  fail units 'cannot be written' 'free some space in its home'\n";
  text += "rm -f \"$units/vindu-master.service\" \"$units/vindu-tile.service\"\n";
  text += "if [ \"$master\" = 1 ]; then\n" + write_file(kMasterUnit, master_unit(request)) + "fi\n";
  text += "if [ -n \"$tiles\" ]; then\n" + write_file(kTileUnit, tile_unit(request)) + "fi\n";
  text +=
      "printf '[Service]\\nEnvironment=%s\\n' \"\\\"TILES=$tiles\\\" $environment\" \\\n"
      "  > \"$units/vindu-tile.service.d/host.conf\"\n";
  return text + "systemctl --user daemon-reload || fail units 'systemd does not read them' ''\n" +
         kStart;
}

std::string doctor_script(const std::vector<HostPlan>& hosts, const HostRequest& request) {
  return checked_host(hosts, request) + kFindDisplay +
         "[ -z \"$display\" ] || export DISPLAY=\"$display\"\n"
         "[ -z \"$authority\" ] || export XAUTHORITY=\"$authority\"\n"
         "\"$vindu\" doctor --wall \"$HOME/.vindu/wall.toml\" 2>&1\n"
         "code=$?\n"
         "[ $code -le 1 ] || fail doctor \"it ended with $code\" 'run it there: vindu doctor'\n"
         "echo @done\n";
}

std::string stop_script() {
  return begin() +
         "said=$(systemctl --user stop vindu-tile.service vindu-master.service 2>&1)\n"
         "for unit in vindu-tile vindu-master; do\n"
         "  ! systemctl --user is-active --quiet $unit || fail stop \"$said\" "
         "'try again; it is killed after 5 s'\n"
         "done\necho @done\n";
}

std::string restart_script() { return begin() + kUnits + kStart; }

std::string log_script(int lines) {
  return begin() +
         fmt::format(
             "journalctl --user -u vindu-tile -u vindu-master -n {} --no-pager -o short-iso\n"
             "echo @done\n",
             lines);
}

// A tile's runtime folder is its session's, which an ssh session need not know of.
std::string kept_script(const std::vector<HostPlan>& hosts, const std::string& folder,
                        const std::string& prefix, int seconds) {
  return kFail + own_part(hosts) + "folder=" + shell_word(folder) +
         " prefix=" + shell_word(prefix) + fmt::format(" tries={}\n", 10 * seconds) + R"sh(
found() {
  for runtime in "${XDG_RUNTIME_DIR:-}" "/run/user/$(id -u)" "/tmp/vindu-$(id -u)"; do
    file=$runtime/$folder/$prefix$1.png
    [ -f "$file" ] && printf '%s\n' "$file" && return
  done
  return 1
}
for tile in $tiles; do
  until found "$tile" || [ $tries -le 0 ]; do
    tries=$((tries - 1))
    sleep 0.1
  done
done
echo @done
)sh";
}

std::string slurm_script(const std::vector<HostPlan>& hosts, const HostRequest& request) {
  std::string step = "case $SLURMD_NODENAME in\n";
  for (const HostPlan& plan : hosts)
    step +=
        fmt::format("{}) tiles={} master={} ;;\n", shell_word(plan.host),
                    shell_word(fmt::format("{}", fmt::join(plan.tiles, " "))), plan.master ? 1 : 0);
  step += R"sh(esac
run() { until "$@"; do case $? in 2|3) return 2 ;; esac; sleep 0.2; done; }
vindu=$HOME/.vindu/bin/vindu wall=$HOME/.vindu/wall.toml
)sh";
  if (!request.headless) step += "export DISPLAY=\"${DISPLAY:-:0}\"\n";
  const std::string model =
      request.model.empty() ? "" : " \"$HOME/.vindu/scene/\"" + shell_word(request.model);
  step += "[ \"$master\" = 0 ] || run \"$vindu\" master" + model + " --wall \"$wall\" " +
          shell_words(request.master_arguments) + " &\n";
  step += "[ -z \"$tiles\" ] || run \"$vindu\" tile $tiles --wall \"$wall\" " +
          std::string(request.headless ? "--headless " : "") + shell_words(request.tile_arguments) +
          " &\n";
  return "exec srun --label --no-kill --kill-on-bad-exit=0 sh -c " + shell_word(step + "wait\n") +
         "\n";
}

}  // namespace vindu
