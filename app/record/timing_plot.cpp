#include "app/record/timing_plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "app/record/plot_canvas.h"

namespace overt {

namespace {

constexpr double width = 900.0, left = 90.0, right = 870.0;

/// Of the causes, readable for the colour-blind (Okabe and Ito 2008): vermillion, orange, blue.
constexpr const char* cause_colours[] = {"#d55e00", "#e69f00", "#0072b2"};
constexpr const char* ink = "#333333";
constexpr const char* grid = "#dddddd";

/// From values to places along an axis.
struct Scale {
    double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
    double operator()(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// A step of 1, 2 or 5 times a power of ten that cuts a span into about `wanted` pieces.
double round_step(double span, int wanted) {
    const double rough = std::max(span, 1e-12) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough)
            return factor * power;
    return 10.0 * power;
}

using Anchor = PlotCanvas::Anchor;

/// The canvas, and what all panels have.
class Drawing : public PlotCanvas {
  public:
    void frame(double top, double bottom) { outline(left, top, right - left, bottom - top, ink); }
    void x_axis(const Scale& x, double step, double top, double bottom, const std::string& name) {
        const int decimals = step < 1.0 ? static_cast<int>(std::ceil(-std::log10(step) - 1e-9)) : 0;
        double at = std::ceil(x.low / step - 1e-9) * step;
        while (at <= x.high + 1e-9 * step) {
            line(x(at), top, x(at), bottom, grid);
            const double exact = std::abs(at) < 1e-6 * step ? 0.0 : at; // no negative zero
            text(x(at), bottom + 16.0, fmt::format("{:.{}f}", exact, decimals));
            at += step;
        }
        text(0.5 * (left + right), bottom + 34.0, name);
    }
    void y_name(double top, double bottom, const std::string& name) {
        text(24.0, 0.5 * (top + bottom), name, Anchor::middle, 12.0, true);
    }
};

void draw_histogram(Drawing& drawing, const TimingReport& report, double top, double bottom) {
    const std::vector<IntervalBin> bins = interval_histogram(report);
    if (bins.empty())
        return;
    const double margin = report.nominal_interval_ms;
    const Scale x{std::max(bins.front().from_ms - margin, 0.0), bins.back().to_ms + margin, left, right};
    int most = 1;
    for (const IntervalBin& bin : bins)
        most = std::max(most, bin.count);
    const int decades = static_cast<int>(std::floor(std::log10(most))) + 1;
    // One count stands a little above the axis.
    const Scale y{-0.3, static_cast<double>(decades), bottom, top};
    drawing.x_axis(x, round_step(x.high - x.low, 10), top, bottom,
                   "from flip to flip by the time stamps, ms");
    for (int decade = 0; decade <= decades; ++decade) {
        drawing.line(left, y(decade), right, y(decade), grid);
        drawing.text(left - 8.0, y(decade) + 4.0, fmt::format("{:.0f}", std::pow(10.0, decade)), Anchor::end);
    }
    for (const IntervalBin& bin : bins)
        if (bin.count > 0)
            drawing.box(x(bin.from_ms), y(std::log10(bin.count)),
                        std::max(x(bin.to_ms) - x(bin.from_ms), 1.5), bottom - y(std::log10(bin.count)),
                        "#56b4e9");
    drawing.frame(top, bottom);
    drawing.y_name(top, bottom, "flips (logarithmic)");
}

void label_trials(Drawing& drawing, const TimingReport& report, const Scale& y) {
    const std::size_t every = std::max<std::size_t>(1, (report.trials.size() + 19) / 20);
    for (std::size_t i = 0; i < report.trials.size(); i += every)
        drawing.text(left - 8.0, y(static_cast<double>(i) + 0.5) + 4.0,
                     fmt::format("{}", report.trials[i].trial.index + 1), Anchor::end, 11.0);
}

void draw_misses(Drawing& drawing, const TimingReport& report, double top, double bottom) {
    int last = 1;
    for (const TrialTiming& trial : report.trials) {
        last = std::max(last, trial.planned_refreshes);
        for (const MissedRun& run : trial.missed_runs)
            last = std::max(last, run.refresh_in_trial + run.count);
    }
    const Scale x{0.0, static_cast<double>(last), left, right};
    const Scale y{0.0, static_cast<double>(report.trials.size()), top, bottom};
    drawing.x_axis(x, round_step(last, 10), top, bottom, "refresh since the onset");
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        const TrialTiming& trial = report.trials[i];
        const double row = y(static_cast<double>(i) + 0.15), height = 0.7 * (y(1.0) - y(0.0));
        drawing.box(left, row, x(trial.planned_refreshes - trial.unaccounted) - left, height, "#eeeeee");
        for (const MissedRun& run : trial.missed_runs)
            drawing.box(x(run.refresh_in_trial), row, std::max(x(run.count) - x(0.0), 2.0), height,
                        cause_colours[static_cast<int>(run.cause)]);
        for (const int refresh : trial.wrong_stamps)
            drawing.dot(x(refresh), row + 0.5 * height, 2.5, "#cc79a7");
    }
    label_trials(drawing, report, y);
    drawing.frame(top, bottom);
    drawing.y_name(top, bottom, "trial");
}

void draw_key(Drawing& drawing, double y) {
    double x = left;
    for (const MissCause cause : {MissCause::asked_late, MissCause::drawn_late, MissCause::shown_late}) {
        drawing.box(x, y - 9.0, 12.0, 10.0, cause_colours[static_cast<int>(cause)]);
        drawing.text(x + 17.0, y, fmt::format("missed, {}", name_of(cause)), Anchor::start);
        x += 160.0;
    }
    drawing.dot(x + 6.0, y - 4.0, 2.5, "#cc79a7");
    drawing.text(x + 17.0, y, "time stamp contradicts the others", Anchor::start);
}

void draw_onsets(Drawing& drawing, const TimingReport& report, double top, double bottom) {
    double reach = 1e-3;
    for (const TrialTiming& trial : report.trials)
        reach = std::max(reach, std::abs(trial.onset_deviation_ms) + trial.onset_uncertainty_ms);
    const Scale x{-1.1 * reach, 1.1 * reach, left, right};
    const Scale y{0.0, static_cast<double>(report.trials.size()), top, bottom};
    drawing.x_axis(
        x, round_step(2.2 * reach, 8), top, bottom,
        "time stamp of the onset minus the line through all time stamps, ms (bars: two standard errors)");
    drawing.line(x(0.0), top, x(0.0), bottom, ink);
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        const TrialTiming& trial = report.trials[i];
        const double row = y(static_cast<double>(i) + 0.5);
        drawing.line(x(trial.onset_deviation_ms - trial.onset_uncertainty_ms), row,
                     x(trial.onset_deviation_ms + trial.onset_uncertainty_ms), row, "#009e73", 2.0);
        drawing.dot(x(trial.onset_deviation_ms), row, 3.0, "#009e73");
    }
    label_trials(drawing, report, y);
    drawing.frame(top, bottom);
    drawing.y_name(top, bottom, "trial");
}

} // namespace

void write_timing_plot(const TimingReport& report, const std::string& title,
                       const std::filesystem::path& file) {
    Drawing drawing;
    drawing.text(0.5 * width, 26.0, title, Anchor::middle, 16.0);
    const std::string kind = report.has_simulated_faults ? "the display's faults were simulated; "
                             : report.is_virtual         ? "virtual time; "
                                                         : "";
    drawing.text(0.5 * width, 46.0,
                 fmt::format("{}{}, measured interval {:.5f} ms ({:.3f} Hz)", kind,
                             report.is_unproven
                                 ? std::string("times and missed refreshes are unproven")
                                 : fmt::format("{} of {} refreshes missed", report.missed_refreshes,
                                               report.planned_refreshes),
                             report.interval_ms, report.interval_ms > 0.0 ? 1e3 / report.interval_ms : 0.0));
    const double rows = std::max(90.0, 14.0 * static_cast<double>(report.trials.size()));
    double top = 66.0;
    draw_histogram(drawing, report, top, top + 200.0);
    top += 200.0 + 78.0;
    draw_key(drawing, top - 12.0);
    draw_misses(drawing, report, top, top + rows);
    top += rows + 60.0;
    draw_onsets(drawing, report, top, top + rows);
    drawing.write(file, width, top + rows + 50.0);
}

} // namespace overt
