#include "experiment/protocol/fault_file.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/whole_file.h"
#include "experiment/protocol/value_reader.h"

namespace overt {

namespace {

enum class TimeStamps { counted, bare };

/// [display]
struct DisplayKeys {
    double drift_ppm = 0.0, jitter_sd_ms = 0.0;
    TimeStamps time_stamps = TimeStamps::counted;
};

/// [chance]
struct ChanceKeys {
    std::optional<std::uint64_t> seed;
    RandomFaults faults;
};

/// [[fault]]
struct FaultKeys {
    DisplayFault::Kind kind = DisplayFault::Kind::late;
    std::optional<int> trial, refresh, refreshes;
    std::optional<double> ms;
};

constexpr std::string_view kinds[] = {"late", "skip", "stall", "stamp"};
constexpr std::string_view time_stamps[] = {"counted", "bare"};
constexpr std::string_view sections[] = {"display", "chance", "fault"};

/// Calls `take(rule, member)` for each key.
template <class Take> void keys_of(DisplayKeys& out, Take&& take) {
    take({.name = "drift_ppm",
          .unit = "ppm",
          .low = -2000,
          .high = 2000,
          .explanation = "By how much the display's clock goes faster than nominal."},
         out.drift_ppm);
    take({.name = "jitter_sd_ms",
          .unit = "ms",
          .low = 0,
          .high = 100,
          .explanation = "Scatter of every time stamp: normal, cut at three standard deviations."},
         out.jitter_sd_ms);
    take({.name = "time_stamps",
          .choices = time_stamps,
          .explanation = "With a count of refreshes, or bare times as of a buffer swap's return."},
         out.time_stamps);
}
template <class Take> void keys_of(ChanceKeys& out, Take&& take) {
    RandomFaults& faults = out.faults;
    take({.name = "seed", .low = 0, .explanation = "Of all that comes by chance."}, out.seed);
    take({.name = "late_share",
          .low = 0,
          .high = 1,
          .explanation = "Probability at each refresh that drawing takes longer."},
         faults.late_share);
    take({.name = "late_min_ms", .unit = "ms", .low = 0, .high = 60000, .explanation = "The least."},
         faults.late_min_ms);
    take({.name = "late_max_ms", .unit = "ms", .low = 0, .high = 60000, .explanation = "The most."},
         faults.late_max_ms);
    take({.name = "skip_share",
          .low = 0,
          .high = 1,
          .explanation = "Probability that the display takes the picture later."},
         faults.skip_share);
    take({.name = "skip_max_refreshes",
          .low = 1,
          .high = 10000,
          .explanation = "By 1 to this many refreshes."},
         faults.skip_max_refreshes);
    take({.name = "stall_share",
          .low = 0,
          .high = 1,
          .explanation = "Probability that the machine stands still."},
         faults.stall_share);
    take({.name = "stall_min_ms", .unit = "ms", .low = 0, .high = 60000, .explanation = "The least."},
         faults.stall_min_ms);
    take({.name = "stall_max_ms", .unit = "ms", .low = 0, .high = 60000, .explanation = "The most."},
         faults.stall_max_ms);
}
template <class Take> void keys_of(FaultKeys& out, Take&& take) {
    take({.name = "kind", .choices = kinds, .explanation = "What goes wrong."}, out.kind);
    take({.name = "trial", .low = 1, .high = 1000000, .explanation = "Which trial, from 1; left out: each."},
         out.trial);
    take({.name = "refresh", .low = 0, .high = 10000000, .explanation = "Since the onset, from 0."},
         out.refresh);
    take({.name = "ms",
          .unit = "ms",
          .low = -60000,
          .high = 60000,
          .explanation = "How much of late, stall or stamp."},
         out.ms);
    take({.name = "refreshes", .low = 1, .high = 10000, .explanation = "How many of skip."}, out.refreshes);
}

class FaultReader {
  public:
    FaultReader(std::string file, Diagnostics& diagnostics)
        : file_(std::move(file)), diagnostics_(diagnostics) {}

    void read(const TomlFile& toml, DisplayFaults& out) {
        for (const TomlEntry& entry : toml.root) {
            if (entry.key == "display")
                read_display(entry, out);
            else if (entry.key == "chance")
                read_chance(entry, out);
            else if (entry.key == "fault")
                read_faults(entry, out);
            else
                diagnostics_.error(file_, entry.key_place, fmt::format("unknown section [{}]", entry.key),
                                   suggest_name(entry.key, sections));
        }
    }

  private:
    template <class Keys> void read_keys(std::string_view section, const TomlTable& table, Keys& out) {
        for (const TomlEntry& entry : table) {
            bool is_known = false;
            std::vector<std::string_view> known;
            keys_of(out, [&](const KeyRule& rule, auto& member) {
                known.push_back(rule.name);
                if (rule.name != entry.key)
                    return;
                is_known = true;
                if (const ValueResult fault = read_value(entry.value, rule, member))
                    diagnostics_.error(file_, fault->place, fault->message, fault->hint);
            });
            if (!is_known)
                diagnostics_.error(file_, entry.key_place,
                                   fmt::format("unknown key \"{}\" in [{}]", entry.key, section),
                                   suggest_name(entry.key, known));
        }
    }

    template <class Keys> bool read_table(const TomlEntry& entry, Keys& out) {
        if (const TomlTable* table = entry.value.table()) {
            read_keys(entry.key, *table, out);
            return true;
        }
        diagnostics_.error(file_, entry.value.place,
                           fmt::format("{}: expected a section, found {}", entry.key, entry.value.kind()),
                           fmt::format("write [{}] on a line of its own, and its keys below", entry.key));
        return false;
    }

    void read_display(const TomlEntry& entry, DisplayFaults& out) {
        DisplayKeys keys;
        read_table(entry, keys);
        out.drift_ppm = keys.drift_ppm;
        out.jitter_sd_ms = keys.jitter_sd_ms;
        out.counts_refreshes = keys.time_stamps == TimeStamps::counted;
    }

    void read_chance(const TomlEntry& entry, DisplayFaults& out) {
        ChanceKeys keys;
        read_table(entry, keys);
        out.seed = keys.seed.value_or(out.seed);
        out.by_chance = keys.faults;
        const RandomFaults& faults = out.by_chance;
        if (faults.late_min_ms > faults.late_max_ms)
            diagnostics_.error(file_, entry.value.place, "late_min_ms is more than late_max_ms");
        if (faults.stall_min_ms > faults.stall_max_ms)
            diagnostics_.error(file_, entry.value.place, "stall_min_ms is more than stall_max_ms");
    }

    void read_faults(const TomlEntry& entry, DisplayFaults& out) {
        const TomlList* list = entry.value.list();
        if (!list) {
            diagnostics_.error(file_, entry.value.place, "fault: expected a list of sections",
                               "write [[fault]], with two brackets");
            return;
        }
        for (const TomlValue& item : *list) {
            if (const TomlTable* table = item.table())
                read_fault(item.place, *table, out);
            else
                diagnostics_.error(file_, item.place,
                                   fmt::format("fault: expected a section, found {}", item.kind()));
        }
    }

    void read_fault(Place place, const TomlTable& table, DisplayFaults& out) {
        using Kind = DisplayFault::Kind;
        FaultKeys keys;
        read_keys("fault", table, keys);
        const auto has = [&](std::string_view key) {
            return std::any_of(table.begin(), table.end(), [&](const TomlEntry& e) { return e.key == key; });
        };
        if (!has("kind"))
            diagnostics_.error(file_, place, "[[fault]] has no \"kind\"",
                               "one of \"late\", \"skip\", \"stall\", \"stamp\"");
        if (!has("refresh"))
            diagnostics_.error(file_, place, "[[fault]] has no \"refresh\"",
                               "the refresh since the onset at which it strikes, from 0");
        const bool skips = keys.kind == Kind::skip;
        if (has("kind") && has(skips ? "ms" : "refreshes"))
            diagnostics_.error(file_, place,
                               fmt::format("a fault of kind \"{}\" is given in {}", name_of(keys.kind),
                                           skips ? "refreshes, not in ms" : "ms, not in refreshes"));
        else if (has("kind") && !skips && !has("ms"))
            diagnostics_.error(file_, place,
                               fmt::format("a fault of kind \"{}\" needs \"ms\"", name_of(keys.kind)),
                               "by how much, in milliseconds");
        if (keys.kind != Kind::stamp && keys.ms.value_or(0.0) < 0.0)
            diagnostics_.error(file_, place, "only a time stamp can be wrong by a negative time");
        if (keys.kind == Kind::stall && keys.refresh == 0)
            diagnostics_.error(file_, place, "before refresh 0 there is no presentation to stall",
                               "take refresh 1 or later");
        out.given.push_back({keys.kind, keys.trial ? std::optional(*keys.trial - 1) : std::nullopt,
                             keys.refresh.value_or(0), keys.ms.value_or(0.0), keys.refreshes.value_or(1)});
    }

    std::string file_;
    Diagnostics& diagnostics_;
};

} // namespace

std::optional<DisplayFaults> read_fault_text(std::string_view text, const std::string& file,
                                             Diagnostics& diagnostics) {
    const int errors_before = diagnostics.error_count();
    diagnostics.quote_from(file, text);
    DisplayFaults faults;
    FaultReader(file, diagnostics).read(parse_toml(text, file, diagnostics), faults);
    return diagnostics.error_count() > errors_before ? std::nullopt : std::optional(faults);
}

std::optional<DisplayFaults> read_fault_file(const std::filesystem::path& file, Diagnostics& diagnostics) {
    int error = 0;
    const std::optional<std::string> text = read_whole_file(file, most_text_bytes, error);
    if (!text) {
        diagnostics.error(file.string(), {}, fmt::format("cannot be read: {}", std::strerror(error)));
        return std::nullopt;
    }
    return read_fault_text(*text, file.string(), diagnostics);
}

} // namespace overt
