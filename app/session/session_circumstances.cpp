#include "app/session/session_circumstances.h"

#include <cmath>

#include <fmt/format.h>

#include "app/cli/progress_bar.h"
#include "app/cli/terminal_output.h"
#include "app/rig/output_verification.h"
#include "app/rig/rig_page.h"
#include "app/session/session_messages.h"
#include "devices/tracker/sample_rate_watch.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/session_faults.h"

namespace overt {

void check_timing(Rig& rig, double seconds) {
    ProgressBar bar;
    const std::vector<ScreenFinding> findings = rig.check_timing(
        seconds, [&](int done, int total) { bar.update("measuring the screen's refresh, s", done, total); });
    bar.finish();
    for (const ScreenFinding& finding : findings)
        if (finding.what == "measured refresh" || finding.what == "vertical blank")
            fmt::print("{}: {}\n", finding.what, finding.finding);
    say_risks(findings);
}

void note_faults(const std::filesystem::path& file, const Clock& clock, SessionLog& log) {
    if (file.empty())
        return;
    const std::string text = read_whole_file(file);
    const SimulatedSides sides = simulated_sides(text);
    if (sides.display)
        log.event({clock.now(), -1, simulated_faults_event, text});
    if (sides.eye_tracker)
        log.event({clock.now(), -1, simulated_tracker_faults_event, text});
    fmt::print("with the simulated faults of {}\n", file.string());
}

void note_rig_page(const std::filesystem::path& folder, const RigFacts& rig, const Clock& clock,
                   SessionLog& log) {
    std::string sentence;
    try {
        sentence = sentence_of(read_rig_page(folder), rig);
    } catch (const Error& error) {
        sentence = fmt::format("cannot be read: {}", error.what());
    }
    log.event({clock.now(), -1, rig_page_event, sentence});
    fmt::print(stderr, "page of this rig: {}\n", sentence);
}

void note_thread(const std::vector<ThreadWish>& wishes, const Clock& clock, SessionLog& log) {
    for (const ThreadWish& wish : wishes) {
        const std::string answer =
            fmt::format("{}: {}{}", wish.what, wish.granted ? "" : "refused: ", wish.detail);
        log.event({clock.now(), -1, thread_event, answer});
        fmt::print(wish.granted ? stdout : stderr, "{}\n", answer);
    }
}

void note_circumstances(const RunOptions& options, const Protocol& protocol, const Schedule& schedule,
                        Rig& rig, SessionLog& log) {
    for (const ScreenFinding& finding : rig.screen_findings())
        log.event(
            {rig.clock().now(), -1, screen_event, fmt::format("{}: {}", finding.what, finding.finding)});
    if (!options.draws_stimuli)
        log.event({rig.clock().now(), -1, screen_event,
                   "stimuli: not drawn (--no-pictures), for nobody saw them; gaze and times do not depend on "
                   "pictures"});
    if (options.verify_output) {
        ProgressBar bar;
        record_verification(rig.page_presenters(), rig.library(), protocol, schedule, rig.clock(), log,
                            [&](int done, int total) { bar.update("verifying the output", done, total); });
    }
}

namespace {

/// "eye tracker", or which of several.
std::string name_of(const RecordedTracker& recorded) {
    return recorded.id.empty() ? "eye tracker" : "eye tracker " + recorded.id;
}

} // namespace

void note_tracker(const RecordedTracker& recorded, const Clock& clock) {
    if (!recorded.tracker.measures_gaze())
        return;
    recorded.tracker.belongs_in(recorded.folder.string());
    const TrackerDescription tracker = recorded.tracker.description();
    if (!tracker.model.empty())
        fmt::print("{}: {}\n", name_of(recorded), tracker.model);
    const auto note = [&](const std::string& what) {
        recorded.store.event({clock.now(), -1, tracker_event, what});
    };
    note(fmt::format("{}{}{}: {:.6g} Hz, {}", tracker.name, tracker.model.empty() ? "" : ", ", tracker.model,
                     tracker.sample_rate_hz,
                     tracker.both_eyes          ? "both eyes"
                     : tracker.eye == Eye::left ? "left eye"
                                                : "right eye"));
    const auto warn = [&](const std::string& of_the_rate) {
        note(of_the_rate);
        fmt::print(stderr, "the {} {}\n", name_of(recorded), of_the_rate);
    };
    const bool is_measured = tracker.told_rate_hz > 0.0;
    if (is_measured && !is_same_rate(tracker.sample_rate_hz, tracker.told_rate_hz))
        warn(fmt::format(
            "sends {:.5g} samples a second where it says {:g} Hz: tables and exports go by what came",
            tracker.sample_rate_hz, tracker.told_rate_hz));
    const double wished_hz = recorded.wish.rate_hz;
    const bool is_as_wished = is_measured ? is_same_rate(tracker.sample_rate_hz, wished_hz)
                                          : std::abs(tracker.sample_rate_hz - wished_hz) <= 1e-3 * wished_hz;
    if (!is_as_wished && tracker.sample_rate_hz > 0.0)
        warn(fmt::format("samples at {:.5g} Hz where the protocol wishes {:g} Hz", tracker.sample_rate_hz,
                         wished_hz));
}

void end_tracker(const RecordedTracker& recorded, const Clock& clock) {
    ProgressBar bar;
    const std::vector<std::string> said =
        recorded.tracker.finish(recorded.folder.string(), [&](std::int64_t done, std::int64_t total) {
            bar.update("fetching the eye tracker's file, kB", static_cast<int>(done / 1000),
                       static_cast<int>(std::max(done, total) / 1000));
        });
    bar.finish();
    for (const std::string& sentence : said) {
        recorded.store.event({clock.now(), -1, tracker_event, sentence});
        fmt::print("{}: {}\n", name_of(recorded), sentence);
    }
}

void rescue_tracker_file(const RecordedTracker& recorded) {
    for (const std::string& sentence :
         recorded.tracker.finish(recorded.folder.string(), [](std::int64_t, std::int64_t) {}))
        fmt::print(stderr, "{}: {}\n", name_of(recorded), sentence);
}

} // namespace overt
