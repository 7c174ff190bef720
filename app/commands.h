// The sub-commands of vindu: each adds itself to the command line and, when chosen, leaves what is
// to be run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace vindu::app {

/// Runs after the command line was read; returns the exit code. Errors are thrown.
using Action = std::function<int()>;

void add_master(CLI::App& parent, Action& chosen);
void add_tile(CLI::App& parent, Action& chosen);
void add_view(CLI::App& parent, Action& chosen);
void add_render(CLI::App& parent, Action& chosen);
void add_simulate(CLI::App& parent, Action& chosen);
void add_check(CLI::App& parent, Action& chosen);
void add_doctor(CLI::App& parent, Action& chosen);
void add_wiimote(CLI::App& parent, Action& chosen);
void add_record(CLI::App& parent, Action& chosen);
void add_calibrate(CLI::App& parent, Action& chosen);
void add_replay(CLI::App& parent, Action& chosen);
void add_events(CLI::App& parent, Action& chosen);
void add_touch(CLI::App& parent, Action& chosen);
void add_track(CLI::App& parent, Action& chosen);
void add_pack(CLI::App& parent, Action& chosen);
void add_plan(CLI::App& parent, Action& chosen);
void add_measure(CLI::App& parent, Action& chosen);
void add_launch(CLI::App& parent, Action& chosen);
void add_status(CLI::App& parent, Action& chosen);
void add_show(CLI::App& parent, Action& chosen);
void add_mode(CLI::App& parent, Action& chosen);
void add_clip_command(CLI::App& parent, Action& chosen);
void add_goto(CLI::App& parent, Action& chosen);
void add_pattern(CLI::App& parent, Action& chosen);
void add_blank(CLI::App& parent, Action& chosen);
void add_overlay(CLI::App& parent, Action& chosen);
void add_capture(CLI::App& parent, Action& chosen);
void add_stop(CLI::App& parent, Action& chosen);
void add_restart(CLI::App& parent, Action& chosen);
void add_logs(CLI::App& parent, Action& chosen);
void add_deploy(CLI::App& parent, Action& chosen);
void add_keys(CLI::App& parent, Action& chosen);

}  // namespace vindu::app
