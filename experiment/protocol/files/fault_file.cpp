#include "experiment/protocol/files/fault_file.h"

#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/whole_file.h"
#include "experiment/keys/key_walk.h"

namespace overt {

namespace {

enum class TimeStamps { counted, bare };

/// [display]
struct DisplayKeys {
    double drift_ppm = 0.0, jitter_sd_ms = 0.0;
    TimeStamps time_stamps = TimeStamps::counted;
};

/// [chance]
struct ChanceKeys : RandomFaults {
    std::optional<std::uint64_t> seed;
};

/// [[fault]]
struct FaultKeys {
    DisplayFault::Kind kind = DisplayFault::Kind::late;
    std::optional<int> trial, refresh, refreshes;
    std::optional<double> ms;
};

/// [tracker]
struct TrackerKeys {
    std::optional<double> granted_rate_hz;
};

/// [[tracker-fault]]
struct TrackerFaultKeys {
    TrackerFault::Kind kind = TrackerFault::Kind::stall;
    std::optional<int> trial, attempt, refusals, number;
    std::optional<double> at_s, s, ms;
};

/// What stands in a file.
struct FileKeys {
    DisplayKeys display;
    ChanceKeys chance;
    std::vector<FaultKeys> faults;
    TrackerKeys tracker;
    std::vector<TrackerFaultKeys> tracker_faults;
};

std::vector<Key> display_keys() {
    using D = DisplayKeys;
    static constexpr std::string_view time_stamps[] = {"counted", "bare"};
    return {{"drift_ppm", &D::drift_ppm, range(-2000, 2000, "ppm"),
             "By how much the display's clock goes faster than nominal."},
            {"jitter_sd_ms", &D::jitter_sd_ms, range(0, 100, "ms"),
             "Scatter of every time stamp: normal, cut at three standard deviations."},
            {"time_stamps", &D::time_stamps, one_of(time_stamps),
             "With a count of refreshes, or bare times as of a buffer swap's return."}};
}

std::vector<Key> chance_keys() {
    using C = ChanceKeys;
    constexpr KeyLimits share = range(0, 1), time = range(0, 60000, "ms");
    return {
        {"seed", &C::seed, at_least(0), "Of all that comes by chance."},
        {"late_share", member_of<C>(&C::late_share), share,
         "Probability at each refresh that drawing takes longer."},
        {"late_min_ms", member_of<C>(&C::late_min_ms), time, "The least."},
        {"late_max_ms", member_of<C>(&C::late_max_ms), time, "The most."},
        {"skip_share", member_of<C>(&C::skip_share), share,
         "Probability that the display takes the picture later."},
        {"skip_max_refreshes", member_of<C>(&C::skip_max_refreshes), range(1, 10000),
         "By 1 to this many refreshes."},
        {"stall_share", member_of<C>(&C::stall_share), share, "Probability that the machine stands still."},
        {"stall_min_ms", member_of<C>(&C::stall_min_ms), time, "The least."},
        {"stall_max_ms", member_of<C>(&C::stall_max_ms), time, "The most."}};
}

std::vector<Key> fault_keys() {
    using F = FaultKeys;
    return {{"kind", &F::kind, required(), "one of \"late\", \"skip\", \"stall\", \"stamp\""},
            {"trial", &F::trial, range(1, 1000000), "Which trial, from 1; left out: each."},
            {"refresh", &F::refresh, range(0, 10000000).required(),
             "the refresh since the onset at which it strikes, from 0"},
            {"ms", &F::ms, range(-60000, 60000, "ms"), "How much of late, stall or stamp."},
            {"refreshes", &F::refreshes, range(1, 10000), "How many of skip."}};
}

std::vector<Key> tracker_fault_keys() {
    using F = TrackerFaultKeys;
    return {{"kind", &F::kind, required(),
             "one of \"stall\", \"gap\", \"garbage\", \"doubled\", \"no-eye\", \"clock-jump\", "
             "\"slow-start\", \"unplug\", \"repeat\", \"skip\", \"abort\", \"calibration\""},
            {"trial", &F::trial, range(1, 1000000), "Which trial, from 1; left out: each."},
            {"attempt", &F::attempt, range(1, 1000), "At the trial, from 1."},
            {"at_s", &F::at_s, range(0, 100000, "s"), "Since the recording's first sample."},
            {"s", &F::s, range(0, 100000, "s"), "How long it lasts."},
            {"ms", &F::ms, range(-1e9, 1e9, "ms"), "By how much the tracker's clock is put forward."},
            {"refusals", &F::refusals, range(0, 1000), "So many attempts to connect again are refused."},
            {"number", &F::number, range(1, 1000), "Which calibration, from 1."}};
}

const KeyTable& fault_table() {
    static const KeyTable table({{"display", &FileKeys::display, display_keys()},
                                 {"chance", &FileKeys::chance, chance_keys()},
                                 {"fault", &FileKeys::faults, fault_keys()},
                                 {"tracker",
                                  &FileKeys::tracker,
                                  {{"granted_rate_hz", &TrackerKeys::granted_rate_hz, range(1, 10000, "Hz"),
                                    "The rate that the eye tracker grants, whatever was wished."}}},
                                 {"tracker-fault", &FileKeys::tracker_faults, tracker_fault_keys()}});
    return table;
}

/// Which of the keys of a tracker's fault belong to its kind.
struct TrackerFaultShape {
    std::string_view amount; ///< the key that says how much; empty: none
    bool has_place = true;   ///< at_s
    bool has_trial = true;   ///< trial and attempt
};

TrackerFaultShape shape_of(TrackerFault::Kind kind) {
    using Kind = TrackerFault::Kind;
    switch (kind) {
    case Kind::stall:
    case Kind::gap:
    case Kind::garbage:
    case Kind::doubled:
    case Kind::no_eye:
        return {.amount = "s"};
    case Kind::slow_start:
        return {.amount = "s", .has_place = false};
    case Kind::clock_jump:
        return {.amount = "ms"};
    case Kind::calibration:
        return {.amount = "number", .has_place = false, .has_trial = false};
    case Kind::unplug:
    case Kind::repeat:
    case Kind::skip:
    case Kind::abort:
        break;
    }
    return {};
}

class FaultReader {
  public:
    FaultReader(std::string file, Diagnostics& diagnostics)
        : file_(std::move(file)), diagnostics_(diagnostics) {}

    SimulatedFaults read(const TomlFile& toml) {
        FileKeys keys;
        KeyPaths faulty;
        KeyWalk(fault_table(), file_, places_, faulty, diagnostics_).read(toml, keys);
        check_chance(keys.chance);
        SimulatedFaults faults{{.seed = keys.chance.seed.value_or(DisplayFaults{}.seed),
                                .drift_ppm = keys.display.drift_ppm,
                                .jitter_sd_ms = keys.display.jitter_sd_ms,
                                .counts_refreshes = keys.display.time_stamps == TimeStamps::counted,
                                .by_chance = keys.chance,
                                .given = {}},
                               {.granted_rate_hz = keys.tracker.granted_rate_hz, .given = {}}};
        for (std::size_t i = 0; i < keys.faults.size(); ++i) {
            const FaultKeys& fault = keys.faults[i];
            check_fault(fmt::format("fault[{}]", i), fault);
            faults.given.push_back({fault.kind, fault.trial ? std::optional(*fault.trial - 1) : std::nullopt,
                                    fault.refresh.value_or(0), fault.ms.value_or(0.0),
                                    fault.refreshes.value_or(1)});
        }
        for (std::size_t i = 0; i < keys.tracker_faults.size(); ++i) {
            const TrackerFaultKeys& fault = keys.tracker_faults[i];
            check_tracker_fault(fmt::format("tracker-fault[{}]", i), fault);
            faults.tracker.given.push_back(
                {.kind = fault.kind,
                 .trial = fault.trial ? std::optional(*fault.trial - 1) : std::nullopt,
                 .attempt = fault.attempt.value_or(1),
                 .at_s = fault.at_s.value_or(0.0),
                 .s = fault.s.value_or(0.0),
                 .ms = fault.ms.value_or(0.0),
                 .refusals = fault.refusals.value_or(0),
                 .number = fault.number.value_or(1)});
        }
        return faults;
    }

  private:
    void error(std::string_view path, std::string message, std::string hint = {}) {
        diagnostics_.error(file_, places_.of(path), std::move(message), std::move(hint));
    }

    void check_chance(const ChanceKeys& faults) {
        if (faults.late_min_ms > faults.late_max_ms)
            error("chance", "late_min_ms is more than late_max_ms");
        if (faults.stall_min_ms > faults.stall_max_ms)
            error("chance", "stall_min_ms is more than stall_max_ms");
    }

    void check_fault(const std::string& path, const FaultKeys& fault) {
        using Kind = DisplayFault::Kind;
        const auto has = [&](std::string_view key) {
            return places_.is_written(fmt::format("{}.{}", path, key));
        };
        const bool skips = fault.kind == Kind::skip;
        if (has("kind") && has(skips ? "ms" : "refreshes"))
            error(path, fmt::format("a fault of kind \"{}\" is given in {}", name_of(fault.kind),
                                    skips ? "refreshes, not in ms" : "ms, not in refreshes"));
        else if (has("kind") && !skips && !has("ms"))
            error(path, fmt::format("a fault of kind \"{}\" needs \"ms\"", name_of(fault.kind)),
                  "by how much, in milliseconds");
        if (fault.kind != Kind::stamp && fault.ms.value_or(0.0) < 0.0)
            error(path, "only a time stamp can be wrong by a negative time");
        if (fault.kind == Kind::stall && fault.refresh == 0)
            error(path, "before refresh 0 there is no presentation to stall", "take refresh 1 or later");
    }

    /// Each kind takes its own keys and no others.
    void check_tracker_fault(const std::string& path, const TrackerFaultKeys& fault) {
        const auto has = [&](std::string_view key) {
            return places_.is_written(fmt::format("{}.{}", path, key));
        };
        if (!has("kind"))
            return;
        const TrackerFaultShape shape = shape_of(fault.kind);
        const auto refuse = [&](std::string_view key, bool is_taken) {
            if (has(key) && !is_taken)
                error(fmt::format("{}.{}", path, key),
                      fmt::format("an eye tracker's fault of kind \"{}\" has no \"{}\"", name_of(fault.kind),
                                  key));
        };
        for (const std::string_view key : {"s", "ms", "number"})
            refuse(key, key == shape.amount);
        refuse("refusals", fault.kind == TrackerFault::Kind::unplug);
        refuse("at_s", shape.has_place);
        refuse("trial", shape.has_trial);
        refuse("attempt", shape.has_trial);
        if ((shape.amount == "s" || shape.amount == "ms") && !has(shape.amount))
            error(path,
                  fmt::format("an eye tracker's fault of kind \"{}\" needs \"{}\"", name_of(fault.kind),
                              shape.amount),
                  shape.amount == "s" ? "how long it lasts, in seconds" : "by how much, in milliseconds");
    }

    std::string file_;
    Diagnostics& diagnostics_;
    KeyPlaces places_;
};

} // namespace

std::optional<SimulatedFaults> read_fault_text(std::string_view text, const std::string& file,
                                               Diagnostics& diagnostics) {
    const int errors_before = diagnostics.error_count();
    diagnostics.quote_from(file, text);
    const SimulatedFaults faults = FaultReader(file, diagnostics).read(parse_toml(text, file, diagnostics));
    return diagnostics.error_count() > errors_before ? std::nullopt : std::optional(faults);
}

std::optional<SimulatedFaults> read_fault_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
    int error = 0;
    const std::optional<std::string> text = read_whole_file(file, most_text_bytes, error);
    if (!text) {
        diagnostics.error(file.string(), {}, fmt::format("cannot be read: {}", std::strerror(error)));
        return std::nullopt;
    }
    return read_fault_text(*text, file.string(), diagnostics);
}

} // namespace overt
