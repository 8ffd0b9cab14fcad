#include <fmt/format.h>

#include "experiment/study/methods/methods_topics.h"
#include "experiment/study/methods/sentences.h"

namespace overt {

namespace {

void add_maps(std::string& text, const StudyResults& results, const StudyOptions& options) {
    const std::optional<MapCounts> counts = map_counts(results);
    if (!counts)
        return;
    const std::string least_mm = as_measured(counts->least_sigma_mm, 1),
                      most_mm = as_measured(counts->most_sigma_mm, 1);
    const char* const kernel =
        options.kernel == MapKernel::geodesic ? "the weight of each fixation spread along the surface as "
                                                "heat, which gives a Gaussian along the "
                                                "surface"
        : options.kernel == MapKernel::euclidean
            ? "the weight of each fixation was spread as a Gaussian in space over the vertices of the surface"
            : "the weight of each fixation was spread as a Gaussian in space over a grid of voxels";
    std::string clause =
        fmt::format("in {} of the time of fixation, and as many of the number of fixations, {} "
                    "with a standard deviation of {} {}",
                    as_counted(counts->maps, "map"), kernel, as_set(options.sigma.value),
                    options.sigma.is_mm ? "mm" : "deg");
    if (!options.sigma.is_mm)
        clause += least_mm == most_mm
                      ? fmt::format("; that is {} mm of the object", most_mm)
                      : fmt::format("; that is {} to {} mm of the object, by the depths of the fixations",
                                    least_mm, most_mm);
    add_sentence(text, clause);
}

std::string words_of_areas(const std::vector<std::string>& areas) {
    if (areas.size() == 1)
        return areas.front() == head_area ? "the head" : fmt::format("the area {}", areas.front());
    return fmt::format("the areas {}", joined_words(areas));
}

void add_areas(std::string& text, const StudyResults& results) {
    const auto has = [](auto what) {
        return [what](const AreaRow& row) { return std::invoke(what, row).value.has_value(); };
    };
    if (!std::ranges::any_of(results.area_rows, has(&AreaRow::by_count)))
        return;
    add_sentence(text, fmt::format("shares of fixations on {} are means over observers of their own shares",
                                   words_of_areas(results.areas)));
    if (std::ranges::any_of(results.area_rows, has(&AreaRow::corrected)))
        add_sentence(text,
                     "the corrected shares have the eye tracker's error taken out: they are those under "
                     "which the measured places are most probable, where the fixations of a trial share an "
                     "error that is as large as the validation before it says");
}

/// After the sentences on pairs.
void add_area_pairs(std::string& text, const StudyResults& results) {
    const auto tested =
        std::ranges::find_if(results.area_pairs, [](const AreaPairRow& row) { return row.p.has_value(); });
    if (tested == results.area_pairs.end())
        return;
    add_sentence(
        text, fmt::format(
                  "differences of shares of fixations on {} between levels of {} were tested by flipping "
                  "the signs of observers' differences; each p is given as it is, after Holm's correction "
                  "for the rows of the area, where rows over all groups are corrected apart{}",
                  words_of_areas(results.compared_areas), tested->column,
                  results.compared_areas.size() > 1 ? ", and after the same for the rows of all areas" : ""));
}

void add_pairs(std::string& text, const StudyResults& results) {
    const auto compared =
        std::ranges::find_if(results.pairs, [](const PairRow& row) { return row.absent.empty(); });
    if (compared == results.pairs.end())
        return;
    add_sentence(text, fmt::format("levels of {} were compared within observers, on each object that an "
                                   "observer saw in both, and averaged over objects and then over observers",
                                   compared->column));
    const auto any = [&](std::optional<double> PairRow::*p) {
        return std::ranges::any_of(results.pairs, [p](const PairRow& row) { return (row.*p).has_value(); });
    };
    const bool has_spreads = any(&PairRow::wss_p);
    if (has_spreads)
        add_sentence(text, "differences of WSS, in deg2, were tested by flipping the signs of observers' "
                           "differences");
    if (any(&PairRow::maps_p))
        add_sentence(text, "whether maps differ was tested by the correlation of the maps of all observers "
                           "together, with the two levels of an observer swapped, whole maps at once "
                           "(maps_p)");
    if (has_spreads || any(&PairRow::maps_p))
        add_sentence(
            text,
            "each p is given as it is and after Holm's correction for the rows of the table, where rows over "
            "all groups are corrected apart");
}

/// After the sentences on pairs, of which there are some then.
void add_measures(std::string& text, const StudyResults& results) {
    if (results.measure_differences.empty())
        return;
    add_sentence(
        text, fmt::format("other measures of trials, such as dwell, first arrival, transitions and ways "
                          "along the surface, were compared between levels of {} within observers, on the "
                          "same object with all else alike, and tested by flipping the signs of observers' "
                          "differences",
                          results.measure_differences.front().column));
    if (std::ranges::any_of(results.time_clusters, [](const TimeClusterRow& row) { return row.number > 0; }))
        add_sentence(text,
                     "when levels differ was tested by clusters of successive stretches of time, with the "
                     "signs of whole observers flipped");
}

void add_differences(std::string& text, const StudyResults& results, const StudyOptions& options) {
    const auto tested = std::ranges::find_if(results.differences,
                                             [](const DifferenceMap& map) { return map.absent.empty(); });
    if (tested == results.differences.end())
        return;
    add_sentence(
        text,
        fmt::format("where on the surface levels of {} differ was tested within observers by clusters of "
                    "neighbouring places, with the signs of whole observers flipped{}; p is corrected "
                    "over the surface, that of clusters over all maps, too",
                    tested->column,
                    options.threshold_free ? ", and by threshold-free cluster enhancement" : ""));
}

void add_intervals(std::string& text, const StudyResults& results, const StudyOptions& options) {
    const double percent = 100.0 * options.confidence;
    if (results.glance.observers < 3) {
        add_sentence(text, "there are no intervals over observers, for which it takes at least three");
        return;
    }
    add_sentence(text, fmt::format("intervals are of {} % and over observers", as_set(percent)));
    add_sentence(text,
                 fmt::format("of shares, durations, counts and other numbers with a least one they are "
                             "Student's on the scale of logits or logarithms where there are fewer than 25 "
                             "observers, of others where there are fewer than ten; else they are bootstraps "
                             "(BCa) with {} draws",
                             as_count(options.resamples)));
}

} // namespace

std::string statistics_text(const StudyResults& results, const StudyOptions& options) {
    std::string text;
    if (results.glance.counted == 0)
        return text;
    add_maps(text, results, options);
    add_areas(text, results);
    add_pairs(text, results);
    add_area_pairs(text, results);
    add_measures(text, results);
    add_differences(text, results, options);
    add_intervals(text, results, options);
    add_sentence(text, fmt::format("all that was drawn at random follows from the seed {}", options.seed));
    return text;
}

} // namespace overt
