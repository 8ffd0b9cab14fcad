#include "experiment/protocol/step_settings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace overt {

double StepDuration::shortest_s() const {
    return choices_s.empty() ? from_s : *std::ranges::min_element(choices_s);
}

double StepDuration::longest_s() const {
    return choices_s.empty() ? to_s : *std::ranges::max_element(choices_s);
}

double time_constant_s(double from_s, double to_s, double mean_s) {
    const double span = to_s - from_s;
    const auto mean_of = [&](double tau) { return from_s + tau - span / std::expm1(span / tau); };
    double low = 1e-6 * span, high = 1e6 * span;
    for (int halving = 0; halving < 200; ++halving) {
        const double middle = std::sqrt(low * high);
        (mean_of(middle) < mean_s ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

std::string seconds_column(const StepSettings& step) {
    return fmt::format("{}_s", step.id.empty() ? name_of(step.kind) : std::string_view(step.id));
}

bool have_tones(const std::vector<StepSettings>& steps) {
    return std::ranges::any_of(steps, &StepSettings::has_tone);
}

namespace {

/// Reads entries and collects all that is wrong with them.
class StepReader {
  public:
    std::vector<ValueFault> faults;

    void read(const TomlValue& list, std::vector<StepSettings>& steps) {
        steps.clear();
        for (const TomlValue& entry : *list.list()) {
            if (entry.table())
                read_step(entry, steps.emplace_back());
            else
                fault(entry.place, fmt::format("steps: expected a step such as {{ blank = 0.5 }}, found {}",
                                               entry.kind()));
        }
        if (steps.empty())
            fault(list.place, "steps: the list is empty", "leave the key out for the trial of one question");
    }

  private:
    void fault(Place place, std::string message, std::string hint = {}) {
        faults.push_back({place, std::move(message), std::move(hint)});
    }

    static const StepKindRow* kind_called(std::string_view key) {
        const auto row = std::ranges::find(step_kinds, key, &StepKindRow::name);
        return row == step_kinds.end() ? nullptr : &*row;
    }

    template <class Value>
    bool take(const TomlValue& written, std::string_view name, Value& out, KeyLimits limits = {}) {
        const KeyRule rule{limits, name, {}};
        if (const ValueResult found = value_type(TypeTag<Value>()).read(written, rule, &out)) {
            faults.push_back(*found);
            return false;
        }
        return true;
    }

    void read_step(const TomlValue& entry, StepSettings& step) {
        step.place = entry.place;
        const StepKindRow* kind = nullptr;
        for (const TomlEntry& key : *entry.table())
            if (const StepKindRow* const row = kind_called(key.key)) {
                if (kind)
                    fault(key.key_place,
                          fmt::format("a step is one kind, and this one is \"{}\" already", kind->name),
                          "make two steps of it");
                else
                    kind = row;
            }
        if (!kind) {
            fault(entry.place, "no kind of step is named here", kinds_text());
            return;
        }
        step.kind = kind->kind;
        for (const TomlEntry& key : *entry.table()) {
            if (key.key == kind->name)
                read_kind(key.value, step);
            else if (!kind_called(key.key))
                read_other(*kind, key, step);
        }
    }

    static std::string kinds_text() {
        std::string text = "kinds are ";
        for (const StepKindRow& row : step_kinds)
            text += fmt::format("{}{}", text.ends_with("are ") ? "" : ", ", row.name);
        return text;
    }

    /// What stands behind the kind itself.
    void read_kind(const TomlValue& value, StepSettings& step) {
        switch (step.kind) {
        case StepKind::text:
            take(value, "text", step.text, required());
            return;
        case StepKind::show:
            take(value, "show", step.slots, identifier());
            return;
        case StepKind::mask:
            if (std::holds_alternative<std::string>(value.content)) {
                static constexpr std::string_view masks[] = {"noise", "scrambled"};
                std::string mask;
                take(value, "mask", mask, one_of(masks));
                step.is_scrambled = mask == "scrambled";
                return;
            }
            [[fallthrough]];
        case StepKind::fixation:
        case StepKind::blank:
            read_duration_or_wait(value, step);
            return;
        case StepKind::answer: {
            step.answers_place = value.place;
            take(value, "answer", step.answers, identifier());
            if (step.answers == std::vector<std::string>{"spoken"})
                step.answers.clear();
            return;
        }
        case StepKind::feedback:
            read_feedback(value, step);
            return;
        case StepKind::drift_check: {
            bool is_wanted = true;
            if (take(value, "drift_check", is_wanted) && !is_wanted)
                fault(value.place, "drift_check: false makes no step", "leave it out");
            return;
        }
        }
    }

    void read_feedback(const TomlValue& value, StepSettings& step) {
        const TomlTable* const table = value.table();
        if (!table) {
            fault(value.place,
                  fmt::format("feedback: expected {{ answered = \"…\", missed = \"…\" }}, found {}",
                              value.kind()));
            return;
        }
        const std::size_t before = faults.size();
        for (const TomlEntry& key : *table) {
            if (key.key == "answered")
                take(key.value, key.key, step.answered, required());
            else if (key.key == "missed")
                take(key.value, key.key, step.missed, required());
            else if (key.key == "correct")
                take(key.value, key.key, step.correct, required());
            else if (key.key == "wrong")
                take(key.value, key.key, step.wrong, required());
            else if (key.key == "colour")
                take(key.value, key.key, step.is_coloured);
            else if (key.key == "tone")
                take(key.value, key.key, step.has_tone);
            else
                fault(key.key_place, fmt::format("feedback: unknown key \"{}\"", key.key),
                      "keys are answered, correct, wrong, missed, colour, tone");
        }
        if (step.answered.empty() && step.missed.empty() && step.correct.empty() && step.wrong.empty() &&
            !step.has_tone && faults.size() == before)
            fault(value.place, "feedback: neither words nor a tone are given",
                  "write correct = \"…\", wrong = \"…\", missed = \"…\", answered = \"…\", or some of "
                  "them, or tone = true");
    }

    void read_other(const StepKindRow& kind, const TomlEntry& key, StepSettings& step) {
        const KeyLimits angle = range(-90, 90, "deg");
        if (key.key == "id") {
            step.id_place = key.value.place;
            take(key.value, "id", step.id, identifier());
        } else if (!kind.has_key(key.key)) {
            std::string keys = "id";
            for (const std::string_view one : kind.keys)
                if (!one.empty())
                    keys += fmt::format(", {}", one);
            fault(key.key_place, fmt::format("a step \"{}\" has no key \"{}\"", kind.name, key.key),
                  fmt::format("besides {} there are {}", kind.name, keys));
        } else if (key.key == "for_s" || key.key == "limit_s") {
            read_duration(key.value, key.key, step);
        } else if (key.key == "until") {
            read_until(key.value, step);
        } else if (key.key == "right_deg") {
            take(key.value, key.key, step.right_deg, angle);
        } else if (key.key == "up_deg") {
            take(key.value, key.key, step.up_deg, angle);
        } else if (key.key == "cell_deg") {
            take(key.value, key.key, step.cell_deg, range(0.01, 20, "deg"));
        } else if (key.key == "frame") {
            step.frame_place = key.value.place;
            take(key.value, key.key, step.frame, at_least(0));
        } else if (key.key == "probes") {
            step.probes_place = key.value.place;
            step.probes.emplace();
            if (!key.value.list() || !key.value.list()->empty()) // an empty list: none
                take(key.value, key.key, *step.probes, identifier());
        }
    }

    /// `fixation = 0.5`, `fixation = { from = …, to = … }` or `fixation = { until = { … } }`.
    void read_duration_or_wait(const TomlValue& value, StepSettings& step) {
        const TomlTable* const table = value.table();
        const auto has = [&](std::string_view name) {
            return table && std::ranges::find(*table, name, &TomlEntry::key) != table->end();
        };
        if (!has("until")) {
            read_duration(value, name_of(step.kind), step);
            return;
        }
        for (const TomlEntry& key : *table) {
            if (key.key == "until")
                read_until(key.value, step);
            else
                fault(key.key_place,
                      fmt::format("{}: unknown key \"{}\" beside until", name_of(step.kind), key.key),
                      "a limit of time is for_s, beside the step's kind");
        }
    }

    bool read_seconds(const TomlValue& value, std::string_view name, double& out) {
        if (!take(value, name, out))
            return false;
        if (out > 0.0 && out <= longest_step_s)
            return true;
        fault(value.place,
              out > 0.0 ? fmt::format("{}: {:g} s is longer than an hour", name, out)
                        : fmt::format("{}: a step of {:g} s shows nothing", name, out),
              "give a time above 0, in seconds");
        return false;
    }

    void read_duration(const TomlValue& value, std::string_view name, StepSettings& step) {
        if (step.duration) {
            fault(value.place, fmt::format("{}: how long the step lasts is said twice", name),
                  "leave out one");
            return;
        }
        StepDuration& duration = step.duration.emplace();
        step.duration_place = value.place;
        if (const TomlList* const list = value.list()) {
            duration.law = StepDuration::Law::one_of;
            for (const TomlValue& one : *list)
                read_seconds(one, name, duration.choices_s.emplace_back());
            if (list->empty())
                fault(value.place, fmt::format("{}: the list of durations is empty", name));
        } else if (const TomlTable* const table = value.table()) {
            read_law(*table, value.place, name, duration);
        } else {
            read_seconds(value, name, duration.choices_s.emplace_back());
        }
    }

    void read_law(const TomlTable& table, Place place, std::string_view name, StepDuration& duration) {
        duration.law = StepDuration::Law::uniform;
        bool is_right = true, has_from = false, has_to = false;
        Place mean_place;
        for (const TomlEntry& key : table) {
            if (key.key == "from") {
                has_from = true;
                is_right = read_seconds(key.value, "from", duration.from_s) && is_right;
            } else if (key.key == "to") {
                has_to = true;
                is_right = read_seconds(key.value, "to", duration.to_s) && is_right;
            } else if (key.key == "mean") {
                duration.law = StepDuration::Law::exponential;
                mean_place = key.value.place;
                is_right = read_seconds(key.value, "mean", duration.mean_s) && is_right;
            } else {
                fault(key.key_place, fmt::format("{}: unknown key \"{}\"", name, key.key),
                      "a duration that is drawn has from, to and, for the exponential law, mean");
                is_right = false;
            }
        }
        if (!is_right)
            return;
        if (!has_from || !has_to)
            fault(place, fmt::format("{}: a duration that is drawn needs from and to", name));
        else if (!(duration.from_s < duration.to_s))
            fault(place, fmt::format("{}: from {:g} to {:g} s there is nothing to draw", name,
                                     duration.from_s, duration.to_s));
        else if (duration.law == StepDuration::Law::exponential &&
                 !(duration.mean_s > duration.from_s &&
                   duration.mean_s < 0.5 * (duration.from_s + duration.to_s)))
            fault(
                mean_place,
                fmt::format("{}: the mean of {:g} s does not lie between {:g} s and the middle, {:g} s", name,
                            duration.mean_s, duration.from_s, 0.5 * (duration.from_s + duration.to_s)),
                "an exponential law that is cut off has its mean there; leave mean out for the uniform law");
    }

    void read_until(const TomlValue& value, StepSettings& step) {
        if (const auto* const word = std::get_if<std::string>(&value.content)) {
            step.ends_by_key = *word == "key";
            step.ends_by_answer = *word == "answer";
            step.answers_place = value.place;
            if (!step.ends_by_key && !step.ends_by_answer)
                fault(value.place, fmt::format("until: unknown value \"{}\"", *word),
                      "write \"key\", \"answer\", or what gaze is waited for: { gaze_within_deg = 1.5, "
                      "patience_s = 5 }");
            return;
        }
        const TomlTable* const table = value.table();
        if (!table) {
            fault(value.place,
                  fmt::format("until: expected \"key\", \"answer\" or a table, found {}", value.kind()));
            return;
        }
        GazeWait& wait = step.gaze.emplace();
        const std::size_t before = faults.size();
        for (const TomlEntry& key : *table)
            read_wait(key, wait, step);
        if (!wait.within_deg && wait.area.empty() && faults.size() == before)
            fault(value.place, "until: nothing says where gaze is waited for",
                  "write gaze_within_deg = 1.5, or gaze_on with a part of the object");
        if (wait.within_deg && !wait.area.empty())
            fault(value.place, "until: gaze is waited for in two places", "leave out one");
    }

    void read_wait(const TomlEntry& key, GazeWait& wait, StepSettings& step) {
        if (key.key == "key")
            take(key.value, key.key, step.ends_by_key);
        else if (key.key == "gaze_within_deg")
            take(key.value, key.key, wait.within_deg, range(0.05, 90, "deg"));
        else if (key.key == "gaze_on") {
            wait.area_place = key.value.place;
            take(key.value, key.key, wait.area, required());
        } else if (key.key == "slot") {
            wait.slot_place = key.value.place;
            take(key.value, key.key, wait.slot, required());
        } else if (key.key == "for_s")
            read_seconds(key.value, key.key, wait.for_s);
        else if (key.key == "blink_s")
            take(key.value, key.key, wait.blink_s, range(0, 2, "s"));
        else if (key.key == "patience_s")
            read_seconds(key.value, key.key, wait.patience_s.emplace());
        else if (key.key == "otherwise")
            take(key.value, key.key, wait.otherwise, one_of(names_of<GazeMissed>));
        else
            fault(key.key_place, fmt::format("until: unknown key \"{}\"", key.key),
                  "keys are gaze_within_deg, gaze_on, slot, for_s, blink_s, patience_s, otherwise, key");
    }
};

ValueResult read_steps(const TomlValue& value, const KeyRule& rule, void* out) {
    if (!value.list())
        return ValueFault{value.place,
                          fmt::format("{}: expected a list of steps, found {}", rule.name, value.kind())};
    StepReader reader;
    reader.read(value, *static_cast<std::vector<StepSettings>*>(out));
    if (reader.faults.empty())
        return std::nullopt;
    ValueFault first = reader.faults.front();
    first.more.assign(reader.faults.begin() + 1, reader.faults.end());
    return first;
}

nlohmann::ordered_json steps_schema(const KeyRule&) {
    nlohmann::ordered_json kinds = nlohmann::ordered_json::array();
    for (const StepKindRow& row : step_kinds)
        kinds.push_back({{"required", nlohmann::ordered_json::array({row.name})}});
    return {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "object"}, {"anyOf", kinds}}}};
}

constexpr ValueType steps_type{"a list of steps", read_steps, steps_schema, nullptr};

} // namespace

const ValueType& value_type(TypeTag<std::vector<StepSettings>>) { return steps_type; }

} // namespace overt
