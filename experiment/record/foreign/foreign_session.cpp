#include "experiment/record/foreign/foreign_session.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/foreign/foreign_frames.h"
#include "experiment/stimulus_lists.h"

namespace overt {
namespace {

/// Gaze before the onset that belongs to the trial, as the drift check's does in a session of our own.
constexpr SessionDuration before_onset = std::chrono::milliseconds(500),
                          after_end = std::chrono::milliseconds(100);

std::string in_small_letters(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// "media/Muse gold.png" as "muse_gold".
std::string plain_name(const std::string& text) {
    std::string name = in_small_letters(
        text.substr(text.find_last_of("/\\") == std::string::npos ? 0 : text.find_last_of("/\\") + 1));
    for (const std::string_view ending :
         {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".mp4", ".avi", ".mov", ".webm", ".gif"})
        if (name.ends_with(ending))
            name.erase(name.size() - ending.size());
    std::ranges::replace(name, ' ', '_');
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Looks up what a log's words name.
class Namer {
  public:
    explicit Namer(const SessionHeader& header) : header_(header) {
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
            entries_[list] = entries_of(header, list);
        add_names(0, {});
    }

    /// Nothing: the word "stimulus" names none of the protocol's.
    std::optional<Stimulus> stimulus(const LoggedTrial& logged, const std::string& slot) const {
        Stimulus found;
        if (const auto word = logged.words.find(slot + "stimulus"); word != logged.words.end()) {
            const auto whole = names_.find(in_small_letters(word->second));
            const auto plain = names_.find(plain_name(word->second));
            if (whole == names_.end() && plain == names_.end())
                return std::nullopt;
            found = whole != names_.end() ? whole->second : plain->second;
        }
        const bool has_stimulus = logged.words.contains(slot + "stimulus");
        for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
            const std::string factor = slot + std::string(stimulus_lists[list].name);
            const auto word = logged.words.find(factor);
            if (word == logged.words.end()) {
                if (!has_stimulus && entries_[list].size() > 1)
                    throw InputError(fmt::format("{}: nothing says which {} was shown: name the column, "
                                                 "--trial-columns {}=NAME; the protocol has {}",
                                                 logged.place, stimulus_lists[list].name, factor,
                                                 ids(entries_[list])));
                continue;
            }
            found.*stimulus_lists[list].index = index_in(entries_[list], word->second, factor, logged.place);
        }
        return found;
    }

    int task(const LoggedTrial& logged) const {
        std::vector<std::string> ids;
        for (const RecordedTask& task : header_.tasks)
            ids.push_back(task.id);
        const auto word = logged.words.find("task");
        if (word == logged.words.end()) {
            if (ids.size() > 1)
                throw InputError(fmt::format("{}: nothing says which task it was: name the column, "
                                             "--trial-columns task=NAME; the protocol has {}",
                                             logged.place, fmt::join(ids, ", ")));
            return 0;
        }
        for (std::size_t i = 0; i < header_.tasks.size(); ++i)
            if (header_.tasks[i].id == word->second || header_.tasks[i].question == word->second)
                return static_cast<int>(i);
        throw InputError(fmt::format("{}: the protocol has no task \"{}\"; it has {}", logged.place,
                                     word->second, fmt::join(ids, ", ")));
    }

    /// The trial's stimuli in the slots that the log names; else the one in the first slot.
    std::vector<PlacedStimulus> shown(const LoggedTrial& logged) const {
        std::vector<PlacedStimulus> all;
        for (std::size_t slot = 0; slot < header_.slots.size(); ++slot) {
            const std::string prefix = header_.slots[slot].id + ".";
            const auto at = logged.words.lower_bound(prefix);
            if (at == logged.words.end() || !at->first.starts_with(prefix))
                continue;
            if (const std::optional<Stimulus> in_slot = stimulus(logged, prefix))
                all.push_back({*in_slot, static_cast<int>(slot)});
            else
                return {};
        }
        if (!all.empty())
            return all;
        if (const std::optional<Stimulus> one = stimulus(logged, ""))
            all.push_back({*one, slot_of(logged)});
        return all;
    }

    std::string known_stimuli() const {
        std::vector<std::string> names;
        for (const RecordedStimulus& stimulus : header_.stimuli)
            if (names.size() < 12)
                names.push_back(stimulus_name(header_, stimulus.stimulus));
        return fmt::format("{}", fmt::join(names, ", "));
    }

    /// Words that are neither of lists, nor task or slot: levels of the trial's own.
    std::vector<TrialLevel> levels(const LoggedTrial& logged) const {
        std::vector<TrialLevel> levels;
        for (const auto& [factor, level] : logged.words) {
            const bool is_of_list =
                factor == "stimulus" || factor == "task" || factor == "slot" ||
                factor.find('.') != std::string::npos ||
                std::ranges::find(stimulus_lists, factor, &StimulusList::name) != stimulus_lists.end();
            if (!is_of_list)
                levels.push_back({factor, level});
        }
        return levels;
    }

  private:
    static std::string ids(const std::vector<ListEntry>& entries) {
        std::vector<std::string> ids;
        for (const ListEntry& entry : entries)
            ids.push_back(entry.id);
        return fmt::format("{}", fmt::join(ids, ", "));
    }
    static int index_in(const std::vector<ListEntry>& entries, const std::string& word,
                        const std::string& factor, const std::string& place) {
        for (std::size_t i = 0; i < entries.size(); ++i)
            if (entries[i].id == word || (!entries[i].title.empty() && entries[i].title == word))
                return static_cast<int>(i);
        throw InputError(
            fmt::format("{}: the protocol has no {} \"{}\"; it has {}", place, factor, word, ids(entries)));
    }
    int slot_of(const LoggedTrial& logged) const {
        const auto word = logged.words.find("slot");
        if (word == logged.words.end())
            return 0;
        for (std::size_t i = 0; i < header_.slots.size(); ++i)
            if (header_.slots[i].id == word->second)
                return static_cast<int>(i);
        throw InputError(fmt::format("{}: the protocol has no slot \"{}\"", logged.place, word->second));
    }
    /// Each stimulus by its name, also with what else may stand between ids, and by the ids of lists with a
    /// choice alone.
    void add_names(std::size_t list, Stimulus stimulus) {
        if (list == stimulus_lists.size()) {
            for (const std::string_view between : {"/", "_"})
                names_.emplace(in_small_letters(stimulus_name(header_, stimulus, between)), stimulus);
            std::string chosen;
            for (std::size_t i = 0; i < stimulus_lists.size(); ++i)
                if (entries_[i].size() > 1)
                    chosen += (chosen.empty() ? "" : "_") +
                              entries_[i][static_cast<std::size_t>(stimulus.*stimulus_lists[i].index)].id;
            if (!chosen.empty())
                names_.emplace(plain_name(chosen), stimulus);
            return;
        }
        for (std::size_t i = 0; i < entries_[list].size(); ++i) {
            stimulus.*stimulus_lists[list].index = static_cast<int>(i);
            add_names(list + 1, stimulus);
        }
    }

    const SessionHeader& header_;
    std::array<std::vector<ListEntry>, stimulus_lists.size()> entries_;
    std::map<std::string, Stimulus> names_;
};

/// Trials that overlap are not two.
void set_windows(std::vector<ForeignTrial>& trials) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
        ForeignTrial& trial = trials[i];
        if (i > 0 && trial.onset < trials[i - 1].end)
            throw InputError(fmt::format(
                "{}: this trial begins before the one before it ({}) has ended: say when trials end, "
                "--trial-columns end=NAME or duration=NAME",
                trial.logged.place, trials[i - 1].logged.place));
        trial.from = trial.onset - before_onset;
        trial.until = std::max(trial.end, trial.responded.value_or(trial.end)) + after_end;
        if (i == 0)
            continue;
        ForeignTrial& before = trials[i - 1];
        before.until = std::min(before.until, trial.onset);
        trial.from = std::max(trial.from, before.until);
    }
}

} // namespace

ForeignPlan plan_foreign_trials(const SessionHeader& header, const TrialLog& log, const std::string& log_file,
                                const GazeSurvey& gaze, const std::optional<std::vector<LoggedFrame>>& frames,
                                bool may_have_others) {
    ForeignPlan plan;
    plan.clocks = relate_clocks(log, gaze, log_file);
    plan.remarks = log.remarks;
    plan.remarks.insert(plan.remarks.end(), plan.clocks.remarks.begin(), plan.clocks.remarks.end());
    plan.validations = validations_in_messages(gaze.marks);
    const Namer namer(header);
    std::map<std::string, int> others;
    for (const LoggedTrial& logged : log.trials) {
        const std::vector<PlacedStimulus> shown = namer.shown(logged);
        if (shown.empty()) {
            const auto word = logged.words.find("stimulus");
            const std::string name = word == logged.words.end() ? std::string("?") : word->second;
            if (!may_have_others)
                throw InputError(fmt::format("{}: \"{}\" is no stimulus of the protocol, which has {}",
                                             logged.place, name, namer.known_stimuli()));
            ++others[name];
            continue;
        }
        ForeignTrial trial;
        trial.logged = logged;
        trial.trial.index = static_cast<int>(plan.trials.size());
        trial.trial.task = namer.task(logged);
        trial.trial.stimulus = shown.front().stimulus;
        trial.trial.slot = shown.front().slot;
        trial.trial.beside.assign(shown.begin() + 1, shown.end());
        trial.trial.levels = namer.levels(logged);
        trial.trial.correct = logged.correct;
        trial.onset = plan.clocks.session(logged.onset);
        if (logged.response_time)
            trial.responded = trial.onset + SessionDuration(*logged.response_time);
        plan.trials.push_back(std::move(trial));
    }
    for (const auto& [name, count] : others)
        plan.remarks.push_back(
            fmt::format("\"{}\" ({} times) is no stimulus of the protocol and is left out.", name, count));
    if (plan.trials.empty()) {
        std::vector<std::string> names;
        for (const auto& [name, count] : others)
            if (names.size() < 12)
                names.push_back(name);
        throw InputError(fmt::format("{}: none of its trials shows a stimulus of the protocol, which has {}; "
                                     "they show {}",
                                     log_file, namer.known_stimuli(), fmt::join(names, ", ")));
    }
    add_flips(header, frames, plan);
    set_windows(plan.trials);
    return plan;
}

} // namespace overt
