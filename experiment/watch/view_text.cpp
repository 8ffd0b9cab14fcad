#include "experiment/watch/view_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/plain_text.h"

namespace overt {

namespace {

std::string share_text(std::optional<double> share) {
    return share ? fmt::format("{:.1f} %", 100.0 * *share) : std::string("-");
}

std::string degrees_text(std::optional<double> value, double limit) {
    if (!value)
        return "-";
    return fmt::format("{:.2f} deg{}", *value,
                       limit > 0.0 && *value > limit ? fmt::format(", more than {:g}", limit) : "");
}

/// As many characters as fit; what is left of a cut one is left out.
std::string cut(const std::string& line, int columns) {
    int characters = 0;
    std::size_t end = 0;
    for (; end < line.size(); ++end)
        if ((static_cast<unsigned char>(line[end]) & 0xC0u) != 0x80u && ++characters > columns)
            break;
    return line.substr(0, end);
}

std::string bar(double share, int length) {
    const int full = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * length));
    return std::string(static_cast<std::size_t>(full), '#') +
           std::string(static_cast<std::size_t>(length - full), '.');
}

/// The stimulus in characters, each about twice as high as wide, with gaze.
std::vector<std::string> picture_of(const ViewText& of, int columns, int rows) {
    const auto shown = static_cast<std::size_t>(of.pictured);
    const bool is_known = shown < of.view.shown.size() &&
                          static_cast<std::size_t>(of.view.shown[shown].slot) < of.facts.slots.size();
    if (of.picture.width <= 0 || of.picture.height <= 0 || !(is_known || of.is_camera) || rows < 4)
        return {};
    rows = std::min(rows, columns / 2);
    const int wide = std::min(columns, rows * 2 * of.picture.width / of.picture.height);
    if (wide < 4)
        return {};
    constexpr std::string_view shades = " .:-=+*%#@";
    std::vector<std::string> lines(static_cast<std::size_t>(rows),
                                   std::string(static_cast<std::size_t>(wide), ' '));
    const bool is_shown = of.is_camera || of.view.shown[shown].pose >= 0;
    for (int y = 0; y < rows && is_shown; ++y)
        for (int x = 0; x < wide; ++x) {
            const int from_x = x * of.picture.width / wide, from_y = y * of.picture.height / rows;
            const float light =
                of.picture.lightness[static_cast<std::size_t>(from_y * of.picture.width + from_x)];
            const int shade = std::clamp(static_cast<int>(light * 10.0f), 0, 9);
            lines[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
                shades[static_cast<std::size_t>(shade)];
        }
    const ViewedSlot at =
        of.is_camera ? ViewedSlot() : of.facts.slots[static_cast<std::size_t>(of.view.shown[shown].slot)];
    for (std::size_t i = 0; i < of.gaze.size() && !of.is_camera; ++i) {
        if (!of.gaze[i].place)
            continue;
        const double x = (of.gaze[i].place->x_px - at.left_px) / at.width_px * wide;
        const double y = (of.gaze[i].place->y_px - at.top_px) / at.height_px * rows;
        if (x >= 0.0 && x < wide && y >= 0.0 && y < rows)
            lines[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
                i + 1 == of.gaze.size() ? 'O' : 'o';
    }
    return lines;
}

std::string where_it_stands(const ViewText& of) {
    const SessionView& view = of.view;
    if (view.is_over)
        return "the session is over";
    return view.trial >= 0 ? fmt::format("trial {} of {}, {}", view.trial + 1, of.facts.trials, view.phase)
                           : view.phase;
}

} // namespace

std::string missed_text(const SessionFacts& facts, const SessionView& view) {
    return facts.is_timing_unproven
               ? "unproven"
               : fmt::format("{} in this trial, {} in all", view.missed_in_trial, view.missed);
}

std::string duration_text(std::optional<double> seconds) {
    if (!seconds || !(*seconds >= 0.0))
        return "-";
    const auto whole = static_cast<long>(std::lround(*seconds));
    if (whole < 60)
        return fmt::format("{} s", whole);
    if (whole < 3600)
        return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::vector<std::string> figures_of(const ViewText& of) {
    const SessionFacts& facts = of.facts;
    const SessionView& view = of.view;
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}, observer {}: {}", facts.protocol, facts.observer, where_it_stands(of)));
    lines.push_back(
        fmt::format("progress  [{}] {} of {} trials{}; {} left, {} gone",
                    bar(facts.trials > 0 ? static_cast<double>(view.done) / facts.trials : 0.0, 10),
                    view.done, facts.trials, view.failed > 0 ? fmt::format(" ({} failed)", view.failed) : "",
                    duration_text(view.is_over ? std::optional(0.0) : time_left_s(facts, view)),
                    duration_text(view.time_s)));
    if (!view.task.empty())
        lines.push_back(
            fmt::format("stimulus  {}: {}", words_of_shown(facts, view), plain_line_of(view.question)));
    lines.push_back("display   missed refreshes: " + missed_text(facts, view));
    if (!facts.has_tracker)
        lines.emplace_back("tracker   none");
    else {
        const auto gaze = [&]() -> std::string {
            if (of.gaze.empty())
                return "no gaze now";
            const ViewedGaze& last = of.gaze.back();
            return last.place ? fmt::format("gaze at {:.0f}, {:.0f} px", last.place->x_px, last.place->y_px)
                              : std::string("no eye");
        };
        lines.push_back(fmt::format("tracker   {}; {} without gaze in this trial, {} in the session",
                                    view.tracker_is_lost ? std::string("LOST") : gaze(),
                                    share_text(lost_share(view.samples_in_trial, view.lost_in_trial)),
                                    share_text(lost_share(view.samples, view.lost))));
        if (!of.surface.empty())
            lines.push_back(fmt::format("surface   {}", of.surface));
        if (!of.areas.empty())
            lines.push_back(fmt::format("areas     {}", of.areas));
        lines.push_back(fmt::format("accuracy  mean {}; largest {}; drift {}",
                                    degrees_text(view.validation_mean_deg, facts.mean_limit_deg),
                                    degrees_text(view.validation_max_deg, facts.max_limit_deg),
                                    degrees_text(view.drift_deg, facts.drift_limit_deg)));
    }
    if (view.level_rms)
        lines.push_back(fmt::format("voice     [{}]{}", bar(std::sqrt(view.level_peak.value_or(0.0)), 20),
                                    view.is_clipping ? " too loud" : ""));
    else if (!view.answer.empty())
        lines.push_back(fmt::format("answer    {}", plain_line_of(view.answer)));
    if (view.dropped > 0)
        lines.push_back(fmt::format("view      {} pieces of news found no room here; the record has them all",
                                    view.dropped));
    if (of.is_silent && !view.is_over)
        lines.emplace_back("view      the session has said nothing for seconds");
    if (!view.asks.empty())
        lines.push_back(fmt::format("ASKED     {}", plain_line_of(view.asks)));
    return lines;
}

std::string screen_of(const ViewText& of, int columns, int rows) {
    std::vector<std::string> lines = figures_of(of);
    const int messages = std::min<int>(6, static_cast<int>(of.events.size()));
    const int left = rows - static_cast<int>(lines.size()) - messages - 4;
    for (std::string& line : picture_of(of, columns - 1, left))
        lines.push_back(std::move(line));
    for (std::size_t i = of.events.size() - static_cast<std::size_t>(messages); i < of.events.size(); ++i) {
        const ViewedEvent& event = of.events[i];
        lines.push_back(fmt::format("{:8.1f} s  {}{}{}", event.at_s, event.kind,
                                    event.detail.empty() ? "" : ": ", plain_line_of(event.detail)));
    }
    std::string screen;
    for (const std::string& line : lines)
        screen += cut(line, columns - 1) + "\n";
    return screen;
}

std::string summary_of(const ViewText& of) {
    const SessionView& view = of.view;
    return fmt::format("{:.1f} s: {}: {} of {} done, {} left, missed: {}, {} without gaze, drift {}{}\n",
                       view.time_s, where_it_stands(of), view.done, of.facts.trials,
                       duration_text(view.is_over ? std::optional(0.0) : time_left_s(of.facts, view)),
                       missed_text(of.facts, view), share_text(lost_share(view.samples, view.lost)),
                       degrees_text(view.drift_deg, of.facts.drift_limit_deg),
                       view.asks.empty() ? "" : "; asked: " + plain_line_of(view.asks));
}

} // namespace overt
