#include "cluster/launch/supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vindu {
namespace {

using std::chrono::milliseconds;

constexpr int kCalledWrong = 2, kInVain = 3;  // exit codes: to start it again would be of no use
constexpr auto kTurn = milliseconds(200);
constexpr auto kStopPatience = std::chrono::seconds(3);

Time now_() { return std::chrono::steady_clock::now(); }

}  // namespace

Supervisor::Supervisor(std::vector<ProcessPlan> plans, Output output, const RestartPolicy& policy)
    : output_(std::move(output)),
      patience_(policy.patience),
      first_patience_(policy.first_patience),
      turned_(now_()) {
  for (ProcessPlan& plan : plans) {
    const std::string name = plan.name;
    processes_.emplace(name, Process{std::move(plan), Restarts(policy), {}, now_(), Time::max()});
  }
}

bool Supervisor::run() {
  Outcome outcome = Outcome::running;
  while (outcome == Outcome::running) {
    start_due(now_());
    const ChildNews news = children_.wait(next_start(now_()));
    print(news);
    end_who_hangs(news, now_());
    for (const ChildEnd& end : news.ends)
      if (outcome == Outcome::running) outcome = consider(end);
    if (news.stop) outcome = Outcome::good;
    output_.idle(restarts());
  }
  stop();
  return outcome == Outcome::good;
}

int Supervisor::restarts() const {
  int count = 0;
  for (const auto& [name, process] : processes_) count += process.restarts.count();
  return count;
}

void Supervisor::start_due(Time now) {
  for (auto& [name, process] : processes_) {
    if (!process.due || *process.due > now) continue;
    process.due.reset();
    process.started = now;
    process.alive_until = now + first_patience_;
    children_.start(name, process.plan.words);
  }
}

Time Supervisor::next_start(Time now) const {
  Time next = now + kTurn;
  for (const auto& [name, process] : processes_)
    if (process.due) next = std::min(next, *process.due);
  return next;
}

void Supervisor::print(const ChildNews& news) {
  for (const ChildLine& line : news.lines) {
    if (line.result && processes_.at(line.name).plan.leads)
      output_.result(line.text);
    else
      output_.log(line.name, line.text);
  }
}

void Supervisor::end_who_hangs(const ChildNews& news, Time now) {
  const Duration away = now - std::exchange(turned_, now);
  for (const std::string& name : news.alive) processes_.at(name).alive_until = now + patience_;
  for (auto& [name, process] : processes_) {
    if (process.alive_until == Time::max()) continue;
    if (away > std::chrono::seconds(1))
      process.alive_until += away;  // it was this process that hung
    if (now <= process.alive_until || !children_.has(name)) continue;
    output_.trouble(name, "hangs: it says nothing any more; it is ended");
    process.alive_until = Time::max();
    children_.kill_one(name);
  }
}

Supervisor::Outcome Supervisor::consider(const ChildEnd& end) {
  Process& process = processes_.at(end.name);
  if (end.signal == 0 && end.exit_code == 0)
    return process.plan.leads ? Outcome::good : outcome_without_followers();
  const bool in_vain =
      end.exit_code == kCalledWrong || end.exit_code == kInVain || end.exit_code == kNotStarted;
  const bool ran_well_before = process.restarts.count() > 0;
  if (process.plan.leads && end.signal == 0 && (in_vain || !ran_well_before)) {
    output_.trouble(end.name, text_of(end) + "; the wall is stopped");
    return Outcome::bad;
  }
  if (in_vain) return give_up(process, text_of(end));
  const Time now = now_();
  const auto delay = process.restarts.after_death(now - process.started);
  if (!delay) return give_up(process, text_of(end) + " again and again");
  process.due = now + *delay;
  output_.trouble(end.name,
                  fmt::format("{}; it starts again in {:.1f} s", text_of(end), seconds(*delay)));
  return Outcome::running;
}

Supervisor::Outcome Supervisor::give_up(Process& process, const std::string& why) {
  given_up_.push_back(process.plan.name);
  output_.trouble(process.plan.name, why + "; given up: see its lines above");
  return process.plan.leads ? Outcome::bad : outcome_without_followers();
}

/// A wall without tiles has ended, well or not.
Supervisor::Outcome Supervisor::outcome_without_followers() const {
  const auto lives = [this](const auto& entry) {
    const Process& process = entry.second;
    return !process.plan.leads && (process.due || children_.has(entry.first));
  };
  if (std::ranges::any_of(processes_, lives)) return Outcome::running;
  return given_up_.empty() ? Outcome::good : Outcome::bad;
}

/// By SIGTERM; at once after another Ctrl-C or when they take too long.
void Supervisor::stop() {
  const Time limit = now_() + kStopPatience;
  children_.signal_all(SIGTERM);
  while (!children_.empty() && now_() < limit) {
    const ChildNews news = children_.wait(limit);
    print(news);
    if (news.stop) break;
  }
}

}  // namespace vindu
