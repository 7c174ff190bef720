// Texts as words of other languages: a POSIX shell's, a systemd unit's. Every path, name and
// argument that reaches one of them goes through here.
#pragma once

#include <string>
#include <vector>

namespace vindu {

/// One word for a POSIX shell, whatever is in it; quoted only where needed. Throws Error for a text
/// with a zero byte.
std::string shell_word(const std::string& text);
std::string shell_words(const std::vector<std::string>& words);

/// One word of ExecStart= of a systemd unit (systemd.service(5), "Command lines"). `prefix`, as
/// "%h/", stands before it as it is. Throws Error for a zero byte.
std::string unit_word(const std::string& text, const std::string& prefix = "");

/// A command line that any login shell of a host takes, and that runs the POSIX shell script.
std::string command_for_hosts(const std::string& script);

}  // namespace vindu
