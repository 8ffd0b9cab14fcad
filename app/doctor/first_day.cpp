#include "app/doctor/first_day.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "app/cli/interruption.h"
#include "app/cli/this_program.h"
#include "app/doctor/first_day_steps.h"
#include "app/doctor/rig_page_html.h"
#include "app/inputs/protocol_file.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/folder_lock.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

namespace fs = std::filesystem;

Protocol protocol_of(const FirstDayOptions& options) {
    Protocol protocol = read_protocol_or_report(options.protocol);
    if (!options.tracker.empty()) {
        protocol.tracker.kind = tracker_kind_called(options.tracker);
        protocol.further_trackers.clear();
    }
    if (!options.tracker_address.empty())
        protocol.tracker.address = options.tracker_address;
    return protocol;
}

bool is_among(const std::vector<std::string>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// Those of the protocol's facts that a step depends on.
RigFacts facts_for(const FirstDayStep& step, const RigFacts& all) {
    RigFacts facts;
    for (const RigFact& fact : all)
        if (("," + std::string(step.depends_on) + ",").find(fact.what + ",") != std::string::npos)
            facts.push_back(fact);
    return facts;
}

/// The page as it is on disk, JSON and HTML; a page of another day stays beside it under its date.
class KeptDay {
  public:
    KeptDay(fs::path folder, RigPage page) : folder_(std::move(folder)), page_(std::move(page)) {}
    RigPage& page() { return page_; }
    fs::path html_file() const { return folder_ / "rig.html"; }
    void keep() const {
        fs::create_directories(folder_);
        write_whole_file(rig_page_file(folder_), to_json_text(page_));
        write_whole_file(html_file(), rig_page_html(page_));
    }

  private:
    fs::path folder_;
    RigPage page_;
};

RigPage new_page(const Protocol& protocol) {
    const ProgramBuild build = this_build();
    RigPage page{utc_now(), protocol.name, fmt::format("overt {} {}", build.version, build.commit), {}};
    for (const FirstDayStep& step : first_day_steps()) {
        page.steps.emplace_back();
        page.steps.back().name = step.name;
    }
    return page;
}

/// An earlier day's files get its date into their names.
void put_aside(const fs::path& folder, const RigPage& page) {
    std::string date = page.begun_utc;
    std::erase(date, ':');
    for (const char* const ending : {".json", ".html"}) {
        std::error_code none;
        fs::rename(folder / (std::string("rig") + ending), folder / fmt::format("rig_{}{}", date, ending),
                   none);
    }
}

/// The day that goes on, or a new one.
RigPage page_to_go_on_with(const FirstDayOptions& options, const Protocol& protocol, const fs::path& folder) {
    std::optional<KeptRigPage> kept = read_rig_page(folder);
    if (kept && options.anew) {
        put_aside(folder, kept->page);
        kept.reset();
    }
    if (!kept)
        return new_page(protocol);
    RigPage page = new_page(protocol);
    page.begun_utc = kept->page.begun_utc;
    page.program = kept->page.program;
    const RigFacts now = facts_of_protocol(protocol);
    for (RigStep& step : page.steps)
        for (const RigStep& done : kept->page.steps)
            if (done.name == step.name) {
                step = done;
                const std::vector<std::string> changed = differences_between(done.facts, now);
                if (done.verdict == StepVerdict::open || changed.empty())
                    continue;
                step.verdict = StepVerdict::open;
                step.finding = fmt::format("It was measured on another rig: {}.", fmt::join(changed, "; "));
                step.remedy = "measure it again";
            }
    return page;
}

enum class Answer { begin, leave_open, end };

/// At a terminal; elsewhere a step begins at once.
Answer ask_before(const FirstDayStep& step, bool asks) {
    if (!asks || isatty(STDIN_FILENO) == 0)
        return Answer::begin;
    for (;;) {
        fmt::print("Enter: begin   s: leave it open   q: go on another day > ");
        std::fflush(stdout);
        std::string line;
        if (!std::getline(std::cin, line) || line == "q")
            return Answer::end;
        if (line.empty())
            return Answer::begin;
        if (line == "s") {
            fmt::print("{} stays open\n", step.name);
            return Answer::leave_open;
        }
    }
}

/// Devices that are not there prove nothing, and refusals are failures.
RigStep measured(const FirstDayStep& step, const FirstDay& day) {
    try {
        return step.measure(day);
    } catch (const InputError& error) {
        RigStep failed = not_proved(error.what(), "mend what is said, and repeat this step");
        failed.verdict = StepVerdict::failed;
        return failed;
    } catch (const Error& error) {
        return not_proved(error.what(), "see that the device is there and switched on, and repeat this step");
    }
}

void print_step(const RigStep& step) {
    fmt::print("{:<10} {}{}: {}\n", step.name, name_of(step.verdict), step.is_simulated ? " (simulated)" : "",
               step.finding);
    for (const BenchFigure& figure : step.figures)
        if (figure.holds && !*figure.holds)
            fmt::print("{:<10} {} is {:.6g} {}, and has to be {}\n", "", figure.figure, figure.value,
                       figure.unit, figure.target);
    if (!step.remedy.empty())
        fmt::print("{:<10} to do: {}\n", "", step.remedy);
}

void print_sums(const RigPage& page) {
    std::vector<std::string> sums;
    for (const StepVerdict verdict :
         {StepVerdict::proved, StepVerdict::failed, StepVerdict::not_proved, StepVerdict::open})
        if (const auto count = std::ranges::count(page.steps, verdict, &RigStep::verdict); count > 0)
            sums.push_back(fmt::format("{} {}", count, name_of(verdict)));
    fmt::print("\nof {}: {}\n", counted(page.steps.size(), "step"), fmt::join(sums, ", "));
}

/// While this lives what is printed goes to the standard error, so that a page for programs stands alone.
class SaidBeside {
  public:
    explicit SaidBeside(bool is_wanted) {
        if (!is_wanted)
            return;
        std::fflush(stdout);
        output_ = dup(STDOUT_FILENO);
        if (output_ >= 0)
            dup2(STDERR_FILENO, STDOUT_FILENO);
    }
    ~SaidBeside() {
        if (output_ < 0)
            return;
        std::fflush(stdout);
        dup2(output_, STDOUT_FILENO);
        close(output_);
    }
    SaidBeside(const SaidBeside&) = delete;
    SaidBeside& operator=(const SaidBeside&) = delete;

  private:
    int output_ = -1;
};

} // namespace

int run_first_day(const FirstDayOptions& options) {
    if (options.protocol.empty())
        throw InputError(
            "--first-day needs the protocol that the rig is for, whose screen, mode, eye tracker, "
            "boxes and outputs are measured: overt doctor PROTOCOL --first-day");
    const Protocol protocol = protocol_of(options);
    const fs::path folder = rig_folder();
    fs::create_directories(folder);
    const FolderLock lock(folder, FolderLock::Patience::none);
    if (lock.is_refused())
        throw InputError("another overt doctor --first-day is running on this machine");
    KeptDay day(folder, page_to_go_on_with(options, protocol, folder));
    day.keep();
    if (day.page().is_finished() && options.steps.empty() && !options.json)
        fmt::print("the first day of {} is finished: --step STEP measures one again, --anew begins another\n",
                   day.page().begun_utc);
    const RigFacts facts = facts_of_protocol(protocol);
    bool is_ended = false, is_broken_off = false;
    for (const FirstDayStep& step : first_day_steps()) {
        RigStep& kept = *std::ranges::find(day.page().steps, step.name, &RigStep::name);
        const bool is_wanted =
            options.steps.empty() ? kept.verdict == StepVerdict::open : is_among(options.steps, step.name);
        if (!is_wanted || is_ended || is_among(options.skip, step.name))
            continue;
        if (!options.json) {
            fmt::print("\n== {}: {} (about {})\n{}\n", step.name, step.title,
                       counted(static_cast<std::size_t>(step.minutes), "minute"), step.needs);
            std::fflush(stdout); // a step takes minutes
            const Answer answer = ask_before(step, options.asks);
            is_ended = answer == Answer::end;
            if (answer != Answer::begin)
                continue;
        }
        RigStep found = [&] {
            const SaidBeside beside(options.json);
            return measured(step, {options, protocol, folder, day.page()});
        }();
        // What was broken off has measured nothing that could be kept.
        if (Interruption::requested()) {
            is_ended = is_broken_off = true;
            if (!options.json)
                fmt::print("\n{} was broken off, and stays as it was\n", step.name);
            continue;
        }
        found.name = step.name;
        found.measured_utc = utc_now();
        RigFacts all = facts_for(step, facts);
        all.insert(all.end(), found.facts.begin(), found.facts.end());
        found.facts = std::move(all);
        kept = std::move(found);
        day.keep();
        if (!options.json)
            print_step(kept);
    }
    if (options.json) {
        fmt::print("{}", to_json_text(day.page()));
    } else {
        print_sums(day.page());
        fmt::print("{}page: {}\n",
                   day.page().is_finished() ? "" : "steps are open: the same command goes on with them\n",
                   day.html_file().string());
    }
    const bool has_failed = std::ranges::any_of(
        day.page().steps, [](const RigStep& step) { return step.verdict == StepVerdict::failed; });
    return has_failed || is_broken_off ? 1 : 0;
}

} // namespace overt
