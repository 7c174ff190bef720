#include "app/asked_file.h"

#include <fmt/format.h>

#include <cassert>
#include <filesystem>
#include <utility>

#include "app/runtime_folder.h"
#include "core/error.h"
#include "core/log.h"
#include "core/new_file.h"

namespace vindu::app {

namespace fs = std::filesystem;

void note(const CommandMessage& command, Asked& asked) {
  const std::string& word = command.argument;
  if (command.verb == Verb::pattern) {
    const auto pattern = pattern_from(word);
    if (!pattern)
      throw Error({"there is no pattern " + word, "pattern",
                   fmt::format("choose one of {}", fmt::join(pattern_names(), ", "))});
    asked.pattern = *pattern;
    return;
  }
  assert(command.verb == Verb::overlay || command.verb == Verb::blank);
  if (word != "on" && word != "off")
    throw Error({"is neither on nor off: \"" + word + "\"",
                 command.verb == Verb::blank ? "blank" : "overlay", "say on or off"});
  (command.verb == Verb::blank ? asked.blank : asked.overlay) = word == "on";
}

std::string AskedFile::path() const { return runtime_folder(cluster_) + "/asked.toml"; }

std::optional<Asked> AskedFile::take() {
  if (session_.empty()) return std::nullopt;
  std::string file;
  try {
    file = path();
  } catch (const std::exception&) {
    return std::nullopt;  // keep() says why
  }
  try {
    if (!fs::exists(file)) return std::nullopt;
    std::optional<Asked> asked = read_asked(file, session_);
    if (asked) fs::remove(file);
    return asked;
  } catch (const std::exception& error) {
    log_warning("master", std::string("what was asked for before is not known: ") + error.what());
    remove();
    return std::nullopt;
  }
}

void AskedFile::keep(const Asked& asked) {
  if (session_.empty()) return;
  try {
    const std::string remedy = "is XDG_RUNTIME_DIR still there, with space?";
    NewFile fresh(path());
    fresh.write(text_of(asked, session_), remedy);
    fresh.place(remedy);
  } catch (const std::exception& error) {
    if (!std::exchange(warned_, true))
      log_warning("master", std::string("would not know after a crash what it was asked for: ") +
                                error.what());
  }
}

void AskedFile::remove() {
  if (session_.empty()) return;
  try {
    fs::remove(path());
  } catch (const std::exception&) {
    // then it was not kept, and was warned of
  }
}

}  // namespace vindu::app
