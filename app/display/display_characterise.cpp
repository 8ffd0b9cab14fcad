#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/figures.h"
#include "app/cli/file_set.h"
#include "app/cli/progress_bar.h"
#include "app/cli/this_program.h"
#include "app/display/display_commands.h"
#include "app/display/patch_display.h"
#include "app/display/patch_photometers.h"
#include "app/inputs/protocol_file.h"
#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "experiment/base/number_table.h"
#include "experiment/colour/characterisation_text.h"
#include "experiment/colour/patch_plan.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

constexpr double most_luminance_error = 0.005, most_xy_error = 0.001;

/// NAME.toml with NAME_readings.csv and the like beside it.
std::filesystem::path beside(const std::filesystem::path& out, const std::string& ending) {
    return out.parent_path() / (out.stem().string() + ending);
}

DisplaySettings display_of(const DisplayCharacteriseOptions& options) {
    DisplaySettings display;
    display.output = OutputMode::native_8bit;
    if (!options.protocol.empty())
        display = read_protocol_or_report(options.protocol).display;
    if (!options.mode.empty())
        display.output = output_mode_called(options.mode).value(); // the command line has only these
    return display;
}

std::vector<PatchReading> read_readings(const std::filesystem::path& file) {
    constexpr std::string_view columns[] = {"level_r", "level_g", "level_b", "X", "Y", "Z"};
    Diagnostics diagnostics;
    std::optional<NumberTable> table;
    if (auto text = read_whole_file(file, file.string(), {}, diagnostics))
        table = read_number_table(*std::move(text), file.string(), columns, {}, diagnostics);
    std::vector<PatchReading> readings;
    for (std::size_t row = 0; table && row < table->rows.size(); ++row) {
        double values[6];
        for (std::size_t i = 0; i < 6; ++i) {
            const auto index = std::find(table->columns.begin(), table->columns.end(), columns[i]);
            values[i] = table->rows[row][static_cast<std::size_t>(index - table->columns.begin())];
            if (i < 3 && !(values[i] >= 0.0 && values[i] <= 1.0))
                diagnostics.error(file.string(), table->place(row, columns[i]),
                                  fmt::format("{} of {} is not in 0 … 1", columns[i], values[i]),
                                  "divide levels by the highest, such as 255");
            if (i >= 3 && values[i] < 0.0)
                diagnostics.error(file.string(), table->place(row, columns[i]),
                                  fmt::format("{} of {} is below 0", columns[i], values[i]));
        }
        readings.push_back({{values[0], values[1], values[2]}, {values[3], values[4], values[5]}});
    }
    print_findings(diagnostics);
    if (diagnostics.has_errors())
        throw FindingsPrinted(fmt::format("{}: cannot be used", file.string()));
    return readings;
}

std::unique_ptr<PatchPhotometer> make_photometer(const DisplayCharacteriseOptions& options, Clock& clock) {
    if (options.simulated) {
        DisplayTruth truth = DisplayTruth::drawn(*options.simulated);
        truth.crosstalk = options.crosstalk;
        return make_simulated_photometer(truth, *options.simulated);
    }
    if (options.typed)
        return make_typed_photometer(options.instrument.empty() ? "readings typed in" : options.instrument);
    return make_colorcal_photometer(options.port.empty() ? std::nullopt : std::optional(options.port), clock);
}

/// Keeps each reading on the disk as it comes, so that an hour before the photometer is never lost.
class ReadingsJournal {
  public:
    ReadingsJournal(std::filesystem::path file, bool force) : file_(std::move(file)) {
        std::error_code ignored;
        if (!force && std::filesystem::exists(file_, ignored))
            throw InputError(fmt::format("{}: holds what was read before a measurement ended early: move it "
                                         "away, or replace it with --overwrite",
                                         file_.string()));
    }
    void add(const PatchReading& reading) {
        if (!stream_.is_open()) {
            stream_.open(file_);
            stream_ << readings_csv({});
        }
        std::string line = readings_csv({&reading, 1});
        line.pop_back();
        stream_ << line.substr(line.rfind('\n') + 1) << '\n' << std::flush;
        if (!stream_)
            throw RecordError(fmt::format("{}: cannot be written; check the disk's space.", file_.string()));
    }
    void remove() {
        stream_.close();
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }
    const std::filesystem::path& file() const { return file_; }
    bool is_empty() const { return !stream_.is_open(); }

  private:
    std::filesystem::path file_;
    std::ofstream stream_;
};

struct Measured {
    std::vector<PatchReading> readings;
    std::string instrument;
};

Measured measure(const DisplayCharacteriseOptions& options, const DisplaySettings& display) {
    const bool is_simulated = options.simulated.has_value();
    if (!is_simulated && !options.context && !display_is_available())
        throw GraphicsError("there is no display for a photometer to look at: set DISPLAY or "
                            "WAYLAND_DISPLAY, or try --simulated 1.");
    SteadyClock clock;
    const auto photometer = make_photometer(options, clock);
    const auto plan = plan_patches({options.levels, options.mixed, options.repeats, options.seed});
    PatchDisplay patches({display, options.context, is_simulated, options.windowed, options.monitor,
                          options.size_deg, options.surround});
    ReadingsJournal journal(beside(options.out, "_readings_partial.csv"), options.force);
    const auto stop = [&] {
        throw DeviceError(journal.is_empty() ? "ended before any patch was measured"
                                             : fmt::format("ended before all patches were measured; what was "
                                                           "is in {}",
                                                           journal.file().string()));
    };
    ProgressBar bar;
    const int warm_up_s = is_simulated ? 0 : static_cast<int>(std::lround(60.0 * options.warm_up_min));
    for (int second = 0; second < warm_up_s; ++second) {
        bar.update("warming up", second, warm_up_s);
        patches.show(glm::dvec3(1.0), 1.0);
        if (patches.is_cancelled())
            stop();
    }
    Measured measured{{}, photometer->description()};
    const int count = static_cast<int>(plan.size());
    for (int i = 0; i < count; ++i) {
        if (!options.typed)
            bar.update("measuring patches", i, count);
        const glm::dvec3 received =
            patches.show(plan[static_cast<std::size_t>(i)], is_simulated ? 0.0 : options.settle_s);
        const auto xyz =
            patches.is_cancelled() ? std::nullopt : photometer->measure({i + 1, count, received});
        if (!xyz)
            stop();
        measured.readings.push_back({received, *xyz});
        journal.add(measured.readings.back());
    }
    if (!options.typed)
        bar.update("measuring patches", count, count);
    journal.remove();
    return measured;
}

/// What is known of the screen: all with a protocol; else what was shown.
MeasuredScreen screen_of(const DisplayCharacteriseOptions& options, const DisplaySettings& display) {
    MeasuredScreen screen;
    if (!options.protocol.empty()) {
        screen.refresh_hz = display.refresh_hz;
        screen.width_mm = display.width_mm;
        screen.height_mm = display.height_mm;
        screen.viewing_distance_mm = display.viewing_distance_mm;
    }
    if (!options.protocol.empty() || options.readings.empty()) {
        screen.width_px = display.width_px;
        screen.height_px = display.height_px;
    }
    return screen;
}

BenchFigures figures_of(const CharacterisationCheck& check) {
    BenchFigures figures;
    if (check.patches > 0) {
        figures.push_back(at_most("luminance of mixed patches: mean error", 100.0 * check.luminance_mean, "%",
                                  100.0 * most_luminance_error));
        figures.push_back({"luminance of mixed patches: largest error", 100.0 * check.luminance_worst, "%"});
        figures.push_back(at_most("x, y of mixed patches: mean error", check.xy_mean, "", most_xy_error));
        figures.push_back({"x, y of mixed patches: largest error", check.xy_worst, ""});
    }
    if (check.additivity)
        figures.push_back({"white against the sum of the channels", 100.0 * *check.additivity, "%"});
    if (check.dependence)
        figures.push_back({"change of a step when other channels are lit", 100.0 * *check.dependence, "%"});
    return figures;
}

} // namespace

int run_display_characterise(const DisplayCharacteriseOptions& options) {
    std::vector<TextFile> files{{beside(options.out, "_readings.csv"), {}},
                                {beside(options.out, "_report.txt"), {}},
                                {options.out, {}}};
    check_can_write(files, options.force);
    const DisplaySettings display = display_of(options);
    const Measured measured = options.readings.empty()
                                  ? measure(options, display)
                                  : Measured{read_readings(options.readings), options.instrument};
    CharacterisationFit fit = fit_characterisation(
        measured.readings, options.model == "power" ? CurveModel::power : CurveModel::table);
    DisplayCharacterisation& result = fit.display;
    result.display = options.name;
    result.date = utc_now().substr(0, 10);
    result.instrument = measured.instrument.empty() ? "readings from a file" : measured.instrument;
    if (options.readings.empty())
        result.note =
            fmt::format("output {}, order of patches by seed {}", name_of(display.output), options.seed);
    result.screen = screen_of(options, display);
    const CharacterisationCheck check = check_characterisation(result, measured.readings);
    const std::string report = characterisation_report(result, fit, check);
    files[0].text = readings_csv(measured.readings);
    files[1].text = report;
    files[2].text = characterisation_toml(result);
    write_file_set(files, options.force);

    const BenchFigures figures = figures_of(check);
    if (options.json) {
        nlohmann::ordered_json json = to_json(figures);
        for (const TextFile& file : files)
            json["files"].push_back(file.path.string());
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{}\n", report);
        print_table(figures);
        fmt::print("\nwritten: {}, {} and {}\nIn a protocol: [display] characterisation = \"{}\"\n",
                   files[2].path.string(), files[0].path.string(), files[1].path.string(),
                   options.out.filename().string());
    }
    if (!all_hold(figures)) {
        fmt::print(stderr, "overt: the model of independent channels that add up misses this display by more "
                           "than it should; the report says where\n");
        return 1;
    }
    return 0;
}

} // namespace overt
