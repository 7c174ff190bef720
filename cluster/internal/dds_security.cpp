#include "cluster/internal/dds_security.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/log.h"

namespace vindu::internal {
namespace {

namespace fs = std::filesystem;

/// Cyclone's plugins lie beside its library, in a folder whose name distributions choose (Debian:
/// libddsc0debian).
std::string plugin_path(const std::string& name) {
  Dl_info cyclone{};
  const void* const inside = reinterpret_cast<const void*>(&dds_create_participant);
  if (dladdr(inside, &cyclone) == 0) return {};
  const fs::path folder = fs::path(cyclone.dli_fname).parent_path();
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().filename().string().starts_with("libddsc") &&
        fs::exists(it->path() / name, error))
      return it->path() / name;
  throw Error({"the wall has keys, but Cyclone's security plugins are not there",
               (folder / "libddsc*" / name).string(), "apt-get install libddsc0debian"});
}

struct Kinds {
  std::atomic<bool> with_keys = false;
  std::mutex mutex;
  std::map<std::pair<std::string_view, std::uint32_t>, unsigned> counts;  // by place in its source
};

void hear_dds(void* argument, const dds_log_data_t* line) {
  Kinds& kinds = *static_cast<Kinds*>(argument);
  std::string text(line->message);
  if (text.starts_with("Remote secure participant")) {
    // Of friends, too, whom a process with keys hears of before it has joined itself.
    if (kinds.with_keys) return;
    text = "somebody with a key was refused: this process has none ([cluster] keys)";
  }
  unsigned count = 0;
  {
    const std::scoped_lock lock(kinds.mutex);
    count = ++kinds.counts[{line->function ? line->function : "", line->line}];
  }
  if (!std::has_single_bit(count)) return;
  std::ranges::replace(text, '\n', ' ');  // whatever comes of the wire: one line
  while (text.ends_with(' ')) text.pop_back();
  if (count > 1) text += " (" + std::to_string(count) + " of this kind so far)";
  log_warning("network", text);
}

}  // namespace

void add_credentials(dds_qos_t* participant, const Credentials& credentials) {
  const auto set = [participant](const char* name, const std::string& value) {
    dds_qset_prop(participant, name, value.c_str());
  };
  const auto plugin = [&set](const std::string& kind, const char* file, const char* what) {
    set(("dds.sec." + kind + ".library.path").c_str(), plugin_path(file));
    set(("dds.sec." + kind + ".library.init").c_str(), std::string("init_") + what);
    set(("dds.sec." + kind + ".library.finalize").c_str(), std::string("finalize_") + what);
  };
  plugin("auth", "libdds_security_auth.so", "authentication");
  plugin("access", "libdds_security_ac.so", "access_control");
  plugin("crypto", "libdds_security_crypto.so", "crypto");
  const std::string data = "data:,";
  set("dds.sec.auth.identity_ca", data + credentials.identity_ca);
  set("dds.sec.auth.identity_certificate", data + credentials.certificate);
  set("dds.sec.auth.private_key", data + credentials.private_key);
  set("org.eclipse.cyclonedds.sec.auth.crl", data + credentials.revoked);
  set("dds.sec.access.permissions_ca", data + credentials.permissions_ca);
  set("dds.sec.access.governance", data + credentials.governance);
  set("dds.sec.access.permissions", data + credentials.permissions);
}

void log_what_dds_says(bool with_keys) {
  // One for the process, as Cyclone's sink is, and never destroyed: its threads may end later.
  static Kinds* const kinds = new Kinds;
  if (with_keys) kinds->with_keys = true;
  dds_set_log_sink(&hear_dds, kinds);
}

}  // namespace vindu::internal
