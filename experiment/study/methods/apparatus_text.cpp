#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"
#include "experiment/study/methods/tracker_words.h"

namespace overt {

namespace {

std::string display_clause(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    std::vector<std::string> known, unknown;
    const auto add = [&](bool is_known, std::string words, const char* what) {
        if (is_known)
            known.push_back(std::move(words));
        else
            unknown.emplace_back(what);
    };
    add(display.screen_px.x > 0, fmt::format("had {} x {} pixels", display.screen_px.x, display.screen_px.y),
        "its resolution");
    add(display.screen_mm.x > 0.0,
        fmt::format("was {} x {} mm large", as_set(display.screen_mm.x), as_set(display.screen_mm.y)),
        "its size");
    add(display.refresh_hz > 0.0, fmt::format("was refreshed at {} Hz", as_set(display.refresh_hz)),
        "its refresh rate");
    add(display.viewing_distance_mm > 0.0,
        fmt::format("was seen from {} mm", as_set(display.viewing_distance_mm)), "the viewing distance");
    std::string clause;
    const char* const which = display.is_simulated ? "the display, which was simulated," : "the display";
    if (!known.empty())
        clause = fmt::format("{} {}", which, joined_words(known));
    if (display.px_per_deg)
        clause += fmt::format(", so that {} pixels in its middle were 1 deg of visual angle",
                              as_measured(*display.px_per_deg, 1));
    if (!unknown.empty())
        clause += fmt::format("{}{} {} not on record{}", clause.empty() ? "of the display " : "; ",
                              joined_words(unknown), unknown.size() == 1 ? "is" : "are",
                              display.px_per_deg ? "" : ", so that degrees of visual angle are not known");
    return clause;
}

/// Of pictures that were lit by this program.
bool lit_pictures(const StudySession& session) {
    return !session.setup.display.is_simulated && session.setup.gaze.origin != GazeOrigin::imported;
}

std::string light_clause(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    if (!lit_pictures(session) && !session.setup.presenter)
        return {};
    if (!display.light)
        return "the luminance of the display is not on record";
    return fmt::format("the white of the display had {} cd/m2, measured with {} on {}",
                       as_measured(display.light->white_cd_m2, 2), display.light->instrument,
                       display.light->date);
}

std::string timing_clause(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    if (session.setup.presenter)
        return fmt::format(
            "when pictures were lit is what the imported log and the protocol say: how many refreshes "
            "were missed is not known, and light is taken to have come {} ms after an onset{}",
            as_set(display.latency_ms),
            display.latency_ms == 0.0 ? ", since nobody knows how long it took" : "");
    if (!lit_pictures(session))
        return {};
    // Nobody measures exactly 0.
    const std::string delay =
        display.latency_ms != 0.0
            ? fmt::format("light came {} ms after the vertical blank", as_set(display.latency_ms))
            : "how long after the vertical blank light comes was not measured";
    if (display.timing == "proven")
        return delay + ", and the times of pictures are proven by the display's vertical blanks";
    if (display.timing == "unproven")
        return delay + ", and nothing proves when pictures were lit";
    return delay + ", and what proves the times of pictures is not on record";
}

std::string stereo_clause(const StudySession& session) {
    const DisplaySetup& display = session.setup.display;
    if (display.stereo.empty())
        return {};
    return fmt::format("each eye saw a picture of its own, {}, from eyes {} mm apart, and its gaze is "
                       "looked up in that picture; the screen is an eye's field of it",
                       display.stereo == "mirrors" ? "side by side through a stereoscope"
                                                   : "in turn through shutters",
                       as_set(display.interocular_mm));
}

std::string rate_words(const GazeSetup& gaze) {
    return gaze.rate_hz > 0.0 ? fmt::format("at {} Hz", as_set(gaze.rate_hz))
                              : "at a rate that is not on record";
}

std::string gaze_clause(const StudySession& session) {
    const GazeSetup& gaze = session.setup.gaze;
    // "gaze of both eyes, of which the left is analysed, was …"
    const std::string of_eyes = fmt::format("gaze of {}{} was", eyes_words(gaze), gaze.both_eyes ? "," : "");
    switch (gaze.origin) {
    case GazeOrigin::measured:
        return fmt::format("{} measured {} with an eye tracker, {}", of_eyes, rate_words(gaze),
                           tracker_words(gaze));
    case GazeOrigin::imported:
        if (gaze.was_simulated)
            return fmt::format("{} imported from a recording, {}, of simulated gaze", of_eyes,
                               rate_words(gaze));
        return fmt::format("{} imported from a recording, {}, of an eye tracker, {}", of_eyes,
                           rate_words(gaze), tracker_words(gaze));
    case GazeOrigin::simulated:
        return fmt::format("{} simulated {}", of_eyes, rate_words(gaze));
    case GazeOrigin::played_back:
        return fmt::format("no eye was measured: {} played back from a recording {}{}", of_eyes,
                           rate_words(gaze), gaze.model.empty() ? "" : fmt::format(" ({})", gaze.model));
    case GazeOrigin::pointer:
        return fmt::format("no eye was measured, and the mouse pointer stood in for it{}",
                           gaze.rate_hz > 0.0 ? fmt::format(" at {} Hz", as_set(gaze.rate_hz)) : "");
    case GazeOrigin::none:
        return "no gaze was recorded";
    }
    return {};
}

std::string program_clause(const StudySession& session) {
    const std::string& version = session.setup.program_version;
    if (const std::optional<std::string>& presenter = session.setup.presenter)
        return fmt::format("pictures were presented by {}, and gaze and trials were imported into overt{}",
                           presenter->empty() ? "another program, which is not on record" : *presenter,
                           version.empty() ? ", in a version that is not on record" : " " + version);
    return fmt::format("{} by overt{}",
                       session.setup.gaze.origin == GazeOrigin::imported ? "the recording was imported"
                                                                         : "presentation and recording were",
                       version.empty() ? ", in a version that is not on record" : " " + version);
}

} // namespace

std::string apparatus_text(const StudyResults& results) {
    std::string text;
    add_over_sessions(text, results, display_clause);
    add_over_sessions(text, results, stereo_clause);
    add_over_sessions(text, results, light_clause);
    add_over_sessions(text, results, timing_clause);
    add_over_sessions(text, results, gaze_clause);
    if (std::ranges::any_of(results.sessions,
                            [](const StudySession& one) { return one.setup.gaze.is_of_people(); }))
        add_sentence(text, "how the head was held, how the eye tracker works and what its software filters, "
                           "and the room and its light, are not on record");
    add_over_sessions(text, results, program_clause);
    return text;
}

} // namespace overt
