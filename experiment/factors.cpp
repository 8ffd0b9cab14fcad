#include "experiment/factors.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"

namespace overt {

namespace {

Factor factor_of_ids(std::string name, Factor::Source source, const std::vector<std::string>& ids) {
    Factor factor{std::move(name), source, 0, {}, {}};
    for (const std::string& id : ids)
        factor.levels.push_back({id});
    return factor;
}

Factor factor_of_list(std::size_t list, const std::vector<ListEntry>& entries) {
    Factor factor{std::string(stimulus_lists[list].name), Factor::Source::list, list, {}, {}};
    for (const ListEntry& entry : entries) {
        factor.level_of_entry.push_back(static_cast<int>(factor.levels.size()));
        factor.levels.push_back({entry.id});
    }
    return factor;
}

const NamedWord* column_of(const ListEntry& entry, std::string_view name) {
    const auto found = std::ranges::find(entry.columns, name, &NamedWord::name);
    return found == entry.columns.end() ? nullptr : &*found;
}

Factor factor_of_column(std::string_view name, std::size_t list, const std::vector<ListEntry>& entries) {
    Factor factor{std::string(name), Factor::Source::column, list, {}, {}};
    const auto level_of = [&](const ListEntry& entry) {
        const NamedWord* column = column_of(entry, name);
        return column ? FactorLevel{column->text, column->number} : FactorLevel{std::string(no_level)};
    };
    for (const ListEntry& entry : entries)
        if (std::ranges::find(factor.levels, level_of(entry)) == factor.levels.end())
            factor.levels.push_back(level_of(entry));
    // Words keep the order of the file, and come behind the numbers.
    std::ranges::stable_sort(factor.levels, [](const FactorLevel& one, const FactorLevel& other) {
        return one.number && (!other.number || *one.number < *other.number);
    });
    for (const ListEntry& entry : entries)
        factor.level_of_entry.push_back(
            static_cast<int>(std::ranges::find(factor.levels, level_of(entry)) - factor.levels.begin()));
    return factor;
}

Factor factor_of_own(std::string_view name, const std::vector<NamedWord>& own) {
    Factor factor{std::string(name), Factor::Source::own, 0, {}, {}};
    for (const NamedWord& level : own)
        if (level.name == name)
            factor.levels.push_back({level.text, level.number});
    std::ranges::stable_sort(factor.levels, [](const FactorLevel& one, const FactorLevel& other) {
        return one.number && (!other.number || *one.number < *other.number);
    });
    factor.levels.push_back({std::string(no_level)});
    return factor;
}

} // namespace

std::string_view own_level(const Trial& trial, std::string_view factor) {
    if (factor == correct_answer)
        return trial.correct;
    const auto found = std::ranges::find(trial.levels, factor, &TrialLevel::factor);
    return found == trial.levels.end() ? std::string_view() : found->level;
}

void OwnLevels::add(std::string_view factor, std::string_view level) {
    if (!level.empty() && known_.emplace(factor, level).second)
        levels_.push_back({std::string(factor), std::string(level), number_in<double>(level)});
}

std::vector<NamedWord> own_levels_of(const std::vector<Trial>& trials) {
    OwnLevels own;
    for (const Trial& trial : trials) {
        for (const TrialLevel& of : trial.levels)
            own.add(of.factor, of.level);
        own.add(correct_answer, trial.correct);
    }
    return own.levels();
}

Factors::Factors(const FactorSources& sources) {
    all_.push_back(factor_of_ids("task", Factor::Source::task, sources.tasks));
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        entries_[list] = sources.lists[list].size();
        all_.push_back(factor_of_list(list, sources.lists[list]));
    }
    all_.push_back(factor_of_ids("stimulus", Factor::Source::stimulus, {}));
    if (!sources.blocks.empty())
        all_.push_back(factor_of_ids("block", Factor::Source::block, sources.blocks));
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        for (const ListEntry& entry : sources.lists[list])
            for (const NamedWord& column : entry.columns)
                if (!find(column.name))
                    all_.push_back(factor_of_column(column.name, list, sources.lists[list]));
    for (const NamedWord& level : sources.own)
        if (!find(level.name))
            all_.push_back(factor_of_own(level.name, sources.own));
}

const Factor* Factors::find(std::string_view name) const {
    const auto found = std::ranges::find(all_, name, &Factor::name);
    return found == all_.end() ? nullptr : &*found;
}

const Factor& Factors::at(std::string_view name) const {
    const Factor* factor = find(name);
    OVERT_EXPECTS(factor != nullptr);
    return *factor;
}

std::vector<std::string_view> Factors::names() const {
    std::vector<std::string_view> names;
    for (const Factor& factor : all_)
        names.push_back(factor.name);
    return names;
}

int Factors::level_of(const Factor& factor, const Trial& trial) const {
    return level_of(factor, trial, trial.stimulus);
}

int Factors::level_of(const Factor& factor, const Trial& trial, const Stimulus& stimulus) const {
    int number = 0;
    switch (factor.source) {
    case Factor::Source::task:
        return trial.task;
    case Factor::Source::block:
        return trial.block;
    case Factor::Source::list:
    case Factor::Source::column:
        return factor.level_of_entry.at(
            static_cast<std::size_t>(stimulus.*stimulus_lists[factor.list].index));
    case Factor::Source::own: {
        const auto level =
            std::ranges::find(factor.levels, own_level(trial, factor.name), &FactorLevel::name);
        return static_cast<int>(
            std::min(level - factor.levels.begin(), static_cast<std::ptrdiff_t>(factor.levels.size()) - 1));
    }
    case Factor::Source::stimulus:
        break;
    }
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        number = number * static_cast<int>(entries_[list]) + stimulus.*stimulus_lists[list].index;
    return number;
}

std::size_t Factors::stimulus_count() const {
    std::size_t count = 1;
    for (const std::size_t entries : entries_)
        count *= entries;
    return count;
}

Stimulus Factors::stimulus_at(int number) const {
    Stimulus stimulus;
    for (std::size_t list = stimulus_lists.size(); list-- > 0;) {
        stimulus.*stimulus_lists[list].index = number % static_cast<int>(entries_[list]);
        number /= static_cast<int>(entries_[list]);
    }
    return stimulus;
}

bool is_name_of_factor(std::string_view name) {
    // Columns that tables of trials, samples, answers, events and studies have besides, and BIDS's events.
    constexpr std::string_view others =
        " accepted along angle_deg answer answered_s area attempt block changes comes_again correct "
        "correct_answer counts day depth deviation_deg device drawn_by drift_deg duration duration_s "
        "end_deg error eye failure first_input_s frame frames frames_sha256 gaze_share group high id "
        "image_x_px image_y_px incidence_deg is_correct item key kind longest_delay_s lost_flips "
        "lost_samples low made_from_sha256 mapping median_delay_s mesh_file mesh_sha256 "
        "missed_refreshes mm_per_unit n net_deg number observer onset origin_x origin_y origin_z "
        "p_object part path_deg phase place point_frame point_image_x_px point_image_y_px "
        "point_incidence_deg point_part point_sd_major point_sd_minor point_slot point_triangle "
        "point_x point_y point_z pose poses presentation_end_s presentation_onset_s pupil_size "
        "question reference responded_s response response_box response_id response_key "
        "response_number response_screen_onset_s response_time response_time_s response_uncertainty_s "
        "reversals role samples samples_off_plan samples_on_object samples_without_gaze "
        "screen_onset_s second_setting second_setting_reference second_setting_start seen session "
        "setting setting_reference setting_start shown_refreshes shown_s shown_size side "
        "silhouette_distance_deg sitting slant_deg slot source start start_deg started_s status step "
        "stim_file stimulus stimulus_onset_s stopped_high stopped_low surface_x surface_y surface_z "
        "swaps_copied swaps_flipped swaps_skipped swaps_suboptimal_copied task task_screen_onset_s "
        "tied tilt_deg time_s time_uncertainty_s timing tracker_onset tracker_time_us trial "
        "trial_type triangle true_slant_deg true_tilt_deg turning_s uncertainty_s value window_end_s "
        "window_onset_s x_px y_px zero ";
    return others.find(fmt::format(" {} ", name)) != std::string_view::npos ||
           std::ranges::find(stimulus_lists, name, &StimulusList::name) != stimulus_lists.end();
}

} // namespace overt
